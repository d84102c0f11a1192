"""How far voxels are from those that hold something."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import distance_transform_cdt

from magwire.kernels.wall.seeds import spread


@pytest.mark.parametrize("held", [1, 5, 200])
def test_voxels_count_their_way_to_the_nearest_as_scipy_does(held: int) -> None:
    rng = np.random.default_rng(held)
    shape = np.array([13, 7, 29])
    holds = rng.choice(shape.prod(), held, replace=False)
    away = np.full(shape.prod(), shape.max(), dtype=np.int32)
    away[holds] = 0
    spread(away, shape)
    empty = np.ones(tuple(shape), dtype=np.int32)
    empty.ravel()[holds] = 0
    np.testing.assert_array_equal(away, distance_transform_cdt(empty, metric="chessboard").ravel())

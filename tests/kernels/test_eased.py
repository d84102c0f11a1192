"""The Hessian of a wall of triangles that Newton's steps are made of (P-14)."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.kernels.wall.eased import without_bulges

PLACES = np.array([[0, 1, 2], [1, 3, 4], [2, 4, 5]])


@pytest.mark.parametrize("seed", range(20))
def test_bulges_go_and_nothing_else(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n, six = rng.normal(size=3), rng.normal(size=6)
    if seed % 4 == 0:
        n = np.eye(3)[seed // 4 % 3]
    whole = six[PLACES]
    eased = np.array(without_bulges(tuple(n), tuple(six)))[PLACES]
    across = np.linalg.svd(n[None])[2][1:]
    before = np.linalg.eigvalsh(across @ whole @ across.T)
    after = np.linalg.eigvalsh(across @ eased @ across.T)
    np.testing.assert_allclose(after, np.sort(np.minimum(before, 0.0)), atol=1e-13)
    np.testing.assert_allclose((whole - eased) @ n, 0.0, atol=1e-13)
    assert np.linalg.eigvalsh(whole - eased).min() > -1e-13


def test_round_walls_stay_as_they_are() -> None:
    hollow = (-3.0, 0.0, 0.0, -3.0, 0.0, 0.0)
    np.testing.assert_array_equal(without_bulges((0.0, 0.0, 1.0), hollow), hollow)
    bulging = (3.0, 0.0, 0.0, 3.0, 0.0, 1.0)
    np.testing.assert_allclose(without_bulges((0.0, 0.0, 1.0), bulging), [0, 0, 0, 0, 0, 1.0])

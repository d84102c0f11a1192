"""Axes of an export: to the left, posterior, superior, as magwire has them, or RAS."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Frame = Literal["lps", "ras"]
FRAMES: tuple[Frame, ...] = ("lps", "ras")
"""DICOM's axes, which magwire works in, and those of 3D Slicer's scenes and of NIfTI."""


def turned(vectors: ArrayLike, frame: Frame) -> Array:
    """Vectors of magwire's in another frame, shape (..., 3).

    Half a turn about z: forces, torques and flux densities turn as positions do.
    """
    signs = np.array([-1.0, -1.0, 1.0]) if frame == "ras" else np.ones(3)
    found: Array = np.asarray(vectors, dtype=np.float64) * signs + 0.0  # no negative zeros
    return found

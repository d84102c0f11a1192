"""Arrays as short texts for a page: exact, or in whole steps of a stated size."""

from __future__ import annotations

import zlib
from base64 import b64encode
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Packed = dict[str, Any]
LARGEST = 2**28
"""Steps up to which second differences stay within 32 bits."""


def exact(values: ArrayLike, kind: str = "float64") -> Packed:
    """Numbers as they are, in one of the kinds "float64" and "float32"."""
    array = np.ascontiguousarray(values, dtype=np.dtype(kind).newbyteorder("<"))
    return {"kind": kind, "shape": list(array.shape), "data": _text(array.tobytes())}


def in_steps(values: ArrayLike, step: float) -> Packed:
    """Numbers rounded to whole steps: none is off by more than half of one.

    What moves evenly along the first axis has second differences of nearly nothing, and their upper
    bytes, which are kept together, take no room.

    Parameters
    ----------
    values
        Finite numbers.
    step
        Size of a step, in their unit; it is made larger where 28 bits do not reach.
    """
    array = np.asarray(values, dtype=np.float64)
    largest = float(np.max(np.abs(array), initial=0.0))
    step = max(step, largest / LARGEST) or 1.0
    steps = np.rint(array / step).astype(np.int64)
    for _ in range(2):
        steps = np.diff(steps, axis=0, prepend=np.zeros_like(steps[:1]))
    zigzag: NDArray[Any] = ((steps << 1) ^ (steps >> 63)).astype("<u4")
    planes = np.ascontiguousarray(zigzag).view(np.uint8).reshape(-1, 4).T
    text = _text(planes.tobytes())
    return {"kind": "steps", "shape": list(array.shape), "step": step, "data": text}


def _text(data: bytes) -> str:
    return b64encode(zlib.compress(data, 9)).decode("ascii")

"""Fields in VTK images."""

from __future__ import annotations

from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from magwire.errors import InputError

Array = NDArray[np.float64]


def read_image(data: bytes, name: str) -> tuple[Array, Array, Array]:
    """First point and step, shape (3,) [m], and flux density, shape (i, j, k, 3), of a .vti file.

    Parameters
    ----------
    data
        The file: one piece, with one array of three components over its points, in ASCII.
    name
        How messages call it.

    Raises
    ------
    InputError
        If it is not that, or its axes are not along x, y and z.
    """
    if b"<!ENTITY" in data or b"<!DOCTYPE" in data:
        raise InputError(f"{name} must have no document type.")
    if b"<AppendedData" in data or b'format="binary"' in data:
        raise InputError(
            f"{name} must have its numbers in ASCII: write it so, by SetDataModeToAscii() in VTK "
            "or Data Mode Ascii in ParaView."
        )
    try:
        image = ElementTree.fromstring(data).find("ImageData")
    except (ElementTree.ParseError, ValueError, LookupError):
        image = None
    if image is None:
        raise InputError(f"{name} must be a VTK image.")
    known = image.findall("Piece/PointData/DataArray")
    fields = [one for one in known if one.get("NumberOfComponents") == "3"]
    if len(fields) != 1:
        raise InputError(
            f"{name} must have one array of 3 components over its points; received {len(fields)}."
        )
    turn = image.get("Direction", "1 0 0 0 1 0 0 0 1")  # VTK 9 writes it with every image
    if not _unturned(turn):
        raise InputError(
            f"{name} must have its axes along x, y and z, Direction 1 0 0 0 1 0 0 0 1; "
            f"received {' '.join(turn.split())}."
        )
    try:
        extent = [int(v) for v in image.attrib["WholeExtent"].split()]
        step = np.array([float(v) for v in image.attrib["Spacing"].split()])
        origin = np.array([float(v) for v in image.attrib["Origin"].split()])
        flux = np.array((fields[0].text or "").split(), dtype=np.float64)
        low, high = extent[::2], extent[1::2]
        shape = [b - a + 1 for a, b in zip(low, high, strict=True)]
        values = flux.reshape(shape[2], shape[1], shape[0], 3).transpose(2, 1, 0, 3)
        first = origin + step * np.array(low)
    except (KeyError, ValueError, TypeError):
        raise InputError(
            f"{name} must have WholeExtent, Spacing and Origin that fit its array."
        ) from None
    if not all(np.all(np.isfinite(some)) for some in (first, step, flux)):
        raise InputError(f"{name} must have finite numbers; received some that are not.")
    if not np.all(step > 0.0):
        raise InputError(f"{name} must have a positive Spacing; received {step.tolist()}.")
    return first, step, values


def _unturned(direction: str) -> bool:
    """Whether an image's direction matrix, by rows, is the identity."""
    try:
        return bool(np.allclose(np.array(direction.split(), float).reshape(3, 3), np.eye(3)))
    except ValueError:
        return False

"""Fields in NetCDF files: versions 3 and 4, of which the latter is HDF5."""

from __future__ import annotations

import io
import warnings
from collections.abc import Container
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.errors import InputError

Array = NDArray[np.float64]
HDF = b"\x89HDF"
NAMES = ("x", "y", "z", "Bx", "By", "Bz")
PACKED = ("scale_factor", "add_offset")


class _Variable(NamedTuple):
    """Numbers over named dimensions; packed: they stand for others."""

    values: Array
    dimensions: tuple[str, ...]
    packed: bool

    @classmethod
    def of(cls, stored: Any, attributes: Container[str]) -> _Variable:
        values = np.array(stored[:], dtype=np.float64)
        return cls(values, tuple(stored.dimensions), any(a in attributes for a in PACKED))


def read_netcdf(data: bytes, name: str) -> tuple[Array, Array]:
    """Points, shape (n, 3) [m], and flux density there, shape (n, 3) [T].

    Parameters
    ----------
    data
        The file: variables x, y, z [m], and Bx, By, Bz [T] over them in any order.
    name
        How messages call it.

    Raises
    ------
    InputError
        If it is not that, or its numbers are packed.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            read = _version_4(data) if data.startswith(HDF) else _version_3(data)
    except Exception:  # a broken file may raise anything in there
        raise InputError(f"{name} must be NetCDF with the variables {', '.join(NAMES)}.") from None
    if any(variable.packed for variable in read.values()):
        raise InputError(
            f"{name} must have its numbers as they are; received some with a scale_factor or an "
            "add_offset."
        )
    if any(set(read[b].dimensions) != {"x", "y", "z"} for b in NAMES[3:]):
        raise InputError(f"{name} must have Bx, By and Bz over the dimensions x, y and z.")
    flux = [
        read[b].values.transpose([read[b].dimensions.index(a) for a in "xyz"]) for b in NAMES[3:]
    ]
    points = np.stack(np.meshgrid(*(read[a].values for a in "xyz"), indexing="ij"), axis=-1)
    return points.reshape(-1, 3), np.stack(flux, axis=-1).reshape(-1, 3)


def _version_3(data: bytes) -> dict[str, _Variable]:
    from scipy.io import netcdf_file

    file = netcdf_file(io.BytesIO(data), "r", mmap=False)
    return {name: _Variable.of(file.variables[name], vars(file.variables[name])) for name in NAMES}


def _version_4(data: bytes) -> dict[str, _Variable]:
    import h5netcdf

    with h5netcdf.File(io.BytesIO(data), "r") as file:
        return {name: _Variable.of(file[name], file[name].attrs) for name in NAMES}

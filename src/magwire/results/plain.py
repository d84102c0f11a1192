"""Result files read with h5py alone: xarray takes longer to import than a short run takes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magwire.pieces import Column, Plain
from magwire.results.contract import CONSTANTS, DERIVED, VARIABLES
from magwire.results.older import lacks_nothing

if TYPE_CHECKING:
    import xarray as xr

NOTES = {"units", "long_name", "flag_values", "flag_meanings", "_FillValue"}
"""Attributes of variables that magwire writes: others may change what the numbers mean."""
OWN = {
    "REFERENCE_LIST", "CLASS", "DIMENSION_LIST", "NAME",
    "_Netcdf4Dimid", "_Netcdf4Coordinates", "_nc3_strict", "_NCProperties",
}  # fmt: skip
"""Attributes that are NetCDF's own."""
NO_VARIABLE = b"This is a netCDF dimension but not a netCDF variable"


@dataclass(frozen=True)
class Stored(Column):
    """A variable whose numbers are read as they are asked for; its ``data`` is of h5py."""

    @property
    def values(self) -> NDArray[Any]:
        """All of it."""
        return np.asarray(self.data[...])


def read(file: Any, *, whole: bool) -> Plain | None:
    """What a file holds, if it is as this version writes it; None if it is of another kind.

    Parameters
    ----------
    file
        The ``h5py.File``; it stays in use if it is not read whole.
    whole
        Whether to read all numbers now, or as they are asked for.
    """
    variables: dict[str, Column] = {}
    for name, held in file.items():
        if bytes(held.attrs.get("NAME", b"")).startswith(NO_VARIABLE):
            continue
        notes = _notes(held.attrs)
        if name not in VARIABLES | DERIVED | CONSTANTS or notes.keys() - NOTES:
            return None
        notes.pop("_FillValue", None)  # a number that is not there is NaN in memory, too
        dims = tuple(Path(dim[0].name).name for dim in held.dims if len(dim)) or (name,)
        variables[name] = Column(dims, held[...], notes) if whole else Stored(dims, held, notes)
    return Plain(variables, _notes(file.attrs)) if lacks_nothing(variables) else None


def dataset(held: Plain) -> xr.Dataset:
    """The same for xarray, which reads what is not in memory as it is asked for, too."""
    import xarray as xr

    if held.source is not None:
        return xr.open_dataset(held.source, engine="h5netcdf")
    parts = {name: (c.dims, c.values, c.attrs) for name, c in held.variables.items()}
    return xr.Dataset(parts).assign_attrs(held.attrs).set_coords("time")


def _notes(attributes: Any) -> dict[str, Any]:
    """Attributes without NetCDF's own; numbers as such, which files hold as arrays of one."""
    found = {name: value for name, value in attributes.items() if name not in OWN}
    return {name: v[0] if np.shape(v) == (1,) else v for name, v in found.items()}

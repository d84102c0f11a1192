"""The records of a long run that make its picture: the curves' extremes, and the shapes drawn."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magwire.pieces import Column, Plain, piece, spans
from magwire.plot.shapes import snapshots

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

MOST = 1500
"""Records that are all drawn."""
STRETCHES = 200
"""Stretches of a longer run; a panel is a few hundred pixels wide."""


def _as_it_is(values: Array) -> Array:
    return values


def _highest(values: Array) -> Array:
    return np.asarray(values.max(axis=1, initial=-np.inf))


def _nearest(clearance: Array) -> Array:
    known = np.where(np.isfinite(clearance) & (clearance > 0.0), clearance, np.inf)
    return np.asarray(known.min(axis=1, initial=np.inf))


def _summed(force: Array) -> Array:
    return np.asarray(np.linalg.norm(force, axis=2).sum(axis=1))


def _part(k: int) -> Callable[[Array], Array]:
    """One column; a copy, as a view would keep all of a piece in memory."""
    return lambda values: values[:, k].copy()


CURVES: dict[str, tuple[Callable[[Array], Array], ...]] = {
    "normalized_push": (_as_it_is,),
    "normalized_tip_force": (_as_it_is,),
    "field": tuple(_part(k) for k in range(3)),
    "clearance": (_nearest, _part(-1)),
    "clearance_midpoint": (_as_it_is,),
    "wall_force": (_as_it_is,),
    "push_force": (_as_it_is,),
    "lumen_force": (_highest,),
    "friction_force": (_summed,),
    "friction_work": (_as_it_is,),
    "guide_twist": (_as_it_is,),
    "tip_twist": (_as_it_is,),
    "slip": (_highest, _part(-1)),
}
"""What figures draw of the variables, each a curve over the records."""
DRAWN = (*CURVES, "tip_force", "inputs", "position", "time")


def few(data: Any) -> Any:
    """A result with no more records than a figure can show, in memory.

    Parameters
    ----------
    data
        A result's variables; of a long run they may be in a file that is larger than memory.

    Returns
    -------
    xarray.Dataset or Plain
        The same if it is short. Of a longer run, of every stretch the first record and those where
        a curve is lowest and highest: what is drawn of them has the same extremes.
    """
    records = data.sizes["time"]
    if records <= MOST:
        return data
    chosen = {0, records - 1, *snapshots(data)}
    length = -(-records // STRETCHES)
    for name in DRAWN:
        for curve in CURVES.get(name, ()) if name in data else ():
            values = np.empty(records)
            for some in spans(data, name):
                values[some] = curve(piece(data, name, some))
            chosen |= _extremes(values, length)
    keep = np.array(sorted(chosen))
    made = {
        str(name): Column(held.dims, held.values, held.attrs)
        for name, held in data.variables.items()
        if "time" not in held.dims
    }
    for name in DRAWN:
        if name in data.variables:
            held = data.variables[name]
            made[name] = Column(held.dims, _gathered(data, name, keep), held.attrs)
    return Plain(made, dict(data.attrs))


def _extremes(values: Array, length: int) -> set[int]:
    """The first of each stretch of records, and the lowest and the highest."""
    found = set(range(0, len(values), length))
    for first in range(0, len(values), length):
        known = np.flatnonzero(np.isfinite(values[first : first + length])) + first
        if known.size:
            there = values[known]
            found |= {int(known[there.argmin()]), int(known[there.argmax()])}
    return found


def _gathered(data: xr.Dataset, name: str, keep: NDArray[np.int64]) -> Array:
    """A variable at some records, read a piece at a time."""
    found = []
    for records in spans(data, name):
        inside = keep[(keep >= records.start) & (keep < records.stop)] - records.start
        found.append(np.asarray(data.variables[name][records].values)[inside])
    return np.concatenate(found)

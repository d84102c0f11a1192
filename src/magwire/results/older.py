"""Results of earlier versions, with what they lack added where it can be known."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magwire.results.contract import CONSTANTS, DERIVED, VARIABLES, derive, force_attributes
from magwire.results.forces import Layout

if TYPE_CHECKING:
    import xarray as xr

    Array = NDArray[np.float64]

WANTED = ("position", "contact_force")
NEVER_KEPT = ("push_force", "guide_torque", "tip_departure")
NOT_YET = {
    "friction_force": 0.0,
    "slip": 0.0,
    "friction_work": 0.0,
    "wall_indentation": 0.0,
    "wall_displacement": 0.0,
    "wall_work": 0.0,
}
"""Of versions without friction, or whose walls were rigid and at rest."""
LATER = {"guide_twist": np.nan, "tip_twist": np.nan, "insertion_force": np.nan}
ONLY_MOTION = "dynamic"  # of versions that did not say which


def lacks_nothing(names: Collection[str]) -> bool:
    """Whether a result with such variables has all that one of this version has."""
    return all(name in names for name in (*WANTED, *NOT_YET, *LATER, "wall_force"))


def completed(dataset: xr.Dataset) -> xr.Dataset:
    """A result with all variables on forces.

    Those along the wire follow from the forces on its nodes; those along the lumen, too, if it is a
    single tube. What the guide did, where the magnet is, and how far a model was off were not kept:
    NaN. Nor was the motion, there being one kind only. There was no friction, and
    walls were rigid and at rest.
    """
    if not all(name in dataset for name in WANTED):
        return dataset
    dataset = _filled(dataset)
    if "wall_force" in dataset:
        return dataset
    layout = Layout(
        length=float(np.asarray(dataset.attrs["length_scale"]).reshape(())),
        nodes=dataset.sizes["node"],
        magnet=(float("nan"), float("nan")),
        way=_way(dataset),
    )
    columns = {name: np.asarray(dataset[name].values, dtype=np.float64) for name in WANTED}
    added = derive(columns, layout)
    if len(layout.arc) == 0:
        del added["lumen_force"]
    made: dict[str, Any] = {
        name: (DERIVED[name].dims, values, _notes(DERIVED[name])) for name, values in added.items()
    }
    for name in NEVER_KEPT:
        if name in dataset:
            continue
        unknown = np.full(dataset.sizes["time"], np.nan)
        made[name] = (VARIABLES[name].dims, unknown, _notes(VARIABLES[name]))
    if len(layout.arc):
        made["arc"] = (("arc",), layout.arc, _notes(CONSTANTS["arc"]))
        made["way"] = (("arc", "xyz"), layout.point(layout.arc)[:, :3], _notes(CONSTANTS["way"]))
    attributes = {"motion": ONLY_MOTION} | dataset.attrs | force_attributes(layout)
    return dataset.assign(made).assign_attrs(attributes)


def _filled(dataset: xr.Dataset) -> xr.Dataset:
    """The same with what is the same at all times of a version that did not have it."""
    made: dict[str, Any] = {}
    for name, value in (NOT_YET | LATER).items():
        if name not in dataset:
            variable = VARIABLES[name]
            shape = tuple(dataset.sizes[dimension] for dimension in variable.dims)
            made[name] = (variable.dims, np.full(shape, value), _notes(variable))
    return dataset.assign(made) if made else dataset


def _way(dataset: xr.Dataset) -> Array:
    """The centreline of a lumen without branches, shape (q, 4) [m]; no rows of any other."""
    if "centreline" not in dataset or np.any(dataset["lumen_branch"].values != 0):
        return np.zeros((0, 4))
    return np.column_stack([dataset["centreline"].values, dataset["lumen_radius"].values])


def _notes(variable: Any) -> dict[str, str]:
    return {"units": variable.units, "long_name": variable.long_name}

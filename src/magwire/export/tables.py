"""A result as two tables: one row a record, and one row a node and record."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from magwire.actuate.recorded import of_hardware
from magwire.export.frames import Frame, turned
from magwire.files import successor

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
RUN, NODES = "run.csv", "nodes.csv"
NUMBERS = {
    "tip_force": "N", "wall_force": "N", "patch_force": "N", "magnet_force": "N",
    "push_force": "N", "guide_torque": "N m", "tip_offset": "m", "clearance_along": "m",
    "stable": "1",
}  # fmt: skip
"""Plain numbers over time, with their units; a file of an earlier version may lack some."""


def write_tables(data: xr.Dataset, folder: Path, frame: Frame = "lps") -> list[Path]:
    """Write ``run.csv`` and ``nodes.csv``; numbers with all their digits, units in the header.

    Parameters
    ----------
    data
        A result file's variables and attributes.
    folder
        Where to.
    frame
        Axes of positions, forces and fields.
    """
    tables = {RUN: run_columns(data, frame), NODES: node_columns(data, frame)}
    return [_write(folder / name, columns) for name, columns in tables.items()]


def run_columns(data: xr.Dataset, frame: Frame) -> dict[str, Array]:
    """Columns of the records: time, feed, tip, field, forces, inputs; each of shape (t,)."""
    return {
        "time [s]": data["time"].values,
        "feed [m]": data["feed"].values,
        **_vector("tip", "m", turned(data["position"].values[:, -1], frame)),
        **_vector("field", "T", turned(data["field"].values, frame)),
        **_vector("tip_force", "N", turned(data["contact_force"].values[:, -1], frame)),
        **{f"{name} [{unit}]": data[name].values for name, unit in NUMBERS.items() if name in data},
        **{
            f"{name} [{unit}]": data["inputs"].values[:, k]
            for k, (name, unit) in enumerate(of_hardware(data.attrs))
        },
    }


def node_columns(data: xr.Dataset, frame: Frame) -> dict[str, Array]:
    """Columns of the nodes of all records, each of shape (t nodes,)."""
    records, nodes = data.sizes["time"], data.sizes["node"]
    station = np.linspace(0.0, float(data.attrs["length_scale"]), nodes)
    flat = {name: turned(data[name].values, frame).reshape(-1, 3) for name in VECTORS}
    return {
        "time [s]": np.repeat(data["time"].values, nodes),
        "node": np.tile(np.arange(nodes), records),
        "station [m]": np.tile(station, records),
        **_vector("position", "m", flat["position"]),
        **_vector("contact_force", "N", flat["contact_force"]),
        "clearance [m]": data["clearance"].values.ravel(),
    }


VECTORS = ("position", "contact_force")


def _vector(name: str, unit: str, values: Array) -> dict[str, Array]:
    return {f"{name}_{axis} [{unit}]": values[:, i] for i, axis in enumerate("xyz")}


def _write(path: Path, columns: Mapping[str, Array]) -> Path:
    with successor(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        # As Python's numbers, whose texts are the shortest that read back to the same.
        writer.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))
    return path

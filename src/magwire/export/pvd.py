"""A result as series for ParaView: the wire, the field at its tip, the wall and its pressure."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magwire.contact.motion import recorded
from magwire.export.frames import Frame, turned
from magwire.export.vtp import write_pvd_list, write_vtp
from magwire.export.wall import of_surface, wall
from magwire.view import content, looks

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]


def write_pvd(data: xr.Dataset, folder: Path, frame: Frame = "lps") -> list[Path]:
    """Write ``wire.pvd``, ``field.pvd`` and, unless in open space, ``wall.pvd``.

    The files of the records are in folders of the same names.

    Parameters
    ----------
    data
        A result file's variables and attributes.
    folder
        Where to.
    frame
        Axes of positions, forces and fields.

    Returns
    -------
    list
        The collections.
    """
    branches = content.branches(data)
    series = {"wire": _wires(data, frame), "field": _fields(data, frame)}
    if branches:
        series["wall"] = _walls(data, branches, frame)
    made = []
    for name, writers in series.items():
        (folder / name).mkdir(exist_ok=True)
        times = data["time"].values.tolist()
        files = []
        for record, (time, (points, rest)) in enumerate(zip(times, writers, strict=True)):
            file = write_vtp(folder / name / f"{name}-{record:05d}.vtp", points, **rest)
            files.append((time, f"{name}/{file.name}"))
        made.append(write_pvd_list(folder / f"{name}.pvd", files))
    return made


Drawn = Iterator[tuple[NDArray[Any], dict[str, Any]]]
"""Of each record the points, and what else ``write_vtp`` takes."""


def _wires(data: xr.Dataset, frame: Frame) -> Drawn:
    position = turned(data["position"].values, frame)
    force = turned(data["contact_force"].values, frame)
    magnetised = looks.magnets(data).astype(np.uint8)
    line = [np.arange(data.sizes["node"])]
    for record in range(len(position)):
        numbers = {
            "contact_force": force[record],
            "force_per_length": data["force_per_length"].values[record],
            "clearance": data["clearance"].values[record],
            "magnetised": magnetised,
        }
        yield position[record], {"lines": line, "point_data": numbers}


def _fields(data: xr.Dataset, frame: Frame) -> Drawn:
    tip = turned(data["position"].values[:, -1:], frame)
    field = turned(data["field"].values[:, None], frame)
    for record in range(len(tip)):
        yield tip[record], {"point_data": {"field": field[record]}}


def _walls(data: xr.Dataset, branches: list[Array], frame: Frame) -> Drawn:
    mesh = wall(branches)
    if "surface_points" in data:
        mesh = of_surface(data["surface_points"].values, data["surface_triangles"].values, branches)
    wall_motions, entrance = recorded(data), looks.entrance(data)
    known = looks.radius(data)
    skin = 0.0 if looks.on_axis(data) or known is None else known
    position, force = data["position"].values, data["contact_force"].values
    for record in range(len(position)):
        moved = mesh.moved(wall_motions, entrance, float(data["time"].values[record]))
        pressure = moved.pressure(position[record], force[record], skin)
        yield (
            turned(moved.points, frame).astype("<f4"),
            {"triangles": mesh.triangles, "point_data": {"pressure": pressure.astype("<f4")}},
        )

"""What a page holds of a result: the numbers of the file, packed, and a few words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from magwire.contact.motion import recorded
from magwire.errors import InputError, shortened
from magwire.view import looks, packing

if TYPE_CHECKING:
    import xarray as xr

    from magwire.contact import WallMotion

Array = NDArray[np.float64]
POINT_STEP = 2e-4
"""Step of the nodes' positions, over the smallest radius of the lumen: they are off by a tenth of a
thousandth of it at most. Ten times the step shows as a wire that trembles."""
FORCE_STEP = 2e-4
"""Step of the forces on the nodes, over the largest component of any."""
RINGS = 240
"""Points of a branch at most: its wall is drawn no finer."""


def run(data: xr.Dataset, name: str) -> dict[str, Any]:
    """A result as the page takes it.

    Parameters
    ----------
    data
        A result file's variables and attributes.
    name
        What it is called where it has no title.

    Raises
    ------
    InputError
        If it holds no records, or positions or forces that are no numbers.
    """
    if data.sizes["time"] == 0:
        raise InputError("Input data of view must hold at least one record; received 0.")
    for key in ("position", "contact_force", "field"):
        if not np.isfinite(data[key].values).all():
            raise InputError(f"Input data of view must hold finite numbers; {key} has others.")
    tubes = branches(data)
    smallest = min((float(tube[:, 3].min()) for tube in tubes), default=_open_scale(data))
    known = looks.radius(data)
    return {
        "name": name,
        "title": _one_line(data.attrs.get("title", "")),
        "status": str(data.attrs["status"]),
        "facts": facts(data),
        "wire": {
            "radius": known if known is not None else looks.UNKNOWN * smallest,
            "onAxis": looks.on_axis(data),
            "magnet": [int(flag) for flag in looks.magnets(data)],
        },
        "branches": [packing.exact(tube, "float32") for tube in tubes],
        "surface": surface(data, tubes),
        "motions": motions(recorded(data)),
        "arrays": arrays(data, smallest),
    }


def arrays(data: xr.Dataset, smallest: float) -> dict[str, packing.Packed]:
    """The numbers over time; positions and forces on nodes in steps, all others exactly."""
    force = data["contact_force"].values
    return {
        "position": packing.in_steps(data["position"].values, POINT_STEP * smallest),
        "contact_force": packing.in_steps(force, FORCE_STEP * float(np.abs(force).max())),
        "tip_clearance": packing.exact(data["clearance"].values[:, -1]),
        "clearance": packing.exact(smallest_clearance(data)),
        **{
            name: packing.exact(data[name].values)
            for name in ("time", "feed", "field", "tip_force", "wall_force", "push_force", "stable")
        },
    }


def smallest_clearance(data: xr.Dataset) -> Array:
    """Smallest clearance anywhere along the wire, shape (t,) [m]; older files know it at nodes."""
    if "clearance_along" in data:
        return np.asarray(data["clearance_along"].values, dtype=np.float64)
    nodes = np.where(np.isnan(data["clearance"].values), np.inf, data["clearance"].values)
    between = data["clearance_midpoint"].values
    found = np.fmin(nodes.min(axis=1), between)
    return np.where(np.isfinite(found), found, np.nan)


def branches(data: xr.Dataset) -> list[Array]:
    """Points and radius of each branch of the lumen, shape (q, 4) [m]; none in open space."""
    if "centreline" not in data:
        return []
    index = data["lumen_branch"].values
    tube = np.column_stack([data["centreline"].values, data["lumen_radius"].values])
    return [_thinned(tube[index == which]) for which in np.unique(index)]


def motions(wall: Sequence[WallMotion]) -> list[dict[str, Any]]:
    """How the wall moves, as the page takes it."""
    return [
        {"amplitude": np.asarray(one.amplitude).tolist(), "period": one.period, "ramp": one.ramp}
        for one in wall
    ]


def surface(data: xr.Dataset, tubes: list[Array]) -> dict[str, packing.Packed] | None:
    """The wall, if it is a surface."""
    if "surface_points" not in data:
        return None
    return sheet(data["surface_points"].values, data["surface_triangles"].values, tubes)


def sheet(
    points: Array, triangles: NDArray[np.int64], tubes: Sequence[Array]
) -> dict[str, packing.Packed]:
    """A wall that is a surface: corners by the points of the centrelines next to them.

    Parameters
    ----------
    points, triangles
        Corners, shape (n, 3) [m], and which of them each triangle has, shape (m, 3).
    tubes
        Points and radius of each branch, shape (q, 4) [m].
    """
    balls = np.concatenate(tubes)
    begins = np.concatenate([np.arange(len(tube)) == 0 for tube in tubes])
    distance, nearest = KDTree(balls[:, :3]).query(points)
    order = np.argsort(nearest, kind="stable")
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    count = np.bincount(nearest, minlength=len(balls))
    far = np.zeros(len(balls))
    np.maximum.at(far, nearest, distance)
    return {
        "positions": packing.exact(points[order], "float32"),
        "indices": packing.exact(place[triangles]),
        "rings": packing.exact(np.column_stack([balls, count, far, begins])),
    }


def facts(data: xr.Dataset) -> str:
    """How the run went, in a line: motion, steering, how it ended, and the insertion length."""
    navigate = looks.tables(data).get("navigate", {})
    method = navigate.get("method", "") if isinstance(navigate, dict) else ""
    steering = {"": "", "none": "not steered"}.get(method, f"steered: {method}")
    fed = 1e3 * float(data["feed"].values[-1])
    words = [str(data.attrs["motion"]), steering, str(data.attrs["status"])]
    words.append(f"inserted {fed:.1f} mm")
    return " · ".join(_one_line(word) for word in words if word)


def _one_line(text: object) -> str:
    return "".join(letter if letter.isprintable() else " " for letter in shortened(text))


def _thinned(tube: Array) -> Array:
    """Points at even places of a branch, its ends among them."""
    if len(tube) <= RINGS:
        return tube
    steps = np.linalg.norm(np.diff(tube[:, :3], axis=0), axis=1)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    even = np.linspace(0.0, arc[-1], RINGS)
    return np.column_stack([np.interp(even, arc, column) for column in tube.T])


def _open_scale(data: xr.Dataset) -> float:
    """What stands for the lumen's radius in open space [m]."""
    return 0.02 * float(data.attrs["length_scale"])

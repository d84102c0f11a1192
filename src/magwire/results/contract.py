"""What a result file holds: its variables with their units, and how to read it back."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magwire.engine.record import Record, RunInfo
from magwire.errors import InputError
from magwire.files import TextFaultError, parse_toml
from magwire.results import forces, provenance
from magwire.results.forces import Layout

FLOAT = np.dtype(np.float64)
Columns = Mapping[str, NDArray[Any]]


@dataclass(frozen=True)
class Variable:
    """A variable of the file that grows with time.

    Attributes
    ----------
    dims
        Names of its dimensions.
    units
        Its unit, "1" for a plain number.
    long_name
        What it is.
    read
        Its value at one time, from the record and what is known of the run.
    dtype
        Type of the numbers.
    extra
        Further attributes.
    column
        In place of ``read``, for speed: its values, with time as their first axis, from the numbers
        of many records by the names of ``Record``. Without either they are those of its own name.
    """

    dims: tuple[str, ...]
    units: str
    long_name: str
    read: Callable[[Record, RunInfo], Any] | None = None
    dtype: np.dtype[Any] = FLOAT
    extra: tuple[tuple[str, Any], ...] = ()
    column: Callable[[Columns, RunInfo], NDArray[Any]] | None = None


@dataclass(frozen=True)
class Derived:
    """A variable of the file that follows from others, of many records at once.

    Attributes
    ----------
    dims, units, long_name
        As of ``Variable``.
    read
        Its values, with time as their first axis, from the columns of the others.
    """

    dims: tuple[str, ...]
    units: str
    long_name: str
    read: Callable[[Columns, Layout], NDArray[np.float64]]
    dtype: np.dtype[Any] = FLOAT
    extra: tuple[tuple[str, Any], ...] = ()


@dataclass(frozen=True)
class Constant:
    """A variable of the file that is known from the start."""

    dims: tuple[str, ...]
    units: str
    long_name: str
    read: Callable[[RunInfo, Layout], Any]
    dtype: np.dtype[Any] = FLOAT


VARIABLES: dict[str, Variable] = {
    "time": Variable(("time",), "s", "simulated time"),
    "feed": Variable(("time",), "m", "insertion: length of wire inside the lumen"),
    "position": Variable(("time", "node", "xyz"), "m", "positions of the nodes"),
    "field": Variable(
        ("time", "xyz"), "T", "flux density at the tip", column=lambda r, _: r["flux_density"]
    ),
    "inputs": Variable(
        ("time", "input"),
        "see the attribute input_units",
        "inputs of the actuator, by the attribute input_names",
    ),
    "contact_force": Variable(("time", "node", "xyz"), "N", "force of the wall on the wire"),
    "clearance": Variable(
        ("time", "node"),
        "m",
        "distance of the nodes to the wall as it is",
    ),
    "clearance_midpoint": Variable(
        ("time",),
        "m",
        "smallest distance to the wall midway between nodes",
    ),
    "clearance_along": Variable(
        ("time",),
        "m",
        "smallest distance to the wall anywhere along the wire",
    ),
    "tip_force": Variable(("time",), "N", "magnitude of the force of the wall on the tip"),
    "tip_offset": Variable(("time",), "m", "distance of the tip from the centreline"),
    "friction_force": Variable(
        ("time", "node", "xyz"),
        "N",
        "force of the wall on the wire along the wall",
    ),
    "slip": Variable(
        ("time", "node"),
        "m",
        "how far the wire's surface has slid on the wall so far",
    ),
    "friction_work": Variable(("time",), "J", "what friction has taken so far"),
    "wall_indentation": Variable(
        ("time", "node"),
        "m",
        "how far each node presses the wall in",
    ),
    "wall_displacement": Variable(
        ("time", "node", "xyz"),
        "m",
        "how far the wall has moved at each node",
    ),
    "wall_work": Variable(("time",), "J", "what the wall that moves has done to the wire"),
    "guide_twist": Variable(
        ("time",),
        "rad",
        "angle by which the guide has turned the wire about its axis",
    ),
    "tip_twist": Variable(
        ("time",),
        "rad",
        "angle by which the tip is turned about its axis, against an untwisted wire",
    ),
    "material_director": Variable(
        ("time", "node", "xyz"),
        "1",
        "first material director of the edge from each node, of the last edge at the tip",
    ),
    "push_force": Variable(("time",), "N", "force of the guide on the wire, along the guide"),
    "insertion_force": Variable(
        ("time",),
        "N",
        "force that feeds the wire through the guide: push less what the bend at its mouth does",
    ),
    "guide_torque": Variable(
        ("time",),
        "N m",
        "torque of the guide on the wire, about the guide",
    ),
    "tip_departure": Variable(
        ("time",),
        "m",
        "distance of the tip from where the navigator's model has it, "
        "largest since the record before",
    ),
    "newton_iterations": Variable(
        ("time",),
        "1",
        "Newton iterations per step, mean since the record before",
    ),
    "stable": Variable(
        ("time",),
        "1",
        "whether the tangent stiffness is positive definite; under friction, whether it stays",
        dtype=np.dtype(np.int8),
        extra=(
            ("flag_values", np.array([0, 1], dtype=np.int8)),
            ("flag_meanings", "unstable stable"),
        ),
    ),
    "wall_time": Variable(("time",), "s", "time spent since the start of the run"),
    "normalized_push": Variable(
        ("time",),
        "1",
        "insertion length over length of the wire",
        column=lambda r, i: r["feed"] / i.scales.length,
    ),
    "normalized_field": Variable(
        ("time", "xyz"),
        "1",
        "flux density at the tip times |M| L^2 / EI",
        column=lambda r, i: r["flux_density"] / i.scales.flux_density,
    ),
    "normalized_tip_force": Variable(
        ("time",),
        "1",
        "tip force times L^2 / EI",
        column=lambda r, i: r["tip_force"] / i.scales.force,
    ),
}

NODE_FORCE = "node_force"  # sizes of the forces on the nodes: a column that no file holds

DERIVED: dict[str, Derived] = {
    "wall_force": Derived(
        ("time",),
        "N",
        "force of the wall on the wire, sizes summed over its nodes",
        lambda c, _: c[NODE_FORCE].sum(axis=1),
    ),
    "magnet_force": Derived(
        ("time",),
        "N",
        "force of the wall on the distal magnet",
        lambda c, at: forces.magnet(at, c[NODE_FORCE]),
    ),
    "patch_force": Derived(
        ("time",),
        "N",
        "force of the wall on the patch of the wire where it is largest",
        lambda c, at: forces.largest_over(at, c[NODE_FORCE], at.patch),
    ),
    "force_per_length": Derived(
        ("time", "node"),
        "N/m",
        "force of the wall per length of the wire, smoothed",
        lambda c, at: forces.per_length(at, c[NODE_FORCE]),
    ),
    "contact_length": Derived(
        ("time",),
        "m",
        "shortest length of wire that carries 95 percent of the wall's force",
        lambda c, at: forces.contact_length(at, c["force_per_length"]),
    ),
    "lumen_force": Derived(
        ("time", "arc"),
        "N/m",
        "force of the wall per length of the path to the target, smoothed",
        lambda c, at: forces.per_way(at, c["position"], c[NODE_FORCE]),
    ),
}
"""By name, each after those that it follows from."""

CONSTANTS: dict[str, Constant] = {
    "arc": Constant(("arc",), "m", "arc length of the path to the target", lambda _, at: at.arc),
    "way": Constant(
        ("arc", "xyz"),
        "m",
        "centreline of the path to the target",
        lambda _, at: at.point(at.arc)[:, :3],
    ),
    "centreline": Constant(
        ("centreline_point", "xyz"), "m", "centreline of the lumen", lambda i, _: i.centreline
    ),
    "lumen_radius": Constant(
        ("centreline_point",), "m", "radius of the lumen", lambda i, _: i.lumen_radius
    ),
    "lumen_branch": Constant(
        ("centreline_point",),
        "1",
        "branch that a point of the centreline belongs to",
        lambda i, _: i.lumen_branch,
        np.dtype(np.int32),
    ),
    "surface_points": Constant(
        ("surface_point", "xyz"),
        "m",
        "corners of the triangles of a wall that is a surface",
        lambda i, _: i.surface[0],
    ),
    "surface_triangles": Constant(
        ("surface_triangle", "corner"),
        "1",
        "points that are the corners of each triangle",
        lambda i, _: i.surface[1],
        np.dtype(np.int32),
    ),
    "wall_amplitude": Constant(
        ("wall_motion", "xyz"),
        "m",
        "largest displacement of a wall that moves, in each of its motions",
        lambda i, _: [one.amplitude for one in i.wall_motion],
    ),
    "wall_period": Constant(
        ("wall_motion",),
        "s",
        "period of each motion",
        lambda i, _: [one.period for one in i.wall_motion],
    ),
    "wall_ramp": Constant(
        ("wall_motion",),
        "m",
        "distance from the entrance at which each motion is full",
        lambda i, _: [one.ramp for one in i.wall_motion],
    ),
}


def layout_of(info: RunInfo) -> Layout:
    """Where the forces of a run are summed."""
    return Layout(info.scales.length, info.nodes, info.magnet, info.way)


def sizes(info: RunInfo, layout: Layout) -> dict[str, int]:
    """Lengths of the dimensions other than time; in open space some are zero."""
    return {
        "node": info.nodes,
        "xyz": 3,
        "input": len(info.inputs),
        "arc": len(layout.arc),
        "centreline_point": len(info.lumen_radius),
        "surface_point": len(info.surface[0]),
        "surface_triangle": len(info.surface[1]),
        "corner": 3,
        "wall_motion": len(info.wall_motion),
    }


def derive(columns: Columns, layout: Layout) -> dict[str, NDArray[Any]]:
    """The columns that follow from those of the records: of each from its own numbers alone."""
    size = forces.sizes(columns["contact_force"])
    touches = size.any(axis=1)
    # All that do not touch the wall have the same: one of them stands for them.
    some = np.append(np.flatnonzero(touches), np.flatnonzero(~touches)[:1])
    which = np.where(touches, np.cumsum(touches) - 1, len(some) - 1)
    known: Columns = {"position": columns["position"][some], NODE_FORCE: size[some]}
    for name, derived in DERIVED.items():
        known = {**known, name: derived.read(known, layout)}
    return {name: known[name][which] for name in DERIVED}


def plain(text: str) -> str:
    """A text without what NetCDF does not take, such as a zero byte."""
    return "".join(letter if letter.isprintable() else " " for letter in text)


def _title_of(scenario: str) -> str:
    try:
        title = parse_toml(scenario).get("title", "")
    except TextFaultError as error:
        expected = "Input scenario of a run must be valid TOML; received a text that is not: "
        raise InputError(f"{expected}{error}.") from None
    return title if isinstance(title, str) else ""


def force_attributes(layout: Layout) -> dict[str, float]:
    """Attributes that say what the forces are sums over."""
    begin, end = layout.magnet
    return {
        "force_patch": float(layout.patch),
        "magnet_begin": float(begin),
        "magnet_end": float(end),
    }


def opening_attributes(info: RunInfo, layout: Layout, version: str) -> dict[str, Any]:
    """Attributes of the file that are known from the start."""
    heated = any(resistance > 0.0 for resistance in info.resistances)
    return {
        "Conventions": "CF-1.11",
        "title": plain(info.title or _title_of(info.scenario)),
        "source": f"magwire {version}",
        "magwire_version": version,
        **provenance.attributes(),
        "scenario": info.scenario,
        "motion": info.motion,
        "input_names": " ".join(name for name, _ in info.inputs),
        "input_units": " ".join(unit for _, unit in info.inputs),
        **({"input_resistances": " ".join(map(repr, info.resistances))} if heated else {}),
        **({"hardware": info.hardware} if info.hardware else {}),
        "length_scale": float(info.scales.length),
        "force_scale": float(info.scales.force),
        "field_scale": float(info.scales.flux_density),
        **force_attributes(layout),
    }


def running_attributes(record: Record | None) -> dict[str, Any]:
    """Attributes of the file that change as the run goes."""
    nan = float("nan")
    if record is None:
        return {
            "max_tip_force": 0.0,
            "mean_tip_force": 0.0,
            "first_contact_feed": nan,
            "smallest_clearance": nan,
            "steps": 0,
            "newton_iterations_total": 0,
            "factorisations_total": 0,
            "retries_total": 0,
            "wall_time_total": 0.0,
        }
    totals = record.totals
    clearance = float(totals.smallest_clearance)
    return {
        "max_tip_force": float(totals.max_tip_force),
        "mean_tip_force": float(totals.mean_tip_force),
        "first_contact_feed": float(totals.first_contact_feed),
        "smallest_clearance": clearance if np.isfinite(clearance) else nan,
        "steps": int(totals.steps),
        "newton_iterations_total": int(totals.newton_iterations),
        "factorisations_total": int(totals.factorisations),
        "retries_total": int(totals.retries),
        "wall_time_total": float(totals.wall_time),
    }

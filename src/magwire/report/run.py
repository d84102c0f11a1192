"""What to know of a run, as lines of text."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from magwire.actuate.recorded import of_hardware, power_of
from magwire.pieces import at, largest, pieces
from magwire.units import show

if TYPE_CHECKING:
    from magwire.results import Result
    from magwire.wire import Wire

COLUMN = 20
"""Width of the names of the rows."""
TURNED = 1e-3
"""Twist of the guide from which on a wire counts as turned [rad]."""
MOST = 4
"""Inputs of which the largest value is shown."""
STRONGEST = 12.0
"""Flux density that no magnet around a patient goes beyond, MRI scanners neither [T]."""
NO_MAGNET = "; no magnet around a patient makes that: set navigate.max_field"
TORQUE = 1e-5
"""Torque at the guide, over EI/L, that is worth a word: round-off turns a wire in a plane, too."""


def lines(result: Result, *, steered: bool = False, passive: Result | None = None) -> list[str]:
    """What to know of a run, a line each.

    Parameters
    ----------
    result
        The run.
    steered
        Whether to say how well it was steered.
    passive
        The same run with nobody steering, to compare with.
    """
    rows = {
        "status": result.status,
        **({"tried again": result.message} if result.converged and result.message else {}),
        **_course(result),
    }
    shown = [
        *rows.items(),
        *_forces(result, passive),
        *_wall(result).items(),
        *_rubbing(result).items(),
        *(_steering(result) if steered else {}).items(),
        *_work(result).items(),
    ]
    return [f"{name:{COLUMN}}{text}" for name, text in shown]


def wire_lines(wire: Wire) -> list[str]:
    """What the wire is, a line for each section: what was given in other words is converted."""
    ends = np.cumsum([section.length for section in wire.sections])
    names = ["wire", *[""] * (len(ends) - 1)]
    return [
        f"{name:{COLUMN}}up to {1e3 * end:.4g} mm: {section.describe()}"
        for name, end, section in zip(names, ends, wire.sections, strict=True)
    ]


def gains(steered: Result, passive: Result) -> list[str]:
    """What steering gained over pushing alone: on the tip, on the wire, at the guide; a line each.

    Parameters
    ----------
    steered, passive
        The runs.
    """

    def change(name: str) -> str:
        before, after = (float(getattr(run, name)) for run in (passive, steered))
        return f"{_brief(before)} to " + (_brief(after) if after else "none")

    fed = [largest(run.held, lambda feed: feed, "feed") for run in (steered, passive)]
    far = f"; over {1e3 * fed[0]:.4g} mm of {1e3 * fed[1]:.4g}" if fed[0] < fed[1] else ""
    rows = {
        "gained, tip": f"peak force from {change('max_tip_force')}, "
        f"mean from {change('mean_tip_force')}{far}",
        "gained, wire": f"peak force from {change('max_wall_force')}, "
        f"on {_patch(steered)} from {change('max_patch_force')}",
    }
    if not np.isnan(steered.max_push_force + passive.max_push_force):
        rows["gained, guide"] = f"peak push from {change('max_push_force')}"
    return [f"{name:{COLUMN}}{text}" for name, text in rows.items()]


def _course(result: Result) -> dict[str, str]:
    """How far it went, and by what kind of motion."""
    records = result.held.sizes["time"]
    fed = show(float(at(result.held, "feed", -1)), "length") if records else "nothing"
    rows = {
        "inserted": f"{fed} in {result.steps} steps, {_simulated(result):.4g} s simulated",
        "motion": result.motion,
    }
    if result.motion == "quasi-static":
        rows["motion"] += ", an equilibrium at every step"
        rows["largest move"] = (
            f"{_short(result.largest_move)} beyond what was inserted, between two records"
        )
    unstable, first = 0, float("nan")
    for stable, feed in pieces(result.held, "stable", "feed"):
        not_so = np.flatnonzero(~(stable > 0.0))
        if not_so.size and not unstable:
            first = float(feed[not_so[0]])
        unstable += not_so.size
    rows["stable"] = "at every record"
    if unstable:
        rows["stable"] = (
            f"not at {unstable} of {records} records, first at a feed of {show(first, 'length')}"
        )
    return rows


def _forces(result: Result, passive: Result | None) -> Iterator[tuple[str, str]]:
    """Who touched the wall, and all forces, of tip, wire and guide apart."""

    def force(newtons: float) -> str:
        return f"{newtons:.4g} N, normalised {newtons / result.force_scale:.4g}"

    def torque(value: float) -> str:
        return f"{value:.4g} N m"

    yield "tip contact-free", "yes, at every step" if result.tip_contact_free else "no"
    yield "wire contact-free", _wire_free(result)
    least = TORQUE * result.force_scale * float(result.held.attrs["length_scale"])
    for name, attribute, show_as in (
        ("peak tip force", "max_tip_force", force),
        ("mean tip force", "mean_tip_force", force),
        ("peak wire force", "max_wall_force", force),
        (f"  on {_patch(result)} of it", "max_patch_force", force),
        ("  on the magnet", "max_magnet_force", force),
        ("longest contact", "longest_contact", _short),
        ("peak push at guide", "max_push_force", force),
        ("  felt by the hand", "max_insertion_force", force),
        ("peak guide torque", "max_guide_torque", torque),
        ("peak friction", "largest_friction", force),
    ):
        values = [float(getattr(run, attribute)) for run in (result, passive) if run is not None]
        if np.isnan(values).all() or (show_as is torque and max(values) < least):
            continue
        if attribute == "largest_friction" and max(values) == 0.0:
            continue
        for label, value in zip((name, "  not steered"), values, strict=False):
            yield label, show_as(value)


def _wire_free(result: Result) -> str:
    """Whether the wall pressed on the wire anywhere, and by how much."""
    if result.wire_contact_free:
        return "yes, at every step"
    free = "no, though its tip is" if result.tip_contact_free else "no"
    total, patch = _brief(result.max_wall_force), _brief(result.max_patch_force)
    return f"{free}: up to {total} in all, {patch} on {_patch(result)}"


def _brief(newtons: float) -> str:
    """A force to the digits that matter: in mN, as soft wires have it, or in N if it is larger."""
    return f"{newtons:.3g} N" if abs(newtons) >= 1.0 else f"{1e3 * newtons:.3g} mN"


def _patch(result: Result) -> str:
    """The length of wire that patch forces are of."""
    return _short(result.force_patch)


def _wall(result: Result) -> dict[str, str]:
    """How near wire and wall came to each other."""
    first, clearance = result.first_contact, result.smallest_clearance
    length = float(result.held.attrs["length_scale"])
    rows = {
        "smallest clearance": "none, no wall" if np.isnan(clearance) else f"{clearance:.3e} m",
        "first contact": "none"
        if first is None
        else f"at a feed of {show(first, 'length')}, push {first / length:.3f}",
    }
    if result.largest_indentation > 0.0:
        rows["wall pressed in"] = f"{_short(result.largest_indentation)} at most"
    moved = 0.0
    if "wall_displacement" in result.held:
        moved = largest(result.held, lambda u: np.linalg.norm(u, axis=-1), "wall_displacement")
    if moved > 0.0:
        rows["wall moved"] = (
            f"{_short(moved)} at most at the wire, and did {result.work_of_wall:.4g} J to it"
        )
    return rows


def _rubbing(result: Result) -> dict[str, str]:
    """What friction took, and how far the tip turned behind the guide."""
    rows = {}
    if result.work_of_friction > 0.0:
        slid = _short(largest(result.held, lambda slip: slip, "slip"))
        rows["work of friction"] = f"{result.work_of_friction:.4g} J, over up to {slid} of slip"
    turns = [(twist.min(), twist.max()) for (twist,) in pieces(result.held, "guide_twist")]
    if turns and np.ptp(turns) > TURNED:
        last = np.degrees([at(result.held, f"{end}_twist", -1) for end in ("guide", "tip")])
        rows["twist"] = (
            f"guide {last[0]:.4g} deg, tip {last[1]:.4g} deg at the end; "
            f"up to {np.degrees(result.largest_lag):.3g} deg apart"
        )
    return rows


def _steering(result: Result) -> dict[str, str]:
    """How well it was steered."""
    scale = float(result.held.attrs["field_scale"])  # NaN without a magnet
    rows = {
        "largest tip offset": _short(result.largest_tip_offset),
        "peak field": show(result.peak_field, "flux_density")
        + ("" if np.isnan(scale) else f", normalised {result.peak_field / scale:.4g}")
        + (NO_MAGNET if result.peak_field > STRONGEST else ""),
    }
    rows |= _driving(result)
    if not np.isnan(result.largest_tip_departure):
        most = result.largest_tip_departure
        courses = pieces(result.held, "tip_departure", "feed")
        fed = next(feed[away == most][0] for away, feed in courses if np.any(away == most))
        rows["model error"] = (
            f"{_short(most)} at most at the tip, at a feed of {show(float(fed), 'length')}"
        )
    return rows


def _driving(result: Result) -> dict[str, str]:
    """What the actuator was set to, and what that cost."""
    names = of_hardware(result.held.attrs)
    if not names or not result.held.sizes["time"]:
        return {}
    rows = {}
    for unit, what in (("A", "peak currents"), ("T", "peak inputs"), ("T/m", "peak gradients")):
        columns = [k for k, (_, own) in enumerate(names) if own == unit]
        if columns:
            largest = np.abs(result.inputs).max(axis=0)
            most = sorted(columns, key=lambda k: -largest[k])[:MOST]
            rows[what] = ", ".join(f"{largest[k]:.3g} {unit} in {names[k][0]}" for k in most)
    power = power_of(result.held.attrs, result.inputs)
    if power is not None:
        rows["power of coils"] = f"{power.max():.4g} W at most, {power.mean():.4g} W on average"
    places = [k for k, (_, unit) in enumerate(names) if unit == "m"]
    if places and len(result.time) > 1:
        steps = np.linalg.norm(np.diff(result.inputs[:, places], axis=0), axis=1)
        fastest = float((steps / np.diff(result.time)).max())
        rows["way of magnet"] = f"{_short(float(steps.sum()))}, up to {1e3 * fastest:.3g} mm/s"
    return rows


def _work(result: Result) -> dict[str, str]:
    """What it cost."""
    simulated = _simulated(result)
    pace = result.wall_time / simulated if simulated > 0.0 else float("nan")
    return {
        "Newton iterations": f"{result.newton_iterations_per_step:.2f} per step",
        "wall time": f"{pace:.4g} s per simulated second, {result.wall_time:.2f} s in all",
    }


def _short(length: float) -> str:
    """A length that was computed, given in metres, to the digits that matter."""
    return f"{1e3 * length:.3g} mm"


def _simulated(result: Result) -> float:
    """Simulated time at the end [s]."""
    return float(at(result.held, "time", -1)) if result.held.sizes["time"] else 0.0

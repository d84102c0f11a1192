"""What to know of a run, as lines of text."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from magwire.units import show

if TYPE_CHECKING:
    from magwire.results import Result
    from magwire.wire import Wire

COLUMN = 20
"""Width of the names of the rows."""


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
        **_contact(result, passive),
        **(_steering(result) if steered else {}),
        **_work(result),
    }
    return [f"{name:{COLUMN}}{text}" for name, text in rows.items()]


def wire_lines(wire: Wire) -> list[str]:
    """What the wire is, a line for each section: what was given in other words is converted."""
    ends = np.cumsum([section.length for section in wire.sections])
    names = ["wire", *[""] * (len(ends) - 1)]
    return [
        f"{name:{COLUMN}}up to {1e3 * end:.4g} mm: {section.describe()}"
        for name, end, section in zip(names, ends, wire.sections, strict=True)
    ]


def gain(steered: Result, passive: Result) -> str:
    """What steering gained over pushing alone, in one line."""

    def change(before: float, after: float) -> str:
        return f"{1e3 * before:.3g} mN to " + (f"{1e3 * after:.3g} mN" if after else "none")

    peak = change(passive.max_tip_force, steered.max_tip_force)
    mean = change(passive.mean_tip_force, steered.mean_tip_force)
    fed = [float(run.feed.max(initial=0.0)) for run in (steered, passive)]
    far = f"; over {1e3 * fed[0]:.4g} mm of {1e3 * fed[1]:.4g}" if fed[0] < fed[1] else ""
    return f"peak tip force from {peak}, mean from {mean}{far}"


def _course(result: Result) -> dict[str, str]:
    """How far it went, and by what kind of motion."""
    fed = show(float(result.feed[-1]), "length") if result.feed.size else "nothing"
    rows = {
        "fed": f"{fed} in {result.steps} steps, {_simulated(result):.4g} s simulated",
        "motion": result.motion,
    }
    if result.motion == "quasi-static":
        rows["motion"] += ", an equilibrium at every step"
        rows["largest move"] = (
            f"{_short(result.largest_move)} beyond what was fed, between two records"
        )
    unstable = np.flatnonzero(~result.stable)
    rows["stable"] = "at every record"
    if unstable.size:
        first = show(float(result.feed[unstable[0]]), "length")
        rows["stable"] = (
            f"not at {unstable.size} of {result.feed.size} records, first at a feed of {first}"
        )
    return rows


def _contact(result: Result, passive: Result | None) -> dict[str, str]:
    """What the wall and the wire had to do with each other."""

    def force(newtons: float) -> str:
        return f"{newtons:.4g} N, normalised {newtons / result.force_scale:.4g}"

    first, clearance = result.first_contact, result.smallest_clearance
    length = float(result.dataset.attrs["length_scale"])
    return {
        "peak tip force": force(result.max_tip_force),
        **({"  not steered": force(passive.max_tip_force)} if passive else {}),
        "mean tip force": force(result.mean_tip_force),
        **({"  not steered ": force(passive.mean_tip_force)} if passive else {}),
        "smallest clearance": "none, no wall" if np.isnan(clearance) else f"{clearance:.3e} m",
        "first contact": "none"
        if first is None
        else f"at a feed of {show(first, 'length')}, push {first / length:.3f}",
    }


def _steering(result: Result) -> dict[str, str]:
    """How well it was steered."""
    touched = result.first_contact is not None
    behind = "the wire behind it does" if touched else "nor does the wire behind it"
    scale = float(result.dataset.attrs["field_scale"])  # NaN without a magnet
    rows = {
        "contact-free": f"yes, the tip never touches; {behind}" if result.contact_free else "no",
        "largest tip offset": _short(result.largest_tip_offset),
        "peak field": show(result.peak_field, "flux_density")
        + ("" if np.isnan(scale) else f", normalised {result.peak_field / scale:.4g}"),
    }
    if not np.isnan(result.largest_tip_departure):
        at = float(result.feed[np.nanargmax(result.tip_departure)])
        away = _short(result.largest_tip_departure)
        rows["tip off the plan"] = f"by {away} at most, at a feed of {show(at, 'length')}"
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
    return float(result.time[-1]) if result.time.size else 0.0

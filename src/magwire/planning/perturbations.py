"""How a planned way to an outlet goes where mesh, wire, vessel or field are not as planned."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from magwire.contact import Barrier
from magwire.errors import InputError, instance, one_of
from magwire.lumen import Lumen
from magwire.lumen.displaced import displaced
from magwire.navigate.demands import Demands
from magwire.navigate.navigator import Prescribed
from magwire.navigate.schedule import Schedule
from magwire.planning.outlets import plan
from magwire.planning.prospect import Prospect, Trial
from magwire.planning.route import route_to
from magwire.wire import Section, Wire

EDGES = (0.75, 1.25)  # length of an edge, over what it was
MODULI = (-0.05, 0.05)  # part by which the wire's moduli are off
FIELDS = (-0.03, 0.03)  # part by which the field is off
REGISTRATION = 0.2e-3  # by which the vessel lies beside where it was thought to be [m]
DIRECTIONS = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(3.0)
"""Of a regular tetrahedron: no direction is farther than 71 degrees from one of them."""
RAMP = 4.0  # way from the entrance to where the vessel is beside in full, in radii there
GENTLE = 10.0  # that way at least, in registrations


class Setting(NamedTuple):
    """What a course is replayed in."""

    lumen: Lumen
    wire: Wire
    schedule: Schedule


Change = Callable[[Setting], Setting]


def robustness(
    prospect: Prospect,
    lumen: Lumen,
    wire: Wire,
    *,
    demands: Demands | None = None,
    contact: Barrier | None = None,
    watch: Callable[[str], None] | None = None,
) -> tuple[Trial, ...]:
    """How the way to an outlet goes where something is off: each change by itself, and tried.

    The planned field is replayed with inertia, open loop, with edges 0.75 and 1.25 times as long,
    with moduli and field a few percent off, and in a vessel that lies 0.2 mm beside where it was
    thought to be, in four directions, but for its entrance, where the guide is. On other edges the
    course is also planned anew.

    Parameters
    ----------
    prospect
        A way that is reached, as of ``mw.plan``.
    lumen, wire, demands, contact
        What it was planned with.
    watch
        Called with each change before it is tried.

    Returns
    -------
    tuple of Trial
        One for each change.

    Raises
    ------
    InputError
        If the outlet is not reached: there is no way to try.

    Examples
    --------
    >>> import magwire as mw
    >>> tube = mw.Lumen.straight(0.03, 2e-3)
    >>> wire = mw.Wire.uniform(
    ...     length=0.02, radius=0.5e-3, youngs_modulus=3e6, shear_modulus=1e6, density=2e3,
    ...     nodes=17, magnetized_tip=5e-3, magnetization=128e3,
    ... )
    >>> (prospect,) = mw.plan(tube, wire)
    >>> sum(trial.reached for trial in mw.robustness(prospect, tube, wire))
    12
    """
    instance("robustness", "prospect", prospect, Prospect)
    instance("robustness", "lumen", lumen, Lumen)
    instance("robustness", "wire", wire, Wire)
    trials = []
    for change in CHANGES:
        if watch is not None:
            watch(change)
        trials.append(tried(change, prospect, lumen, wire, demands, contact))
    return tuple(trials)


def tried(
    change: str,
    prospect: Prospect,
    lumen: Lumen,
    wire: Wire,
    demands: Demands | None = None,
    contact: Barrier | None = None,
) -> Trial:
    """How it goes with one of the ``CHANGES``; see ``robustness``."""
    one_of("robustness", "change", change, CHANGES)
    if not prospect.reached:
        raise InputError(
            "Input prospect of robustness must be one that is reached; received one that is not, "
            f"to '{prospect.outlet}'."
        )
    there = lumen.towards(prospect.outlet) if lumen.outlets else lumen
    try:
        if change in PLANNED:
            return _anew(change, there, remeshed(wire, PLANNED[change]), demands, contact)
        setting = REPLAYED[change](Setting(there, wire, prospect.schedule))
        return _replayed(change, setting, contact)
    except InputError as error:  # such as a magnet shorter than an edge
        return Trial(change, False, 0.0, 0.0, 0.0, float("nan"), str(error))


def remeshed(wire: Wire, factor: float) -> Wire:
    """The wire with edges that are longer by a factor, or very nearly."""
    return Wire(wire.sections, max(round((wire.nodes - 1) / factor), 4) + 1)


def stiffened(wire: Wire, part: float) -> Wire:
    """The wire with all moduli larger by a part of them."""
    return Wire(tuple(_stiffened(section, 1.0 + part) for section in wire.sections), wire.nodes)


def _stiffened(section: Section, factor: float) -> Section:
    given = section.stiffness
    if given is None:
        assert section.youngs_modulus is not None
        assert section.shear_modulus is not None
        return replace(
            section,
            youngs_modulus=factor * section.youngs_modulus,
            shear_modulus=factor * section.shear_modulus,
        )
    more = replace(
        given,
        bending=factor * given.bending,
        twisting=factor * given.twisting,
        stretching=factor * given.stretching,
    )
    return replace(section, stiffness=more)


def _beside(direction: int, setting: Setting) -> Setting:
    """The vessel beside where it was thought to be."""
    ramp = max(RAMP * float(setting.lumen.branches[0].radius[0]), GENTLE * REGISTRATION)
    moved = displaced(setting.lumen, REGISTRATION * DIRECTIONS[direction], ramp)
    return setting._replace(lumen=moved)


def _on_edges(factor: float, setting: Setting) -> Setting:
    return setting._replace(wire=remeshed(setting.wire, factor))


def _stiffer(part: float, setting: Setting) -> Setting:
    return setting._replace(wire=stiffened(setting.wire, part))


def _stronger(part: float, setting: Setting) -> Setting:
    return setting._replace(schedule=setting.schedule.scaled(1.0 + part))


def _signed(vector: np.ndarray[tuple[int], np.dtype[np.float64]]) -> str:
    return ", ".join(f"{1e3 * REGISTRATION * part:+.2f}" for part in vector)


REPLAYED: Mapping[str, Change] = {
    **{f"edges x {f:g}": partial(_on_edges, f) for f in EDGES},
    **{f"E {100.0 * part:+g} %": partial(_stiffer, part) for part in MODULI},
    **{f"field {100.0 * part:+g} %": partial(_stronger, part) for part in FIELDS},
    **{f"vessel ({_signed(way)}) mm": partial(_beside, k) for k, way in enumerate(DIRECTIONS)},
}
PLANNED: Mapping[str, float] = {f"planned with edges x {f:g}": f for f in EDGES}
CHANGES = (*REPLAYED, *PLANNED)
"""What is tried."""


def _replayed(change: str, setting: Setting, contact: Barrier | None) -> Trial:
    """Replay; at the end the wire is fed on in the last field, by a radius of the outlet."""
    lumen, wire, schedule = setting
    way = lumen.path().branches[0]
    route = route_to(lumen, wire, contact)
    further = float(schedule.feed[-1]) + way.length - route.goal
    result = route.run(min(further, route.feed.largest), Prescribed(schedule))
    arc = route.replayed.system.path.locate(result.position[:, -1])[0]
    reached, came = bool(arc[-1] >= route.goal), float(arc.max())
    left = f"{1e3 * (route.goal - came):.3g} mm are left"
    return Trial(
        change=change,
        reached=reached,
        came=came,
        peak_field=float(np.linalg.norm(result.field, axis=1).max()),
        tip_force=result.max_tip_force,
        clearance=result.smallest_clearance,
        reason="" if reached else f"{left}. {result.message}".strip(),
    )


def _anew(
    change: str, lumen: Lumen, wire: Wire, demands: Demands | None, contact: Barrier | None
) -> Trial:
    """Plan again."""
    outlets = (str(lumen.target),) if lumen.outlets else ()
    (found,) = plan(lumen, wire, demands=demands, contact=contact, outlets=outlets)
    reason = "" if found.reached else found.reason
    return Trial(
        change,
        found.reached,
        found.came,
        found.peak_field,
        found.tip_force,
        found.clearance,
        reason,
    )

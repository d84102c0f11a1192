"""What ``magwire plan`` is to do, as its options say."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from magwire.cli.reading import spot
from magwire.contact import Barrier
from magwire.errors import InputError, one_of, positive
from magwire.lumen import Lumen
from magwire.lumen.names import meant
from magwire.many.planners import NOBODY, Check, Crew, Task, check_at_once, plan_at_once
from magwire.navigate.demands import Demands
from magwire.planning import Prospect, Trial, plan
from magwire.planning.perturbations import CHANGES, tried
from magwire.units import parse
from magwire.vessel import Source, Vessel
from magwire.wire import Wire

if TYPE_CHECKING:
    from magwire.scenario import Scenario

FINE = 0.2  # edge length at least, over the smallest radius of the lumen
SAG = 0.025  # of an edge in the tightest bend at most, over the least room for the wire
FINEST = 0.5  # edge length at least, over the radius of the wire
MAGNET = 10.0  # length of the magnet, over the radius of the wire, if nothing else is said
TRUNK = 5.0  # length of a wire before it is fitted to its way, over that of its magnet
POISSON = 0.5
DENSITY = 2000.0  # plays no part in equilibria [kg/m^3]
DEFAULTS = {"modulus": "3 MPa", "magnetization": "128 kA/m"}

Words = Mapping[str, str | None]
WallKind = Literal["balls", "surface"]


class Work(NamedTuple):
    """What is to be planned.

    Attributes
    ----------
    lumen, wire
        The lumen, and the wire that goes through it.
    demands, contact
        What the field must keep to, and the wall's barrier; one that fits if None.
    notes
        What was done to the vessel's file, a sentence each.
    vessel
        What the file holds; None for a scenario.
    """

    lumen: Lumen
    wire: Wire
    demands: Demands
    contact: Barrier | None
    notes: tuple[str, ...]
    vessel: Vessel | None


def of_file(
    source: Source,
    units: str | None,
    words: Words,
    options: dict[str, Any],
    wall: WallKind = "balls",
) -> Work:
    """What to plan for a vessel's file.

    Parameters
    ----------
    source, units, options
        For ``Vessel.read``.
    words
        Texts by name: the wire's ``diameter``, ``modulus``, ``magnetization`` and ``magnet``, and
        the largest ``field``.
    wall
        As of ``Vessel.lumen``.
    """
    if words["diameter"] is None:
        raise InputError(
            "Input --wire must be the wire's diameter, such as '0.6 mm'; received none."
        )
    _read(words, "diameter", "diameter", "--wire")  # better said before the file is read
    vessel = Vessel.read(source, units, **options)
    lumen = vessel.lumen(wall=wall)
    demands = _demands(words, Demands())
    notes = vessel.record(wall)
    return Work(lumen, _wire(words, lumen), demands, None, notes, vessel)


def of_scenario(scenario: Scenario, words: Words) -> Work:
    """What to plan for a scenario: its lumen, its wire, its wall, and its steering's demands."""
    job = scenario.build()
    system = job.simulation.system
    lumen, wire = system.lumen, system.wire
    if words["diameter"] is not None:
        radius = 0.5 * _read(words, "diameter", "diameter", "--wire")
        parts = (replace(part, radius=radius, end_radius=None) for part in wire.sections)
        wire = Wire(tuple(parts), wire.nodes)
    steered = {
        name: value
        for name in Demands.__dataclass_fields__
        if (value := getattr(scenario.navigate, name, None)) is not None
    }
    demands = _demands(words, Demands(**steered))
    notes = list(scenario.notes)
    if system.actuator is not None:
        notes.append(
            "The plan is one of a uniform field: the scenario's [actuator] plays no part in it; "
            "'magwire run' steers by its inputs."
        )
    return Work(lumen, wire, demands, system.contact, tuple(notes), None)


def outlets(work: Work, targets: Sequence[str]) -> tuple[str, ...]:
    """The outlets that are asked for, each once; if none is all of them, the nearest one first."""
    known = work.lumen.outlets
    if not targets or not known:
        ways = work.lumen.paths
        return tuple(sorted(known, key=lambda name: ways[name].length)) or ("outlet",)
    if work.vessel is not None:
        found = [work.vessel.outlet(spot(target, "--target")) for target in targets]
        return tuple(dict.fromkeys(name for name in found if name is not None))
    names = (one_of("magwire plan", "--target", meant(name, known), known) for name in targets)
    return tuple(dict.fromkeys(names))


def carried_out(
    work: Work, names: Sequence[str], workers: int = 1, crew: Crew = NOBODY
) -> Iterator[Prospect]:
    """Plan for outlets, as many at a time as there are workers; yielded as they are done."""
    if workers > 1 and len(names) > 1:
        task = Task(work.lumen, work.wire, work.demands, work.contact)
        yield from plan_at_once(task, names, workers, crew)
        return
    for name in names:
        yield from plan(
            work.lumen,
            work.wire,
            demands=work.demands,
            contact=work.contact,
            outlets=(name,) if work.lumen.outlets else (),
        )


def checked(
    work: Work, prospects: Sequence[Prospect], workers: int = 1
) -> Iterator[tuple[str, Trial]]:
    """Try the ways to outlets, as many changes at a time as there are workers.

    Yielded as they are done, with the outlet's name.
    """
    orders = [(change, prospect) for prospect in prospects for change in CHANGES]
    if workers > 1:
        task = Task(work.lumen, work.wire, work.demands, work.contact)
        yield from check_at_once(task, [Check(*order) for order in orders], workers)
        return
    for order in orders:
        yield order[1].outlet, tried(*order, work.lumen, work.wire, work.demands, work.contact)


def in_order(trials: Sequence[Trial]) -> tuple[Trial, ...]:
    """Trials in the order in which they are listed, whichever was done first."""
    return tuple(sorted(trials, key=lambda trial: CHANGES.index(trial.change)))


def fingerprint(work: Work) -> str:
    """A few letters that are the same for the same lumen, wire, demands, wall and version only."""
    from magwire import __version__

    known = [one.name for one in fields(Prospect)]
    seen = hashlib.sha256(repr((__version__, known, work.wire.nodes)).encode())
    seen.update(repr((work.wire.sections, work.demands, work.contact)).encode())
    ways = work.lumen.paths or {"outlet": work.lumen.branches[0]}
    for name in sorted(ways):
        seen.update(name.encode())
        for part in ways[name].centreline():
            seen.update(np.ascontiguousarray(part).tobytes())
    if work.lumen.sheet is not None:
        seen.update(np.ascontiguousarray(work.lumen.sheet.points).tobytes())
        seen.update(np.ascontiguousarray(work.lumen.sheet.triangles).tobytes())
    return seen.hexdigest()[:16]


def _wire(words: Words, lumen: Lumen) -> Wire:
    """A wire of one material with a magnet at its tip."""
    radius = 0.5 * _read(words, "diameter", "diameter", "--wire")
    modulus = _read(words, "modulus", "pressure", "--youngs-modulus")
    magnet = MAGNET * radius
    if words["magnet"] is not None:
        magnet = _read(words, "magnet", "length", "--magnetized-tip")
    edge = min(max(radius, FINE * lumen.narrowest), magnet)
    room, bend = lumen.narrowest - radius, min(bend.radius for bend in lumen.bend_radius())
    if room > 0.0:
        edge = min(edge, max(FINEST * radius, math.sqrt(8.0 * bend * SAG * room)))
    edges = max(round(TRUNK * magnet / edge), 8)
    return Wire.uniform(
        length=edges * edge,
        radius=radius,
        youngs_modulus=modulus,
        shear_modulus=modulus / (2.0 * (1.0 + POISSON)),
        density=DENSITY,
        nodes=edges + 1,
        magnetized_tip=magnet,
        magnetization=_read(words, "magnetization", "magnetization", "--magnetization"),
    )


def _demands(words: Words, given: Demands) -> Demands:
    """What the field must keep to, with the limit that was asked for."""
    if words["field"] is None:
        return given
    return replace(given, max_field=_read(words, "field", "flux_density", "--max-field"))


def _read(words: Words, name: str, dimension: str, option: str) -> float:
    """A positive quantity of an option."""
    value = parse(words[name] or DEFAULTS.get(name), dimension, option)
    return positive("magwire plan", option, value)

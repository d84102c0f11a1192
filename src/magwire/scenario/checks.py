"""Checks across the keys of a scenario: each yields the faults it finds, one sentence each."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Callable, Iterator

from magwire.errors import InputError
from magwire.scenario.lumens import PointsLumen, TreeLumen
from magwire.scenario.model import Scenario
from magwire.scenario.navigators import ModelSteering, ScheduledSteering
from magwire.scenario.synthetic import SyntheticLumen
from magwire.scenario.tables import (
    ConstantFeed,
    MakeTable,
    SectionedWire,
    TabledFeed,
    UniformFieldTable,
    UniformWire,
)
from magwire.scenario.vessels import VesselLumen
from magwire.units import show
from magwire.wire.make import Make, contradictions

Faults = Iterator[str]
SLACK = 1e-9
"""Relative room for rounding in comparisons of lengths."""


def makes(scenario: Scenario) -> Faults:
    """What a wire is made of is said once, and nothing is left out."""
    for where, table in _makes(scenario):
        given = {name for name in Make.__dataclass_fields__ if vars(table).get(name, 0) is not None}
        yield from contradictions(given, (where + ".{}").format)


def bores(scenario: Scenario) -> Faults:
    """A hollow wire has some wall."""
    if any(makes(scenario)):
        return
    for name, table in _makes(scenario):
        if table.bore >= table.outer_radius:
            inner = "inner_radius" if table.inner_radius is not None else "inner_diameter"
            outer = "radius" if table.radius is not None else "diameter"
            has = table.bore if inner == "inner_radius" else table.inner_diameter
            limit = table.outer_radius if outer == "radius" else table.diameter
            yield (
                f"Input {name}.{inner} must be smaller than {name}.{outer}, "
                f"{show(limit or 0.0, 'length')}; received {show(has or 0.0, 'length')}."
            )


def magnetized_tip(scenario: Scenario) -> Faults:
    """The magnetised tip is part of the wire, and the mesh resolves it."""
    wire = scenario.wire
    if not isinstance(wire, UniformWire) or not wire.magnetized:
        return
    tip, received = wire.magnetized_tip, show(wire.magnetized_tip, "length")
    if tip == 0.0:
        yield (
            f"Input wire.magnetized_tip must be positive for a wire with wire.{_magnet(wire)}; "
            f"received {received}."
        )
    elif tip > wire.length * (1.0 + SLACK):
        yield (
            "Input wire.magnetized_tip must be at most wire.length, "
            f"{show(wire.length, 'length')}; received {received}."
        )
    else:
        least = math.ceil(wire.length / tip * (1.0 - SLACK)) + 1
        if wire.nodes < least:
            yield (
                f"Input wire.nodes must be at least {least} for a magnetised tip of {received} "
                f"to span one edge; received {wire.nodes}."
            )


def magnetized_sections(scenario: Scenario) -> Faults:
    """The mesh resolves every magnetised section."""
    wire = scenario.wire
    if not isinstance(wire, SectionedWire):
        return
    for i, section in enumerate(wire.sections):
        least = math.ceil(wire.total_length / section.length * (1.0 - SLACK)) + 1
        if section.magnetized and wire.nodes < least:
            yield (
                f"Input wire.nodes must be at least {least} for the magnetised wire.sections[{i}] "
                f"of {show(section.length, 'length')} to span one edge; received {wire.nodes}."
            )


def wire_fits(scenario: Scenario) -> Faults:
    """The wire is thinner than the lumen."""
    if any(any(check(scenario)) for check in (makes, outlets, formula)):
        return
    wire, lumen = scenario.wire.largest_radius, scenario.lumen.narrowest
    if wire >= lumen:
        wide = isinstance(scenario.wire, UniformWire) and scenario.wire.radius is None
        what, times = ("diameter", 2.0) if wide else ("radius", 1.0)
        yield (
            f"Input wire.{what} must be smaller than the lumen's smallest {what}, "
            f"{show(times * lumen, 'length')}; received {show(times * wire, 'length')}."
        )


def activation_gap(scenario: Scenario) -> Faults:
    """A wire in the middle of the lumen does not feel the wall."""
    if any(any(check(scenario)) for check in (makes, outlets, formula)):
        return
    wire, lumen = scenario.wire.largest_radius, scenario.lumen.narrowest
    free = lumen - wire if scenario.contact.wall == "surface" else lumen
    gap = scenario.contact.activation_gap
    if wire < lumen and gap != "auto" and gap >= free:
        yield (
            "Input contact.activation_gap must be smaller than the free gap of the lumen, "
            f"{show(free, 'length')}; received {show(gap, 'length')}."
        )


def radii(scenario: Scenario) -> Faults:
    """There is one radius for all points, or one for each."""
    lumen = scenario.lumen
    if isinstance(lumen, PointsLumen) and len(lumen.radius) not in (1, len(lumen.points)):
        yield (
            f"Input lumen.radius must be one value or one for each of the {len(lumen.points)} "
            f"points; received {len(lumen.radius)}."
        )


def outlets(scenario: Scenario) -> Faults:
    """The arc lengths of a tree's branches start at zero and grow; the target is one of them."""
    lumen = scenario.lumen
    if not isinstance(lumen, (TreeLumen, VesselLumen)):
        return
    for name, rows in lumen.branches.items() if isinstance(lumen, TreeLumen) else ():
        arcs = [row[0] for row in rows]
        if arcs[0] != 0.0 or any(b <= a for a, b in itertools.pairwise(arcs)):
            yield (
                f"Input lumen.branches.{name} must have arc lengths that start at 0 mm and "
                f"increase; received {', '.join(show(arc, 'length') for arc in arcs)}."
            )
    if lumen.target not in lumen.branches:
        words = ", ".join(f"'{name}'" for name in lumen.branches)
        yield f"Input lumen.target must be one of the outlets {words}; received {lumen.target!r}."


def formula(scenario: Scenario) -> Faults:
    """A vessel with a formula can be made."""
    if isinstance(scenario.lumen, SyntheticLumen):
        for fault in refusals(scenario.lumen.build):  # the points are no key of such a lumen
            yield fault.replace("Input lumen.points must", "Input lumen must", 1)


def bends(scenario: Scenario) -> Faults:
    """The lumen's centreline bends more gently than the lumen is wide."""
    lumen = scenario.lumen
    if any(radii(scenario)) or any(outlets(scenario)) or isinstance(lumen, SyntheticLumen):
        return
    if isinstance(lumen, (PointsLumen, VesselLumen)):
        yield from refusals(lumen.build)
    elif lumen.tightest_bend <= lumen.radius:
        yield (
            "Input lumen must bend with a radius larger than lumen.radius, "
            f"{show(lumen.radius, 'length')}; received a bend radius of "
            f"{show(lumen.tightest_bend, 'length')}."
        )
    else:
        yield from refusals(lumen.build)


def feed_within_wire(scenario: Scenario) -> Faults:
    """No more wire is fed than there is."""
    fed, length = _farthest(scenario), scenario.wire.total_length
    if fed > length * (1.0 + SLACK):
        yield (
            f"Input {_feed_key(scenario)} must be at most the length of the wire, "
            f"{show(length, 'length')}; received {show(fed, 'length')}."
        )


def feed_within_lumen(scenario: Scenario) -> Faults:
    """The wire does not come out at the far end."""
    if any(any(check(scenario)) for check in (radii, outlets, formula, bends)):
        return
    fed, length = _farthest(scenario), scenario.lumen.build().length
    if fed > length * (1.0 + SLACK):
        yield (
            f"Input {_feed_key(scenario)} must be at most the length of the lumen, "
            f"{show(length, 'length')}; received {show(fed, 'length')}."
        )


def feed_table(scenario: Scenario) -> Faults:
    """A table's times start at zero and grow, and the wire is not drawn out of the lumen."""
    feed = scenario.feed
    if not isinstance(feed, TabledFeed):
        return
    in_order = True
    for name, rows in (("table", feed.table), ("twist_table", feed.twist_table)):
        times = [row[0] for row in rows] if rows else [0.0]
        if times[0] != 0.0 or any(b <= a for a, b in itertools.pairwise(times)):
            in_order = False
            yield (
                f"Input feed.{name} must have times that start at 0 s and increase; "
                f"received {', '.join(show(time, 'time') for time in times)}."
            )
    if in_order:
        lowest, highest = feed.extremes
        if lowest < -SLACK * max(highest, 1.0):
            yield (
                "Input feed.table must not retract more wire than it has fed; "
                f"received a feed of {show(lowest, 'length')}."
            )
        if highest <= 0.0:
            yield "Input feed.table must feed some wire; received a feed of 0 mm."


def time_step(scenario: Scenario) -> Faults:
    """A run in time has at least one whole step."""
    duration, step = scenario.feed.duration, scenario.solver.time_step
    if step > duration and scenario.solver.motion == "dynamic":
        yield (
            "Input solver.time_step must be at most the duration of the feed, "
            f"{show(duration, 'time')}; received {show(step, 'time')}."
        )


def sources(scenario: Scenario) -> Faults:
    """A linear field obeys Maxwell's equations in free space."""
    source = scenario.field
    if isinstance(source, UniformFieldTable):
        return
    rows = source.gradient
    size = max(abs(entry) for row in rows for entry in row)
    trace = rows[0][0] + rows[1][1] + rows[2][2]
    if abs(trace) > 1e-6 * size:
        yield (
            "Input field.gradient must have a trace of zero (no sources of flux); "
            f"received {show(trace, 'flux_gradient')}."
        )
    skew = max(abs(rows[i][j] - rows[j][i]) for i in range(3) for j in range(i))
    if skew > 1e-6 * size:
        yield (
            "Input field.gradient must be symmetric (no currents in the lumen); "
            f"received a difference of {show(skew, 'flux_gradient')} across the diagonal."
        )


def schedule(scenario: Scenario) -> Faults:
    """The feeds of a schedule grow."""
    navigate = scenario.navigate
    if not isinstance(navigate, ScheduledSteering):
        return
    for before, after in itertools.pairwise(row[0] for row in navigate.table):
        if after <= before:
            yield (
                "Input navigate.table must have feeds that increase; received "
                f"{show(after, 'length')} after {show(before, 'length')}."
            )
            return


def magnet_to_steer(scenario: Scenario) -> Faults:
    """A wire that is steered has a magnet."""
    if not isinstance(scenario.navigate, ModelSteering):
        return
    wire = scenario.wire
    sections = (wire,) if isinstance(wire, UniformWire) else wire.sections
    if not any(section.magnetized for section in sections):
        key = "magnetization" if isinstance(wire, UniformWire) else "sections"
        yield (
            f"Input wire.{key} must have a magnetisation for navigate.method "
            f"'{scenario.navigate.method}'; received none."
        )


def field_to_steer(scenario: Scenario) -> Faults:
    """The navigator's model knows of no field but its own."""
    if not isinstance(scenario.navigate, ModelSteering):
        return
    source, method = scenario.field, scenario.navigate.method
    if not isinstance(source, UniformFieldTable):
        yield (
            f"Input field.kind must be 'uniform' for navigate.method '{method}'; "
            "received 'gradient'."
        )
    elif any(source.flux_density):
        given = ", ".join(show(component, "flux_density") for component in source.flux_density)
        yield (
            f"Input field.flux_density must be zero for navigate.method '{method}', which knows of "
            f"no field but its own; received {given}."
        )


def refusals(build: Callable[[], object]) -> Faults:
    """What a model refuses, in the scenario's words."""
    try:
        build()
    except InputError as error:
        yield _OWNER.sub(lambda found: f"Input {_TABLES[found[2]]}.{found[1]}", str(error), count=1)


_TABLES = {
    "Branch": "lumen",
    "Lumen": "lumen",
    "aortic_arch": "lumen",
    "carotid_bifurcation": "lumen",
    "coronary_tree": "lumen",
    "tortuous": "lumen",
    "Wire": "wire",
    "Make": "wire",
    "Section": "wire",
    "UniformField": "field",
    "GradientField": "field",
    "Barrier": "contact",
    "Friction": "contact.friction",
    "Feed": "feed",
    "Demands": "navigate",
    "StableNavigator": "navigate",
    "Schedule": "navigate",
    "Simulation": "solver",
}
_OWNER = re.compile(rf"^Input (\w+) of ({'|'.join(_TABLES)})(?:\.\w+)?\b")

CHECKS: tuple[Callable[[Scenario], Faults], ...] = (
    makes,
    bores,
    magnetized_tip,
    magnetized_sections,
    wire_fits,
    activation_gap,
    radii,
    outlets,
    formula,
    bends,
    feed_table,
    feed_within_wire,
    feed_within_lumen,
    time_step,
    sources,
    schedule,
    magnet_to_steer,
    field_to_steer,
)


def cross_faults(scenario: Scenario, *, whole: bool) -> list[str]:
    """All faults that the checks find.

    Parameters
    ----------
    scenario
        The scenario, or what is left of it without its faulty keys.
    whole
        Whether nothing is left out. If something is, a check that asks for it is skipped.
    """
    faults: list[str] = []
    for check in CHECKS:
        try:
            faults += check(scenario)
        except AttributeError:
            if whole:
                raise
    return list(dict.fromkeys(faults))


def _makes(scenario: Scenario) -> Iterator[tuple[str, MakeTable]]:
    """Each table that says what wire is made of, with its name."""
    wire = scenario.wire
    if isinstance(wire, UniformWire):
        yield "wire", wire
    else:
        for i, section in enumerate(wire.sections):
            yield f"wire.sections[{i}]", section


def _magnet(wire: MakeTable) -> str:
    """The key that magnetises the wire."""
    return "magnetization" if wire.remanence is None else "remanence"


def _farthest(scenario: Scenario) -> float:
    feed = scenario.feed
    return feed.distance if isinstance(feed, ConstantFeed) else feed.extremes[1]


def _feed_key(scenario: Scenario) -> str:
    return "feed.distance" if isinstance(scenario.feed, ConstantFeed) else "feed.table"

"""Rules between the tables of a scenario: each yields the faults it finds, one sentence each."""

from __future__ import annotations

from collections.abc import Callable

from magwire.scenario.kind import FAMILIES, Faults, KindTable
from magwire.scenario.kinds.navigate import ModelSteering
from magwire.scenario.model import Scenario
from magwire.scenario.quantity import SLACK
from magwire.scenario.table import FaultyKeyError
from magwire.units import show


def wire_fits(scenario: Scenario) -> Faults:
    """The wire is thinner than the lumen."""
    if any(scenario.wire.clashes()) or any(scenario.lumen.clashes()):
        return
    wire, lumen = scenario.wire.largest_radius, scenario.lumen.narrowest
    if wire >= lumen:
        what = scenario.wire.width_key
        times = 2.0 if what == "diameter" else 1.0
        yield (
            f"Input wire.{what} must be smaller than the lumen's smallest {what}, "
            f"{show(times * lumen, 'length')}; received {show(times * wire, 'length')}."
        )


def activation_gap(scenario: Scenario) -> Faults:
    """A wire in the middle of the lumen does not feel the wall."""
    if any(scenario.wire.clashes()) or any(scenario.lumen.clashes()):
        return
    wire, lumen = scenario.wire.largest_radius, scenario.lumen.narrowest
    free = lumen - wire if scenario.contact.wall == "surface" else lumen
    gap = scenario.contact.activation_gap
    if wire < lumen and gap != "auto" and gap >= free:
        yield (
            "Input contact.activation_gap must be smaller than the free gap of the lumen, "
            f"{show(free, 'length')}; received {show(gap, 'length')}."
        )


def feed_within_wire(scenario: Scenario) -> Faults:
    """No more wire is fed than there is."""
    fed, length = scenario.feed.farthest, scenario.wire.total_length
    if fed > length * (1.0 + SLACK):
        yield (
            f"Input feed.{scenario.feed.length_key} must be at most the length of the wire, "
            f"{show(length, 'length')}; received {show(fed, 'length')}."
        )


def feed_within_lumen(scenario: Scenario) -> Faults:
    """The wire does not come out at the far end."""
    if any(scenario.lumen.clashes()) or any(scenario.lumen.faults()):
        return
    fed, length = scenario.feed.farthest, scenario.lumen.build().length
    if fed > length * (1.0 + SLACK):
        yield (
            f"Input feed.{scenario.feed.length_key} must be at most the length of the lumen, "
            f"{show(length, 'length')}; received {show(fed, 'length')}."
        )


def time_step(scenario: Scenario) -> Faults:
    """A run in time has at least one whole step."""
    duration, step = scenario.feed.duration, scenario.solver.time_step
    if step > duration and scenario.solver.motion == "dynamic":
        yield (
            "Input solver.time_step must be at most the duration of the feed, "
            f"{show(duration, 'time')}; received {show(step, 'time')}."
        )


def magnet_to_steer(scenario: Scenario) -> Faults:
    """A wire that is steered has a magnet."""
    if isinstance(scenario.navigate, ModelSteering) and not scenario.wire.magnetized:
        yield (
            f"Input wire.{scenario.wire.magnet_key} must have a magnetisation for navigate.method "
            f"'{scenario.navigate.method}'; received none."
        )


def field_to_steer(scenario: Scenario) -> Faults:
    """The navigator's model samples the outside field once: it is linear in space."""
    if not isinstance(scenario.navigate, ModelSteering) or any(scenario.field.clashes()):
        return
    if not scenario.field.build().affine:
        yield (
            "Input field.kind must be linear in space, such as 'uniform' or 'gradient', for "
            f"navigate.method '{scenario.navigate.method}'; received '{scenario.field.kind}'."
        )


def _own(name: str, check: Callable[[KindTable], Faults]) -> Callable[[Scenario], Faults]:
    """The checks that a table makes itself."""
    return lambda scenario: check(getattr(scenario, name))


CHECKS: tuple[Callable[[Scenario], Faults], ...] = (
    *(_own(name, lambda table: table.clashes()) for name in FAMILIES),
    *(_own(name, lambda table: table.faults()) for name in FAMILIES),
    wire_fits,
    activation_gap,
    feed_within_wire,
    feed_within_lumen,
    time_step,
    magnet_to_steer,
    field_to_steer,
)


def cross_faults(scenario: Scenario) -> list[str]:
    """All faults that the tables find in themselves, and that the rules between them find.

    Parameters
    ----------
    scenario
        The scenario, or what is left of it without its faulty keys: a check that asks for one of
        these is left out.
    """
    faults: list[str] = []
    for check in CHECKS:
        try:
            faults += check(scenario)
        except FaultyKeyError:
            continue
    return list(dict.fromkeys(faults))

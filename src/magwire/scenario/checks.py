"""Rules between the tables of a scenario: each yields the faults it finds, one sentence each."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from magwire.actuate import Uniform
from magwire.errors import InputError
from magwire.scenario.kind import FAMILIES, Faults, KindTable
from magwire.scenario.kinds.navigate import ModelSteering
from magwire.scenario.kinds.navigate.inputs import InputSteering
from magwire.scenario.kinds.navigate.stable import StableSteering
from magwire.scenario.kinds.navigate.timed import TimedSteering
from magwire.scenario.model import Scenario
from magwire.scenario.quantity import SLACK
from magwire.scenario.table import FaultyKeyError
from magwire.units import show

WAY = 201
"""Points of the lumen at which the actuator has to be calibrated."""


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


def inputs_to_steer(scenario: Scenario) -> Faults:
    """Who steers by inputs has an actuator that has them."""
    navigate, table = scenario.navigate, scenario.actuator
    if isinstance(navigate, StableSteering) and navigate.objective and table is None:
        yield (
            "Input navigate.objective needs an [actuator] whose inputs are planned; "
            f"received '{navigate.objective}' without one."
        )
    if isinstance(navigate, TimedSteering) and (table is None or not any(table.faults())):
        try:
            navigate.inputs().of(Uniform() if table is None else table.build())
        except InputError as error:
            yield f"Input navigate.table: {error}"
    if not isinstance(navigate, InputSteering):
        return
    if table is None:
        yield "Input navigate.method 'inputs' needs an [actuator] whose inputs it sets."
    elif not any(table.faults()):
        try:
            navigate.schedule().of(table.build())
        except InputError as error:
            yield f"Input navigate.table: {error}"


def actuator_reaches(scenario: Scenario) -> Faults:
    """The wire stays in the box in which its actuator is calibrated."""
    table = scenario.actuator
    if table is None or table.may_leave or any(table.faults()):
        return
    if any(scenario.lumen.clashes()) or any(scenario.lumen.faults()):
        return
    actuator = table.build()
    curve = scenario.lumen.build().path().branches[0].curve
    arc = np.linspace(0.0, min(curve.length, scenario.feed.farthest), WAY)
    tube = curve.at(arc)
    sides = tube[:, None, :3] + tube[:, None, 3:] * np.concatenate([np.eye(3), -np.eye(3)])
    away = actuator.outside(sides.reshape(-1, 3)).reshape(len(arc), 6).max(axis=1)
    worst = int(np.argmax(away))
    if away[worst] > 0.0:
        remedy = "or ask for extrapolation by actuator.extrapolate = true"
        yield (
            f"The box in which the actuator is calibrated must hold the lumen; at "
            f"{show(float(arc[worst]), 'length')} along it, the lumen is "
            f"{show(float(f'{away[worst]:.3g}'), 'length')} outside: move the actuator by "
            "actuator.pose, scale the lumen"
            + (f", {remedy}." if "extrapolate" in type(table).model_fields else ".")
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
    """The checks that a table makes itself, if it is there."""

    def own(scenario: Scenario) -> Faults:
        table = getattr(scenario, name)
        if table is not None:
            yield from check(table)

    return own


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
    inputs_to_steer,
    actuator_reaches,
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

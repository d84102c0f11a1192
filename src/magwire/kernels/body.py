"""A moving wire as one object for compiled code.

A call pays for every array that is handed over: seventy of them cost more than a time step. A body
is one handle instead; the functions here look up what lies behind it, and do nothing else.
"""

from __future__ import annotations

from typing import NamedTuple

from magwire.kernels._handle import Handle, parts_of
from magwire.kernels._jit import entry, kernel
from magwire.kernels.arrays import Array, Guide, Motion, Mouth, State, Terms, Work
from magwire.kernels.centreline import LumenArrays
from magwire.kernels.glance import GLANCE, glance
from magwire.kernels.guide import find_mouth, place_held
from magwire.kernels.linearise import linearise
from magwire.kernels.march import Drive, Tally, march
from magwire.kernels.newton import Limits, newton
from magwire.kernels.observe import observe, read_tally
from magwire.kernels.sheet import Sheet
from magwire.kernels.wall.motion import move_wall
from magwire.kernels.wall.traction import read_friction


class Queue(NamedTuple):
    """Where guide and inputs are at the ends of steps that wait: feed, twist [k]; inputs [k, m]."""

    feed: Array
    twist: Array
    inputs: Array


INPUTS = GLANCE + 2
"""Where inputs begin in what is seen of a wire."""


class Sight(NamedTuple):
    """Where what is seen of a wire without a record is written, and what it takes.

    seen [INPUTS + m] as of ``glance``, in SI, then feed, twist and inputs; length, force: units of
    what is scaled; patch, turn: see ``glance``.
    """

    seen: Array
    length: float
    force: float
    patch: float
    turn: tuple[float, float]


class Parts(NamedTuple):
    """What a moving wire is made of.

    model: what its energy is made of; path: the way to the target, as a single tube; queue: what is
    to be done; sheet, sight: where what a record holds, and what is seen at once, is written.
    """

    model: Terms
    path: LumenArrays
    guide: Guide
    state: State
    work: Work
    limits: Limits
    tally: Tally
    queue: Queue
    sheet: Sheet
    sight: Sight


class Body(Handle):
    """The parts of a moving wire, behind one address."""

    def __init__(self, parts: Parts) -> None:
        super().__init__(parts)


@entry
def advance(body, count, time_step, damping, inertia):
    """The first steps of the queue; how many were done, and how the last one ended.

    They are taken from the body: a call that hands over arrays costs as much as a short step.
    """
    p = parts_of(body)
    feed, twist, inputs = p.queue
    drive = Drive(feed[:count], twist[:count], inputs[:count], time_step, damping, inertia)
    return march(p.model, p.guide, p.state, p.work, p.limits, drive, p.tally)


@entry
def place_wall(body):
    """Put the wall where it is at the state's time, if it moves."""
    p = parts_of(body)
    time = p.state.clock[0]
    move_wall(p.model.lumen.moving, p.model.wall, time, time)


@entry
def rest(body, limits):
    """Newton's method to the equilibrium nearby; see ``newton``."""
    p = parts_of(body)
    mouth = mouth_of(p.model.rod, p.guide, p.state)
    return newton(p.model, p.state, mouth, Motion(0.0, p.work.target), p.work, limits)


@entry
def linearised(body, linear):
    """Linearise the equilibrium about its uniform field; see ``linearise``."""
    p = parts_of(body)
    mouth = mouth_of(p.model.rod, p.guide, p.state)
    return linearise(p.model, p.state, mouth, p.work, linear)


@entry
def survey(body, length, force):
    """Put what the guide holds in its place and fill the sheet; see ``observe``."""
    p = parts_of(body)
    mouth = mouth_of(p.model.rod, p.guide, p.state)
    scales = (length, force)
    read_friction(
        p.model.wall.friction, p.model.rod, p.state, mouth.held, p.sheet.friction_force, force
    )
    place_held(p.model.rod, p.guide, p.state, 0, mouth.held, p.state.guide[0], p.state.guide[1])
    observe(p.model, p.path, p.guide, p.state, mouth, p.work, p.sheet, scales)
    read_tally(p.tally, p.sheet, scales)


@kernel
def mouth_of(rod, guide, state):
    """Where the guide ends."""
    held, fraction = find_mouth(rod, guide, state.guide[0])
    return Mouth(held, fraction)


@entry
def look(body):
    """Fill what the body's ``Sight`` names with a glance at the wire, in SI."""
    p = parts_of(body)
    seen, length, force, patch, turn = p.sight
    glance(p.model, p.state, p.work, patch, turn, seen)
    for c in range(3):
        seen[c] *= length
        seen[6 + c] *= force
    seen[9] *= length
    seen[GLANCE], seen[GLANCE + 1] = p.state.guide[0] * length, p.state.guide[1]
    for c in range(p.state.inputs.shape[0]):
        seen[INPUTS + c] = p.state.inputs[c]

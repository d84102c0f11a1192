"""A moving wire as one object for compiled code.

A call pays for every array that is handed over: seventy of them cost more than a time step. The
body is one reference instead. To follow it takes numba's runtime, which the kernels are without:
the functions here do nothing else.
"""

from __future__ import annotations

from typing import NamedTuple

from numba import types
from numba.experimental import structref

from magwire.kernels._jit import entry
from magwire.kernels.arrays import Field, Guide, Rod, State, Wall, Work
from magwire.kernels.centreline import LumenArrays
from magwire.kernels.glance import glance
from magwire.kernels.march import Drive, Tally, march
from magwire.kernels.newton import Limits


class Parts(NamedTuple):
    """What a moving wire is made of; ``model`` is what its energy needs."""

    model: tuple[Rod, Field, Wall, LumenArrays]
    guide: Guide
    state: State
    work: Work
    limits: Limits
    tally: Tally


@structref.register
class BodyType(types.StructRef):  # type: ignore[misc]
    """Numba's type of a body."""


class Body(structref.StructRefProxy):  # type: ignore[misc]
    """The parts of a moving wire, behind one reference; ``make_body`` makes one."""


structref.define_proxy(Body, BodyType, ["parts"])


@entry
def make_body(parts):
    """The body of some parts, which stay where they are."""
    return Body(parts)


@entry
def advance(body, feed, twist, inputs, time_step, damping, inertia):
    """Time steps along a drive; steps done, and how the last one ended."""
    p = body.parts
    drive = Drive(feed, twist, inputs, time_step, damping, inertia)
    return march(p.model, p.guide, p.state, p.work, p.limits, drive, p.tally)


@entry
def look(body, patch, turn, seen):
    """Fill ``seen`` with a glance at the wire."""
    p = body.parts
    glance(p.model, p.state, p.work, patch, turn, seen)

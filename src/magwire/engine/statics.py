"""Equilibria at a given feed and field, with their certificate (P-16)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate.magnets import nearest_magnet
from magwire.engine.hold import Hold, carry
from magwire.engine.plant import Plant
from magwire.engine.point import Point
from magwire.engine.sampling import unsampled_stiffness
from magwire.engine.sensitivity import Input, Output, derivative
from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.engine.tip import tip_direction
from magwire.engine.uneven import Settled, settle
from magwire.errors import ConvergenceError, InputError, array, finite, within
from magwire.field import FieldSource
from magwire.kernels.arrays import Mouth, State
from magwire.kernels.guide import find_mouth, place_held
from magwire.kernels.hinge import transport
from magwire.units import show

Array = NDArray[np.float64]
FEWEST = 4  # nodes past the guide of a wire whose last edge is held


@dataclass(frozen=True, repr=False)
class Equilibrium:
    """A wire at rest, and what certifies it (P-16).

    Attributes
    ----------
    feed, twist
        Length of wire past the entrance [m]; angle of the guide [rad].
    positions
        Nodes, proximal first, shape (nodes, 3) [m].
    wall_force
        Force of the wall on each node, shape (nodes, 3) [N].
    push_force, guide_torque
        Those of the guide on the wire in front of it: along the guide [N], about it [N m] (P-38).
    clearance
        That of each node to the wall, shape (nodes,) [m]; NaN on the guide.
    stable
        Whether the tangent stiffness is positive definite. An unstable equilibrium is one that
        a real wire leaves.
    residual
        Largest force left over on a free unknown [N].
    iterations
        Newton iterations taken.
    """

    feed: float
    twist: float
    positions: Array
    wall_force: Array
    push_force: float
    guide_torque: float
    clearance: Array
    stable: bool
    residual: float
    iterations: int
    point: Point = field(repr=False)

    def __repr__(self) -> str:
        x, y, z = (1e3 * self.tip).tolist()
        clearance = self.clearance[np.isfinite(self.clearance)]
        least = show(float(clearance.min()), "length") if len(clearance) else "none to tell"
        force = float(np.linalg.norm(self.wall_force, axis=1).sum())
        kind = "stable" if self.stable else "unstable"
        return (
            f"<Equilibrium: {kind}, {show(self.feed, 'length')} inserted, tip at "
            f"({x:.4g}, {y:.4g}, {z:.4g}) mm, smallest clearance {least}, force of the wall "
            f"{show(force, 'force')} on the wire and {show(self.tip_force, 'force')} on the tip>"
        )

    @property
    def tip(self) -> Array:
        """Position of the tip, shape (3,) [m]."""
        result: Array = self.positions[-1]
        return result

    @property
    def tip_direction(self) -> Array:
        """Unit tangent at the tip, shape (3,)."""
        point = self.point
        return tip_direction(point.system, point.state, point.mouth.held)

    @property
    def tip_force(self) -> float:
        """Size of the wall force on the tip node [N]."""
        return float(np.linalg.norm(self.wall_force[-1]))

    def sensitivity(self, output: Output, *, wrt: Input) -> Array:
        """How the equilibrium moves with an input, to first order.

        Parameters
        ----------
        output
            ``"tip"``, shape (3,) [m]; ``"positions"``, shape (nodes, 3) [m]; or
            ``"tip_direction"``, shape (3,).
        wrt
            ``"field"``, shape (3,) [T]; ``"inputs"`` of the actuator, shape (m,); ``"gradient"``,
            shape (3, 3) [T/m], dB_i/dx_j about the origin; ``"feed"`` [m]; ``"twist"`` [rad]; or a
            parameter of each section of the wire:
            ``"youngs_modulus"`` and ``"shear_modulus"``, shape (sections,) [Pa],
            ``"magnetization"``, shape (sections, 3) [A/m], ``"radius"``, shape (sections,) [m], in
            which a bore stays as it is, and so does a stiffness that was given. Each parameter
            counts with all others as they are, also where a Poisson ratio was given.

        Returns
        -------
        array
            Shape of the output followed by the shape of the input.

        Raises
        ------
        InputError
            If output or input is none of these, or a section has no such parameter.

        Notes
        -----
        (P-21): K dq/du = -d(grad E)/du with the tangent stiffness K.
        """
        return derivative(self.point, output, wrt)


def find_equilibrium(
    system: System,
    source: FieldSource,
    feed: float,
    *,
    inputs: ArrayLike | None = None,
    start: Equilibrium | None = None,
    twist: float = 0.0,
    hold: Hold | None = None,
) -> Equilibrium:
    """Static equilibrium at a fixed feed and field; see ``Simulation.equilibrium``."""
    system = system.smooth
    feed, length = finite("Simulation", "feed", feed, "m"), system.wire.length
    if length < feed <= length * (1.0 + 1e-9):  # sections sum to the length but for rounding
        feed = length
    within("Simulation", "feed", feed, "m", low=0.0, high=length)
    twist = finite("Simulation", "twist", twist, "rad")
    part = feed / length
    plant = system.idle.pop() if system.idle else Plant(system, source)
    plant.use(source)
    given = system.idle_inputs if inputs is None else inputs
    state, mouth = plant.state, Mouth(*find_mouth(system.rod, system.guide, part))
    held = mouth.held
    if start is None:
        lay_on_centreline(system, state, held, part, twist)
    else:
        follow(plant, start, part, twist)
    place_held(system.rod, system.guide, state, 0, held, part, twist)
    state.guide[:], state.held[0] = (part, twist), held
    plant.inputs = array("Simulation", "inputs", given, (system.inputs,))
    done = Settled(plant.field, "", 0, 0.0)
    if hold is not None:
        _check_hold(source, start, feed, system.wire.nodes - held)
        done = carry(system, plant.field, state, mouth, hold)
    elif held < system.wire.nodes and source.affine:
        status, taken, left = plant.settle(system.sharp_limits())
        reason = "" if status is Status.CONVERGED else status.remedy
        done = Settled(plant.field, reason, taken, left)
    elif held < system.wire.nodes:
        done = settle(system, source, state, mouth, plant.work)
        plant.sample_again()
    if done.reason or _to_magnet(system, state) < system.wire.radius:
        raise _failure(system, feed, done.reason, state)
    seen = plant.survey()
    stable = seen.stable
    point = Point(system, plant.samples(), plant.snapshot().state, mouth, far_held=hold is not None)
    if held < system.wire.nodes and not source.affine:
        point = replace(point, unsampled=unsampled_stiffness(system, source, state))
    if point.far_held or point.unsampled is not None:
        stable = point.stable
    system.idle.append(plant)
    return Equilibrium(
        feed=feed,
        twist=twist,
        positions=state.q[1:, :3] * system.scales.length,
        wall_force=seen.contact_force,
        push_force=seen.push_force,
        guide_torque=seen.guide_torque,
        clearance=seen.clearance,
        stable=bool(stable),
        residual=done.residual * system.scales.force,
        iterations=done.iterations,
        point=point,
    )


def _check_hold(source: FieldSource, start: Equilibrium | None, feed: float, free: int) -> None:
    """What is held at its far end is not fed, in a field that is linear in space."""
    if not source.affine:
        raise InputError(
            "Input field of Simulation must be uniform or linear for a wire with a held end; "
            f"received {source!r}."
        )
    if start is not None and abs(start.feed - feed) > 1e-9 * feed:
        raise InputError(
            "Input start of Simulation must be at the same feed for a wire with a held end, "
            f"{feed:.10g} m; received {start.feed:.10g} m."
        )
    if free < FEWEST:
        raise InputError(
            f"Input feed of Simulation must let go of {FEWEST} nodes for a wire with a held end; "
            f"received {feed:.10g} m, which lets go of {free}."
        )


def lay_on_centreline(system: System, state: State, held: int, feed: float, twist: float) -> None:
    """Lay the wire along the path to the target, untwisted; feed in wire lengths."""
    tip = len(state.q) - 1
    place_held(system.rod, system.guide, state, 0, tip, feed, twist)
    past = system.rod.station - (system.rod.station[-1] - feed)
    free = np.arange(held + 1, tip + 1)
    if len(free) > 0 and system.lumen.branches:
        curve = system.path.branches[0].curve
        state.q[free, :3] = curve.at(past[free] * system.wire.length)[:, :3] / system.wire.length
    for i in range(held, tip):  # frames carried along the wire: no edge is twisted
        edge = state.q[i + 1, :3] - state.q[i, :3]
        state.length[i] = np.linalg.norm(edge)
        state.tangent[i] = edge / state.length[i]
        before = tuple(state.director[i - 1]), tuple(state.tangent[i - 1])
        state.director[i] = transport(*before, tuple(state.tangent[i]))
    state.q[tip, 3] = state.twist[:] = 0.0


def follow(plant: Plant, start: Equilibrium, feed: float, twist: float) -> None:
    """Feed a wire from an equilibrium on, by equilibria; feed in wire lengths."""
    system, affine = plant.system, plant.source.affine
    plant.start_at(start.point.state)
    before = start.feed / system.wire.length
    steps = math.ceil(abs(feed - before) / (0.5 * system.shortest_edge) - 1e-9)
    course = np.linspace(before, feed, steps + 1)[1:]
    turns = np.linspace(start.twist, twist, steps + 1)[1:]
    still = np.broadcast_to(plant.inputs, (steps, len(plant.inputs))).copy()
    done, status = 0, Status.CONVERGED
    while done < steps and status == Status.CONVERGED:
        some = slice(done, steps if affine else done + 1)
        now, ended = plant.march(course[some], turns[some], still[some], 1.0, inertia=False)
        done, status = done + now, Status(ended)
        if not affine:  # to settle there comes after this
            plant.sample_again()
    if status != Status.CONVERGED:
        raise _failure(system, plant.feed, status.remedy, plant.state)


def _to_magnet(system: System, state: State) -> float:
    """Distance of the free nodes from the nearest magnet of the actuator [m]."""
    free = state.q[int(state.held[0]) + 1 :, :3] * system.scales.length
    return nearest_magnet(system.actuator, state.inputs, free)


def _failure(system: System, feed: float, reason: str, state: State) -> ConvergenceError:
    near = _to_magnet(system, state)
    said = f"The equilibrium at {feed * 1e3:.4g} mm of feed was not found: {reason}."
    if near < system.wire.radius:
        where = f"{1e3 * near:.3g} mm from" if near > 0.0 else f"{-1e3 * near:.3g} mm inside"
        said = (
            f"At {feed * 1e3:.4g} mm of feed the wire snaps onto the magnet: its axis comes to "
            f"{where} the surface; move the magnet away, or turn it round."
        )
    return ConvergenceError(said, state.q[1:, :3] * system.scales.length)

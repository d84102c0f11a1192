"""Inputs that cost least under the tip's and the stability's conditions (P-28).

At a feed the inputs u solve

    min cost(u)   subject to   |offset(u)| <= room,   eigenvalue(u) >= margin   and the limits

by sequential quadratic programming, with the wire's equilibria in the actuator's own field: a
gradient that pulls counts like a torque. Offset and eigenvalue are linearised by moving each input
a little, as the field is nothing that could be chosen freely.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import daqp
import numpy as np
from numpy.typing import NDArray

from magwire.actuate import Actuator, Magnet
from magwire.engine.command import Drive
from magwire.engine.plant import Plant
from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.kernels.linearise import new_linear, steadiness
from magwire.navigate import tuned
from magwire.navigate.demands import Demands
from magwire.navigate.least_cost import held
from magwire.navigate.model import across
from magwire.navigate.programme import NORMALS

Array = NDArray[np.float64]

ROUNDS = 20  # programmes at a feed, at most
TRUST = 0.3  # largest change of an input in a programme, in its unit
LEAST_TRUST = 3e-3
SETTLED = 3e-3  # programmes end when no input changes by more, in its unit
PROBE = 2e-3  # change of an input for its derivatives, in its unit
PENALTY = 300.0  # price of missing a constraint
FORBIDDEN = 1e4  # price of coming too near to the vessel
MISSED = 0.05  # part of the radius, or of the margin, by which one may be missed
STRETCH = 0.1  # of a magnet's position that counts as one [m]
TURN = 0.3  # of its direction that counts as one
NEAREST = 12  # points of the vessel from which a magnet keeps away in a programme
SPARE = 1e-3  # distance from the vessel that is kept more [m]
APART = 10  # of the points that are looked at lie between two of those
ALONG = 401  # points of the vessel that are looked at
LEAST = {"A": 0.1, "T": 1e-3, "T/m": 1e-2}  # of an input that counts as one, by its unit
AT = 1e-6  # of a limit, within which an input is at it
FREE = 1e30


@dataclass(frozen=True, eq=False)
class Sight:
    """An equilibrium: where the tip is and how stable it is, and both to first order.

    Attributes
    ----------
    offset
        From the centreline, in two axes across it, shape (2,) [m].
    radius
        That of the lumen there [m].
    eigenvalue
        Smallest of the tangent stiffness against the lumped mass [rad^2/s^2].
    offset_by_input, eigenvalue_by_input
        Shapes (2, m) and (m,), per unit of each input.
    """

    offset: Array
    radius: float
    eigenvalue: float
    offset_by_input: Array
    eigenvalue_by_input: Array


class Direct:
    """Inputs of least cost, from feed to feed.

    Parameters
    ----------
    plant
        The model of the wire, with the actuator; it is moved about.
    demands
        What the tip must keep to, also in a field that is weaker by their tolerance.
    prices
        What the square of each input costs; of a magnet its way counts.
    """

    def __init__(self, plant: Plant, demands: Demands, prices: Array) -> None:
        system = plant.system
        assert system.actuator is not None
        self.plant, self.demands = plant, demands
        self._system: System = system
        self._actuator: Actuator = system.actuator
        inputs = system.actuator.inputs
        self._low, self._high = held(inputs)
        self._currents = np.array([one.unit not in ("m", "") for one in inputs])
        self._prices = prices
        self._limits = system.step_limits()
        self._linear = new_linear(len(plant.work.step))
        curve = system.path.branches[0].curve
        self._least = np.array([LEAST.get(one.unit, 1.0) for one in inputs])
        self._vessel = curve.at(np.linspace(0.0, curve.length, ALONG))
        self._trust, self._scale = TRUST, 1.0
        self._stretch = np.array([TURN if one.unit == "" else STRETCH for one in inputs])
        self.weak = demands.weakening if bool(self._currents.all()) else 1.0

    def feed_to(self, feed: float) -> bool:
        """Feed the wire on with the inputs as they are; whether an equilibrium was found."""
        plant = self.plant
        edge = float(self._system.mesh.edge_length.min())
        steps = max(1, int(np.ceil(abs(feed - plant.feed) / (0.5 * edge) - 1e-9)))
        course = np.linspace(plant.feed, feed, steps + 1)[1:]
        still = np.tile(plant.inputs, (steps, 1))
        return plant.advance(Drive(course, np.zeros(steps), still, 1.0, inertia=False)) == steps

    def improve(self, before: Array, reach: Array, towards: Array | None = None) -> bool:
        """Go to the inputs of least cost at this feed; whether they do what is asked for.

        Parameters
        ----------
        before
            Inputs at the feed before, shape (m,): a magnet's way starts there.
        reach
            Largest change from there, shape (m,).
        towards
            Where the way of a magnet is to lead, shape (m,); it is kept short if left out.
        """
        plant = self.plant
        home = before if towards is None else towards
        if not plant.released:
            return True
        here = self.look()
        if here is None:
            return False
        spent = float(self._prices @ np.where(self._currents, plant.inputs, 0.0) ** 2)
        self._scale = max(spent, float(np.max(self._prices * self._least**2)))
        self._trust = max(self._trust, 0.1 * TRUST)
        for _ in range(ROUNDS):
            units = self._units()
            change = self._change(here, home, (before - reach, before + reach), units)
            if change is None:
                break
            start, merit = plant.snapshot(), self._merit(here, home)
            plant.inputs = np.clip(plant.inputs + change, self._low, self._high)
            there = self.look() if plant.settle(self._limits)[0] is Status.CONVERGED else None
            size = float(np.abs(change / units).max())
            if there is None or self._merit(there, home) > merit + 1e-9:
                plant.restore(start)
                self._trust = 0.3 * min(size, self._trust)
                if self._trust < LEAST_TRUST:
                    break
                continue
            here = there
            self._trust = min(TRUST, max(2.0 * size, self._trust))
            if size < SETTLED:
                break
        return self.meets(here)

    def meets(self, sight: Sight) -> bool:
        """Whether an equilibrium does what is asked for, or misses it by little."""
        over, under = self._misses(sight)
        within = over <= MISSED and under <= MISSED and self.spare(self.plant.inputs) >= 0.0
        return within and self._withstands(sight)

    def _withstands(self, sight: Sight) -> bool:
        """Whether the wire stays where it is, off the wall, with inputs off in all signs.

        Of more than three inputs, those signs that move the tip most in eight directions.
        """
        part = self.demands.gain_tolerance
        if part == 0.0:
            return True
        plant, start = self.plant, self.plant.snapshot()
        count = len(start.inputs)
        if count <= 3:
            signs = np.array(list(product((-1.0, 1.0), repeat=count)))
        else:
            moves = NORMALS[::2] @ sight.offset_by_input * start.inputs
            signs = np.where(moves < 0.0, -1.0, 1.0)
        touches = self._touches(sight.radius)
        for gains in 1.0 + part * signs:
            plant.inputs = gains * start.inputs / self.weak
            stays = plant.settle(self._limits)[0] is Status.CONVERGED and self._eigenvalue() > 0.0
            away = float(np.linalg.norm(self._tip()[0]))
            plant.restore(start)
            if not stays or away > touches:
                return False
        return True

    def look(self) -> Sight | None:
        """The equilibrium as it is; None if it is not stable."""
        plant = self.plant
        start = plant.snapshot()
        offset, radius, axes = self._tip()
        eigenvalue = self._eigenvalue()
        if not eigenvalue > 0.0:
            return None
        units, count = self._units(), len(start.inputs)
        by_offset, by_eigen = np.zeros((2, count)), np.zeros(count)
        for k in range(count):
            step = PROBE * units[k]
            plant.inputs = start.inputs + step * np.eye(count)[k]
            if plant.settle(self._limits)[0] is Status.CONVERGED:
                by_offset[:, k] = (self._tip(axes)[0] - offset) / step
                value = self._eigenvalue()
                by_eigen[k] = (value - eigenvalue) / step if value > 0.0 else 0.0
            plant.restore(start)
        return Sight(offset, radius, eigenvalue, by_offset, by_eigen)

    def why(self, feed: float) -> str:
        """Which limit is in the way, or what is missed, as a sentence about a feed [m]."""
        said = f"At {1e3 * feed:.4g} mm of feed"
        bound = self._bound()
        offset, radius, _ = self._tip()
        room, away = self._room(radius), float(np.linalg.norm(offset))
        value = self._eigenvalue() if self.plant.released else 0.0
        state = f"the tip is {1e3 * away:.3g} mm from the centreline and may be {1e3 * room:.3g} mm"
        if away <= room * (1.0 + MISSED):
            state = (
                f"the equilibrium's stability is {value:.3g} rad^2/s^2, and is to be "
                f"{self.demands.stability_margin:.3g} rad^2/s^2"
            )
        return f"{said} {bound}; {state}." if bound else f"{said} {state}, whatever the inputs."

    def _bound(self) -> str:
        """The limits that the inputs are at, "" if there are none."""
        u = self.plant.inputs / self.weak
        said = [
            one.at_limit(edge)
            for one, value in zip(self._actuator.inputs, u, strict=True)
            for edge in one.held
            if one.unit and abs(value - edge) <= AT * max(1.0, abs(edge)) < np.inf
        ]
        if isinstance(self._actuator, Magnet) and self.spare(self.plant.inputs) < 2.0 * SPARE:
            near = 1e3 * (self._actuator.keep_out + self.spare(self.plant.inputs))
            spare = 1e3 * SPARE
            said.append(
                f"the magnet is {near:.3g} mm from the vessel, as near as it may with {spare:g} mm "
                "to spare"
            )
        return ", ".join(said)

    def _units(self) -> Array:
        """What counts as one of each input, shape (m,)."""
        u = self.plant.inputs
        cost = np.sqrt(float(self._prices @ np.where(self._currents, u, 0.0) ** 2))
        amperes = np.maximum(cost / np.sqrt(self._prices), self._least)
        return np.where(self._currents, amperes, self._stretch)

    def _tip(self, axes: Array | None = None) -> tuple[Array, float, Array]:
        """Offset of the tip in two axes across the path, radius there, and the axes."""
        curve = self._system.path.branches[0].curve
        tip = self.plant.state.q[-1, :3] * self._system.wire.length
        arc = self._system.path.locate(tip[None])[0]
        centre = curve.at(arc)[0]
        if axes is None:
            axes = across(curve.at(arc, 1)[0, :3])
        return axes @ (tip - centre[:3]), float(centre[3]), axes

    def _eigenvalue(self) -> float:
        plant = self.plant
        return float(steadiness(plant.model, plant.state, plant.mouth, plant.work, self._linear))

    def _touches(self, radius: float) -> float:
        """Offset of the tip from which on the wall presses on it [m]."""
        return radius - self._system.keep_off - self._system.firmness.activation_gap

    def _room(self, radius: float) -> float:
        return (radius - self._system.keep_off) * (1.0 - self.demands.tip_clearance)

    def _wider(self, radius: float) -> float:
        """Room for a tip in a field that is off [m]."""
        room, free = self._room(radius), radius - self._system.keep_off
        most = min(tuned.PROGRAMME.most_room * free, free - self._system.firmness.activation_gap)
        return max(room, min(tuned.PROGRAMME.off_room * room, most))

    def _misses(self, sight: Sight) -> tuple[float, float]:
        """By how much offset and eigenvalue miss what is asked for, over radius and margin."""
        strong = self.plant.inputs * (1.0 / self.weak - 1.0) if self.weak < 1.0 else None
        over = float(np.linalg.norm(sight.offset)) - self._wider(sight.radius)
        planned = sight.offset + (0.0 if strong is None else sight.offset_by_input @ strong)
        over = max(over, float(np.linalg.norm(planned)) - self._room(sight.radius))
        margin, value = self.demands.stability_margin, sight.eigenvalue
        if self.demands.gain_tolerance > 0.0:
            farther = self._off(NORMALS @ sight.offset_by_input) @ self.plant.inputs
            farthest = float((NORMALS @ planned + farther).max())
            over = max(over, farthest - self._wider(sight.radius))
            more = 0.0 if strong is None else float(sight.eigenvalue_by_input @ strong)
            less = float((self._off(-sight.eigenvalue_by_input[None]) @ self.plant.inputs)[0])
            value = min(value, value + more - less)
        return max(0.0, over / sight.radius), max(0.0, 1.0 - value / margin)

    def _off(self, rows: Array) -> Array:
        """By what to multiply inputs for what rows . inputs gain by their errors at most.

        For each row the signs of the errors are the worst ones; shape (n, m), as the rows.
        """
        part = self.demands.gain_tolerance / self.weak
        worst = np.where(rows * self.plant.inputs < 0.0, -1.0, 1.0)
        found: Array = part * worst * rows
        return found

    def _merit(self, sight: Sight, home: Array) -> float:
        over, under = self._misses(sight)
        close = max(0.0, SPARE - self.spare(self.plant.inputs)) / STRETCH
        missed = PENALTY * (over + under) + FORBIDDEN * close
        return self.cost(self.plant.inputs, home) + missed

    def spare(self, u: Array) -> float:
        """How much farther than it must a magnet is from the vessel [m]."""
        if not isinstance(self._actuator, Magnet):
            return np.inf
        near = float(self._distances(self._actuator, u).min())
        return near - self._actuator.keep_out

    def is_off_wall(self) -> bool:
        """Whether the tip is where the wall does not press on it."""
        offset, radius, _ = self._tip()
        return float(np.linalg.norm(offset)) < self._touches(radius)

    def apart(self, u: Array, other: Array) -> float:
        """Largest difference of two poses, in what counts as one."""
        return float(np.abs((u - other) / self._stretch).max())

    def cost(self, u: Array, home: Array) -> float:
        """Half of the power over that of the inputs before; of a magnet the square of its way."""
        way = np.where(self._currents, 0.0, (u - home) / self._stretch)
        spent = float(self._prices @ np.where(self._currents, u, 0.0) ** 2)
        return 0.5 * spent / self._scale + 0.5 * float(way @ way)

    def _change(
        self, sight: Sight, home: Array, bounds: tuple[Array, Array], units: Array
    ) -> Array | None:
        """The change of the inputs that the next programme wants; None if it finds none.

        Its unknowns are the changes in their units, and what offset and eigenvalue miss.
        """
        u, count = self.plant.inputs, len(units)
        weight = np.where(self._currents, self._prices * units**2 / self._scale, 1.0)
        slope = np.where(
            self._currents, self._prices * units * u / self._scale, (u - home) / self._stretch
        )
        rows, upper = self._conditions(sight, units)
        low = np.maximum(np.maximum(self._low * self.weak - u, bounds[0] - u) / units, -FREE)
        high = np.minimum(np.minimum(self._high * self.weak - u, bounds[1] - u) / units, FREE)
        low, high = np.maximum(low, -self._trust), np.minimum(high, self._trust)
        low, high = np.minimum(low, 0.0), np.maximum(high, 0.0)
        more = rows.shape[1] - count
        solution, _, flag, _ = daqp.solve(
            np.diag(np.concatenate([weight + 1e-6, np.full(more, 1e-3)])),
            np.concatenate([slope, [PENALTY, PENALTY, FORBIDDEN][:more]]),
            np.ascontiguousarray(rows),
            np.concatenate([high, np.full(more, 1e3), upper]),
            np.concatenate([low, np.zeros(more), np.full(len(upper), -FREE)]),
            np.zeros(count + more + len(upper), dtype=np.int32),
        )
        return np.asarray(solution[:count]) * units if flag > 0 else None

    def _conditions(self, sight: Sight, units: Array) -> tuple[Array, Array]:
        """Linear conditions on changes and misses, rows . unknowns <= upper."""
        size, margin = sight.radius, self.demands.stability_margin
        moves = sight.offset_by_input * units / size
        part = 1.0 / self.weak
        further = (part - 1.0) * (sight.offset_by_input @ self.plant.inputs) / size
        offset = sight.offset / size
        sides = np.concatenate([NORMALS @ moves, part * (NORMALS @ moves)])
        room = np.concatenate(
            [
                self._wider(size) / size - NORMALS @ offset,
                self._room(size) / size - NORMALS @ (offset + further),
            ]
        )
        grows = -sight.eigenvalue_by_input[None] * units / margin
        spare = np.array([sight.eigenvalue / margin - 1.0])
        if self.demands.gain_tolerance > 0.0:
            own, u = NORMALS @ sight.offset_by_input / size, self.plant.inputs
            fading = -sight.eigenvalue_by_input[None] / margin
            off, slower = self._off(own), self._off(fading)
            sides = np.concatenate([sides, (part * own + off) * units])
            left = self._wider(size) / size - NORMALS @ (offset + further) - off @ u
            room = np.concatenate([room, left])
            spare = np.append(spare, spare - (part - 1.0) * (fading @ u) - slower @ u)
            grows = np.vstack([grows, (part * fading + slower) * units])
        rows = np.vstack([sides, grows])
        misses = np.zeros((len(rows), 2))
        misses[: len(sides), 0] = misses[len(sides) :, 1] = -1.0
        rows, upper = np.hstack([rows, misses]), np.concatenate([room, spare])
        if isinstance(self._actuator, Magnet):
            near, away = self._off_vessel(self._actuator, units)
            rows = np.vstack(
                [
                    np.hstack([rows, np.zeros((len(rows), 1))]),
                    np.hstack([near, np.zeros((len(near), 2)), np.full((len(near), 1), -1.0)]),
                ]
            )
            upper = np.append(upper, away)
        return rows, upper

    def _off_vessel(self, magnet: Magnet, units: Array) -> tuple[Array, Array]:
        """Conditions that keep a magnet off the vessel's nearest points, over STRETCH."""
        u = self.plant.inputs
        now = self._distances(magnet, u)
        near = np.argsort(now[::APART])[:NEAREST] * APART
        near[0] = np.argmin(now)
        rows = np.zeros((len(near), len(u)))
        for k in range(len(u)):
            moved = u + PROBE * units[k] * np.eye(len(u))[k]
            rows[:, k] = -(self._distances(magnet, moved)[near] - now[near]) / PROBE / STRETCH
        return rows, (now[near] - magnet.keep_out - SPARE) / STRETCH

    def _distances(self, magnet: Magnet, u: Array) -> Array:
        """Of the magnet's surface from the vessel's, at points along it [m]."""
        away: Array = magnet.distance(u, self._vessel[:, :3]) - self._vessel[:, 3]
        return away

"""What a person holds down, turned into time steps that are safe to take."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.drive.account import Account, Sight
from magwire.drive.foresight import Foresight
from magwire.engine.command import Command
from magwire.errors import ConvergenceError, InputError, array, one_of, positive
from magwire.navigate import NavigationError, Navigator
from magwire.session import Session

Array = NDArray[np.float64]
Help = Literal["none", "assist", "suggest"]

DEAD_MAN = 0.3
"""Time after which what is held counts as let go unless it is said again [s]."""
KEPT = 1200
"""Snapshots that are kept to go back to; one takes some 20 kB."""
SLEW = 0.2
"""Largest rate of a uniform flux density by hand [T/s]."""
SWEEP = 0.5
"""Time in which an input goes through its range by hand, if nothing else limits it [s]."""
LARGEST = 1.0
"""Uniform flux density that is not exceeded by hand [T]."""
AHEAD = 1e-4  # feed ahead for which inputs are suggested [m]


@dataclass(frozen=True)
class Held:
    """What is held down: speeds of the guide [m/s, rad/s], and when it was said [s]."""

    feed_speed: float
    twist_rate: float
    since: float


NOTHING = Held(0.0, 0.0, -math.inf)


class Pilot:
    """A session in the hands of a person, who may let go, push too hard, or vanish.

    Parameters
    ----------
    session
        The wire.
    limit
        Force of the wall on the wire, summed over it [N], from which the guide advances no more.
    every
        Time between two snapshots to go back to [s].
    navigator
        Makes who helps, anew after each rewind; nobody helps if left out.
    clock
        Seconds that never run backwards.

    Attributes
    ----------
    message
        Why the last step was not the one asked for; empty if it was.
    sight
        What was seen after the last step.
    account
        What has been done so far.
    suggested
        Inputs that the navigator would set, shape (m,); None if it was not asked, or knows none.
    course
        Speeds of the guide that were taken up: since which time, feed speed, rate [s, m/s, rad/s].
    rewinds
        How often the wire was taken back.
    help
        Whether the navigator sets the inputs, suggests them, or is not asked.
    """

    def __init__(
        self,
        session: Session,
        *,
        limit: float = math.inf,
        every: float = 0.5,
        navigator: Callable[[], Navigator] | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.session, self._clock = session, clock
        self.limit_to(limit)
        self._every = positive("Pilot", "every", every, "s")
        self._held = NOTHING
        self._wanted: Array = session.plant.inputs
        self._slew = slew_of(session)
        self.message, self.help = "", "none"
        self.account, self.rewinds = Account(), 0
        self.suggested: Array | None = None
        self.sight = self._look()
        self._past = deque([(session.snapshot(), self.account)], maxlen=KEPT)
        self._due = session.plant.time + every
        self.course: list[tuple[float, float, float]] = []
        self._make = navigator
        self._foresight: Foresight | None = None
        self._begin_plan()

    def hold(self, feed_speed: float, twist_rate: float = 0.0) -> None:
        """Take speeds [m/s, rad/s] as held down, for ``DEAD_MAN`` seconds from now.

        Raises
        ------
        InputError
            If one is not finite; what was held before stays.
        """
        Command(feed_speed, twist_rate, None, self.session.time_step)  # says which it is
        self._held = Held(feed_speed, twist_rate, self._clock())

    def let_go(self) -> None:
        """Hold nothing any more."""
        self._held = NOTHING

    def limit_to(self, limit: float) -> None:
        """Stop the advance at another force [N].

        Raises
        ------
        InputError
            If it is not positive.
        """
        self.limit = limit if limit == math.inf else positive("Pilot", "limit", limit, "N")

    def steer(self, inputs: ArrayLike) -> None:
        """Set where the inputs are to go, shape (m,), as fast as they may.

        Raises
        ------
        InputError
            If they are not finite, not as many as the actuator has, or beyond its limits, or if the
            navigator sets them.
        """
        wanted = array("Pilot", "inputs", inputs, self._wanted.shape)
        actuator = self.session.plant.system.actuator
        if self.help == "assist":
            raise InputError("The navigator sets the field: switch it off to set it by hand.")
        if actuator is None:
            if not float(np.linalg.norm(wanted)) <= LARGEST:
                raise InputError(
                    f"Input inputs of Pilot must be a field of at most {LARGEST:g} T; "
                    f"received {np.linalg.norm(wanted):.3g} T."
                )
        else:
            for one, value in zip(actuator.inputs, wanted.tolist(), strict=True):
                if not one.low <= value <= one.high:
                    raise InputError(
                        f"Input {one.name} must be between {one.low:g} and {one.high:g} {one.unit}"
                        f"; received {value:g} {one.unit}."
                    )
        self._wanted = wanted

    def ask(self, kind: Help) -> None:
        """Have the navigator set the inputs, suggest them, or be silent.

        Raises
        ------
        InputError
            If there is no navigator.
        """
        one_of("Pilot", "help", kind, ("none", "assist", "suggest"))
        if kind != "none" and self._make is None:
            raise InputError("Input help of Pilot must be 'none' without a navigator.")
        self.help, self.suggested = kind, None
        self._wanted = self.session.plant.inputs

    def guided_by(self, navigator: Callable[[], Navigator] | None) -> None:
        """Have another navigator help, such as one to another target."""
        self._make = navigator
        self._begin_plan()

    @property
    def wanted(self) -> Array:
        """Where the inputs are on their way to, shape (m,)."""
        return self.session.plant.inputs if self.help == "assist" else self._wanted

    @property
    def idle(self) -> bool:
        """Whether nothing is held and the inputs are where they are to be."""
        return self._speeds() == (0.0, 0.0) and (
            self.help == "assist" or bool(np.array_equal(self._wanted, self.session.plant.inputs))
        )

    def tick(self) -> Sight:
        """Take one time step with what is held, and see what has become of the wire.

        A step that fails leaves the wire as it was and says why in ``message``.
        """
        self.message = ""
        feed, twist = self._speeds()
        if feed > 0.0 and self.sight.wall_force >= self.limit:
            feed = 0.0
            self.message = f"The limit of {1e3 * self.limit:.4g} mN is reached: retract."
        before = self.sight
        try:
            wanted, feed = self._asked_for(feed)
            self.session.step(feed, twist, self._towards(wanted))
        except (ConvergenceError, NavigationError) as error:
            self.message = str(error)
        else:
            self._note(before.time, feed, twist)
        self.sight = self._look()
        if self.sight.time > before.time:
            self.account = self.account.after(before, self.sight)
            self._keep()
        return self.sight

    def rewind(self, back: float) -> float:
        """Go back by a time [s], or as far as snapshots reach; returns the time come to [s].

        Whatever was held is let go, and the recording goes back, too.

        Raises
        ------
        InputError
            If the time is not positive.
        """
        until = self.session.plant.time - positive("Pilot", "back", back, "s")
        while len(self._past) > 1 and self._past[-1][0].time > until + 1e-9:
            self._past.pop()
        snapshot, self.account = self._past[-1]
        self.session.restore(snapshot)
        self.rewinds += 1
        self.let_go()
        self.message, self.suggested = "", None
        self.sight = self._look()
        self._wanted = self.session.plant.inputs
        self._due = self.sight.time + self._every
        self.course = [one for one in self.course if one[0] < self.sight.time - 1e-9]
        self._begin_plan()
        return self.sight.time

    def _speeds(self) -> tuple[float, float]:
        """Speeds of the guide [m/s, rad/s]; none if it was too long ago that they were held."""
        held = self._held
        if self._clock() - held.since > DEAD_MAN:
            return 0.0, 0.0
        return held.feed_speed, held.twist_rate

    def _asked_for(self, feed_speed: float) -> tuple[Array, float]:
        """Inputs to go to, and the speed that may be fed meanwhile [m/s]."""
        if self.help == "none" or self._foresight is None:
            return self._wanted, feed_speed
        plant, dt = self.session.plant, self.session.time_step
        length = plant.system.wire.length
        if self.help == "suggest":
            way = -AHEAD if feed_speed < 0.0 else AHEAD
            found = self._foresight.inputs(min(max(plant.feed + way, 0.0), length), feed_speed)
            self.suggested = self.suggested if found is None else found
            return self._wanted, feed_speed
        feed = min(max(plant.feed + feed_speed * dt, 0.0), length)
        if feed_speed == 0.0 or feed == plant.feed:
            return plant.inputs, feed_speed
        found = self._foresight.inputs(feed, feed_speed)
        if found is None:
            self.message = "The navigator is planning; the wire waits."
            return plant.inputs, 0.0
        if bool((np.abs(found - plant.inputs) > self._slew * dt).any()):
            self.message = "The field is on its way to where the navigator wants it."
            return found, 0.0
        return found, feed_speed

    def _towards(self, wanted: Array) -> Array:
        """The next inputs on the way to the wanted ones."""
        now = self.session.plant.inputs
        if np.array_equal(wanted, now):
            return now
        by, most = wanted - now, self._slew * self.session.time_step
        largest = float(np.max(np.abs(by) / most))
        return wanted if largest <= 1.0 else now + by / largest

    def _begin_plan(self) -> None:
        made = None if self._make is None else Foresight(self._make, self.session.plant)
        self._foresight = made
        self.suggested = None

    def _note(self, since: float, feed_speed: float, twist_rate: float) -> None:
        if (feed_speed, twist_rate) != (self.course[-1][1:] if self.course else (0.0, 0.0)):
            self.course.append((since, feed_speed, twist_rate))

    def _keep(self) -> None:
        if self.sight.time >= self._due - 1e-9:
            self._past.append((self.session.snapshot(), self.account))
            self._due = self.sight.time + self._every

    def _look(self) -> Sight:
        plant = self.session.plant
        seen = plant.survey()
        return Sight(
            time=plant.time,
            feed=plant.feed,
            twist=plant.twist,
            points=seen.position,
            forces=seen.contact_force,
            push=seen.push_force,
            torque=seen.guide_torque,
            field=seen.flux_density,
            inputs=plant.inputs,
            clearance=seen.clearance_along,
        )


def slew_of(session: Session) -> Array:
    """Largest rates of the inputs by hand, shape (m,) [unit/s]."""
    actuator = session.plant.system.actuator
    if actuator is None:
        return np.full(3, SLEW)
    rates = []
    for one in actuator.inputs:
        span = one.high - one.low
        by_hand = span / SWEEP if math.isfinite(span) and span > 0.0 else SLEW
        rates.append(min(one.slew, by_hand))
    return np.array(rates)

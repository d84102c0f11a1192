"""What stands between commanded inputs and those that flow: delay, steps, gains, ramps (P-27)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate.actuator import Actuator
from magwire.actuate.inputs import Input, Vector3
from magwire.actuate.misaligned import Misaligned
from magwire.errors import InputError, array, nonnegative, positive

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Hardware:
    """How a real actuator departs from its model.

    Commands arrive late, are rounded to whole quanta, and are off by the gain; the inputs then go
    there as fast as the circuits let them.

    Parameters
    ----------
    quantum
        Least difference between two settings of an input, in its unit; none if zero.
    delay
        From a command to the answer [s].
    gain_errors
        Part by which each input is too large, shape (m,), such as 0.03; one for all, or none.
    tilts
        Rotation vector by which the field of each input is turned about the actuator's origin,
        shape (m, 3) [rad]; none if empty.
    ramps
        Whether inputs are held back by slew, inductance and supply. They jump if not.

    Raises
    ------
    InputError
        If a value cannot be.
    """

    quantum: float = 0.0
    delay: float = 0.0
    gain_errors: tuple[float, ...] = ()
    tilts: tuple[Vector3, ...] = ()
    ramps: bool = True

    def __post_init__(self) -> None:
        nonnegative("Hardware", "quantum", self.quantum)
        nonnegative("Hardware", "delay", self.delay, "s")
        errors = array("Hardware", "gain_errors", self.gain_errors, (None,))
        tilts = array("Hardware", "tilts", np.reshape(self.tilts, (-1, 3)), (None, 3), "rad")
        object.__setattr__(self, "gain_errors", tuple(errors.tolist()))
        object.__setattr__(self, "tilts", tuple(tuple(tilt) for tilt in tilts.tolist()))

    def __str__(self) -> str:
        """In words, in SI units."""
        said = [
            f"steps of {self.quantum:g}" if self.quantum > 0.0 else "",
            f"{self.delay:g} s late" if self.delay > 0.0 else "",
            _listed("too large by", [f"{error:g}" for error in self.gain_errors]),
            _listed("turned by", [str(list(tilt)) for tilt in self.tilts])
            + " rad" * bool(self.tilts),
            "held back by slew and supply" if self.ramps else "",
        ]
        return ", ".join(filter(None, said)) or "as told"

    def built(self, actuator: Actuator) -> Actuator:
        """The actuator as it stands in the laboratory: with its coils tilted.

        Raises
        ------
        InputError
            If there is not one gain error, or tilt, for each input, or a magnet is to be tilted.
        """
        count = len(actuator.inputs)
        if len(self.gain_errors) not in (0, 1, count):
            raise InputError(
                f"Input gain_errors of Hardware must be one for each of {count} inputs, or one for "
                f"all; received {len(self.gain_errors)}."
            )
        if not self.tilts:
            return actuator
        if len(self.tilts) != count:
            raise InputError(
                f"Input tilts of Hardware must be one for each of {count} inputs; "
                f"received {len(self.tilts)}."
            )
        return Misaligned(
            actuator=actuator,
            tilts=self.tilts,
            workspace=actuator.workspace,
            max_power=actuator.max_power,
        )

    def line(self, actuator: Actuator, time_step: float, start: ArrayLike) -> Line:
        """What turns commands into inputs, step after step, from inputs at rest, shape (m,)."""
        return Line(self, actuator.inputs, time_step, start)


def _listed(what: str, values: list[str]) -> str:
    return f"{what} {' '.join(values)}" if values else ""


class Line:
    """Commands in, inputs out, one time step after the other.

    Parameters
    ----------
    hardware
        What it does to them.
    inputs
        What the actuator has, with their limits.
    time_step
        dt [s].
    start
        Commands so far, shape (m,).
    """

    def __init__(
        self, hardware: Hardware, inputs: tuple[Input, ...], time_step: float, start: ArrayLike
    ) -> None:
        self._dt = positive("Hardware", "time_step", time_step, "s")
        self._quantum, self._ramps = hardware.quantum, hardware.ramps
        first = array("Hardware", "start", start, (len(inputs),))
        self._gain = 1.0 + np.broadcast_to(hardware.gain_errors or (0.0,), first.shape)
        late = hardware.delay / self._dt
        whole = math.ceil(late - 1e-9)
        self._part = whole - late  # of the command after the oldest one
        self._sent: list[Array] = [first] * (
            whole + 1
        )  # oldest first, the last one sent at the end
        self._now: Array = self._settled(first)
        self._slew = np.array([one.slew for one in inputs])
        self._supply = np.array([one.supply for one in inputs])
        self._resistance = np.array([one.resistance for one in inputs])
        self._inductance = np.array([one.inductance for one in inputs])

    def made(self, commands: Array) -> Array:
        """Inputs at the ends of the next steps, shape (k, m), from the commands there."""
        found = np.empty_like(commands)
        for k, command in enumerate(commands):
            found[k] = self._next(command)
        return found

    def _next(self, command: Array) -> Array:
        self._sent = [*self._sent[1:], command]
        heard = self._sent[0]
        if self._part > 0.0:  # sent between two steps
            heard = heard + self._part * (self._sent[1] - heard)
        aim = self._settled(heard)
        if self._ramps:
            low, high = self._reach()
            aim = np.clip(aim, low, high)
        self._now = aim
        return aim

    def _settled(self, command: Array) -> Array:
        """Inputs when a command has been answered."""
        said = command
        if self._quantum > 0.0:
            said = np.round(command / self._quantum) * self._quantum
        answered: Array = self._gain * said
        return answered

    def _reach(self) -> tuple[Array, Array]:
        """Lowest and highest inputs after a step: L di/dt = +-V - R i, solved exactly."""
        now, dt = self._now, self._dt
        low, high = now - self._slew * dt, now + self._slew * dt
        for k in np.flatnonzero((self._inductance > 0.0) & np.isfinite(self._supply)):
            volts, ohms, henries = self._supply[k], self._resistance[k], self._inductance[k]
            fade = math.exp(-ohms * dt / henries)
            # (1 - fade)/R, which is dt/L where there is no resistance
            gain = (1.0 - fade) / ohms if ohms > 0.0 else dt / henries
            low[k] = max(low[k], fade * now[k] - volts * gain)
            high[k] = min(high[k], fade * now[k] + volts * gain)
        return low, high

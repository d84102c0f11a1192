"""A wire in the hands of whoever steps it: a controller, a learner, a person."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from types import TracebackType
from typing import TYPE_CHECKING, Self, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.engine.command import Command, Drive
from magwire.engine.observation import Observation
from magwire.engine.plant import Plant, Snapshot
from magwire.engine.record import Record
from magwire.engine.rubbing import Change, Course, goes_on
from magwire.engine.sensitivity import Output
from magwire.engine.status import Status
from magwire.errors import ConvergenceError, InputError, ResultError, array, one_of, positive
from magwire.operate import Assist
from magwire.status import RunStatus

if TYPE_CHECKING:
    from magwire.results import Result, Writer

Array = NDArray[np.float64]


class Session:
    """A wire that is stepped from outside; ``Simulation.session`` makes one.

    Use it in a ``with`` statement, at the end of which its recording is closed.

    Parameters
    ----------
    plant
        The wire.
    time_step
        Longest time step [s]; longer intervals are cut into equal ones.
    inertia
        Without it every step is an equilibrium.
    recording
        What records are written to, and the time between two of them [s]; nothing if left out.

    Attributes
    ----------
    plant
        The wire as the engine has it.
    assist
        Who gives the inputs where a step leaves them out; nobody if None.
    """

    def __init__(
        self,
        plant: Plant,
        *,
        time_step: float = 0.01,
        inertia: bool = True,
        recording: tuple[Writer, float] | None = None,
    ) -> None:
        self.plant = plant
        self.time_step = positive("Session", "time_step", time_step, "s")
        self._inertia, self._recording = inertia, recording
        self._due, self._recorded, self._closed = 0.0, -1.0, False
        self.assist: Assist | None = None
        self._length = plant.system.wire.length
        self._record_if_due()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._recording is None:
            return
        writer, plant = self._recording[0], self.plant
        if plant.time != self._recorded:
            writer.append(plant.record())
        if plant.status is not Status.CONVERGED:
            writer.close(RunStatus.NOT_CONVERGED, plant.message)
        self._closed = True
        writer.__exit__(kind, error, trace)

    def step(
        self,
        feed_speed: float = 0.0,
        twist_rate: float = 0.0,
        inputs: ArrayLike | None = None,
        duration: float | None = None,
    ) -> None:
        """Move guide and inputs for an interval of time.

        The guide stops where the wire's length ends, either way.

        Parameters
        ----------
        feed_speed
            Speed of the guide [m/s]; negative retracts.
        twist_rate
            Rate of the guide about its axis [rad/s].
        inputs
            Inputs of the actuator at the interval's end, reached linearly, shape (m,): a uniform
            flux density [T] without one. If left out, the navigator's, or as they are without one.
        duration
            Length of the interval [s]; one time step if left out.

        Raises
        ------
        InputError
            If a value is not finite, the duration is not positive, the inputs are not as many as
            the actuator has, or the recording has ended.
        ConvergenceError
            If a time step fails; the wire is as it was before that step.
        NavigationError
            If the navigator finds no inputs.
        """
        if duration is not None and duration != self.time_step:
            command = Command(feed_speed, twist_rate, inputs, duration)
            parts = 1 if self.assist is None or inputs is not None else self._steps(command)
            each = replace(command, duration=duration / parts)
            for _ in range(parts):
                self.advance((self._assisted(each),))
            return
        if self._closed:
            raise self._over()
        plant, dt = self.plant, self.time_step
        given = plant.wanted
        try:
            feed, twist = plant.guided
            feed = min(max(feed + feed_speed * dt, 0.0), self._length)
            twist += twist_rate * dt
        except TypeError:
            Command(feed_speed, twist_rate, inputs)  # says which it is
            raise
        if inputs is None and self.assist is not None:
            inputs = self.assist.inputs(feed, feed_speed)
        given[:] = plant.state.inputs if inputs is None else _as_many(inputs, given.shape)
        if not math.isfinite(feed_speed + twist_rate + sum(given.tolist())):
            Command(feed_speed, twist_rate, given)  # says which it is
        if not plant.step(feed, twist, dt, inertia=self._inertia):
            raise self._failed()
        if self._recording is not None:
            self._record_if_due()

    def advance(self, commands: Sequence[Command]) -> None:
        """Carry out commands one after the other, in as few calls of compiled code as can be.

        Raises
        ------
        InputError
            If the inputs of a command are not as many as the actuator has, or the recording has
            ended.
        ConvergenceError
            If a time step fails; the wire is as it was before that step.
        """
        if self._closed:
            raise self._over()
        feed, twist, inputs = self.plant.feed, self.plant.twist, self.plant.inputs
        rows: list[tuple[float, float, Array]] = []
        step = 0.0
        for command in commands:
            if not isinstance(command, Command):
                raise InputError(
                    "Input commands of Session.advance must be of Command; "
                    f"received {type(command).__name__}."
                )
            count = self._steps(command)
            each = command.duration / count
            if rows and each != step:
                self._do(self._drive(rows, step))
                rows = []
            step = each
            wanted = (
                inputs
                if command.inputs is None
                else array("Command", "inputs", command.inputs, (len(inputs),))
            )
            for k in range(1, count + 1):
                feed = min(max(feed + command.feed_speed * each, 0.0), self._length)
                twist += command.twist_rate * each
                course = inputs + (wanted - inputs) * (k / count)
                rows.append((feed, twist, wanted if k == count else course))
            inputs = wanted
        if rows:
            self._do(self._drive(rows, step))

    def _steps(self, command: Command) -> int:
        return max(1, math.ceil(command.duration / self.time_step - 1e-9))

    def _assisted(self, command: Command) -> Command:
        """The command with the navigator's inputs, if there is one and none are given."""
        if command.inputs is not None or self.assist is None:
            return command
        feed = self.plant.feed + command.feed_speed * command.duration
        feed = min(max(feed, 0.0), self._length)
        return replace(command, inputs=self.assist.inputs(feed, command.feed_speed))

    def _drive(self, rows: list[tuple[float, float, Array]], step: float) -> Drive:
        feed, twist, inputs = zip(*rows, strict=True)
        return Drive(np.array(feed), np.array(twist), np.stack(inputs), step, self._inertia)

    def _do(self, drive: Drive) -> None:
        plant, done, whole = self.plant, 0, len(drive.feed)
        if self._recording is None:
            done = plant.advance(drive)
        while done < whole and plant.status is Status.CONVERGED and self._recording is not None:
            wait = self._due - plant.time
            count = min(whole - done, max(1, math.ceil(wait / drive.time_step - 1e-9)))
            done += plant.advance(drive.part(done, done + count))
            self._record_if_due()
        if done < whole:
            raise self._failed()

    def _over(self) -> InputError:
        return InputError(
            "Session has ended with its 'with' statement, and so has its recording; "
            "begin another with Simulation.session."
        )

    def _failed(self) -> ConvergenceError:
        plant = self.plant
        return ConvergenceError(plant.message, plant.state.q[1:, :3] * self._length)

    def _record_if_due(self) -> None:
        if self._recording is None or self.plant.time < self._due * (1.0 - 1e-12):
            return
        writer, every = self._recording
        self._recorded = self.plant.time
        self._due = self._recorded + every
        writer.append(self.plant.record())

    def observe(self) -> Observation:
        """What can be seen of the wire now."""
        return self.plant.observe()

    @property
    def stable(self) -> bool:
        """Whether a wire would stay where it is: its tangent stiffness is positive definite."""
        return self.plant.stable

    def sensitivity(self, output: Output, *, wrt: Course, change: Change = "rising") -> Array:
        """How the wire at rest moves with an input from here on, to first order, under friction.

        Contacts inside their cones hold as springs; those on their cones slide on, or stick if the
        change would turn them back. So it is a derivative from one side.

        Parameters
        ----------
        output
            ``"tip"``, shape (3,) [m]; ``"positions"``, shape (nodes, 3) [m]; or
            ``"tip_direction"``, shape (3,).
        wrt
            ``"field"``, shape (3,) [T]; ``"inputs"`` of the actuator, shape (m,); ``"gradient"``,
            shape (3, 3) [T/m]; ``"feed"`` [m]; or ``"twist"`` [rad]. Each component with the others
            as they are.
        change
            Whether the input is ``"rising"`` or ``"falling"``.

        Returns
        -------
        array
            Shape of the output followed by the shape of the input.

        Raises
        ------
        InputError
            If output, input or change is none of these, the wall moves, or the
            session is one in time: a wire that moves is not at rest.
        ConvergenceError
            If no choice of which contacts slide agrees with itself.

        Notes
        -----
        (P-33): the coefficients of friction are taken as they are where the wire is.
        """
        one_of("sensitivity", "wrt", wrt, get_args(Course))
        one_of("sensitivity", "change", change, get_args(Change))
        if self._inertia:
            raise InputError(
                "Input motion of Simulation.session must be 'quasi-static' for sensitivities; "
                "received 'dynamic'."
            )
        if self.plant.system.wall_motion:
            raise InputError(
                "Simulation must have its wall at rest for sensitivities; it moves by wall_motion."
            )
        return goes_on(self.plant.rubbing, output, wrt, change)

    def record(self) -> Record:
        """The whole state, as a result file has it."""
        return self.plant.record()

    def snapshot(self) -> Snapshot:
        """What it takes to come back here."""
        return self.plant.snapshot()

    def restore(self, snapshot: Snapshot) -> None:
        """Come back to a snapshot, from this session or another one of the same simulation.

        The recording goes back, too: what was recorded at later times is dropped, so that a result
        is one way of one wire, with times that rise.
        """
        if not isinstance(snapshot, Snapshot):
            raise InputError(
                "Input snapshot of Session.restore must be a Snapshot; "
                f"received {type(snapshot).__name__}."
            )
        if self._closed:
            raise self._over()
        self.plant.restore(snapshot)
        if self._recording is None:
            return
        writer, every = self._recording
        self._recorded = self.plant.time
        self._due = self._recorded + every
        writer.rewind(self.plant.record())

    @property
    def result(self) -> Result:
        """What has been recorded, after the ``with`` statement.

        Raises
        ------
        InputError
            If nothing is recorded.
        ResultError
            If the session is still open.
        """
        if self._recording is None:
            raise InputError("Input record_every of Simulation.session must be given for a result.")
        if not self._closed:
            raise ResultError(
                "A session's result is there when the session has ended: ask for it after its with "
                "statement."
            )
        return self._recording[0].result()


def _as_many(inputs: ArrayLike, shape: tuple[int, ...]) -> ArrayLike:
    """Inputs of a shape, refused with any other: one number would be spread over all of them."""
    try:
        fits = np.shape(inputs) == shape
    except ValueError:  # rows of several lengths
        fits = False
    return inputs if fits else array("Command", "inputs", inputs, shape)

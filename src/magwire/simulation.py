"""A wire, a lumen, a field: run them, or ask for an equilibrium."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate import Actuator, Hardware, Uniform
from magwire.contact import Barrier, Friction, WallMotion
from magwire.engine.feed import Feed
from magwire.engine.hold import Hold
from magwire.engine.plant import Plant
from magwire.engine.record import Motion, RunInfo
from magwire.engine.statics import Equilibrium, find_equilibrium
from magwire.engine.system import Release, System
from magwire.errors import InputError, array, instance, offering, one_of, positive, refuse
from magwire.field import FieldSource, UniformField, as_field
from magwire.interrupt import held_back_interrupt
from magwire.lumen import Lumen
from magwire.navigate import NavigationError, Navigator, Steering
from magwire.operate import (
    Assist,
    Ending,
    March,
    Until,
    Watcher,
    inside,
    stable,
    steered_records,
)
from magwire.session import Session
from magwire.status import RunStatus
from magwire.wire import Wire

if TYPE_CHECKING:
    from magwire.results import Result

Array = NDArray[np.float64]

UPDATE_EVERY = 5e-4  # feed between two observations of a navigator that has no wish [m]
WAY_POINTS = 2001  # of the way to the target, in the description of a run


class Simulation:
    """A magnetic wire that is pushed through a lumen.

    Parameters
    ----------
    wire, lumen
        The wire and the lumen; the wire enters at the lumen's entrance, along its direction.
    field
        The outside field; none if left out.
    contact
        The wall's barrier.
    friction
        The wall's; none if left out. An equilibrium is one without friction: with it, it would
        depend on the way there. A quasi-static run, or session, is such a way.
    wall_motion
        How the wall moves with the tissue around it, one displacement or several; it rests if left
        out. In an equilibrium it is where it is at rest.
    actuator
        What makes a field from the inputs of whoever steers; three components of a uniform flux
        density [T] if left out.
    damping
        Dissipation mu [1/s] (P-14).
    gravity
        Acceleration, shape (3,) [m/s^2].
    fluid_density
        That of what fills the lumen [kg/m^3]; its buoyancy acts against gravity.
    tip_load
        Dead force on the tip, which keeps its direction in space, shape (3,) [N].
    release
        How the guide lets go of the wire (P-15): ``"sliding"``, or node by node as in the paper,
        ``"node"``.

    Raises
    ------
    InputError
        If a value is out of its range, or the wire does not fit into the lumen.
    """

    def __init__(
        self,
        wire: Wire,
        lumen: Lumen,
        *,
        field: FieldSource | ArrayLike | None = None,
        contact: Barrier | None = None,
        friction: Friction | None = None,
        wall_motion: WallMotion | Sequence[WallMotion] = (),
        actuator: Actuator | None = None,
        damping: float = 0.01,
        gravity: ArrayLike = (0.0, 0.0, 0.0),
        fluid_density: float = 0.0,
        tip_load: ArrayLike = (0.0, 0.0, 0.0),
        release: Release = "sliding",
    ) -> None:
        pull = array("Simulation", "gravity", gravity, (3,), "m/s^2")
        load = array("Simulation", "tip_load", tip_load, (3,), "N")
        self.system = System(
            wire=wire,
            lumen=lumen,
            contact=Barrier() if contact is None else contact,
            damping=damping,
            gravity=(float(pull[0]), float(pull[1]), float(pull[2])),
            fluid_density=fluid_density,
            tip_load=(float(load[0]), float(load[1]), float(load[2])),
            release=release,
            background=UniformField() if field is None else as_field("Simulation", field),
            friction=friction,
            wall_motion=_several(wall_motion),
            actuator=actuator,
        )
        narrowest = lumen.path().narrowest  # a side branch may be too narrow for the wire
        if narrowest <= self.system.keep_off:
            raise InputError(
                f"Input wire of Simulation must be thinner than the lumen, whose smallest radius "
                f"is {narrowest:.6g} m; received a wire radius of {wire.radius:.6g} m."
            )

    def __repr__(self) -> str:
        return self.system.called("Simulation")

    @property
    def field(self) -> FieldSource:
        """The outside field."""
        return self.system.background

    def run(
        self,
        feed: Feed,
        navigator: Navigator | Steering | None = None,
        *,
        motion: Motion = "dynamic",
        time_step: float = 0.01,
        record_every: float = 1e-4,
        update_every: float | None = None,
        until: float | None = None,
        hardware: Hardware | None = None,
        out: str | Path | None = None,
        title: str = "",
        scenario: str = "",
        watch: Watcher | Sequence[Watcher] | None = None,
    ) -> Result:
        """Push the wire through the lumen (P-14, P-15, P-16).

        Parameters
        ----------
        feed
            The course of the guide.
        navigator
            Who steers, with a uniform field on top of the simulation's own; nobody if left out.
        motion
            ``"dynamic"``: implicit Euler steps. ``"quasi-static"``: an equilibrium at every record
            and every observation, and two at least for every edge fed; the time is that of the
            course, inertia and damping play no part.
        time_step
            dt [s]; of quasi-static motion only where the course feeds nothing at all.
        record_every
            Feed between two records [m], at the course's fastest speed.
        update_every
            Feed between two observations of the navigator [m], at the course's fastest speed; if
            left out, what the navigator asks for, or 0.5 mm.
        until
            Arc parameter of the way to the lumen's target [m]: the run ends at the first record
            whose tip has come so far. If left out, it ends with the feed.
        hardware
            How the actuator departs from its model: whoever steers knows the model, the wire is in
            the field that the hardware makes, and the inputs of the result are those that flow. The
            actuator is as its model says if left out.
        out
            NetCDF file to write as the run goes; none if left out.
        title, scenario
            Kept in the result.
        watch
            Called with every record, one or several. A run ends with the ``Ending`` that one of
            them returns; ``ForceLimit`` is one.

        Returns
        -------
        Result
            Its ``status`` is "complete"; or "not converged" with a ``message`` that names the
            remedy, and it then ends at the last state that did converge; or "unstable", if the
            motion is quasi-static and comes to an equilibrium that a wire would leave; or "no
            field" with a ``message`` that says where the navigator found none, and why; or that of
            a watcher that ended it.
        """
        from magwire.results import Writer

        instance("Simulation.run", "feed", feed, Feed)
        _check_navigator("Simulation.run", navigator)
        inertia = one_of("Simulation", "motion", motion, ("dynamic", "quasi-static")) == "dynamic"
        positive("Simulation", "record_every", record_every, "m")
        if isinstance(navigator, Steering):
            update_every = navigator.update_every if update_every is None else update_every
            navigator = navigator.start(self.system)
        update_every = UPDATE_EVERY if update_every is None else update_every
        positive("Simulation", "update_every", update_every, "m")
        if not inertia and feed.fastest > 0.0:
            finer = record_every if navigator is None else min(record_every, update_every)
            apart = min(finer, feed.fastest * feed.duration)
            parts = np.ceil(apart / (0.5 * self.system.wire.edge_length) - 1e-9)
            time_step = apart / float(parts) / feed.fastest
        march = March(
            self._built(hardware),
            self.field,
            feed,
            time_step=time_step,
            inertia=inertia,
            hardware=hardware,
        )
        every, update = (_steps(length, feed, time_step) for length in (record_every, update_every))
        if navigator is None:
            records = march.records(every)
        else:
            records = steered_records(march, navigator, every=every, update=update)
        watchers: list[Watcher] = [inside] if inertia else [inside, stable]
        if until is not None:
            watchers.append(Until(until, self.tip_arc))
        watchers += _watching(watch)
        info = self.info(title=title, scenario=scenario, motion=motion)
        info = replace(info, hardware="" if hardware is None else str(hardware))
        with Writer(info, out) as writer, held_back_interrupt() as strike:
            try:
                for record in records:
                    writer.append(record)
                    strike()
                    endings = [watcher(record) for watcher in watchers]  # all of them see it
                    ending = next((one for one in endings if isinstance(one, Ending)), None)
                    if ending is not None:
                        break
                else:
                    converged = march.step == march.steps
                    status = RunStatus.COMPLETE if converged else RunStatus.NOT_CONVERGED
                    ending = Ending(status, march.plant.message)
                said = [*getattr(navigator, "notes", ()), ending.message]
                writer.close(ending.status, " ".join(said).strip())
            except NavigationError as error:
                writer.close(RunStatus.NO_FIELD, str(error))
        return writer.result()

    def _built(self, hardware: Hardware | None) -> System:
        """The system with the actuator as it stands in the laboratory."""
        if hardware is None:
            return self.system
        instance("Simulation.run", "hardware", hardware, Hardware)
        built = hardware.built(self.system.actuator or Uniform())
        return replace(self.system, actuator=built)

    def session(
        self,
        *,
        feed: float = 0.0,
        navigator: Navigator | Steering | None = None,
        motion: Motion = "dynamic",
        time_step: float = 0.01,
        record_every: float | None = None,
        out: str | Path | None = None,
        title: str = "",
        scenario: str = "",
    ) -> Session:
        """The wire in the caller's hands, to be stepped and watched.

        Parameters
        ----------
        feed
            Length of wire past the entrance at the start [m]: an equilibrium there.
        navigator
            Who gives the inputs where a step leaves them out; they stay as they are without one.
        motion
            ``"dynamic"``, or ``"quasi-static"``: every step is an equilibrium.
        time_step
            Longest time step [s].
        record_every
            Time between two records [s]; nothing is recorded if left out.
        out
            NetCDF file to record to; in memory if left out.
        title, scenario
            Kept in the result.

        Raises
        ------
        ConvergenceError
            If there is no equilibrium at ``feed``.
        """
        from magwire.results import Writer

        _check_navigator("Simulation.session", navigator)
        inertia = one_of("Simulation", "motion", motion, ("dynamic", "quasi-static")) == "dynamic"
        plant = Plant(self.system)
        if feed != 0.0:
            plant.start_at(self.equilibrium(feed).point.state)
        recording = None
        if record_every is not None:
            positive("Simulation", "record_every", record_every, "s")
            info = self.info(title=title, scenario=scenario, motion=motion)
            recording = Writer(info, out), record_every
        elif out is not None:
            raise InputError(f"Input record_every of Simulation must be given to write {out}.")
        session = Session(plant, time_step=time_step, inertia=inertia, recording=recording)
        if navigator is not None:
            every = navigator.update_every if isinstance(navigator, Steering) else UPDATE_EVERY
            if isinstance(navigator, Steering):
                navigator = navigator.start(self.system)
            session.assist = Assist(navigator, plant, every)
        return session

    def equilibrium(
        self,
        feed: float,
        field: ArrayLike | FieldSource | None = None,
        *,
        inputs: ArrayLike | None = None,
        start: Equilibrium | None = None,
        twist: float = 0.0,
        hold: Hold | None = None,
    ) -> Equilibrium:
        """Static equilibrium of the wire at a fixed feed and field (P-16).

        Parameters
        ----------
        feed
            Length of wire inside the lumen [m], between 0 and the wire's length.
        field
            Uniform flux density, shape (3,) [T], or a field source; the simulation's own field if
            left out.
        inputs
            Those of the actuator, shape (m,), on top of the field; zero if left out.
        start
            Equilibrium to start from; where its feed differs, the wire is fed from there by
            equilibria. Left out: the wire laid along the centreline. A wire in a lumen can have
            more than one equilibrium: the start decides which is found.
        twist
            Angle by which the guide turns the wire about its axis [rad].
        hold
            Where the far end is held, and how; it is free if left out. It is carried there from
            where it is in ``start``, at the same feed. Stability and sensitivities are those of the
            held wire.

        Returns
        -------
        Equilibrium
            Positions, shape (nodes, 3) [m]; wall forces, shape (nodes, 3) [N]; ``stable`` by the
            sign of the tangent stiffness.

        Raises
        ------
        InputError
            If the feed is not between 0 and the wire's length.
        ConvergenceError
            If Newton's method fails; carries the last iterate and says what to try.
        """
        instance("Simulation.equilibrium", "start", start, Equilibrium, or_none=True)
        instance("Simulation.equilibrium", "hold", hold, Hold, or_none=True)
        source = self.field if field is None else as_field("Simulation", field)
        return find_equilibrium(
            self.system, source, feed, inputs=inputs, start=start, twist=twist, hold=hold
        )

    def tip_arc(self, position: ArrayLike) -> float:
        """How far the tip has come on the way to the lumen's target, an arc parameter [m].

        A wire that cuts the bends comes farther than it is fed.

        Parameters
        ----------
        position
            That of the nodes, shape (nodes, 3) [m].
        """
        nodes = array("Simulation.tip_arc", "position", position, (None, 3), "m")
        return float(self.system.path.locate(nodes[-1:])[0][0])

    def info(self, *, title: str = "", scenario: str = "", motion: Motion = "dynamic") -> RunInfo:
        """What a result file says of the run as a whole."""
        points, radii, tags = [np.zeros((0, 3))], [np.zeros(0)], [np.zeros(0, dtype=np.int64)]
        for i in range(len(self.system.lumen.branches)):
            centre, radius = self.system.lumen.centreline(i)
            points.append(centre)
            radii.append(radius)
            tags.append(np.full(len(centre), i, dtype=np.int64))
        known = RunInfo(
            nodes=self.system.wire.nodes,
            scales=self.system.scales,
            centreline=np.concatenate(points),
            lumen_radius=np.concatenate(radii),
            lumen_branch=np.concatenate(tags),
            magnet=self.system.wire.magnet,
            way=self._way(),
            title=title,
            scenario=scenario,
            motion=motion,
            inputs=self.system.input_names,
            resistances=self.system.resistances,
            wall_motion=self.system.wall_motion,
            absent=self.system.absent,
        )
        sheet = self.system.lumen.sheet
        if sheet is None:
            return known
        return replace(known, surface=(sheet.points, sheet.triangles))

    def _way(self) -> Array:
        """Points and radius of the way to the target, densely along it, shape (q, 4) [m]."""
        if not self.system.lumen.branches:
            return np.zeros((0, 4))
        curve = self.system.path.branches[0].curve
        return curve.at(np.linspace(0.0, curve.length, WAY_POINTS))


def _several(wall_motion: WallMotion | Sequence[WallMotion]) -> tuple[WallMotion, ...]:
    """One displacement or several, each of which the system checks."""
    if isinstance(wall_motion, WallMotion) or not isinstance(wall_motion, (tuple, list)):
        return (wall_motion,)  # type: ignore[return-value]
    return tuple(wall_motion)


def _check_navigator(owner: str, navigator: object) -> None:
    """Refuse what can neither steer nor start somebody who does."""
    if navigator is not None:
        expected = "a navigator such as TipNavigator()"
        offering(owner, "navigator", navigator, [("plan",), ("start",)], expected)


def _steps(length: float, feed: Feed, time_step: float) -> int:
    """How many time steps a length of feed takes, at the course's fastest speed."""
    interval = length / feed.fastest if feed.fastest > 0.0 else feed.duration
    return max(1, round(interval / time_step))


def _watching(watch: Watcher | Sequence[Watcher] | None) -> list[Watcher]:
    """Those that watch a run.

    Raises
    ------
    InputError
        If one of them cannot be called.
    """
    found = [watch] if callable(watch) else list(watch or ())
    for one in found:
        if not callable(one):
            raise refuse("Simulation.run", "watch", "functions of a record, or a list of them", one)
    return found

"""The server of the live simulator: a page, a connection for each who looks, an engine's thread."""

from __future__ import annotations

import asyncio
import secrets
import sys
from collections.abc import Callable
from contextlib import suppress
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING, Any

from magwire.drive.doors import LIVE, LOOPBACK, Doors
from magwire.drive.outcome import Outcome
from magwire.drive.page import page
from magwire.drive.pilot import Pilot
from magwire.drive.room import Guest, Room
from magwire.drive.world import aimed, usual_limit, world
from magwire.errors import InputError, MagwireError
from magwire.files import write_whole
from magwire.navigate import Navigator, Steering
from magwire.navigate.allocation import Allocated
from magwire.navigate.tip import TipNavigator
from magwire.simulation import Simulation

if TYPE_CHECKING:
    from magwire.engine.record import Motion

PORT = 8140
"""Where the page is if nothing else is said and nobody else is there."""
RECORD_EVERY = 0.1
"""Time between two records [s]."""
FAREWELL = 0.3
"""Time in which pages take the report [s]."""
SWITCH = 5e-4
"""Longest time that a planning thread keeps the engine's waiting for the interpreter [s]."""
LONGEST = 4096
"""Bytes of a message from a page at most."""

HANDS = "hands.csv"
"""What was held, next to the result."""

Steer = Callable[[Simulation], Navigator | Steering | None]


class DriveError(MagwireError):
    """A simulator that cannot be served."""


def helping(simulation: Simulation) -> Steering:
    """Who helps where a scenario has no navigator of its own."""
    plain = TipNavigator()
    return plain if simulation.system.actuator is None else Allocated(plain)


def serve(
    simulation: Simulation,
    *,
    title: str = "",
    steering: Steer = helping,
    out: str | Path | None = None,
    scenario: str = "",
    time_step: float = 0.01,
    motion: Motion = "dynamic",
    limit: float | None = None,
    host: str = "127.0.0.1",
    port: int | None = None,
    ready: Callable[[str], None] = lambda address: None,
) -> Outcome:
    """Let a person drive a wire in a browser, until they end it or interrupt the process.

    Parameters
    ----------
    simulation
        Wire, lumen, field or actuator.
    title
        What it is called.
    steering
        Makes who helps, for the simulation with the target that is asked for.
    out
        NetCDF file to record to, with ``hands.csv`` beside it: what was held from when to when.
        Nothing is recorded if left out.
    scenario
        Kept in the result.
    time_step
        dt [s].
    motion
        ``"dynamic"``, or ``"quasi-static"``: every step is an equilibrium.
    limit
        Force of the wall on the wire, summed over it, from which the guide advances no more [N];
        what a wire pushed around the tightest bend comes near to if left out.
    host
        Address to listen at. One that others can reach gets a token, which the address has.
    port
        Port; 8140, or any if that is taken, if left out.
    ready
        Called with the address of the page.

    Returns
    -------
    Outcome
        How it went.

    Raises
    ------
    DriveError
        If the package that serves pages is missing, or the port cannot be listened at.
    """
    check_package()
    note = ""
    try:
        _maker(steering, simulation)()
    except MagwireError as error:  # a wire without magnet, a field that no navigator knows
        note = str(error)
    limit = usual_limit(simulation) if limit is None else limit
    token = "" if host in LOOPBACK else secrets.token_urlsafe(16)
    told = world(simulation, title=title, limit=limit, help_note=note)
    session = simulation.session(
        time_step=time_step,
        motion=motion,
        record_every=None if out is None else RECORD_EVERY,
        out=out,
        title=title,
        scenario=scenario,
    )
    switch = sys.getswitchinterval()
    with session:
        maker = None if note else _maker(steering, simulation)
        pilot = Pilot(session, limit=limit, navigator=maker)
        stage = _Stage(simulation, steering, pilot, told, None if out is None else Path(out))
        try:
            sys.setswitchinterval(SWITCH)
            asyncio.run(stage.play(Doors(host, token), port, ready))
        except KeyboardInterrupt:
            pass  # the way to end it from the terminal
        finally:
            stage.room.clockwork.stop()
            sys.setswitchinterval(switch)
            if out is not None:
                write_whole(Path(out).with_name(HANDS), hands(pilot))
        failure = stage.room.clockwork.failure
        if failure is not None:
            raise failure
    return stage.outcome()


class _Stage:
    """A room, the navigator's target, and the end."""

    def __init__(
        self,
        simulation: Simulation,
        steering: Steer,
        pilot: Pilot,
        told: dict[str, Any],
        file: Path | None,
    ) -> None:
        self._simulation, self._steering, self._pilot = simulation, steering, pilot
        self._aimed, self._file = simulation, file
        self._title = told["title"]
        self.room = Room(pilot, told, self._aim, self._finish)
        self._done = asyncio.Event()

    def outcome(self) -> Outcome:
        """How it went so far."""
        aimed_at, points = self._aimed, self._pilot.sight.points
        rest = aimed_at.system.path.length - aimed_at.tip_arc(points)
        return Outcome.of(self._pilot, max(0.0, rest), self._file)

    async def play(self, doors: Doors, port: int | None, ready: Callable[[str], None]) -> None:
        """Serve the page until the end is asked for."""
        from websockets.asyncio.server import ServerConnection, serve
        from websockets.exceptions import ConnectionClosed
        from websockets.http11 import Request, Response

        html = page(self._title or "magwire")

        def answer(line: ServerConnection, request: Request) -> Response | None:
            refusal = doors.refuse(request.path, request.headers)
            if refusal is not None:
                return line.respond(HTTPStatus(refusal.status), refusal.sentence + "\n")
            if request.path.startswith(LIVE):
                return None
            made = line.respond(HTTPStatus.OK, html)
            del made.headers["Content-Type"]
            made.headers["Content-Type"] = "text/html; charset=utf-8"
            made.headers["Cache-Control"] = "no-store"
            made.headers["Referrer-Policy"] = "no-referrer"
            return made

        async def look_after(line: ServerConnection) -> None:
            with suppress(ConnectionClosed):
                await self.room.stay(Guest(line), line)

        try:
            served = await serve(
                look_after,
                doors.host,
                PORT if port is None else port,
                process_request=answer,
                max_size=LONGEST,
                compression=None,
                ping_interval=2.0,
                ping_timeout=4.0,
            )
        except OSError as error:
            if port is None:
                await self.play(doors, 0, ready)
                return
            reason = (error.strerror or str(error)).lower()
            raise DriveError(
                f"Port {port} of {doors.host} cannot be listened at: {reason}."
            ) from None
        async with served as server:
            self.room.open(asyncio.get_running_loop())
            bound = next(iter(server.sockets)).getsockname()[1]
            name = f"[{doors.host}]" if ":" in doors.host else doors.host
            ready(f"http://{name}:{bound}/" + (f"?token={doors.token}" if doors.token else ""))
            try:
                await self._done.wait()
            finally:  # asked for by a page, or by Ctrl-C
                self.room.clockwork.stop()
                self.room.announce("report", self._report())
                await asyncio.sleep(FAREWELL)

    def _report(self) -> dict[str, Any]:
        failure = self.room.clockwork.failure
        words = "" if failure is None else f"The engine stopped: {failure}"
        return {"rows": self.outcome().rows(), "failure": words}

    def _aim(self, name: str) -> None:
        """Have the navigator lead to another outlet; called in the engine's thread."""
        lumen = self._simulation.system.lumen
        if name not in lumen.outlets:
            raise InputError(f"Input target of drive must be an outlet; received {name!r}.")
        self._aimed = aimed(self._simulation, name)
        if not self.room.world["noHelp"]:
            self._pilot.guided_by(_maker(self._steering, self._aimed))

    def _finish(self) -> None:
        self._done.set()


def _maker(steering: Steer, simulation: Simulation) -> Callable[[], Navigator]:
    def make() -> Navigator:
        found = steering(simulation)
        if found is None:
            found = helping(simulation)
        return found.start(simulation.system) if isinstance(found, Steering) else found

    return make


def hands(pilot: Pilot) -> str:
    """What was held, as CSV: from each time on, until the next."""
    rows = [",".join(map(repr, row)) for row in pilot.course]
    return "\n".join(["time [s],feed speed [m/s],twist rate [rad/s]", *rows]) + "\n"


def check_package() -> None:
    """Refuse to go on where the package that serves pages is missing.

    Raises
    ------
    DriveError
        If it is.
    """
    try:
        import websockets  # noqa: F401
    except ModuleNotFoundError:
        raise DriveError(
            "The live simulator needs the package websockets, which is not installed; "
            "install it with 'pip install magwire[drive]'."
        ) from None

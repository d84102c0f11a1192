"""Who is there: pages that look, one of which drives."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from typing import Any, Protocol

from magwire.drive.clockwork import Clockwork
from magwire.drive.pilot import Pilot
from magwire.drive.world import seen
from magwire.errors import InputError, MagwireError, array, one_of, positive, refuse

WORDS = ("hold", "field", "help", "limit", "rewind", "target", "take", "end")
"""What a page may say."""


class Line(Protocol):
    """A connection to a page."""

    async def send(self, message: str) -> None:
        """Send a text."""
        ...


class Guest:
    """A page: what is new goes to it when it is ready, and only the newest."""

    def __init__(self, line: Line) -> None:
        self.line = line
        self._news = asyncio.Event()
        self._waiting: dict[str, str] = {}

    def tell(self, kind: str, text: str) -> None:
        """Leave a message, in place of one of its kind that was not taken yet."""
        self._waiting[kind] = text
        self._news.set()

    async def deliver(self) -> None:
        """Send what waits, for as long as the connection holds."""
        while True:
            await self._news.wait()
            self._news.clear()
            while self._waiting:
                kind = next(iter(self._waiting))
                await self.line.send(self._waiting.pop(kind))


class Room:
    """Pages around one wire.

    Parameters
    ----------
    pilot
        What is driven.
    world
        What each page is told first.
    aim
        Has the navigator lead to another target, by its name.
    finish
        Called when a page asks for the end.
    """

    def __init__(
        self,
        pilot: Pilot,
        world: dict[str, Any],
        aim: Callable[[str], None],
        finish: Callable[[], None],
    ) -> None:
        self.pilot, self.world = pilot, world
        self._aim, self._finish = aim, finish
        self.clockwork = Clockwork(pilot, self._picture, self._give_up)
        self.guests: list[Guest] = []
        self.driver: Guest | None = None
        self._heard = 0
        self._loop: asyncio.AbstractEventLoop | None = None

    def open(self, loop: asyncio.AbstractEventLoop) -> None:
        """Let time go on; pictures are sent from this loop."""
        self._loop = loop
        self.clockwork.start()

    async def stay(self, guest: Guest, messages: Any) -> None:
        """Look after a page until it is gone."""
        guest.tell("world", json.dumps({"world": self.world}, allow_nan=False))
        self.guests.append(guest)
        if self.driver is None:
            self._hand_over(guest)
        self._counted()
        sending = asyncio.ensure_future(guest.deliver())
        try:
            async for message in messages:
                self._hear(guest, message)
        finally:
            sending.cancel()
            self.guests.remove(guest)
            if self.driver is guest:
                self.driver = None
                self.clockwork.order(self.pilot.let_go)
            self._counted()

    def announce(self, kind: str, value: Any) -> None:
        """Tell all pages something."""
        self.announce_text(kind, json.dumps({kind: value}, allow_nan=False))

    def announce_text(self, kind: str, text: str) -> None:
        """Tell all pages what is a text already."""
        for guest in self.guests:
            guest.tell(kind, text)

    def _hand_over(self, guest: Guest) -> None:
        self.driver, self._heard = guest, 0

    def _counted(self) -> None:
        self.clockwork.watched = bool(self.guests)
        self._roles()
        self.clockwork.order(lambda: None)  # wakes it, and has a picture sent

    def _roles(self) -> None:
        for guest in self.guests:
            role = {"drives": guest is self.driver, "free": self.driver is None}
            guest.tell("role", json.dumps({"role": role}))

    def _hear(self, guest: Guest, message: object) -> None:
        """Do what a page says, or tell it why not."""
        try:
            said = json.loads(message) if isinstance(message, str) else None
            if not isinstance(said, dict) or len(set(said) & set(WORDS)) != 1:
                raise InputError(f"A message must be an object with one of {', '.join(WORDS)}.")
            word = next(key for key in said if key in WORDS)
            if word == "take":
                if self.driver is not guest:
                    self.clockwork.order(self.pilot.let_go)
                    self._hand_over(guest)
                self._roles()
            elif guest is not self.driver:
                raise InputError("Another page drives: take the controls first.")
            elif word == "end":
                self._finish()
            else:
                self._order(guest, word, said)
        except (MagwireError, ValueError, RecursionError) as error:
            guest.tell("said", json.dumps({"said": str(error)}))

    def _order(self, guest: Guest, word: str, said: dict[str, Any]) -> None:
        value, number = said[word], said.get("number", 0)
        act = self._act(word, value)

        def order() -> None:
            try:
                act()
            except MagwireError as error:
                self._post(guest, str(error))
            if isinstance(number, int) and guest is self.driver:
                self._heard = int(number)

        self.clockwork.order(order)

    def _act(self, word: str, value: Any) -> Callable[[], object]:
        """What to do in the engine's thread; types are checked here."""
        pilot = self.pilot
        if word == "hold":
            feed, twist = array("drive", word, value, (2,)).tolist()
            for speed, most in ((feed, self.world["fastest"]), (twist, self.world["fastestTurn"])):
                if not abs(speed) <= most:
                    raise refuse("drive", word, f"speeds of at most {most:.4g}", speed)
            return lambda: pilot.hold(feed, twist)
        if word == "field":
            wanted = array("drive", word, value, (len(self.world["inputs"]),))
            return lambda: pilot.steer(wanted)
        if word == "help":
            kind = one_of("drive", "help", value, ("none", "assist", "suggest"))
            return lambda: pilot.ask(kind)  # type: ignore[arg-type]
        if word == "target":
            name = one_of("drive", "target", value, tuple(self.world["ways"]))
            return lambda: self._turn_to(name)
        number = positive("drive", word, value)
        return (lambda: pilot.limit_to(number)) if word == "limit" else self._back(number)

    def _back(self, seconds: float) -> Callable[[], object]:
        return lambda: self.pilot.rewind(seconds)

    def _turn_to(self, name: str) -> None:
        self._aim(name)
        self.world["target"] = name

    def _post(self, guest: Guest, sentence: str) -> None:
        """Tell a page something from the engine's thread."""
        self._later(guest.tell, "said", json.dumps({"said": sentence}))

    def _picture(self) -> None:
        """Send all pages what has become of the wire; called in the engine's thread."""
        pilot = self.pilot
        picture = seen(pilot.sight) | {
            "rate": self.clockwork.rate,
            "message": pilot.message,
            "wanted": pilot.wanted.tolist(),
            "help": pilot.help,
            "suggested": None if pilot.suggested is None else pilot.suggested.tolist(),
            "target": self.world["target"],
            "limit": pilot.limit,
            "peak": pilot.account.peak_force,
            "heard": self._heard,
        }
        self._later(self.announce_text, "picture", json.dumps({"picture": picture}))

    def _give_up(self) -> None:
        self._later(self._finish)

    def _later(self, act: Callable[..., object], *words: object) -> None:
        """Have the loop's thread do something."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(act, *words)

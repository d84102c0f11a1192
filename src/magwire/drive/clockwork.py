"""The engine's thread: one time step after the other, as fast as a clock on the wall goes."""

from __future__ import annotations

import queue
import threading
import time
from collections import deque
from collections.abc import Callable

import numpy as np

from magwire.drive.pilot import Pilot

PICTURES = 33.0
"""Pictures a second: some that a page has no room for, and it still shows thirty."""
PATIENCE = 0.1
"""How far the steps may be behind the clock before the clock is slowed [s]."""
REST = 1.0
"""Time without anything asked for after which a wire that does not move is left alone [s]."""
STILL = 1e-6
"""Way of the tip in that time of a wire that does not move [m]."""
WINDOW = 0.5
"""Time over which the rate of the clock is measured [s]."""


class Clockwork:
    """Takes a pilot's steps in real time, in a thread of its own.

    No step is left out: where the machine cannot keep up, simulated time is slower than the clock,
    and ``rate`` says by how much. The time stands while a wire at rest is left alone.

    Parameters
    ----------
    pilot
        Who steps; nobody else may touch it while the clockwork runs, but by ``order``.
    show
        Called in the thread, some thirty times a second and after every order.
    give_up
        Called in the thread when something brings it to an end.

    Attributes
    ----------
    rate
        Simulated time over that of the clock, lately; 0 while it stands.
    watched
        Whether anybody looks: if not, the time stands as soon as nothing is held.
    failure
        What brought the thread to an end, if anything did.
    """

    def __init__(self, pilot: Pilot, show: Callable[[], None], give_up: Callable[[], None]) -> None:
        self.pilot, self._show, self._give_up = pilot, show, give_up
        self._orders: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="magwire-engine", daemon=True)
        self._past: deque[tuple[float, float]] = deque()
        self._since, self._there = pilot.sight.time, pilot.sight.points[-1]
        self.rate, self.watched = 0.0, False
        self.failure: Exception | None = None

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def stop(self) -> None:
        """End after the present step."""
        self._stopping.set()
        self._orders.put(lambda: None)
        if self._thread.is_alive():
            self._thread.join()

    def order(self, order: Callable[[], None]) -> None:
        """Have something done between two steps, in their thread."""
        self._orders.put(order)

    def _run(self) -> None:
        try:
            self._go_on()
        except Exception as error:  # told to whoever started the thread
            self.failure = error
            self._give_up()

    def _go_on(self) -> None:
        dt = self.pilot.session.time_step
        due = shown = time.monotonic()
        woken = False
        while not self._stopping.is_set():
            acted = self._carry_out() or woken
            woken = False
            if self._rests():
                self.rate = 0.0
                self._past.clear()
                if acted or shown:
                    self._show()
                shown = 0.0  # once more is enough while the time stands
                self._orders.get()()
                woken = True
                due = time.monotonic()
                continue
            self.pilot.tick()
            now = time.monotonic()
            due = max(due + dt, now - PATIENCE)
            self._measure(now)
            if acted or now - shown >= 1.0 / PICTURES:
                shown = min(now, max(shown + 1.0 / PICTURES, now - 1.0 / PICTURES))
                self._show()
            time.sleep(max(0.0, due - time.monotonic()))

    def _carry_out(self) -> bool:
        """Do what was ordered; whether anything was."""
        acted = False
        while not self._orders.empty():
            self._orders.get()()
            acted = True
        return acted

    def _rests(self) -> bool:
        """Whether nothing is asked for and, if anybody looks, nothing moves."""
        now, tip = self.pilot.sight.time, self.pilot.sight.points[-1]
        if not self.pilot.idle or now < self._since:
            self._since, self._there = now, tip
            return False
        if not self.watched:
            return True
        if now - self._since < REST - 1e-9:
            return False
        moved = float(np.linalg.norm(tip - self._there))
        if moved > STILL:
            self._since, self._there = now, tip
        return moved <= STILL

    def _measure(self, now: float) -> None:
        past = self._past
        past.append((now, self.pilot.sight.time))
        while now - past[0][0] > WINDOW:
            past.popleft()
        wall, simulated = now - past[0][0], past[-1][1] - past[0][1]
        self.rate = min(1.0, max(0.0, simulated / wall)) if wall > 0.0 else 1.0

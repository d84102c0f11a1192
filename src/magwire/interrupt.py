"""Ctrl-C, and being told to end, while compiled code runs."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

ENDING = tuple(signal.Signals[name] for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))
"""How batch systems, and terminals that are closed, tell a process to end."""


class Terminated(SystemExit):
    """The process was told to end: its results are closed, and then it does.

    Parameters
    ----------
    number
        The signal.
    """

    def __init__(self, number: int) -> None:
        self.signal = signal.Signals(number)
        self.status = 128 + number  # as shells have it
        super().__init__(self.status)

    def __str__(self) -> str:
        return f"The process was told to end by {self.signal.name}."


def end_in_order() -> None:
    """From now on signals that tell the process to end raise ``Terminated``.

    A signal that the process was started to ignore, as by ``nohup``, stays ignored.
    """
    for number in ENDING:
        if signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, _end)


def _end(number: int, frame: FrameType | None) -> None:
    raise Terminated(number)


@contextmanager
def nothing_dropped() -> Iterator[None]:
    """Raise a Ctrl-C, or a signal to end, in place of the error that came of dropping it.

    While numba compiles, LLVM calls back into Python, and what is raised there goes no further: a
    ``RuntimeError`` follows, as the machine code is missing.
    """
    dropped: list[BaseException] = []
    former = sys.unraisablehook

    def keep(found: Any) -> None:
        if isinstance(found.exc_value, KeyboardInterrupt | Terminated):
            dropped.append(found.exc_value)
        else:
            former(found)

    sys.unraisablehook = keep
    try:
        yield
    except Exception:
        if dropped:
            raise dropped[0] from None
        raise
    finally:
        sys.unraisablehook = former


@contextmanager
def held_back_interrupt() -> Iterator[Callable[[], None]]:
    """Let the first Ctrl-C, or signal to end, wait until it is asked for; the second strikes.

    numba does not expect a ``KeyboardInterrupt`` while it hands arguments and results over: one
    that arrives just then can end the whole process, with a result half written.

    Yields
    ------
    callable
        Raises ``KeyboardInterrupt`` if there was a Ctrl-C, ``Terminated`` if a signal to end.
    """
    if threading.current_thread() is not threading.main_thread():
        yield lambda: None  # signals reach the main thread only
        return
    pressed = 0
    former = {number: signal.getsignal(number) for number in (signal.SIGINT, *ENDING)}
    held = [n for n, by in former.items() if n == signal.SIGINT or by not in (signal.SIG_IGN, None)]

    def press(number: int, frame: FrameType | None) -> None:
        nonlocal pressed
        pressed = number
        restore()

    def restore() -> None:
        for number in held:
            signal.signal(number, former[number])

    def strike() -> None:
        if pressed in ENDING:
            raise Terminated(pressed)
        if pressed:
            raise KeyboardInterrupt

    for number in held:
        signal.signal(number, press)
    try:
        yield strike
    finally:
        restore()

"""Ctrl-C while compiled code runs."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def held_back_interrupt() -> Iterator[Callable[[], None]]:
    """Let the first Ctrl-C wait until it is asked for; the second one strikes at once.

    numba does not expect a ``KeyboardInterrupt`` while it hands arguments and results over: one
    that arrives just then can end the whole process, with a result half written.

    Yields
    ------
    callable
        Raises ``KeyboardInterrupt`` if there was a Ctrl-C.
    """
    if threading.current_thread() is not threading.main_thread():
        yield lambda: None  # signals reach the main thread only
        return
    pressed = False
    former = signal.getsignal(signal.SIGINT)

    def press(number: int, frame: FrameType | None) -> None:
        nonlocal pressed
        pressed = True
        signal.signal(signal.SIGINT, former)

    def strike() -> None:
        if pressed:
            raise KeyboardInterrupt

    signal.signal(signal.SIGINT, press)
    try:
        yield strike
    finally:
        signal.signal(signal.SIGINT, former)

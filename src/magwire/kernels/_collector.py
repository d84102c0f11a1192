"""Python's garbage collector, held back while numba compiles.

A compilation makes millions of objects that live to its end; looking through them for cycles again
and again takes a tenth of its time.
"""

from __future__ import annotations

import gc

from numba.core import event

SELDOM = (100_000, 20, 50)
"""Thresholds while something is compiled: 5 percent more memory; none at all would take 60 more."""


class _HoldBack(event.Listener):  # type: ignore[misc]
    """Compilations lie within each other: the outermost one counts."""

    def __init__(self) -> None:
        self._within = 0
        self._before = gc.get_threshold()

    def on_start(self, event: event.Event) -> None:
        if self._within == 0:
            self._before = gc.get_threshold()
            gc.set_threshold(*SELDOM)
        self._within += 1

    def on_end(self, event: event.Event) -> None:
        self._within -= 1
        if self._within == 0:
            gc.set_threshold(*self._before)


def hold_back() -> None:
    """From now on, whenever numba compiles."""
    event.register("numba:compile", _HoldBack())

"""A lumen in a line or two."""

from __future__ import annotations

from collections.abc import Sequence

from magwire.units import show

SHOWN = 4  # names of outlets that are listed


def tube_words(branches: int, length: float, radii: tuple[float, float]) -> str:
    """A tube or branches without outlets: how many, how long [m], extreme radii [m]."""
    what = "tube" if branches == 1 else f"{branches} branches, the first one"
    return f"<Lumen: {what} of {show(length, 'length')}, radius {_range(*radii)}>"


def tree_words(
    branches: int, radii: tuple[float, float], outlets: Sequence[str], target: str | None
) -> str:
    """A tree: how many branches, smallest and largest radius [m], where it may be left."""
    left = len(outlets) - SHOWN
    names = ", ".join(repr(name) for name in outlets[:SHOWN])
    more = f" and {left} more" if left > 0 else ""
    return (
        f"<Lumen: tree of {branches} branches, radius {_range(*radii)}; outlets {names}{more}; "
        f"target {target!r}>"
    )


def _range(low: float, high: float) -> str:
    if high - low < 1e-9 * high:
        return show(low, "length")
    return f"{show(low, 'length')} to {show(high, 'length')}"

"""A lumen in a line or two."""

from __future__ import annotations

from typing import TYPE_CHECKING

from magwire.units import show

if TYPE_CHECKING:
    from magwire.lumen.lumen import Lumen

SHOWN = 4  # names of outlets that are listed


def lumen_words(lumen: Lumen) -> str:
    """What it is: length, radii, entrance; of a tree its outlets and the target."""
    if not lumen.branches:
        return "<Lumen: open space, no wall>"
    low, high = lumen.radius_range
    radius = show(low, "length") if high - low < 1e-9 * high else _range(low, high)
    if not lumen.paths:
        count = len(lumen.branches)
        what = "tube" if count == 1 else f"{count} branches, the first one"
        return f"<Lumen: {what} of {show(lumen.length, 'length')}, radius {radius}>"
    names = [repr(name) for name in lumen.outlets[:SHOWN]]
    left = len(lumen.outlets) - len(names)
    more = f" and {left} more" if left else ""
    return (
        f"<Lumen: tree of {len(lumen.branches)} branches, radius {radius}; outlets "
        f"{', '.join(names)}{more}; target {lumen.target!r}>"
    )


def _range(low: float, high: float) -> str:
    return f"{show(low, 'length')} to {show(high, 'length')}"

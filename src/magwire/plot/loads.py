"""Where the wall presses, as a heat map, and the forces on tip, wire and guide (P-37, P-38)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from magwire.plot import style
from magwire.plot.curves import PUSH_LABEL, note

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

Array = NDArray[np.float64]
COLUMNS = 240
"""Columns of a heat map at most."""
ELSEWHERE = 0.02
"""Part of the wall's force off the path that is worth a word; sums are rounded to less."""
CURVES = (
    ("wall_force", "wire", style.CLEARANCE, 2.4),
    ("push_force", "push", style.COMPONENTS[2], 1.3),
    ("tip_force", "tip", style.TIP, 1.1),
)
"""Variable, name, colour, width of the line; the tip on top, which may carry all."""


def columns_of(push: Array, values: Array) -> tuple[float, Array]:
    """Push at the end of the last of even columns, and the largest values in each, shape (k, n).

    Where a wire was at the same push more than once, as in a retraction, the largest counts.
    """
    count = int(np.clip(len(push) - 1, 1, COLUMNS))
    last = float(push.max(initial=0.0)) or 1.0
    where = np.clip((push / last * count).astype(np.int64), 0, count - 1)
    found = np.full((count, values.shape[1]), -np.inf)
    np.maximum.at(found, where, values)
    there = np.unique(where)
    nearest = there[np.abs(np.arange(count)[:, None] - there).argmin(axis=1)]
    return last, found[nearest]


def draw_map(ax: Axes, data: xr.Dataset, largest: float) -> Any:
    """Force per length of the path over arc length and push; colours end at ``largest`` [N/m]."""
    ax.set_xlabel(PUSH_LABEL)
    ax.set_ylabel("along the lumen [mm]")
    ax.grid(visible=False)
    if "lumen_force" not in data or not data.sizes["time"]:
        note(ax, "no wall")
        return None
    arc = 1e3 * data["arc"].values
    last, values = columns_of(data["normalized_push"].values, data["lumen_force"].values)
    end = float(arc[0] + arc[-1])
    image = ax.imshow(
        values.T, cmap=style.PRESSURE, vmin=0.0, vmax=largest, extent=(0.0, last, 0.0, end),
        origin="lower", aspect="auto", interpolation="bilinear", zorder=0,
    )  # fmt: skip
    if not np.any(values > 0.0):
        touches = bool(np.any(data["wall_force"].values > 0.0))
        note(ax, f"all {_off_path(data)}" if touches else "nothing touches the wall")
        return image
    fed = 1e3 * float(data.attrs["length_scale"])
    ax.plot([0.0, last], [0.0, fed * last], color=style.MUTED, linewidth=0.7, dashes=(4, 3))
    ax.set_ylim(0.0, end)
    words = "dashed: insertion"
    if _elsewhere(data) > ELSEWHERE:
        words += f"\nnot shown: what presses\n{_off_path(data)}"
    ax.text(
        0.04, 0.95, words, transform=ax.transAxes, va="top",
        color=style.MUTED, fontsize=6.5,
    )  # fmt: skip
    return image


def _off_path(data: xr.Dataset) -> str:
    """Where what is not shown presses: a single tube has no other branches, but a rim."""
    tree = len(np.unique(data["lumen_branch"].values)) > 1
    return "in other branches" if tree else "off the path"


def _elsewhere(data: xr.Dataset) -> float:
    """Part of the wall's force that is not on the path to the target, where it is largest."""
    spacing = 2.0 * float(data["arc"].values[0])
    shown, whole = spacing * data["lumen_force"].values.sum(axis=1), data["wall_force"].values
    return float(np.max((whole - shown) / (whole.max(initial=0.0) or 1.0), initial=0.0))


def draw_forces(ax: Axes, data: xr.Dataset, passive: xr.Dataset | None = None) -> None:
    """Forces on tip and wire and the push at the guide [mN]; dashed for a run nobody steered."""
    drawn = [*_draw_run(ax, data)]
    if passive is not None:
        drawn += _draw_run(ax, passive, dashed=True)
        ax.set_title("dashed: not steered", loc="left")
    low, high = min(drawn, default=0.0), max(drawn, default=0.0)
    room = high - low or 1.0
    ax.axhline(0.0, color=style.MUTED, linewidth=0.5, zorder=1)
    ax.set_ylim(low - 0.06 * room, high + 0.3 * room)  # room on top for the legend
    ax.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))
    ax.set_xlabel(PUSH_LABEL)
    ax.set_ylabel("forces [mN]")
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="upper left", ncols=3, borderaxespad=0.1, columnspacing=0.9, handlelength=1.1)


def _draw_run(ax: Axes, data: xr.Dataset, *, dashed: bool = False) -> Iterator[float]:
    """Draw the forces of a run; the smallest and the largest of each [mN]."""
    push = data["normalized_push"].values
    for k, (name, label, colour, width) in enumerate(CURVES):
        if name not in data or not np.isfinite(data[name].values).any():
            continue
        force = 1e3 * data[name].values
        (line,) = ax.plot(push, force, color=colour, linewidth=width, zorder=3 + 0.1 * k)
        if dashed:
            line.set(linestyle=(0, (3, 1.5)), linewidth=0.7 * width)
        else:
            line.set_label(label)
        yield from (min(0.0, float(np.nanmin(force))), float(np.nanmax(force)))


def most(runs: list[xr.Dataset]) -> float:
    """Largest force per length of the path in some runs [N/m]; 1 if there is none."""
    known = [run["lumen_force"].values for run in runs if "lumen_force" in run]
    return max((float(values.max(initial=0.0)) for values in known), default=0.0) or 1.0

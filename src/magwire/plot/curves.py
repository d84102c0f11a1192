"""The curves against push: tip force, field and clearance."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter
from numpy.typing import NDArray

from magwire.plot import style

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

Array = NDArray[np.float64]
PUSH_LABEL = r"normalised push  $\mathcal{X}$"


def draw_force(ax: Axes, data: xr.Dataset, passive: xr.Dataset | None = None) -> None:
    """Normalised tip force against normalised push, with millinewtons on the right.

    Next to a run that nobody steered, both have a name.
    """
    runs = [(data, style.FORCE, "" if passive is None else "steered")]
    if passive is not None:
        runs.append((passive, style.PASSIVE, "not steered"))
    tops = [float(np.nanmax(run["normalized_tip_force"].values, initial=0.0)) for run, _, _ in runs]
    for k, ((run, colour, name), top) in enumerate(zip(runs, tops, strict=True)):
        push, force = run["normalized_push"].values, run["normalized_tip_force"].values
        ax.fill_between(push, force, color=colour, alpha=0.12, linewidth=0.0)
        ax.plot(push, force, color=colour, label=name, zorder=3 - 0.1 * k, clip_on=False)
        if top > 0.0:
            _peak(ax, push, force, colour)
    top = max(tops)
    room = 1.22 if passive is None else 1.45  # on top, for the legend
    ax.set_ylim(0.0, room * top if top > 0.0 else 1.0)
    ax.yaxis.set_major_locator(MaxNLocator(nbins=4, steps=[1, 2, 5, 10]))
    ax.set_ylabel(r"tip force  $\mathcal{F}$")
    second_axis(ax, 1e3 * float(data.attrs["force_scale"]), "[mN]")
    if passive is not None:
        ax.legend(loc="upper left", ncols=2, borderaxespad=0.1, columnspacing=1.2)
    if top == 0.0:
        note(ax, "the tip never touches the wall")


def draw_field(ax: Axes, data: xr.Dataset) -> None:
    """Components of the flux density against normalised push, normalised on the right."""
    push, field = data["normalized_push"].values, 1e3 * data["field"].values
    size = float(np.nanmax(np.abs(field), initial=0.0))
    for k, (name, colour) in enumerate(zip("xyz", style.COMPONENTS, strict=True)):
        if size > 0.0:
            ax.plot(push, field[:, k], color=colour, label=f"$B_{name}$", zorder=3 - 0.1 * k)
    ax.axhline(0.0, color=style.MUTED, linewidth=0.5, zorder=1)
    ax.set_ylabel("field [mT]")
    if size > 0.0:
        low, high = min(float(np.nanmin(field)), 0.0), max(float(np.nanmax(field)), 0.0)
        room = high - low
        ax.set_ylim(low - 0.08 * room, high + 0.3 * room)  # room on top for the legend
        ax.legend(loc="upper left", ncols=3, borderaxespad=0.1, columnspacing=1.2)
    else:
        ax.set_ylim(-1.0, 1.0)
        note(ax, "no field")
    ax.yaxis.set_major_locator(MaxNLocator(nbins=4, steps=[1, 2, 5, 10]))
    scale = float(data.attrs["field_scale"])
    if np.isfinite(scale):
        second_axis(ax, 1e3 * scale, r"$\mathcal{B}$", inverse=True)


def draw_clearance(ax: Axes, data: xr.Dataset) -> None:
    """Clearance of the tip and the smallest along the wire against normalised push."""
    push, nodes = data["normalized_push"].values, 1e3 * data["clearance"].values
    between = 1e3 * data["clearance_midpoint"].values
    finite = np.where(np.isfinite(nodes) & (nodes > 0.0), nodes, np.inf)
    smallest = np.minimum(
        finite.min(axis=1, initial=np.inf), np.where(between > 0, between, np.inf)
    )
    tip = finite[:, -1]
    ax.set_xlabel(PUSH_LABEL)
    ax.set_ylabel("clearance [mm]")
    if not np.isfinite(smallest).any():
        ax.set_ylim(0.0, 1.0)
        note(ax, "no wall")
        return
    for values, colour, name, width in (  # the tip on top: where it touches, they are the same
        (smallest, style.CLEARANCE, "smallest of the wire", 2.4),
        (tip, style.TIP, "tip", 1.1),
    ):
        shown = np.where(np.isfinite(values), values, np.nan)
        ax.plot(push, shown, color=colour, label=name, linewidth=width)
    ax.set_yscale("log")
    shown = np.concatenate([smallest[np.isfinite(smallest)], tip[np.isfinite(tip)]])
    decades = np.floor(np.log10(shown.min()) + 1e-9), np.ceil(np.log10(shown.max()) + 0.4)
    ax.set_ylim(10 ** min(decades[0], decades[1] - 2.0), 10 ** decades[1])
    ax.yaxis.set_major_locator(LogLocator(base=10.0, numticks=5))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.legend(loc="upper right", ncols=2, borderaxespad=0.1, columnspacing=1.2)


def _peak(ax: Axes, push: Array, force: Array, colour: str) -> None:
    """A dot and a number where a force is largest."""
    peak = int(np.nanargmax(force))
    ax.plot(push[peak], force[peak], "o", color=colour, markersize=3.2, mec="white", mew=0.5)
    ax.annotate(
        f"peak {force[peak]:.1f}",
        (push[peak], force[peak]),
        xytext=(0, 3.5),
        textcoords="offset points",
        ha="right" if push[peak] > 0.6 * push.max() else "left",
        fontsize=6.5,
        color=colour,
    )


def second_axis(ax: Axes, factor: float, label: str, *, inverse: bool = False) -> None:
    """A scale on the right: the left one times ``factor``, or over it."""
    k = 1.0 / factor if inverse else factor

    def there(y: Any) -> Any:
        return y * k

    def back(y: Any) -> Any:
        return y / k

    right: Any = ax.secondary_yaxis("right", functions=(there, back))
    right.yaxis.set_major_locator(MaxNLocator(nbins=4, steps=[1, 2, 5, 10]))
    right.spines["right"].set_visible(True)
    right.spines["right"].set_linewidth(0.6)
    right.set_ylabel(label)


def note(ax: Axes, text: str) -> None:
    """A word in the middle of a panel that has nothing to show."""
    ax.text(
        0.5,
        0.62,
        text,
        transform=ax.transAxes,
        ha="center",
        va="bottom",
        color=style.MUTED,
        fontstyle="italic",
    )

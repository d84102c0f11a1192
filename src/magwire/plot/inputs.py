"""What the actuator was set to: currents and what they cost, or where a magnet was."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.ticker import MaxNLocator

from magwire.actuate.recorded import of_hardware, power_of
from magwire.plot import style
from magwire.plot.curves import PUSH_LABEL

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

SHOWN = {"A": ("current", "A", 1.0), "m": ("position of the magnet", "mm", 1e3)}
SHOWN |= {"T": ("field", "mT", 1e3), "T/m": ("gradient", "T/m", 1.0), "": ("direction", "", 1.0)}
FEW = 3
"""Inputs that have the colours of components; more of them have others."""


def driven(data: xr.Dataset) -> bool:
    """Whether there was an actuator whose inputs are not the field itself."""
    return "inputs" in data and bool(of_hardware(data.attrs))


def draw_inputs(ax: Axes, data: xr.Dataset) -> None:
    """The inputs in the unit of the first one, over push."""
    names = of_hardware(data.attrs)
    _draw(ax, data, names[0][1])


def draw_cost(ax: Axes, data: xr.Dataset) -> None:
    """The power of the coils; without resistances, or coils, the inputs in other units."""
    names = of_hardware(data.attrs)
    others = [unit for _, unit in names if unit != names[0][1]]
    if others:
        _draw(ax, data, others[0])
        return
    push, inputs = data["normalized_push"].values, data["inputs"].values
    power = power_of(data.attrs, inputs)
    ax.set_xlabel(PUSH_LABEL)
    if power is None:
        power = np.linalg.norm(inputs, axis=1)
        ax.set_ylabel("root of summed squares [A]")
    else:
        ax.set_ylabel("power of the coils [W]")
    ax.plot(push, power, color=style.FORCE)
    ax.fill_between(push, power, color=style.FORCE, alpha=0.12, linewidth=0.0)
    ax.set_ylim(0.0, 1.1 * float(power.max(initial=0.0)) or 1.0)
    ax.yaxis.set_major_locator(MaxNLocator(nbins=4, steps=[1, 2, 5, 10]))


def _draw(ax: Axes, data: xr.Dataset, unit: str) -> None:
    names = of_hardware(data.attrs)
    word, shown, factor = SHOWN[unit]
    columns = [k for k, (_, own) in enumerate(names) if own == unit]
    push, inputs = data["normalized_push"].values, factor * data["inputs"].values
    colours: list[Any] = list(style.COMPONENTS)
    if len(columns) > FEW:
        colours = [mpl.colormaps["viridis"](k / len(columns)) for k in range(len(columns))]
    for colour, k in zip(colours, columns, strict=False):
        label = style.plain(names[k][0])
        ax.plot(push, inputs[:, k], color=colour, linewidth=1.2, label=label)
    ax.axhline(0.0, color=style.MUTED, linewidth=0.5, zorder=1)
    ax.set_xlabel(PUSH_LABEL)
    ax.set_ylabel(f"{word} [{shown}]" if shown else word)
    values = inputs[:, columns]
    low, high = float(min(values.min(initial=0.0), 0.0)), float(max(values.max(initial=0.0), 0.0))
    room = (high - low) or 1.0
    rows = -(-len(columns) // 4)
    ax.set_ylim(low - 0.08 * room, high + (0.12 + 0.16 * rows) * room)  # on top for the legend
    ax.yaxis.set_major_locator(MaxNLocator(nbins=4, steps=[1, 2, 5, 10]))
    ax.legend(loc="upper left", ncols=4, borderaxespad=0.1, columnspacing=1.2)

"""The figure of a sweep: what came out, against each parameter."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from magwire.files import successor
from magwire.plot import style
from magwire.plot.figure import FORMATS

if TYPE_CHECKING:
    import xarray as xr

ROWS = (
    ("max_tip_force", 1e3, "peak force\non the tip [mN]"),
    ("max_wall_force", 1e3, "peak force\non the wire [mN]"),
    ("peak_field", 1e3, "peak field [mT]"),
    ("fed", 1e3, "insertion [mm]"),
)
"""Variable, factor, label."""
SHOWN = {"m": (1e3, "mm"), "T": (1e3, "mT"), "Pa": (1e-6, "MPa"), "A/m": (1e-3, "kA/m")}
"""Factor and unit in which people read a parameter, by its unit in the table."""
WIDEST = 5
"""Parameters in one figure, at most: the first ones."""
KINDS = (
    ("no contact", style.COMPONENTS[2], "^"),
    ("wire touches, tip does not", style.CLEARANCE, "o"),
    ("tip touches", style.FORCE, "s"),
    ("ended early", style.INK, "x"),
)


def draw_sweep(table: xr.Dataset) -> Figure:
    """Draw the table of a sweep.

    Parameters
    ----------
    table
        Its variables and attributes.

    Returns
    -------
    Figure
        A column for each parameter; rows for the peak forces on tip and wire, peak field
        and insertion length.
    """
    names = _varied(table)
    with mpl.rc_context(style.RC):
        width = max(0.55, len(names) / 3.0) * style.WIDTH
        figure = Figure(figsize=(width * style.MM, 170.0 * style.MM), layout="constrained")
        FigureCanvasAgg(figure)
        panels: Any = figure.subplots(
            len(ROWS), len(names), sharex="col", sharey="row", squeeze=False
        )
        kinds = _kinds(table)
        for name, column in zip(names, panels.T, strict=True):
            where, ticks, label = _axis(table, name)
            for panel, (variable, factor, title) in zip(column, ROWS, strict=True):
                values = factor * table[variable].values
                for kind, (words, colour, marker) in enumerate(KINDS):
                    chosen = kinds == kind
                    if chosen.any():
                        panel.scatter(
                            where[chosen],
                            values[chosen],
                            s=12.0,
                            c=colour,
                            marker=marker,
                            label=words,
                            linewidths=0.8 if marker == "x" else 0.0,
                            alpha=0.85,
                            clip_on=False,  # much is zero
                            zorder=3,
                        )
                largest = max((float(y) for y in values if np.isfinite(y)), default=0.0)
                panel.set_ylim(0.0, 1.05 * largest or 1.0)
                if name == names[0]:
                    panel.set_ylabel(title)
            column[-1].set_xlabel(label)
            if ticks:
                column[-1].set_xticks(range(len(ticks)), ticks)
                column[-1].set_xlim(-0.5, len(ticks) - 0.5)
        handles, kinds_drawn = _legend(panels)
        figure.legend(handles, kinds_drawn, loc="outside upper left", ncols=2 * len(names))
    return figure


def save_sweep(table: xr.Dataset, folder: str | Path, name: str = "sweep") -> list[Path]:
    """Draw the table of a sweep and write it as PNG and SVG.

    Parameters
    ----------
    table
        Its variables and attributes.
    folder
        Where to.
    name
        Name of the files without suffix.

    Returns
    -------
    list
        The files.
    """
    figure = draw_sweep(table)
    paths = [Path(folder) / f"{name}.{suffix}" for suffix in FORMATS]
    with mpl.rc_context(style.RC):
        for path in paths:
            with successor(path) as draft:
                figure.savefig(draft, metadata={"Date": None} if path.suffix == ".svg" else None)
    return paths


def _kinds(table: xr.Dataset) -> Any:
    """Place in KINDS of each run; -1 for one that was not done."""
    status = table["status"].values
    tip, wire = (table[f"{part}_contact_free"].values == 1.0 for part in ("tip", "wire"))
    ended = np.where(wire, 0, np.where(tip, 1, 2))
    return np.where(status == "complete", ended, np.where(status == "pending", -1, 3))


def _varied(table: xr.Dataset) -> list[str]:
    """Parameters with more than one value; the first one if there is none."""
    names = str(table.attrs["parameters"]).split(", ")
    return [name for name in names if len(set(table[name].values)) > 1][:WIDEST] or names[:1]


def _axis(table: xr.Dataset, name: str) -> tuple[Any, list[str], str]:
    """Where the runs are on a parameter's axis, the names there if it has names, and its label."""
    values = table[name].values
    if values.dtype.kind not in "fiu":
        words = list(dict.fromkeys(str(value) for value in values))
        where = np.array([words.index(str(value)) for value in values])
        return where, [style.plain(word) for word in words], name
    units = str(table[name].attrs["units"])
    factor, shown = SHOWN.get(units, (1.0, units))
    return factor * values, [], name if shown == "1" else f"{name} [{shown}]"


def _legend(panels: Any) -> tuple[list[Any], list[str]]:
    """Handles and words of all kinds that are drawn, each once."""
    found: dict[str, Any] = {}
    for panel in panels.flat:
        for handle, words in zip(*panel.get_legend_handles_labels(), strict=True):
            found.setdefault(words, handle)
    order = [words for words, _, _ in KINDS if words in found]
    return [found[words] for words in order], order

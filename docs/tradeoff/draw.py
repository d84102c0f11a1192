"""Figure of ``peak_fields.csv``: peak field against tip clearance, and against stability margin."""

from __future__ import annotations

import csv
from pathlib import Path

import matplotlib as mpl
import matplotlib.ticker
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from magwire.plot import style

FOLDER = Path(__file__).parent
FIGURE = FOLDER.parent / "_static" / "peak_fields.png"
MARKERS = {"half-circle": "o", "sinusoid": "s", "helix": "^"}
COMPLETE = 0.719  # push that a plan to the end reaches


def draw(ax: Axes, rows: list[dict[str, str]], along: str) -> None:
    """Peaks of one kind of row; hollow where the replay touches, a cross where the plan ends."""
    for (lumen, marker), colour in zip(MARKERS.items(), style.COMPONENTS, strict=True):
        mine = sorted((r for r in rows if r["lumen"] == lumen), key=lambda r: float(r[along]))
        done = [r for r in mine if float(r["reached"]) > COMPLETE]
        ax.plot([float(r[along]) for r in done], [float(r["peak"]) for r in done], color=colour)
        for row in mine:
            place = float(row[along]), float(row["peak"])
            if row not in done:
                ax.plot(*place, "x", color=colour, ms=6, mew=1.5)
            else:
                face = colour if row["free"] == "1" else "white"
                ax.plot(*place, marker, mec=colour, mfc=face, ms=4.5)
    ax.set(yscale="log", ylim=(60.0, 3000.0), yticks=(100, 200, 300, 500, 1000, 2000))
    ax.yaxis.set_major_formatter("{x:.0f}")
    ax.yaxis.set_minor_locator(mpl.ticker.NullLocator())


def main() -> None:
    """Draw."""
    with (FOLDER / "peak_fields.csv").open(encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    with mpl.rc_context(style.RC):
        size = (style.WIDTH * style.MM, 75.0 * style.MM)
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasAgg(figure)
        left, right = figure.subplots(1, 2, sharey=True)
        draw(left, [r for r in rows if float(r["stability_margin"]) == 1.0], "tip_clearance")
        draw(right, [r for r in rows if float(r["tip_clearance"]) == 0.4], "stability_margin")
        left.set(
            xlabel="tip_clearance (stability_margin 1 s$^{-2}$)",
            ylabel=r"peak field  $|\mathcal{B}|$",
        )
        right.set(xlabel="stability_margin [s$^{-2}$] (tip_clearance 0.4)", xscale="log")
        keys = [
            Line2D([], [], color=colour, marker=marker, ms=4.5, label=lumen)
            for (lumen, marker), colour in zip(MARKERS.items(), style.COMPONENTS, strict=True)
        ]
        keys.append(Line2D([], [], ls="", marker="o", mfc="white", mec="k", label="replay touches"))
        keys.append(Line2D([], [], ls="", marker="x", color="k", label="no field, peak so far"))
        right.legend(handles=keys, loc="upper right", ncols=2)
        figure.savefig(FIGURE, dpi=150)


if __name__ == "__main__":
    main()

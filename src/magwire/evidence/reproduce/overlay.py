"""The picture of the authors' own curves, with magwire's over them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np

from magwire.evidence.published import curve
from magwire.evidence.reproduce import authors
from magwire.evidence.reproduce.pictures import FORCE_LABEL, canvas, save
from magwire.plot import curves, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from magwire.evidence.reproduce.runs import Run


def overlay(runs: dict[str, Run], file: Path) -> None:
    """Forces, field and shapes.

    Parameters
    ----------
    runs
        ``half-circle``, ``sinusoid``, ``narrow bend`` and ``steered``, in the earlier geometry.
    file
        Where to.
    """
    with mpl.rc_context(style.RC):
        figure = canvas(150.0)
        axes: Any = figure.subplots(2, 2)
        for ax, name in zip(axes[0], ("half-circle", "sinusoid"), strict=True):
            drawing = f"control_{name.replace('-', '')}_force"
            _forces(ax, runs[name], drawing)
            ax.set_title(f"{name}, tip force", loc="left")
        _field(axes[1, 0], runs["steered"])
        _shapes(axes[1, 1], runs)
        save(figure, file)


def _forces(ax: Axes, run: Run, drawing: str) -> None:
    without, given = curve(drawing, "blue_triangle"), curve(drawing, "red_square")
    outcome = run.outcome
    push = outcome.push - authors.ENTRY
    ax.plot(push, outcome.tip_force / outcome.unit, color=style.PASSIVE, label="magwire, passive")
    ax.plot(*without.T, "^", color=style.CLEARANCE, ms=4, label="authors, without control")
    ax.plot(*given.T, "s", color=style.FORCE, ms=3, label="authors, with control")
    ax.set(xlim=(0.0, float(without[-1, 0]) + 0.02), ylim=(-2.0, 1.45 * float(without.max())))
    ax.set_xlabel(r"push past the tube's entrance  $\mathcal{X}$")
    ax.set_ylabel(FORCE_LABEL)
    ax.legend(loc="upper left")


def _field(ax: Axes, run: Run) -> None:
    push, theirs = authors.field()
    outcome = run.outcome
    where = outcome.push - authors.ENTRY
    for k, name in enumerate("xyz"):
        colour = style.COMPONENTS[k]
        ax.plot(push, theirs[:, k], "o", color=colour, ms=3, alpha=0.55)
        ax.plot(where, outcome.field[:, k], color=colour, linewidth=0.8, label=rf"$B_{name}$")
    ax.plot(push, authors.across(push, theirs), "D", color=style.INK, ms=3.5)
    across = authors.across(where, outcome.field)
    ax.plot(where, across, color=style.INK, label="across the tip")
    ax.plot([], [], "D", color=style.MUTED, ms=3.5, label="authors (sign turned)")
    ax.set(xlim=(0.0, 0.62))
    ax.set_xlabel(curves.PUSH_LABEL.replace("normalised push", "push past the tube's entrance"))
    ax.set_ylabel(r"field  $\mathcal{B}$")
    ax.set_title("half-circle, field; lines: magwire (Newton's method)", loc="left")
    ax.legend(loc="lower left", ncols=2)


def _shapes(ax: Axes, runs: dict[str, Run]) -> None:
    for drawing, name, colour in (
        ("planar_case1", "narrow bend", style.CLEARANCE),
        ("planar_case3", "half-circle", style.FORCE),
    ):
        wall = curve(drawing, "wall")[:, 1:]
        ax.plot(*wall.T, ".", color=style.LUMEN_EDGE, ms=0.8)
        for push, line in authors.drawn_shapes(drawing):
            ours = shape(runs[name], push)
            inside = ours[:, 0] > -0.11
            ax.plot(*line.T, color=colour, linewidth=3.0, alpha=0.3)
            ax.plot(*ours[inside].T, color=colour, linewidth=0.9)
    ax.plot([], [], color=style.MUTED, linewidth=3.0, alpha=0.3, label="authors")
    ax.plot([], [], color=style.MUTED, linewidth=0.9, label="magwire")
    ax.set_aspect("equal")
    ax.set_xlim(-0.3, 0.24)
    ax.set(xlabel="x / L", ylabel="y / L")
    ax.set_title("passive shapes, two half-circles", loc="left")
    ax.legend(loc="upper left")


def shape(run: Run, push: float) -> Any:
    """Nodes at a push past the tube's entrance, shape (n, 2) [L]."""
    near = int(np.abs(run.outcome.push - authors.ENTRY - push).argmin())
    length = float(run.result.dataset.attrs["length_scale"])
    return run.result.position[near, :, :2] / length

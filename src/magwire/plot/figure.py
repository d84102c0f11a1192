"""The figure of a run: the paper's panels on one page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from magwire.files import successor
from magwire.plot import curves, friction, inputs, loads, shapes, style
from magwire.plot.few import few

if TYPE_CHECKING:
    import xarray as xr

HEIGHT = 104.0
"""Height of the figure [mm], at least."""
WIDE = 1.8
"""Width over height from which a lumen shares its column with the field's panel."""
COLUMN, AROUND, BELOW = 82.0, 33.0, 46.0
"""Width of a wide lumen, height of what is around it, and of the panel below it [mm]."""
PLACES = 5
"""Decimals of where a panel is, in parts of its figure."""
LOADS = 48.0
"""Height of the row of forces, and of those of inputs and friction where there are any [mm]."""
FORMATS = ("png", "svg")


def draw(data: xr.Dataset, passive: xr.Dataset | None = None) -> Figure:
    """Draw a result.

    Parameters
    ----------
    data
        A result file's variables and attributes.
    passive
        The same of a run that nobody steered, for its tip force next to that of ``data``.

    Returns
    -------
    Figure
        Two columns wide (180 mm): shapes of the wire at several feeds, normalised tip force, field
        components and clearance against normalised push; below, where along the lumen the wall is
        pressed, and the forces on tip and wire and at the guide; where there is an actuator, a
        row with its inputs and what they cost; where there is friction, a row with what it takes,
        and with how far the wire slid or the twists of guide and tip. Of
        a run of very many records those are drawn that make the same picture.
    """
    data, passive = few(data), None if passive is None else few(passive)
    with mpl.rc_context(style.RC):
        aspect = shapes.aspect(data)
        top = COLUMN / aspect + AROUND
        height = HEIGHT if aspect < WIDE else max(HEIGHT, top + BELOW)
        further = [
            *([(inputs.draw_inputs, inputs.draw_cost)] if inputs.driven(data) else []),
            *([(friction.draw_friction, friction.draw_slip)] if friction.rubs(data) else []),
        ]
        rows = [height, LOADS, *[LOADS] * len(further)]
        size = (style.WIDTH * style.MM, sum(rows) * style.MM)
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasAgg(figure)
        engine: Any = figure.get_layout_engine()
        engine.set(w_pad=0.03, h_pad=0.03, wspace=0.02, hspace=0.02)
        parts: Any = figure.subfigures(len(rows), 1, height_ratios=rows)
        above, *below_it = parts
        left, right = above.subfigures(1, 2, width_ratios=(1.12, 1.0))
        if aspect < WIDE:
            shape, (force, field, clearance) = left, right.subplots(3, 1, sharex=True)
        else:
            shape, below = left.subfigures(2, 1, height_ratios=(top, height - top))
            field = below.subplots()
            field.set_xlabel(curves.PUSH_LABEL)
            force, clearance = right.subplots(2, 1, sharex=True)
        _draw_shapes(shape, data)
        curves.draw_force(force, data, passive)
        curves.draw_field(field, data)
        curves.draw_clearance(clearance, data)
        runs = [data] if passive is None else [data, passive]
        push = np.concatenate([run["normalized_push"].values for run in runs])
        panels = [force, field, clearance, *_draw_loads(below_it[0], runs)]
        for row, drawn in zip(below_it[1:], further, strict=True):
            # a figure each: the layout of one would let the second scale meet its neighbour's label
            left, right = (half.subplots() for half in row.subfigures(1, 2))
            for draw_panel, panel in zip(drawn, (left, right), strict=True):
                draw_panel(panel, data)
            panels += [left, right]
        for letter, panel in zip("bcdefghijk", panels, strict=False):
            panel.set_title(
                rf"$\bf{{{letter}}}$   {panel.get_title(loc='left')}", loc="left", pad=3.0
            )
            panel.xaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))
            panel.set_xlim(0.0, float(push.max(initial=0.0)) or 1.0)
        figure.draw_without_rendering()  # settles the layout, once for all formats
        figure.set_layout_engine(None)  # a placeholder would have each format drawn twice
        _round_places(figure)
    return figure


def _round_places(figure: Figure) -> None:
    """Round where all panels are: the layout's last digits are not the same every time."""
    waiting: list[Any] = list(figure.subfigs)
    while waiting:
        part = waiting.pop()
        part.bbox_relative.set_points(np.round(part.bbox_relative.get_points(), PLACES))
        waiting += part.subfigs
    for panel in figure.axes:
        box = panel.get_position(original=True).get_points()
        (left, low), (right, high) = np.round(box, PLACES)
        panel.set_position((left, low, right - left, high - low))


def save(
    data: xr.Dataset,
    folder: str | Path,
    name: str = "figure",
    *,
    passive: xr.Dataset | None = None,
) -> list[Path]:
    """Draw a result and write it as PNG and SVG.

    Parameters
    ----------
    data
        A result file's variables and attributes.
    folder
        Where to.
    name
        Name of the files without suffix.
    passive
        A run that nobody steered, for comparison.

    Returns
    -------
    list
        The files.
    """
    figure = draw(data, passive)
    paths = [Path(folder) / f"{name}.{suffix}" for suffix in FORMATS]
    with mpl.rc_context(style.RC):
        for path in paths:
            with successor(path) as draft:
                # Without the date, the same result makes the same file.
                figure.savefig(draft, metadata={"Date": None} if path.suffix == ".svg" else None)
    return paths


def _draw_shapes(panel: Any, data: xr.Dataset) -> None:
    pair = shapes.plane(data)
    if pair is None:
        ax = panel.add_subplot(projection="3d", computed_zorder=False)
        shapes.draw_spatial(ax, data)
    else:
        ax = panel.add_subplot()
        shapes.draw_planar(ax, data, pair)
    ax.set_title(_title(data), loc="left", pad=6.0)
    push = data["normalized_push"].values
    colours = ScalarMappable(Normalize(0.0, float(push.max(initial=0.0)) or 1.0), style.PUSH)
    bar = panel.colorbar(colours, ax=ax, orientation="horizontal", shrink=0.62, aspect=34, pad=0.02)
    bar.outline.set_visible(False)
    shown = [float(push[k]) for k in shapes.snapshots(data)]
    bar.set_ticks(shown, labels=[f"{x:.2g}" for x in shown])  # longer ones run together
    bar.ax.tick_params(length=0.0)
    bar.set_label(curves.PUSH_LABEL)


def _draw_loads(panel: Any, runs: list[xr.Dataset]) -> list[Any]:
    """The row of forces, with a heat map for each run; its axes."""
    axes = list(panel.subplots(1, len(runs) + 1, width_ratios=[*(1.0 for _ in runs), 1.25]))
    largest = loads.most(runs)
    for ax, run, name in zip(axes, runs, ("steered", "not steered"), strict=False):
        mesh = loads.draw_map(ax, run, largest)
        if len(runs) > 1:
            ax.set_title(name, loc="left")
    for ax in axes[1 : len(runs)]:
        ax.set_ylabel("")
    if mesh is not None:
        bar = panel.colorbar(mesh, ax=axes[: len(runs)], aspect=22, pad=0.02)
        bar.outline.set_visible(False)
        bar.ax.yaxis.set_major_locator(MaxNLocator(nbins=4, steps=[1, 2, 5, 10]))
        bar.set_label("wall force [N/m]")
    loads.draw_forces(axes[-1], *runs)
    return axes


def _title(data: xr.Dataset) -> str:
    """Letter, title, motion unless it is dynamic and, for a run that ended early, how."""
    title = style.plain(data.attrs.get("title", ""))
    motion = str(data.attrs.get("motion", "dynamic"))
    if motion != "dynamic":
        title = f"{title}, {motion}" if title else motion
    status = style.plain(data.attrs.get("status", "complete"))
    push = data["normalized_push"].values
    if status != "complete" and push.size:
        title += f" ({status} at push {push[-1]:.3f})"
    return r"$\bf{a}$   " + title

"""The map of a tree: which field each of its parts takes, and which parts are not reached."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Line3DCollection
from numpy.typing import NDArray

from magwire.files import successor
from magwire.plot import shapes, style

Array = NDArray[np.float64]
OPACITY = 0.13  # of tubes
HEIGHT = 120.0
"""Height of the figure [mm]."""


def draw(
    tubes: Mapping[str, tuple[Array, Array]],
    fields: Mapping[str, tuple[Array, Array]],
    *,
    trunks: Sequence[tuple[Array, Array]] = (),
    surface: tuple[Array, NDArray[np.int64]] | None = None,
) -> Figure:
    """Draw the tree, coloured by the field that it takes.

    Parameters
    ----------
    tubes
        Points, shape (q, 3), and radius, shape (q,), of the path to each outlet by its name [m].
    fields
        How far the tip came [m] and flux density [T] on the path to each outlet, shapes (n,); what
        lies past the farthest is not reached. On a part that paths share, the largest field counts.
    trunks
        Points and radius of tubes that are wall, but no path.
    surface
        Corners [m] and triangles of the wall, if it is not of balls, to be drawn in place of tubes.

    Returns
    -------
    Figure
        Two columns wide (180 mm).
    """
    with mpl.rc_context(style.RC):
        figure = Figure(figsize=(style.WIDTH * style.MM, HEIGHT * style.MM))
        FigureCanvasAgg(figure)
        figure.set_layout_engine("constrained")
        axes: Any = figure.add_subplot(projection="3d", computed_zorder=False)
        parts = {n: shapes.Branch(1e3 * p, 1e3 * r) for n, (p, r) in tubes.items()}
        peak = max((1e3 * float(b.max(initial=0.0)) for _, b in fields.values()), default=0.0)
        scale = ScalarMappable(Normalize(0.0, peak or 1.0), style.PUSH)
        if surface is not None:
            shapes.draw_sheet(axes, 1e3 * surface[0], surface[1])
        for points, radius in trunks if surface is None else ():
            tube = shapes.tube(shapes.Branch(1e3 * points, 1e3 * radius))
            shapes.draw_wall(axes, tube, style.LUMEN_EDGE, OPACITY)
        for k, name in enumerate(parts):
            part, before = parts[name], list(parts.values())[:k]
            start = shapes.leaves(part, before)
            if surface is None:
                tube = shapes.tube(shapes.Branch(part.points[start:], part.radius[start:]))
                shapes.draw_wall(axes, tube, style.LUMEN_EDGE, OPACITY)
            _draw_way(axes, name, part.points[start:], _needed(name, parts, fields)[start:], scale)
        axes.plot(*next(iter(parts.values())).points[:1].T, "s", color=style.INK, markersize=4)
        shapes.frame(axes, list(parts.values()))
        figure.colorbar(scale, ax=axes, shrink=0.6, label="flux density [mT]")
    return figure


def save(
    tubes: Mapping[str, tuple[Array, Array]],
    fields: Mapping[str, tuple[Array, Array]],
    path: str | Path,
    *,
    trunks: Sequence[tuple[Array, Array]] = (),
    surface: tuple[Array, NDArray[np.int64]] | None = None,
) -> None:
    """Draw the tree into a file; the parameters are those of ``draw``."""
    figure = draw(tubes, fields, trunks=trunks, surface=surface)
    with mpl.rc_context(style.RC), successor(Path(path)) as draft:
        figure.savefig(draft)


def _needed(
    name: str, parts: Mapping[str, shapes.Branch], fields: Mapping[str, tuple[Array, Array]]
) -> Array:
    """Largest flux density at each point of a path [mT]; NaN where no wire got."""
    own = parts[name]
    needed = np.full(len(own.points), np.nan)
    for other, (arc, flux) in fields.items():
        if len(arc) == 0:
            continue
        end = len(own.points)
        if other != name:
            end = shapes.leaves(own, [parts[other]]) + 1
        far = np.maximum.accumulate(arc)  # of where the tip was twice, the last field counts
        along = shapes.arcs(own)[:end]
        last = np.searchsorted(far, 1e-3 * along + 1e-12, side="right") - 1
        there = flux[np.maximum(last, 0)]
        there[1e-3 * along > far[-1] + 1e-3 * own.radius[:end]] = np.nan
        needed[:end] = np.fmax(needed[:end], 1e3 * there)
    return needed


def _draw_way(axes: Any, name: str, points: Array, needed: Array, scale: ScalarMappable) -> None:
    """Draw what a path does not share with those before it, by the field that it takes there."""
    pieces = np.stack([points[:-1], points[1:]], axis=1)
    values = needed[:-1]
    known = np.isfinite(values)
    colours = np.where(known[:, None], scale.to_rgba(np.nan_to_num(values)), (0.6, 0.63, 0.66, 1.0))
    axes.add_collection3d(Line3DCollection(pieces, colors=colours, linewidths=2.4))
    reached = bool(known[-1])
    mark = "o" if reached else "x"
    colour = colours[-1] if reached else style.FORCE
    axes.plot(*points[-1:].T, mark, color=colour, markersize=4.5)
    axes.text(*points[-1], f"  {style.plain(name)}", color=style.INK, fontsize=7.0)

"""The picture of a vessel: its tubes in space, and the radius along the path to each outlet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from numpy.typing import NDArray

from magwire.files import successor
from magwire.plot import shapes, style

Array = NDArray[np.float64]
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#22303c")
OPACITY = 0.22  # of tubes
TRIANGLES = 20_000  # of a surface that are drawn
HEIGHT = 92.0
"""Height of the figure [mm]."""


class Mesh(Protocol):
    """Triangles: points, shape (n, 3) [m], and their indices, shape (m, 3)."""

    @property
    def points(self) -> Array:
        """Corners of the triangles."""
        ...

    @property
    def triangles(self) -> NDArray[np.int64]:
        """Which corners each has."""
        ...


def draw(
    tubes: Mapping[str, tuple[Array, Array]],
    wire: float | None = None,
    surface: Mesh | None = None,
    *,
    trunks: Sequence[tuple[Array, Array]] = (),
) -> Figure:
    """Draw the tubes of a vessel.

    Parameters
    ----------
    tubes
        Points, shape (n, 3), and radius, shape (n,), of the path to each outlet by its name [m].
    wire
        Radius of a wire to compare with [m].
    surface
        The vessel's surface, to be drawn around its tubes.
    trunks
        Points and radius of tubes that are wall, but no path.

    Returns
    -------
    Figure
        Two columns wide (180 mm).
    """
    with mpl.rc_context(style.RC):
        figure = Figure(figsize=(style.WIDTH * style.MM, HEIGHT * style.MM))
        FigureCanvasAgg(figure)
        draw_into(figure, tubes, wire, surface, trunks=trunks)
    return figure


def draw_into(
    figure: Figure,
    tubes: Mapping[str, tuple[Array, Array]],
    wire: float | None = None,
    surface: Mesh | None = None,
    *,
    trunks: Sequence[tuple[Array, Array]] = (),
) -> None:
    """Draw the tubes of a vessel into an empty figure; what they are is said in ``draw``."""
    with mpl.rc_context(style.RC):
        figure.set_layout_engine("constrained")
        halves: Any = figure.subfigures(1, 2, width_ratios=(1.0, 1.0))
        parts = [shapes.Branch(1e3 * p, 1e3 * r) for p, r in tubes.values()]
        space = halves[0].add_subplot(projection="3d", computed_zorder=False)
        if surface is not None:
            _draw_surface(space, surface)
        for points, radius in trunks:
            tube = shapes.tube(shapes.Branch(1e3 * points, 1e3 * radius))
            shapes.draw_wall(space, tube, style.LUMEN_EDGE, OPACITY)
        _draw_tubes(space, parts, tubes)
        axes = halves[1].subplots()
        for i, (name, part) in enumerate(zip(tubes, parts, strict=True)):
            axes.plot(
                shapes.arcs(part),
                part.radius,
                color=COLOURS[i % len(COLOURS)],
                label=style.plain(name),
            )
        if wire is not None:
            axes.axhline(1e3 * wire, color=style.INK, linestyle="--", linewidth=0.8, label="wire")
        axes.set(xlabel="arc length from the entrance [mm]", ylabel="radius [mm]")
        axes.set_ylim(bottom=0.0)
        axes.legend()


def save(
    tubes: Mapping[str, tuple[Array, Array]],
    path: str | Path,
    wire: float | None = None,
    surface: Mesh | None = None,
    *,
    trunks: Sequence[tuple[Array, Array]] = (),
) -> None:
    """Draw the tubes of a vessel into a file; the parameters are those of ``draw``."""
    figure = draw(tubes, wire, surface, trunks=trunks)
    with mpl.rc_context(style.RC), successor(Path(path)) as draft:
        figure.savefig(draft)


def _draw_surface(axes: Any, surface: Mesh) -> None:
    """Draw triangles; of very many, some, evenly spread."""
    some = surface.triangles[:: max(1, len(surface.triangles) // TRIANGLES)]
    sheet = Poly3DCollection(
        1e3 * surface.points[some], facecolors=style.LUMEN_EDGE, alpha=0.3, rasterized=True
    )
    axes.add_collection3d(sheet)


def _draw_tubes(axes: Any, parts: list[shapes.Branch], names: Mapping[str, Any]) -> None:
    for i, (name, part) in enumerate(zip(names, parts, strict=True)):
        colour = COLOURS[i % len(COLOURS)]
        start = shapes.leaves(part, parts[:i])
        own = shapes.Branch(part.points[start:], part.radius[start:])
        shapes.draw_wall(axes, shapes.tube(own), colour, OPACITY)
        axes.plot(*own.points.T, color=colour, linewidth=0.9)
        axes.text(*own.points[-1], f" {style.plain(name)}", color=colour, fontsize=6.5)
    axes.plot(*parts[0].points[:1].T, "o", color=style.INK, markersize=3.5)
    shapes.frame(axes, parts)

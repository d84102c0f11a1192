"""The wire in its lumen at several feeds, in the plane or in space."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Polygon
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from numpy.typing import NDArray

from magwire.contact.motion import recorded
from magwire.plot import moving, style

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

Array = NDArray[np.float64]
PLANES = ((0, 1), (0, 2), (1, 2))
FLAT = 1e-6
"""Extent across a coordinate plane, over the largest extent, up to which a lumen is planar."""
SIDES = 28
"""Corners of a cross-section of the lumen drawn in space."""
VIEW = (24.0, -58.0)
"""Elevation and azimuth that a single tube is seen from [deg]."""
OPACITY = 0.16  # of a wall in space
SHORT = 0.2  # extent along an axis over the longest, below which ticks would run together
SLIM = 3.0
"""Longest extent over the second longest from which a box in space leaves room for its names."""
TRIANGLES = 20_000
"""Triangles of a surface that are drawn."""
GUIDE = 0.12
"""Length of the guide that is shown before the entrance, over the largest extent."""


class Branch(NamedTuple):
    """One branch of the lumen: points, shape (q, 3), and radius, shape (q,) [mm]."""

    points: Array
    radius: Array


def branches(data: xr.Dataset) -> list[Branch]:
    """The branches of the lumen in millimetres; none in open space."""
    if "centreline" not in data:
        return []
    index = data["lumen_branch"].values
    points, radius = 1e3 * data["centreline"].values, 1e3 * data["lumen_radius"].values
    return [Branch(points[index == i], radius[index == i]) for i in np.unique(index)]


def plane(data: xr.Dataset) -> tuple[int, int] | None:
    """The coordinate plane that the lumen lies in, as two axes; None if it lies in none."""
    parts = branches(data)
    points = np.concatenate([part.points for part in parts]) if parts else _all_nodes(data)
    extent = np.ptp(points, axis=0)
    for pair in PLANES:
        across = ({0, 1, 2} - set(pair)).pop()
        if extent[across] <= FLAT * extent.max():
            return pair
    return None


def aspect(data: xr.Dataset) -> float:
    """Width over height of what is shown; 1 in space."""
    pair = plane(data)
    if pair is None:
        return 1.0
    low, high = window(data)
    size = high - low
    return float(size[pair[0]] / size[pair[1]])


def snapshots(data: xr.Dataset, most: int = 8, *, until: float | None = None) -> list[int]:
    """Indices of the records to draw: at even feeds on round numbers, and the last one.

    The feeds are even over pushes up to ``until``; over those of the run if it is left out.
    """
    push = data["normalized_push"].values
    if push.size == 0:
        return []
    last = float(push.max())
    whole = last if until is None else until
    step = next((s for s in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0) if whole / s <= most), whole)
    wanted = [*np.arange(step, last + 1e-9, step)] if step > 0.0 else []
    if not wanted or last - wanted[-1] > 0.6 * step:
        wanted.append(last)
    # The first time that a feed is reached: later ones may belong to a retraction.
    return [int(np.argmax(push >= feed - 1e-9)) for feed in wanted]


def draw_planar(
    ax: Axes,
    data: xr.Dataset,
    pair: tuple[int, int],
    *,
    wires: bool = True,
    until: float | None = None,
) -> None:
    """Draw lumen and wires in a coordinate plane; colours run up to the push ``until``.

    A wall that moves is filled where it is at rest; thin lines of a wire's colour show it where it
    is at that wire's time.
    """
    i, j = pair
    moves = bool(recorded(data))
    draw_lumen(ax, data, pair)
    for nodes, colour, time in _wires(data, until) if wires else ():
        for wall in itertools.chain(*_walls(data, pair, time)) if moves else ():
            ax.plot(*wall.T, color=colour, linewidth=0.6, zorder=2.5)
        ax.plot(nodes[:, i], nodes[:, j], color=colour, linewidth=1.6, zorder=3)
        ax.plot(*nodes[-1, [i, j]], "o", color=colour, markersize=4, mec="white", mew=0.5, zorder=4)
    low, high = window(data)
    ax.set_xlim(low[i], high[i])
    ax.set_ylim(low[j], high[j])
    ax.set_aspect("equal")
    ax.grid(visible=False)
    ax.set_xlabel(f"{'xyz'[i]} [mm]")
    ax.set_ylabel(f"{'xyz'[j]} [mm]")


def draw_spatial(
    ax: Any, data: xr.Dataset, *, wires: bool = True, until: float | None = None
) -> None:
    """Draw lumen and wires in space, on 3D axes; colours run up to the push ``until``.

    A wall that moves is where it is at the time of the longest wire.
    """
    shown = snapshots(data, until=until) if wires else []
    draw_lumen(ax, data, None, float(data["time"].values[shown[-1]]) if shown else None)
    parts = branches(data)
    low, high = window(data)
    for nodes, colour, _ in _wires(data, until) if wires else ():
        inside = nodes[np.all((nodes >= low) & (nodes <= high), axis=1)]
        ax.plot(*inside.T, color=colour, linewidth=1.8, zorder=3)
        ax.plot(*nodes[-1:].T, "o", color=colour, markersize=4, mec="white", mew=0.5, zorder=4)
    frame(ax, parts, (low, high), zoom=1.0 if len(parts) < 2 else 0.95)


def draw_lumen(
    ax: Any, data: xr.Dataset, pair: tuple[int, int] | None, time: float | None = None
) -> list[Any]:
    """Draw the lumen in a plane, or in space if it is none, where it is at a time [s]; its artists.

    Without a time it is where it is at rest.
    """
    parts, sheet = branches(data), surface(data)
    if sheet is not None:
        sheet = moving.moved(data, sheet[0], time), sheet[1]
        if pair is None:
            return [draw_sheet(ax, *sheet)]
        cut = LineCollection(
            _cut(sheet, data, pair), colors=style.LUMEN_EDGE, linewidths=0.9, zorder=1
        )
        return [ax.add_collection(cut)]
    made: list[Any] = []
    if pair is not None:
        for left, right in _walls(data, pair, time):
            for wall in (left, right):
                made += ax.plot(*wall.T, color=style.LUMEN_EDGE, linewidth=0.9, zorder=1)
            corners = np.concatenate([left, right[::-1]])
            filled = Polygon(corners, facecolor=style.LUMEN_FILL, edgecolor="none", zorder=2)
            made.append(ax.add_patch(filled))
        return made
    parts = [part._replace(points=moving.moved(data, part.points, time)) for part in parts]
    for part in parts:
        around = _outside(tube(part), [other for other in parts if other is not part])
        made.append(draw_wall(ax, around, style.LUMEN_EDGE, OPACITY))
    return made


def draw_wall(ax: Any, wall: tuple[Array, Array, Array], colour: str, opacity: float) -> Any:
    """Draw the wall of a ``tube`` in space."""
    return ax.plot_surface(
        *wall, color=colour, alpha=opacity, linewidth=0.0, shade=False, zorder=1,
        rstride=1, cstride=1, antialiased=True, rasterized=True,
    )  # fmt: skip


def draw_sheet(ax: Any, points: Array, triangles: NDArray[np.int64]) -> Any:
    """Draw triangles [mm] in space; of very many, some, evenly spread."""
    some = triangles[:: max(1, len(triangles) // TRIANGLES)]
    sheet = Poly3DCollection(
        points[some], facecolors=style.LUMEN_EDGE, alpha=OPACITY, linewidths=0.0, rasterized=True
    )
    return ax.add_collection3d(sheet)


def surface(data: xr.Dataset) -> tuple[Array, NDArray[np.int64]] | None:
    """Corners [mm] and triangles of a wall that is a surface; None of a wall of balls."""
    if "surface_points" not in data:
        return None
    return 1e3 * data["surface_points"].values, data["surface_triangles"].values


def _cut(
    sheet: tuple[Array, NDArray[np.int64]], data: xr.Dataset, pair: tuple[int, int]
) -> list[Array]:
    """Where the plane of the centrelines cuts triangles: segments, shape (2, 2) each [mm]."""
    across = ({0, 1, 2} - set(pair)).pop()
    height = float(np.mean([part.points[:, across].mean() for part in branches(data)]))
    corners = sheet[0][sheet[1]]
    off = corners[:, :, across] - height
    off[off == 0.0] = 1e-12
    found = []
    for corner, side in zip(corners, off, strict=True):
        ends = []
        for k in range(3):
            a, b = side[k], side[(k + 1) % 3]
            if a * b < 0.0:
                ends.append(corner[k] + a / (a - b) * (corner[(k + 1) % 3] - corner[k]))
        if len(ends) == 2:
            found.append(np.array(ends)[:, list(pair)])
    return found


def bounds(parts: list[Branch]) -> tuple[Array, Array]:
    """Corners of the box around tubes [mm]."""
    low = np.min([np.min(p.points - p.radius[:, None], axis=0) for p in parts], axis=0)
    high = np.max([np.max(p.points + p.radius[:, None], axis=0) for p in parts], axis=0)
    return low, high


def frame(
    ax: Any, parts: list[Branch], box: tuple[Array, Array] | None = None, *, zoom: float = 1.0
) -> None:
    """Show a box around tubes in space at one scale; the smallest box if none is given."""
    low, high = bounds(parts) if box is None else box
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    size = high - low
    slim = bool(size.max() > SLIM * np.sort(size)[1])
    ax.set_box_aspect(size, zoom=0.85 * zoom if slim else zoom)
    elevation, azimuth = view(parts)
    ax.view_init(elev=elevation, azim=azimuth)
    dress(ax)
    for axis, extent in zip((ax.xaxis, ax.yaxis, ax.zaxis), size, strict=True):
        if extent < SHORT * size.max():
            axis.set_major_locator(_few_ticks(2))
    if slim:
        (ax.xaxis, ax.yaxis, ax.zaxis)[int(np.argmax(size))].labelpad = 12


def dress(ax: Any) -> None:
    """Give axes in space their grid, few ticks and names."""
    for axis, name in zip((ax.xaxis, ax.yaxis, ax.zaxis), "xyz", strict=True):
        axis.set_pane_color((1.0, 1.0, 1.0, 0.0))
        axis.line.set_color(style.MUTED)
        axis._axinfo["grid"].update(color=style.GRID, linewidth=0.5)
        axis.set_major_locator(_few_ticks())
        axis.set_label_text(f"{name} [mm]")
        axis.labelpad = -6
        axis.set_tick_params(pad=-3)


def view(parts: list[Branch]) -> tuple[float, float]:
    """Elevation and azimuth [deg]: a tree is seen from where its ends are well apart."""
    if len(parts) < 2:
        return VIEW
    ends = np.array([parts[0].points[0], *(part.points[-1] for part in parts)])
    first, second = np.triu_indices(len(ends), 1)
    halves = [part.points[-1] - part.points[len(part.points) // 2] for part in parts]
    shown = np.concatenate([ends[first] - ends[second], 2.0 * np.array(halves)])
    best, view = -1.0, VIEW
    for elevation, azimuth in itertools.product(range(15, 50, 5), range(-120, -35, 5)):
        up, around = np.radians(elevation), np.radians(azimuth)
        eye = [np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)]
        apart = float(np.linalg.norm(np.cross(shown, eye), axis=1).min())
        if apart > best:
            best, view = apart, (float(elevation), float(azimuth))
    return view


def _outside(wall: tuple[Array, Array, Array], others: list[Branch]) -> tuple[Array, Array, Array]:
    """The wall without what lies inside of other branches; one ring of it stays."""
    corners = np.stack(wall, axis=-1)
    inside = np.zeros(corners.shape[:2], dtype=bool)
    for other in others:
        for k, ring in enumerate(corners):
            away = np.linalg.norm(ring[:, None] - other.points, axis=2)
            inside[k] |= np.any(away < other.radius, axis=1)
    lost = inside.copy()
    lost[:-1] &= inside[1:]
    lost[1:] &= inside[:-1]
    lost &= np.roll(inside, 1, axis=1) & np.roll(inside, -1, axis=1)
    corners[lost] = np.nan
    return corners[..., 0], corners[..., 1], corners[..., 2]


def leaves(part: Branch, before: list[Branch]) -> int:
    """Index of the point after which a path is not one with those before it any more."""
    if not before:
        return 0
    from scipy.spatial import KDTree

    points = np.concatenate([other.points for other in before])
    radius = np.concatenate([other.radius for other in before])
    away, nearest = KDTree(points).query(part.points)
    shared = away < 0.5 * radius[nearest]
    return min(int(np.flatnonzero(shared)[-1]), len(shared) - 2) if shared.any() else 0


def arcs(part: Branch) -> Array:
    """Arc length along the points of a branch, shape (q,) [mm]."""
    steps = np.linalg.norm(np.diff(part.points, axis=0), axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])


def _few_ticks(most: int = 4) -> Any:
    from matplotlib.ticker import MaxNLocator

    return MaxNLocator(nbins=most, steps=[1, 2, 5, 10])


def _all_nodes(data: xr.Dataset) -> Array:
    nodes = 1e3 * np.asarray(data["position"].values, dtype=np.float64).reshape(-1, 3)
    return nodes if len(nodes) else np.zeros((1, 3))


def _wires(data: xr.Dataset, until: float | None) -> Iterator[tuple[Array, Any, float]]:
    """Nodes [mm], colours and times of the wires to draw; the longest first: none is hidden.

    The darkest colour stands for the push ``until``; for the last one if it is left out.
    """
    push = data["normalized_push"].values
    last = until or (float(push.max()) if push.size else 1.0)
    for k in reversed(snapshots(data, until=until)):
        colour, time = style.PUSH(push[k] / last if last else 1.0), data["time"].values[k]
        yield 1e3 * data["position"].values[k], colour, float(time)


def window(data: xr.Dataset) -> tuple[Array, Array]:
    """Corners of what is shown [mm]: the lumen with a margin and the last bit of the guide."""
    parts = branches(data)
    if not parts:
        points = _all_nodes(data)
        low, high = points.min(axis=0), points.max(axis=0)
        margin = 0.05 * float((high - low).max()) or 1.0
        return low - margin, high + margin
    low, high = bounds(parts)
    size = float((high - low).max())
    margin = 0.03 * size
    start, after = parts[0].points[:2]
    guide = start - (after - start) / np.linalg.norm(after - start) * GUIDE * size
    back, forth = moving.reach(data)
    return np.minimum(low + back - margin, guide), np.maximum(high + forth + margin, guide)


def _tangents(points: Array) -> Array:
    slope = np.gradient(points, axis=0)
    return np.asarray(slope / np.linalg.norm(slope, axis=1, keepdims=True))


def _walls(
    data: xr.Dataset, pair: tuple[int, int], time: float | None = None
) -> Iterator[tuple[Array, Array]]:
    """Both walls of each branch in the plane, shape (q, 2) [mm]; at a time, or at rest."""
    for part in branches(data):
        points = moving.moved(data, part.points, time)[:, list(pair)]
        tangent = _tangents(points)
        normal = np.column_stack([-tangent[:, 1], tangent[:, 0]]) * part.radius[:, None]
        yield points + normal, points - normal


def tube(part: Branch) -> tuple[Array, Array, Array]:
    """The lumen's wall in space: three arrays of shape (q, SIDES) [mm]."""
    every = max(1, len(part.radius) // 160)
    keep = np.unique(np.r_[0 : len(part.radius) : every, len(part.radius) - 1])
    points, radius = part.points[keep], part.radius[keep]
    tangent = _tangents(points)
    across = np.eye(3)[np.argmin(np.abs(tangent[0]))]
    angle = np.linspace(0.0, 2.0 * np.pi, SIDES)
    wall = np.empty((len(points), SIDES, 3))
    for k, along in enumerate(tangent):  # the normal is carried along without twisting
        across = across - along * (across @ along)
        across /= np.linalg.norm(across)
        beside = np.cross(along, across)
        circle = np.outer(np.cos(angle), across) + np.outer(np.sin(angle), beside)
        wall[k] = points[k] + radius[k] * circle
    return wall[..., 0], wall[..., 1], wall[..., 2]

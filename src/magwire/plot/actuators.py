"""What an actuator can do: its field with the wire in it, and the fields that it can make."""

from __future__ import annotations

from typing import Any, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from magwire.actuate import Actuator, Extremes, Magnet
from magwire.plot import style

Array = NDArray[np.float64]
HEIGHT = 88.0
"""Height of the figure [mm]."""
GRID = 81
"""Points along each side of the plane that is drawn."""
FAR = np.linspace(5e-3, 0.25, 200)
"""Distances from a magnet's surface [m]."""


class Scene(NamedTuple):
    """What is drawn with a field.

    Attributes
    ----------
    low, high
        Opposite corners of the working volume, shape (3,) [m].
    inputs
        What the actuator is set to, shape (m,).
    tubes
        Points and radius of each branch of a lumen, shape (q, 4) [m].
    wire
        Positions of the nodes, shape (nodes, 3) [m]; None if there is no wire.
    """

    low: Array
    high: Array
    inputs: Array
    tubes: tuple[Array, ...] = ()
    wire: Array | None = None


def draw(actuator: Actuator, scene: Scene, found: Extremes | None) -> Figure:
    """Draw an actuator's field and what it can do.

    Parameters
    ----------
    actuator
        Coils, or a magnet.
    scene
        Where, and what else is there.
    found
        The set of fields in the middle of the volume; None for a magnet, whose strength over the
        distance is shown in its place.

    Returns
    -------
    Figure
        Two columns wide (180 mm).
    """
    with mpl.rc_context(style.RC):
        figure = Figure(figsize=(style.WIDTH * style.MM, HEIGHT * style.MM), layout="constrained")
        FigureCanvasAgg(figure)
        parts: Any = figure.subfigures(1, 2, width_ratios=(1.15, 1.0))
        left, right = parts
        _draw_field(left, actuator, scene)
        if found is not None:
            _draw_set(right, found)
        elif isinstance(actuator, Magnet):
            _draw_reach(right.subplots(), actuator)
    return figure


def _draw_field(panel: Any, actuator: Actuator, scene: Scene) -> None:
    """Strength and direction in the plane of the volume's two longest sides, through its middle."""
    size = scene.high - scene.low
    a, b = sorted(sorted(range(3), key=lambda k: (size[k], -k))[1:])
    x, y = (np.linspace(scene.low[k], scene.high[k], GRID) for k in (a, b))
    points = np.tile(0.5 * (scene.low + scene.high), (GRID * GRID, 1))
    points[:, a], points[:, b] = (part.ravel() for part in np.meshgrid(x, y))
    flux = 1e3 * actuator.at(points, scene.inputs)[0].reshape(GRID, GRID, 3)
    strength = np.linalg.norm(flux, axis=2)
    ax = panel.subplots()
    most = 1.2 * float(np.nanquantile(strength, 0.99)) or 1.0  # white is lost on the palest end
    mesh = ax.pcolormesh(
        1e3 * x, 1e3 * y, strength, cmap="viridis", vmin=0.0, vmax=most, shading="gouraud"
    )
    if np.nanmax(strength) > 0.0:
        some = slice(4, None, 9)
        u, v = flux[some, some, a], flux[some, some, b]
        norm = np.hypot(u, v)
        norm[norm == 0.0] = 1.0
        ax.quiver(
            *(1e3 * x[some], 1e3 * y[some], u / norm, v / norm),
            color="white",
            alpha=0.75,
            scale=22.0,
            width=0.004,
            pivot="mid",
        )
    for tube in scene.tubes:
        _draw_tube(ax, 1e3 * tube, a, b)
    if scene.wire is not None:
        ax.plot(1e3 * scene.wire[:, a], 1e3 * scene.wire[:, b], color="white", linewidth=2.6)
        ax.plot(1e3 * scene.wire[:, a], 1e3 * scene.wire[:, b], color=style.FORCE, linewidth=1.6)
    ax.set_xlim(1e3 * x[0], 1e3 * x[-1])
    ax.set_ylim(1e3 * y[0], 1e3 * y[-1])
    ax.set_aspect("equal")
    ax.grid(visible=False)
    ax.set_xlabel(f"{'xyz'[a]} [mm]")
    ax.set_ylabel(f"{'xyz'[b]} [mm]")
    ax.set_title(_setting(actuator, scene.inputs), loc="left", fontsize=6.5)
    bar = panel.colorbar(mesh, ax=ax, shrink=0.8, aspect=26, pad=0.02)
    bar.outline.set_visible(False)
    bar.set_label("flux density [mT]")


def _draw_tube(ax: Any, tube: Array, a: int, b: int) -> None:
    """The outline of a branch in a plane."""
    line = tube[:, [a, b]]
    along = np.gradient(line, axis=0)
    size = np.linalg.norm(along, axis=1, keepdims=True)
    size[size == 0.0] = 1.0
    across = np.stack([-along[:, 1], along[:, 0]], axis=1) / size * tube[:, 3:]
    for side in (1.0, -1.0):
        ax.plot(*(line + side * across).T, color="white", linewidth=0.9, alpha=0.9)


def _setting(actuator: Actuator, inputs: Array) -> str:
    """The inputs in words, the largest first; of a magnet where it is in the vessel's axes."""
    named = list(zip(actuator.inputs, inputs, strict=True))
    if isinstance(actuator, Magnet):
        aim = actuator.pose.direction(inputs[3:] / np.linalg.norm(inputs[3:]))
        place = _numbers(1e3 * actuator.pose.placed(inputs[:3]), 1)
        return f"magnet at {place} mm, along {_numbers(aim, 2)}"
    shown = sorted(named, key=lambda one: -abs(one[1]))[:4]
    return ", ".join(f"{style.plain(one.name)} {value:.3g} {one.unit}" for one, value in shown)


def _numbers(values: Array, digits: int) -> str:
    """Numbers with so many digits after the point, without a minus before zero."""
    return ", ".join(f"{value:g}" for value in np.round(values, digits) + 0.0)


def _draw_set(panel: Any, found: Extremes) -> None:
    """The largest field in each direction, on the sphere of directions."""
    ax = panel.add_subplot(projection="hammer")
    longitude = np.arctan2(found.directions[:, 1], found.directions[:, 0])
    latitude = np.arcsin(np.clip(found.directions[:, 2], -1.0, 1.0))
    flux = 1e3 * found.flux_density
    shown = np.where(np.isfinite(flux), flux, np.nan)
    dots = ax.scatter(longitude, latitude, c=shown, cmap="viridis", s=22, linewidths=0)
    for which, mark in ((int(np.argmin(flux)), "v"), (int(np.argmax(flux)), "^")):
        ax.plot(
            longitude[which], latitude[which], mark, color=style.FORCE, markersize=7, mec="white"
        )
    ax.set_xticks(np.radians([-90, 0, 90]), ["-y", "+x", "+y"])
    ax.set_yticks(np.radians([-60, 0, 60]), ["", "", ""])
    ax.set_axisbelow(False)  # names of directions stand on the dots
    for label in ax.get_xticklabels():
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0})
    ax.set_title(
        "largest field by its direction, +z on top\n"
        f"worst {1e3 * found.worst:.3g} mT (▼), median {1e3 * found.median:.3g} mT, "
        f"best {1e3 * found.best:.3g} mT (▲)",
        loc="center",
        fontsize=7.5,
    )
    bar = panel.colorbar(dots, ax=ax, orientation="horizontal", shrink=0.7, aspect=30, pad=0.06)
    bar.outline.set_visible(False)
    bar.set_label("flux density [mT]")


def _draw_reach(ax: Any, magnet: Magnet) -> None:
    """The strength of a magnet over the distance from its surface, along and across its axis."""
    half = magnet.radius if magnet.length is None else 0.5 * magnet.length
    here = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    pose = magnet.pose
    for start, unit, name, colour in (
        (half, (0.0, 0.0, 1.0), "along its axis", style.COMPONENTS[0]),
        (magnet.radius, (1.0, 0.0, 0.0), "across it", style.COMPONENTS[1]),
    ):
        points = (start + FAR)[:, None] * np.array(unit) @ pose.matrix.T + pose.shift
        flux = np.linalg.norm(magnet.at(points, here)[0], axis=1)
        ax.plot(1e3 * FAR, 1e3 * flux, color=colour, label=name)
    if magnet.keep_out > 0.0:
        ax.axvspan(0.0, 1e3 * magnet.keep_out, color=style.LUMEN_FILL, zorder=0)
        ax.text(
            500.0 * magnet.keep_out, 0.02, "kept out", transform=ax.get_xaxis_transform(),
            ha="center", va="bottom", color=style.MUTED, fontstyle="italic",
        )  # fmt: skip
    ax.set_yscale("log")
    ax.set_xlim(0.0, 1e3 * FAR[-1])
    ax.set_xlabel("distance from its surface [mm]")
    ax.set_ylabel("flux density [mT]")
    ax.legend(loc="upper right")

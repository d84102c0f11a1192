"""A moving picture of a run: the wire in its lumen; forces on tip and wire grow beside it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from magwire.contact.motion import recorded
from magwire.errors import InputError, MagwireError, positive, whole
from magwire.files import parse_toml, successor
from magwire.plot import curves, shapes, style
from magwire.units import parse

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Frame = NDArray[np.uint8]

ARROW = 0.2
"""Length of the arrow of the largest field, over the largest extent of the lumen."""
WIRE, TIP = "#4c6272", "#111111"


class Panel(NamedTuple):
    """A force that grows beside the wire: variable, title, what to say if it is none, its place."""

    variable: str
    title: str
    none: str
    bottom: float


PANELS = (
    Panel("tip_force", r"force on the tip  $\mathcal{F}$", "the tip never touches", 0.57),
    Panel("wall_force", "force on the wire, in all", "nothing touches the wall", 0.13),
)


class MovieError(MagwireError):
    """A moving picture that cannot be made."""


def animate(
    data: xr.Dataset,
    path: str | Path,
    *,
    passive: xr.Dataset | None = None,
    width: int = 960,
    seconds: float = 12.0,
    rate: int = 25,
    watch: Callable[[int, int], None] = lambda frame, frames: None,
) -> Path:
    """Write a moving picture of a run.

    Parameters
    ----------
    data
        A result file's variables and attributes.
    path
        File to write, GIF or MP4 by its suffix; an existing one is overwritten. MP4 needs
        ``imageio-ffmpeg``.
    passive
        A run that nobody steered, whose forces are shown for comparison.
    width
        Width of the picture [pixels]; its height is 9/16 of it.
    seconds
        How long it takes [s].
    rate
        Frames per second.
    watch
        Called with the number of frames done and of all.

    Raises
    ------
    InputError
        If the run has no records, the suffix is another or a number is out of range.
    MovieError
        If MP4 is asked for and ``imageio-ffmpeg`` is missing.
    """
    path = Path(path)
    whole("animate", "width", width, minimum=160)
    whole("animate", "rate", rate, minimum=1)
    positive("animate", "seconds", seconds, "s")
    writers = {".gif": _write_gif, ".mp4": _write_mp4}
    if path.suffix.lower() not in writers:
        raise InputError(f"Input path of animate must end in .gif or .mp4; received '{path.name}'.")
    if data.sizes["time"] == 0:
        raise InputError("Input data of animate must hold at least one record; received 0.")
    frames = max(2, round(seconds * rate))
    chosen = np.linspace(0, data.sizes["time"] - 1, frames).round().astype(int)
    size = (width - width % 16, width * 9 // 16 - width * 9 // 16 % 16)  # as encoders like it

    def pictures() -> Iterator[Frame]:
        with mpl.rc_context(style.RC):
            scene = Scene(data, size, passive)
            for done, record in enumerate(chosen, start=1):
                yield scene.frame(int(record))
                watch(done, frames)

    with successor(path) as draft:
        writers[path.suffix.lower()](draft, pictures(), size, rate)
    return path


class Scene:
    """What stays from frame to frame, drawn once, and what moves over it."""

    def __init__(
        self, data: xr.Dataset, size: tuple[int, int], passive: xr.Dataset | None = None
    ) -> None:
        self.push = data["normalized_push"].values
        self.nodes = 1e3 * data["position"].values
        self.field, self.time = data["field"].values, data["time"].values
        self.feed = 1e3 * data["feed"].values
        self.peak = float(np.linalg.norm(self.field, axis=1).max())
        self.plane = shapes.plane(data)
        self.data = data if recorded(data) else None
        self.walls: list[Any] = []
        dpi = 200.0 * size[0] / 1280.0
        self.figure: Any = Figure(figsize=(size[0] / dpi, size[1] / dpi), dpi=dpi)
        self.canvas: Any = FigureCanvasAgg(self.figure)
        self._lumen(data)
        self.grown = [self._curve(panel, data, passive) for panel in PANELS]
        self.magnet = magnetised(data)
        self.lines = [
            self.ax.plot(*self._flat(self.nodes[0]), color=colour, linewidth=width, zorder=5)[0]
            for colour, width in ((WIRE, 1.8), (TIP, 3.0))
        ]
        self.arrow = FancyArrowPatch(  # in the plane of the picture, of 3D axes too
            (0, 0), (0, 0), color=style.CLEARANCE, linewidth=1.6, mutation_scale=9
        )
        self.arrow.set_figure(self.figure)
        self.arrow.set_transform(self.ax.transData)
        growing = [artist for _, *artists in self.grown for artist in artists]
        self.moving = [*self.lines, *growing, self.words]
        self.still = self._background()

    def _background(self) -> Any:
        """What stays, as pixels."""
        for artist in self.moving:
            artist.set_animated(True)
        self.canvas.draw()
        return self.canvas.copy_from_bbox(self.figure.bbox)

    def frame(self, record: int) -> Frame:
        """The picture of a record, shape (height, width, 3)."""
        if self.data is not None:  # the wall moves
            for artist in self.walls:
                artist.remove()
            time = float(self.time[record])
            self.walls = shapes.draw_lumen(self.ax, self.data, self.plane, time)
            self.still = self._background()
        self.canvas.restore_region(self.still)
        nodes = self.nodes[record]
        for line, part in zip(self.lines, (nodes, nodes[self.magnet]), strict=True):
            seen = part[np.all((part >= self.low) & (part <= self.high), axis=1)]
            if self.plane is None:
                line.set_data_3d(*seen.T)
            else:
                line.set_data(*seen[:, list(self.plane)].T)
        self._point(record)
        for force, line, dot in self.grown:
            line.set_data(self.push[: record + 1], force[: record + 1])
            dot.set_data([self.push[record]], [force[record]])
        strength = 1e3 * float(np.linalg.norm(self.field[record]))
        self.words.set_text(
            f"t = {self.time[record]:5.1f} s     inserted {self.feed[record]:5.1f} mm     "
            f"field {strength:5.1f} mT"
        )
        for artist in (*self.moving, self.arrow):
            artist.draw(self.canvas.get_renderer())
        return np.asarray(self.canvas.buffer_rgba())[..., :3].copy()

    def _point(self, record: int) -> None:
        """Turn the arrow at the tip into the direction of the field."""
        tip, field = self.nodes[record, -1], self.field[record]
        self.arrow.set_visible(self.peak > 0.0 and bool(np.linalg.norm(field) > 0.02 * self.peak))
        if not self.arrow.get_visible():
            return
        reach = ARROW * float((self.high - self.low).max())
        ends = np.stack([tip, tip + reach * field / self.peak])
        if self.plane is None:
            from mpl_toolkits.mplot3d import proj3d

            x, y, _ = proj3d.proj_transform(*ends.T, self.ax.get_proj())
        else:
            x, y = ends[:, list(self.plane)].T
        self.arrow.set_positions((x[0], y[0]), (x[1], y[1]))

    def _flat(self, nodes: Array) -> Array:
        """Columns of the nodes that the axes take."""
        return nodes.T if self.plane is None else nodes[:, list(self.plane)].T

    def _lumen(self, data: xr.Dataset) -> None:
        place = (0.08, 0.11, 0.47, 0.78)
        if self.plane is None:
            self.ax: Any = self.figure.add_axes(
                (0.0, 0.03, 0.58, 0.9), projection="3d", computed_zorder=False
            )
            shapes.draw_spatial(self.ax, data, wires=False)
        else:
            self.ax = self.figure.add_axes(place)
            shapes.draw_planar(self.ax, data, self.plane, wires=False)
        if self.data is not None:  # what moves is drawn anew for every picture
            for artist in [*self.ax.lines, *self.ax.patches, *self.ax.collections]:
                artist.remove()
        self.low, self.high = shapes.window(data)
        title = style.plain(data.attrs.get("title", ""))
        self.figure.text(0.02, 0.955, title, fontsize=9.5, fontweight="bold", va="center")
        self.words = self.figure.text(0.98, 0.955, "", ha="right", va="center")

    def _curve(
        self, panel: Panel, data: xr.Dataset, passive: xr.Dataset | None
    ) -> tuple[Array, Any, Any]:
        """Axes for a force; its values over EI/L^2, and the line and the dot that grow."""
        scale = float(data.attrs["force_scale"])
        force = data[panel.variable].values / scale
        runs = [force] if passive is None else [force, passive[panel.variable].values / scale]
        top = max(float(np.nanmax(values, initial=0.0)) for values in runs)
        ax = self.figure.add_axes((0.66, panel.bottom, 0.26, 0.29))
        if passive is not None:
            push = passive["normalized_push"].values
            ax.plot(push, runs[1], color=style.PASSIVE, label="not steered")
        ax.set_xlim(0.0, float(self.push.max()) or 1.0)
        ax.set_ylim(0.0, (1.25 if passive is None else 1.5) * top or 1.0)
        ax.yaxis.set_major_locator(MaxNLocator(nbins=4, steps=[1, 2, 5, 10]))
        ax.set_title(panel.title, loc="left")
        curves.second_axis(ax, 1e3 * scale, "[mN]")
        ax.plot(self.push, force, color=style.GRID, linewidth=1.0, zorder=1)
        (line,) = ax.plot([], [], color=style.FORCE, clip_on=False, label="this run")
        (dot,) = ax.plot([], [], "o", color=style.FORCE, markersize=4, clip_on=False)
        if passive is not None:
            ax.legend(loc="upper left", ncols=2, handlelength=1.0, columnspacing=1.0)
        elif top == 0.0:
            curves.note(ax, panel.none)
        if panel is PANELS[-1]:
            ax.set_xlabel(curves.PUSH_LABEL)
        return force, line, dot


def magnetised(data: xr.Dataset) -> NDArray[np.bool_]:
    """Which nodes lie in the magnetised part of the wire, from the scenario; shape (nodes,).

    A run that was set up in Python has no scenario: none are known then.
    """
    nodes = data.sizes["node"]
    s = np.linspace(0.0, float(data.attrs["length_scale"]), nodes)
    found = np.zeros(nodes, dtype=bool)
    wire = parse_toml(str(data.attrs.get("scenario", ""))).get("wire", {})
    if "sections" not in wire:
        part = parse(wire["magnetized_tip"], "length", "magnetized_tip") if wire else 0.0
        return np.asarray(s >= s[-1] - part - 1e-9) if part > 0.0 else found
    end = 0.0
    for section in wire["sections"]:
        begin, end = end, end + parse(section["length"], "length", "length")
        given = section.get("magnetization", "0 A/m")
        values = given if isinstance(given, list) else [given]
        if any(parse(value, "magnetization", "magnetization") != 0.0 for value in values):
            found |= (s >= begin - 1e-9) & (s <= end + 1e-9)
    return found


def _write_gif(path: Path, frames: Iterator[Frame], size: tuple[int, int], rate: int) -> None:
    from PIL import Image

    images = (Image.fromarray(frame) for frame in frames)
    # One palette for all frames: what stands still then costs next to nothing.
    first = next(images)
    rest = list(images)
    sample = Image.new("RGB", (size[0], 2 * size[1]))
    sample.paste(rest[len(rest) // 2], (0, 0))
    sure = ("#ffffff", WIRE, TIP, style.CLEARANCE, style.FORCE)  # however thin they are
    part = size[1] // len(sure)
    for k, colour in enumerate(sure):
        sample.paste(Image.new("RGB", (size[0], part), colour), (0, size[1] + k * part))
    palette = sample.quantize(64, dither=Image.Dither.NONE)
    flat = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in (first, *rest)]
    duration = [round(1000 / rate)] * (len(flat) - 1) + [1500]
    flat[0].save(
        path, save_all=True, append_images=flat[1:], duration=duration, loop=0, optimize=False
    )


def _write_mp4(path: Path, frames: Iterator[Frame], size: tuple[int, int], rate: int) -> None:
    try:
        import imageio_ffmpeg
    except ModuleNotFoundError:
        raise MovieError(
            "MP4 needs the package imageio-ffmpeg, which is not installed; "
            "install it with 'pip install magwire[movie]', or ask for a .gif."
        ) from None
    first = next(frames)
    writer = imageio_ffmpeg.write_frames(
        str(path), size, fps=rate, codec="libx264", quality=7, macro_block_size=16
    )
    writer.send(None)
    try:
        for frame in chain([first], frames):
            writer.send(np.ascontiguousarray(frame))
    finally:
        writer.close()

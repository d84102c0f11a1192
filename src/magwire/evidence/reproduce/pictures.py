"""The pictures of the page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from magwire.evidence.reproduce.active_claims import NAMES
from magwire.evidence.reproduce.outcome import Outcome
from magwire.files import successor
from magwire.plot import curves, shapes, style

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from magwire.evidence.reproduce.runs import Run

Array = NDArray[np.float64]
DPI = 150
COLOURS = {"paper": style.TIP, "newton": style.CLEARANCE, "stable": style.FORCE}
MARKERS = {"half-circle": "o", "sinusoid": "s", "helix": "^"}
FORCE_LABEL = r"tip force  $\mathcal{F}$"


def canvas(height: float) -> Figure:
    """An empty figure of the page's width and a height [mm]."""
    figure = Figure(figsize=(style.WIDTH * style.MM, height * style.MM), layout="constrained")
    FigureCanvasAgg(figure)
    engine: Any = figure.get_layout_engine()
    engine.set(w_pad=0.03, h_pad=0.03, wspace=0.03, hspace=0.03)
    return figure


def save(figure: Figure, file: Path) -> None:
    """Write a figure as PNG."""
    with successor(file) as draft:
        figure.savefig(draft, dpi=DPI)


def passive(runs: Mapping[str, xr.Dataset], file: Path) -> None:
    """Shapes in each of the lumens, and below them the force on the tip in all."""
    with mpl.rc_context(style.RC):
        wide = len(runs) == 1
        figure = canvas(128.0 if wide else 150.0)
        grid = figure.add_gridspec(2, len(runs), height_ratios=(1.3, 1.0) if wide else (1.9, 1.0))
        panels = []
        for k, (name, data) in enumerate(runs.items()):
            panels.append(draw_shape(figure, grid[0, k], data, name))
        force = figure.add_subplot(grid[1, :])
        tints = style.COMPONENTS if len(runs) > 1 else (style.PASSIVE,)
        for (name, data), colour in zip(runs.items(), tints, strict=False):
            push, values = data["normalized_push"].values, data["normalized_tip_force"].values
            force.plot(
                push, values, color=colour, label=f"{name}, peak {values.max(initial=0.0):.1f}"
            )
        _force_axes(force, next(iter(runs.values())))
        force.legend(loc="upper left", ncols=len(runs))
        push_bar(figure, panels, next(iter(runs.values())))
        save(figure, file)


def active(
    passive_run: xr.Dataset, steered: Mapping[str, xr.Dataset], file: Path, shown: str = "stable"
) -> None:
    """A lumen without and with a field: shapes, tip force, and the fields of all navigators."""
    with mpl.rc_context(style.RC):
        top_height = 0.5 * style.WIDTH / max(shapes.aspect(passive_run), 1.0) + 24.0
        heights = (min(top_height, 105.0), 50.0, 62.0)
        figure = canvas(sum(heights))
        rows: Any = figure.subfigures(3, 1, height_ratios=heights)
        top, until = rows[0], float(passive_run["normalized_push"].values.max(initial=0.0))
        grid = top.add_gridspec(1, 2)
        panels = [
            draw_shape(top, grid[0, 0], passive_run, "without field"),
            draw_shape(top, grid[0, 1], steered[shown], f"with field, {NAMES[shown]}", until),
        ]
        push_bar(top, panels, passive_run)
        force = rows[1].subplots()
        draw_forces(force, passive_run, steered)
        fields = rows[2].subplots(1, len(steered), squeeze=False)
        for ax, (name, data) in zip(fields[0], steered.items(), strict=True):
            draw_components(ax, data, NAMES[name])
        fields[0, 0].set_ylabel(r"field  $\mathcal{B}$")
        save(figure, file)


def branches(steered: Mapping[str, xr.Dataset], file: Path) -> None:
    """The wire in each of the branches, and the field that took it there."""
    with mpl.rc_context(style.RC):
        figure = canvas(112.0)
        halves: Any = figure.subfigures(2, 1, height_ratios=(1.0, 0.85))
        upper, lower = halves
        grid = upper.add_gridspec(1, len(steered))
        panels = [
            draw_shape(upper, grid[0, k], data, name)
            for k, (name, data) in enumerate(steered.items())
        ]
        push_bar(upper, panels, next(iter(steered.values())))
        axes = lower.subplots(1, len(steered), squeeze=False)
        for ax, (name, data) in zip(axes[0], steered.items(), strict=True):
            draw_components(ax, data, name)
        axes[0, 0].set_ylabel(r"field  $\mathcal{B}$")
        save(figure, file)


def draw_shape(
    figure: Any, place: Any, data: xr.Dataset, title: str, until: float | None = None
) -> Any:
    """The wire in its lumen at several feeds; colours run up to the push ``until``."""
    pair = shapes.plane(data)
    if pair is None:
        ax = figure.add_subplot(place, projection="3d", computed_zorder=False)
        shapes.draw_spatial(ax, data, until=until)
        low, high = shapes.window(data)  # wide things may be larger, tall ones lose their labels
        ax.set_box_aspect(high - low, zoom=1.1 if len(shapes.branches(data)) > 1 else 0.88)
    else:
        ax = figure.add_subplot(place)
        shapes.draw_planar(ax, data, pair, until=until)
    ended = str(data.attrs["status"])
    if ended != "complete":
        title += f"; {ended} from X = {data['normalized_push'].values[-1]:.3f} on"
    if pair is None:  # above 3D axes there is no room
        ax.text2D(0.02, 0.97, title, transform=ax.transAxes, fontsize=8.0)
    else:
        ax.set_title(title, loc="left")
    return ax


def push_bar(figure: Any, panels: Sequence[Any], data: xr.Dataset) -> None:
    """The key to the colours of the wires."""
    push = data["normalized_push"].values
    colours = ScalarMappable(Normalize(0.0, float(push.max(initial=0.0)) or 1.0), style.PUSH)
    bar = figure.colorbar(
        colours, ax=list(panels), orientation="horizontal", shrink=0.4, aspect=45, pad=0.02
    )
    bar.outline.set_visible(False)
    bar.set_ticks([round(float(push[k]), 2) for k in shapes.snapshots(data)])
    bar.ax.tick_params(length=0.0)
    bar.set_label(curves.PUSH_LABEL)


def draw_forces(ax: Axes, passive_run: xr.Dataset, steered: Mapping[str, xr.Dataset]) -> None:
    """Tip force without and with a field; a cross where a navigator stopped."""
    push, force = passive_run["normalized_push"].values, passive_run["normalized_tip_force"].values
    ax.fill_between(push, force, color=style.PASSIVE, alpha=0.15, linewidth=0.0)
    ax.plot(push, force, color=style.PASSIVE, label="without field")
    for k, (name, data) in enumerate(steered.items()):
        push, force = data["normalized_push"].values, data["normalized_tip_force"].values
        ax.plot(
            push, force, color=COLOURS[name], label=f"with field, {NAMES[name]}",
            zorder=4 - 0.1 * k, linestyle=(0, (4, 2 * k)) if k else "-", clip_on=False,
        )  # fmt: skip
        if str(data.attrs["status"]) != "complete" and push.size:
            ax.plot(
                push[-1], force[-1], "x", color=COLOURS[name], markersize=6, mew=1.6, zorder=5,
                clip_on=False, label=f"{NAMES[name]} stops",
            )  # fmt: skip
    _force_axes(ax, passive_run)
    ax.legend(loc="upper left", ncols=3)


def draw_components(ax: Axes, data: xr.Dataset, title: str) -> None:
    """Components and size of the normalised field."""
    push, field = data["normalized_push"].values, data["normalized_field"].values
    size = np.linalg.norm(field, axis=1)
    ax.plot(push, size, color=style.MUTED, linewidth=0.9, label=r"$|\mathcal{B}|$")
    for k, (name, colour) in enumerate(zip("xyz", style.COMPONENTS, strict=True)):
        label = rf"$\mathcal{{B}}_{name}$"
        ax.plot(push, field[:, k], color=colour, label=label, zorder=3 - 0.1 * k)
    ax.axhline(0.0, color=style.MUTED, linewidth=0.5, zorder=1)
    low, high = min(float(field.min(initial=0.0)), 0.0), max(float(size.max(initial=0.0)), 1.0)
    ax.set_ylim(low - 0.05 * (high - low), high + 0.28 * (high - low))
    ax.set_xlim(0.0, None)
    ax.set_title(f"{title}, peak {size.max(initial=0.0):.0f}", loc="left", fontsize=7.0)
    ax.set_xlabel(curves.PUSH_LABEL)
    ax.legend(loc="upper left", ncols=4, columnspacing=0.8, handlelength=1.0)


def speed(
    steps: Mapping[tuple[str, float], Outcome],
    updates: Mapping[tuple[str, str, float], Run],
    plans: Mapping[tuple[str, str, float], Run],
    file: Path,
) -> None:
    """Relative compute time against the time step, and against the update step.

    Parameters
    ----------
    steps
        Passive runs by lumen and time step [s].
    updates
        Steered runs by lumen, navigator and update step.
    plans
        The same in quasi-static motion.
    file
        Where to.
    """
    with mpl.rc_context(style.RC):
        figure = canvas(95.0)
        left, middle, right = axes = figure.subplots(1, 3, sharey=True)
        _time_steps(left, steps)
        _update_steps(middle, updates, "steered, dt = 10 ms")
        _update_steps(right, plans, "steered, quasi-static")
        for ax, known in zip(axes, (0.003, 0.005, 0.005), strict=True):
            ax.set(xscale="log", yscale="log")
            ax.axhline(1.0, color=style.INK, linewidth=0.8)
            ax.plot(known, 1.0, "*", color=style.INK, markersize=7.0, clip_on=False)
            ax.annotate(
                "the paper", (known, 1.0), xytext=(4, 5), textcoords="offset points", fontsize=6.5
            )
        left.set(ylabel="computing time / simulated time", ylim=(3e-5, 3.0))
        _speed_keys(middle, right)
        save(figure, file)


def _time_steps(ax: Axes, steps: Mapping[tuple[str, float], Outcome]) -> None:
    colours = (*style.COMPONENTS, style.TIP, style.MUTED)
    for k, name in enumerate(dict.fromkeys(lumen for lumen, _ in steps)):
        line = sorted((dt, run.pace) for (lumen, dt), run in steps.items() if lumen == name)
        ax.plot(
            *zip(*line, strict=True), marker="osD^v"[k % 5], color=colours[k % 5], markersize=3.5,
            label=name,
        )  # fmt: skip
    ax.set_xlabel(r"time step  $dt$  [s]")
    ax.set_title("passive pushing", loc="left")
    ax.legend(loc="lower left")


def _update_steps(ax: Axes, updates: Mapping[tuple[str, str, float], Run], title: str) -> None:
    for name, method in dict.fromkeys((n, m) for n, m, _ in updates):
        colour = COLOURS[method]
        made = {s: r for (n, m, s), r in updates.items() if (n, m) == (name, method)}
        push = sorted(made)
        ax.plot(push, [made[s].outcome.pace for s in push], color=colour, linewidth=1.1)
        ax.plot(push, [made[s].steering_pace for s in push], color=colour, linewidth=0.7, ls="--")
        for step, run in made.items():
            face, pace = colour if run.outcome.contact_free else "white", run.outcome.pace
            ax.plot(step, pace, MARKERS[name], mfc=face, mec=colour, markersize=4.2, zorder=4)
    ax.set_xlabel(r"update step  $\delta\mathcal{X}$")
    ax.set_title(title, loc="left")


def _speed_keys(left: Axes, right: Axes) -> None:
    """Who steers, and where."""
    from matplotlib.lines import Line2D

    keys = [Line2D([], [], color=COLOURS[name], label=text) for name, text in NAMES.items()]
    keys.append(Line2D([], [], color=style.MUTED, ls="--", lw=0.7, label="navigator alone"))
    left.legend(handles=keys, loc="lower left")
    marks = [
        Line2D([], [], color=style.MUTED, ls="", marker=mark, markersize=4.2, label=name)
        for name, mark in MARKERS.items()
    ]
    marks.append(
        Line2D([], [], ls="", marker="o", mfc="white", mec=style.MUTED, label="touches or stops")
    )
    right.legend(handles=marks, loc="lower left")


def _force_axes(ax: Axes, data: xr.Dataset) -> None:
    top = max((float(line.get_ydata().max(initial=0.0)) for line in ax.lines), default=0.0)  # type: ignore[union-attr]
    ax.set_ylim(0.0, 1.35 * top or 1.0)
    ax.set_xlim(0.0, float(data["normalized_push"].values.max(initial=0.0)) or 1.0)
    ax.set_xlabel(curves.PUSH_LABEL)
    ax.set_ylabel(FORCE_LABEL)
    curves.second_axis(ax, 1e3 * float(data.attrs["force_scale"]), "[mN]")

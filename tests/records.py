"""Made-up records of a run, for tests of what happens to records: no engine is asked."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from magwire.contact import WallMotion
from magwire.engine.record import Record, RunInfo, Scales, row_type

SCALES = Scales(length=0.1, force=3.054e-5, flux_density=2.109e-4)


BREATHING = (
    WallMotion((0.0, 1e-3, 4e-3), period=7.0, ramp=30e-3),
    WallMotion((0.5e-3, 0.0, 0.0), period=2.3, ramp=10e-3),
)


def half_circle(points: int = 60) -> np.ndarray:
    """Centreline of the paper's half-circle, shape (points, 3) [m]."""
    w = np.linspace(0.0, np.pi, points)
    return 0.025 * np.column_stack([np.sin(w), 1.0 - np.cos(w), 0.0 * w])


def helix(points: int = 120) -> np.ndarray:
    """Centreline of the paper's helix, shape (points, 3) [m]."""
    rise = 0.01 / (2.0 * np.pi)
    w = np.linspace(0.0, 0.09 / np.hypot(0.01, rise), points)
    return np.column_stack([0.01 * np.sin(w), 0.01 * (1.0 - np.cos(w)), rise * w])


def info(
    centreline: np.ndarray | None = None,
    nodes: int = 20,
    *,
    title: str = "",
    scenario: str = "",
    wall_motion: tuple[WallMotion, ...] = (),
) -> RunInfo:
    """A run in a lumen of radius 3 mm; in open space if the centreline has no points."""
    line = half_circle() if centreline is None else centreline
    return RunInfo(
        nodes=nodes,
        scales=SCALES,
        centreline=line,
        lumen_radius=np.full(len(line), 3e-3),
        lumen_branch=np.zeros(len(line), dtype=np.int64),
        magnet=(0.095, 0.1),
        way=np.column_stack([line, np.full(len(line), 3e-3)]),
        title=title,
        scenario=scenario,
        wall_motion=wall_motion,
    )


def made(run: RunInfo, **values: ArrayLike) -> Record:
    """A record of these numbers; those that are left out are zero."""
    kind = row_type(run.nodes, len(run.inputs), run.absent)
    row = np.zeros(kind.itemsize // 8)
    row.view(kind)["tip_departure"] = np.nan
    for name, value in values.items():
        if name in run.absent:
            continue
        row.view(kind)[name][0] = value
    return Record(row, kind)


def records(run: RunInfo, count: int = 73, *, step: float = 1e-3) -> Iterator[Record]:
    """A wire that slides along the centreline and touches the wall from a feed of 12 mm on."""
    line = run.centreline if len(run.centreline) else half_circle()
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    along = (line[1] - line[0]) / np.linalg.norm(line[1] - line[0])
    largest, total, first = 0.0, 0.0, np.nan
    for k in range(count):
        feed = k * step
        s = feed + np.linspace(-run.scales.length, 0.0, run.nodes)
        position = np.column_stack([np.interp(s, arc, line[:, i]) for i in range(3)])
        position[s < 0] = s[s < 0, None] * along
        clearance = np.where(s < 0, np.nan, 3e-3 - 2.99e-3 * np.clip(s / 0.012, 0.0, 1.0))
        force = run.scales.force * 19.0 * (1.0 - np.exp(-max(feed - 0.012, 0.0) / 0.004))
        wall = np.zeros((run.nodes, 3))
        wall[-1, 1] = force
        largest, total = max(largest, force), total + force
        if force > 0.0 and np.isnan(first):
            first = feed
        yield made(
            run,
            time=feed / 1e-3,
            feed=feed,
            position=position,
            flux_density=np.array([0.0, 0.01 * np.sin(80.0 * feed), 0.05 * feed]),
            inputs=np.array([0.0, 0.01 * np.sin(80.0 * feed), 0.05 * feed]),
            contact_force=wall,
            clearance=clearance,
            clearance_midpoint=float(np.nanmin(clearance)),
            clearance_along=float(np.nanmin(clearance)),
            tip_force=force,
            tip_offset=min(3e-3, feed / 4),
            friction_force=-0.1 * wall[:, ::-1],
            slip=np.full(run.nodes, max(feed - 0.012, 0.0)),
            friction_work=1e-3 * force * feed,
            wall_indentation=np.zeros(run.nodes),
            wall_displacement=np.zeros((run.nodes, 3)),
            wall_work=0.0,
            guide_twist=0.1 * k,
            tip_twist=0.08 * k,
            material_director=np.tile([0.0, 0.0, 1.0], (run.nodes, 1)),
            push_force=1.5 * force,
            guide_torque=-1e-3 * force,
            newton_iterations=2.3,
            stable=True,
            max_tip_force=largest,
            mean_tip_force=total / (k + 1),
            first_contact_feed=first,
            smallest_clearance=float(np.nanmin(clearance)),
            steps=100 * k,
            newton_iterations_total=230 * k,
            factorisations=240 * k,
            wall_time=0.01 * k,
        )

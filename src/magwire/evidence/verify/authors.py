"""Group 7: forces, shapes and fields that the paper's authors published, in an earlier geometry.

Their forces and shapes without a field depend on the geometry alone (P-18), so that the wire
may be the paper's. X is the push past the tube's entrance, which has a straight entry before it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.engine.system import System
from magwire.evidence.published import curve
from magwire.evidence.verify.evidence import NODES, Curve, Line
from magwire.evidence.verify.references import hard_contact
from magwire.field import UniformField
from magwire.lumen import Lumen
from magwire.navigate.navigator import Observation
from magwire.navigate.newton import NewtonNavigator
from magwire.operate import March
from magwire.wire import Wire

Array = NDArray[np.float64]
GROUP = "authors"
L, ENTRY = 0.1, 0.15
SOURCE = "Tong and others, drawings of an earlier version, read to 0.3 of F L²/EI and 1e-4 L"
LUMENS = {
    "half-circle": lambda: Lumen.half_circle(0.2 * L, 0.01 * L),
    "narrow bend": lambda: Lumen.half_circle(0.1 * L, 0.01 * L),
    "sinusoid": lambda: Lumen.sinusoid(0.1 * L, 0.2 * np.pi * L, 0.8 * L, 0.01 * L),
}


def evidence(full: bool) -> Iterator[Line | Curve]:
    """Lines and curves of the group; nothing is left out of the fast set but the narrow bend."""
    pushes = {"half-circle": 0.725, "sinusoid": 0.725, **({"narrow bend": 0.5} if full else {})}
    runs = {name: _Run.of(name, push) for name, push in pushes.items()}
    yield from _forces(runs["half-circle"], "half-circle", "control_halfcircle_force")
    yield from _forces(runs["sinusoid"], "sinusoid", "control_sinusoid_force")
    yield from _plateau(runs["half-circle"])
    yield from _peaks(runs["sinusoid"])
    yield from _shapes(runs["half-circle"], "half-circle", "planar_case3")
    if full:
        yield from _shapes(runs["narrow bend"], "narrow bend", "planar_case1")
        yield from _against_hard_walls(runs["half-circle"])
    yield from _field()


@dataclass(frozen=True)
class _Run:
    """A quasi-static push without a field: push X, tip force in EI/L^2, nodes in L."""

    push: Array
    force: Array
    shapes: Array

    @classmethod
    def of(cls, name: str, push: float) -> _Run:
        course = Feed(0.01 * L, (ENTRY + push) * L)
        march = March(_system(name, 5e-3), UniformField(), course, time_step=0.1, inertia=False)
        records = list(march.records(2))
        scale = march.plant.system.scales.force
        return cls(
            np.array([record.feed for record in records]) / L - ENTRY,
            np.array([record.tip_force for record in records]) / scale,
            np.array([record.position[:, :2] for record in records]) / L,
        )

    def at(self, push: Array) -> Array:
        """Force at pushes."""
        return np.interp(push, self.push, self.force)


def _system(name: str, magnet: float) -> System:
    wire = Wire.uniform(
        L, 0.6e-3, 3e6, 1e6, 2000.0, NODES, magnetized_tip=magnet, magnetization=128e3
    )
    return System(wire, LUMENS[name]().with_entry(ENTRY * L), Barrier(1e3, 1e-4, wall="centreline"))


def _forces(run: _Run, name: str, drawing: str) -> Iterator[Line | Curve]:
    push, theirs = curve(drawing, "blue_triangle").T
    ours = run.at(push)
    yield Line(
        GROUP, f"{name}, no field", f"largest difference of the tip force, {len(push)} points",
        "of the peak", 0.0, SOURCE, float(np.abs(ours - theirs).max() / theirs.max()), 0.1,
    )  # fmt: skip
    yield Curve(
        f"Tip force, {name}, no field",
        "push X [L]",
        "F L²/EI",
        {"authors": (push, theirs, "line"), "magwire": (push, ours, "points")},
    )


def _plateau(run: _Run) -> Iterator[Line]:
    mean = float(run.at(np.linspace(0.28, 0.42, 50)).mean())
    yield Line(
        GROUP, "half-circle, no field", "plateau of the tip force, X = 0.28 to 0.42", "EI/L²", 39.4,
        SOURCE, mean, 0.05, relative=True,
    )  # fmt: skip


def _against_hard_walls(run: _Run) -> Iterator[Line]:
    """Who is right on the plateau: the authors' curve lies 3.6 percent above hard contact."""
    links = 45
    hard = hard_contact.press(links, 1.0 / (NODES - 1), 0.2, 0.01, entry=ENTRY)
    push = links / (NODES - 1) - ENTRY
    yield Line(
        GROUP, f"half-circle, no field, X = {push:.3f}", "tip force", "EI/L²",
        float(np.hypot(*hard.wall_force[-1])),
        "least energy of a chain of rigid links between hard walls (SLSQP)",
        float(run.at(np.array([push]))[0]), 0.05, relative=True,
    )  # fmt: skip


def _peaks(run: _Run) -> Iterator[Line]:
    for name, low, high, expected in (("first", 0.10, 0.16, 33.5), ("second", 0.40, 0.48, 82.5)):
        value = float(run.at(np.linspace(low, high, 80)).max())
        yield Line(
            GROUP, "sinusoid, no field", f"{name} peak of the tip force", "EI/L²", expected, SOURCE,
            value, 0.1, relative=True,
        )  # fmt: skip
    pause = float(run.at(np.linspace(0.29, 0.33, 20)).max())
    yield Line(
        GROUP, "sinusoid, no field", "tip force between the peaks, X = 0.29 to 0.33", "EI/L²", 0.0,
        SOURCE, pause, 0.3,
    )  # fmt: skip


def _distance(points: Array, line: Array) -> Array:
    """Of points from a polyline."""
    start, along = line[:-1], np.diff(line, axis=0)
    part = np.sum((points[:, None] - start) * along, axis=2) / np.sum(along**2, axis=1)
    nearest = start + np.clip(part, 0.0, 1.0)[..., None] * along
    squares: Array = ((points[:, None] - nearest) ** 2).sum(axis=2).min(axis=1)
    return np.sqrt(squares)


def _shapes(run: _Run, name: str, drawing: str) -> Iterator[Line | Curve]:
    """The push is not printed: it follows from the length of the drawn curve past x = 0."""
    drawn_all, found_all = [], []
    for moment in ("t0", "t100", "t200", "t300"):
        drawn = curve(drawing, moment)[:, 1:]
        push = float(np.linalg.norm(np.diff(drawn, axis=0), axis=1).sum()) + drawn[0, 0]
        shape = run.shapes[np.abs(run.push - push).argmin()]
        yield Line(
            GROUP, f"{name}, X = {push:.2f}", "mean distance of the drawn wire", "L", 0.0, SOURCE,
            float(_distance(drawn, shape).mean()), 0.005,
        )  # fmt: skip
        drawn_all.append(drawn)
        found_all.append(shape[shape[:, 0] > -0.1][::3])
    gap = np.full((1, 2), np.nan)
    theirs = np.concatenate([part for drawn in drawn_all for part in (drawn, gap)])
    ours = np.concatenate(found_all)
    yield Curve(
        f"Shapes, {name}",
        "x [L]",
        "y [L]",
        {
            "authors": (theirs[:, 0], theirs[:, 1], "line"),
            "magwire": (ours[:, 0], ours[:, 1], "points"),
        },
        equal=True,
    )


def _field() -> Iterator[Line | Curve]:
    """The field that keeps the tip on the centreline, by its component across the centreline.

    The component along the tip is a matter of choice (P-22). Four magnetised edges fit their
    curves (P-4); they print the field with the opposite sign.
    """
    navigator = NewtonNavigator(_system("half-circle", 4.0 * L / (NODES - 1)))
    navigator.model.feed_to(ENTRY * L)
    seen = Observation(ENTRY * L, np.zeros(3), np.array([1.0, 0.0, 0.0]))
    course = navigator.plan(seen, (ENTRY + 0.36) * L)
    x, y = (curve("control_halfcircle_field", c) for c in ("green_square", "red_circle"))
    within = (x[:, 0] > 0.1) & (x[:, 0] < 0.35)
    push = x[within, 0]
    theirs = -np.stack((x[within, 1], y[within, 1]), axis=1)
    ours = course.at((ENTRY + push) * L)[:, :2] / navigator.model.system.scales.flux_density
    across = np.stack((-np.sin(push / 0.2), np.cos(push / 0.2)), axis=1)
    found, printed = (np.einsum("ij,ij->i", field, across) for field in (ours, theirs))
    worst = float(np.abs(found - printed).max() / np.abs(printed).max())
    yield Line(
        GROUP, "half-circle, tip on the centreline", f"field across, {len(push)} points",
        "of the peak", 0.0, SOURCE, worst, 0.05,
    )  # fmt: skip
    yield Curve(
        "Field across the centreline, half-circle",
        "push X [L]",
        "M B L²/EI",
        {"authors": (push, printed, "line"), "magwire": (push, found, "points")},
    )

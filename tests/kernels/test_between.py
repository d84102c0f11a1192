"""Contact between the nodes: derivatives, and that no point of an edge leaves the lumen (P-11)."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

import magwire as mw
from magwire.engine.system import System
from magwire.engine.wall import THIN, divide
from magwire.kernels.arrays import Motion, Mouth
from magwire.lumen import Lumen

from .rods import Array, Case, derivatives, difference_quotients, random_case, state_at, system

RADIUS, GAP = 0.05, 0.01


def worst(computed: Array, expected: Array) -> float:
    """Largest difference, relative to the largest entry."""
    return float(np.abs(computed - expected).max() / np.abs(expected).max())


def chords(lumen: Lumen) -> Case:
    """Long edges inside a bend; the wall is felt at their middles, not at the nodes."""
    where = system(lumen, gap=GAP)
    edge = where.wire.edge_length
    clearance = where.new_wall().between.margin + 0.5 * THIN * GAP
    rod = where.rod._replace(bend=np.full(len(where.rod.station), 1e-30))
    rod = rod._replace(stretch=0.0 * rod.stretch, twist=0.0 * rod.twist)
    count = len(rod.station)
    curve = lumen.branches[0].curve
    s = 0.1 * edge + edge * np.arange(count)
    centre, bent = curve.at(s)[:, :3], curve.at(s, 2)[:, :3]
    inward = bent / np.linalg.norm(bent, axis=1)[:, None]
    part = np.linspace(0.0, 1.0, 41)[None, :, None]
    q = np.zeros((count, 4))

    def nearest(off: float) -> float:
        q[:, :3] = centre + off * inward
        x, y = q[:-1, None, :3], q[1:, None, :3]
        return float(lumen.gap((x * (1.0 - part) + y * part).reshape(-1, 3)).min()) - clearance

    q[:, :3] = centre + brentq(nearest, 0.0, RADIUS) * inward
    state = state_at(where, q, np.random.default_rng(1).normal(size=(count - 1, 3)), 1)
    model = where.new_terms(random_case(0).model.field, rod=rod)
    return Case(where, model, state, Mouth(1, 1.0), Motion(0.0, np.zeros_like(q)))


@pytest.mark.parametrize("name", ["half-circle", "helix"])
def test_against_differences(name: str) -> None:
    bend = {
        "half-circle": lambda: Lumen.half_circle(0.5, RADIUS),
        "helix": lambda: Lumen.helix(0.4, 0.2, 2.5, RADIUS),
    }[name]()
    case = chords(bend)
    energy, gradient, hessian = derivatives(case)
    slope, raw = difference_quotients(case, 2e-8)
    assert energy > 0.0
    assert worst(gradient, slope) < 1e-6
    assert worst(raw, hessian) < 1e-4


def test_nodes_alone_where_no_chord_comes_nearer_than_they_do() -> None:
    where = system(Lumen.straight(1.0, RADIUS), gap=GAP)
    assert divide(where.firmness, 0.1, 0.0, 1.0, 10).parts == 1


def test_the_margin_is_what_chords_can_use_up() -> None:
    """A node that touches the wall, the next point a margin off it: the chord stays inside."""
    bulge, edge = 50.0, 0.01
    where = system(Lumen.half_circle(0.5, RADIUS), gap=1e-4)
    between = divide(where.firmness, edge, bulge, 1.0, 10)
    chord = edge / between.parts
    s = np.linspace(0.0, 1.0, 101)
    inside = s * between.margin - 0.5 * bulge * chord**2 * s * (1.0 - s)
    assert inside.min() >= -1e-18


def coarse(nodes: int) -> mw.Simulation:
    wire = mw.Wire.uniform(0.1, 0.3e-3, 60e9, 20e9, 6500.0, nodes)
    return mw.Simulation(wire, mw.Lumen.half_circle(0.02, 1.3e-3))


def test_no_point_of_a_coarse_wire_leaves_the_lumen() -> None:
    """Edges of 5 mm cut a bend of 20 mm radius by a sixth of the room that the wire has."""
    simulation = coarse(21)
    result = simulation.run(mw.Feed(5e-3, 0.055), time_step=0.01, record_every=1e-3)
    assert result.status == "complete"
    angles = 0.0
    for nodes in result.position:
        t = np.linspace(0.0, 1.0, 26)[None, :, None]
        points = (nodes[:-1, None] * (1.0 - t) + nodes[1:, None] * t).reshape(-1, 3)
        inside = points[:, 0] > 0.0
        radius = np.hypot(points[inside, 0], points[inside, 1] - 0.02)
        off = np.hypot(radius - 0.02, points[inside, 2])
        angles = max(angles, off.max(initial=0.0))
    assert angles < 1e-3
    assert 0.0 < result.smallest_clearance < 1e-5


def test_the_certificate_finds_the_nearest_point() -> None:
    """As a search in steps of a two-hundredth of an edge does, to what it passes over at most."""
    simulation = coarse(41)
    result = simulation.run(mw.Feed(5e-3, 0.055), time_step=0.01, record_every=5e-3)
    edge, lumen = simulation.system.wire.edge_length, simulation.system.lumen
    t = np.linspace(0.0, 1.0, 201)[None, :, None]
    passed_over = lumen.bulge(0.3e-3) * (edge / 24.0) ** 2 / 8.0
    for nodes, known, found in zip(
        result.position[1:],
        result.clearance[1:],
        result.dataset["clearance_along"].values[1:],
        strict=True,
    ):
        held = int(np.flatnonzero(np.isfinite(known))[0]) - 1
        x, y = nodes[held:-1, None], nodes[held + 1 :, None]
        points = (x * (1.0 - t) + y * t).reshape(-1, 3)
        least = float(lumen.gap(points).min()) - 0.3e-3
        assert least - passed_over <= found <= least + passed_over


def test_a_run_that_is_outside_is_not_complete(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the points between the nodes switched off, the certificate still tells."""
    monkeypatch.setattr(System, "bulge", 0.0)
    result = coarse(21).run(mw.Feed(5e-3, 0.055), time_step=0.01, record_every=1e-3)
    assert result.status == "not converged"
    assert "a point between two nodes is" in result.message
    assert result.message.endswith("use more nodes.")


def test_edges_that_cut_through_a_bend_are_refused() -> None:
    with pytest.raises(
        mw.InputError, match=r"^Input nodes of Wire must be at least \d+ for the lu"
    ):
        coarse(8)
    needed = 0
    try:
        coarse(8)
    except mw.InputError as error:
        needed = int(str(error).split("at least ")[1].split()[0])
    coarse(needed)
    with pytest.raises(mw.InputError):
        coarse(needed - 1)

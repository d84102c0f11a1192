"""The references of dynamics and contact: in their limits, and against each other."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.evidence.verify.mujoco_rod import _couples
from magwire.evidence.verify.references import chain, hard_contact, pendulum, tube, vibration
from tables import closed_form

Array = NDArray[np.float64]
TABLE = closed_form("vibration_aligned_field")


def one(s: Array) -> Array:
    return np.ones_like(s)


def none(s: Array) -> Array:
    return np.zeros_like(s)


@pytest.mark.parametrize("row", TABLE, ids=[f"b={row[0]:g}" for row in TABLE])
def test_table_of_frequencies(row: tuple[float, ...]) -> None:
    b, *expected = row
    np.testing.assert_allclose(vibration.frequencies(b, 3), expected, rtol=1e-8)


def test_frequency_vanishes_where_the_beam_buckles() -> None:
    squares = [vibration.frequencies(-(np.pi**2) / 4 + near, 1)[0] ** 2 for near in (1e-2, 1e-3)]
    assert squares[0] / squares[1] == pytest.approx(10.0, rel=1e-2)


@pytest.mark.parametrize("b", [-1.0, 0.0, 5.0])
def test_modes_add_up_to_the_deflection_at_rest(b: float) -> None:
    """w'''' - b w'' = 0 under a tip force: (tan(r)/r - 1)/-b with r^2 = -b, 1/3 without a field."""
    root = np.sqrt(complex(-b))
    exact = 1.0 / 3.0 if b == 0.0 else float(((np.tan(root) / root - 1.0) / -b).real)
    tips = [float(vibration.tip_after_release(0.0, b, 2.0, modes)) for modes in (4, 8)]
    assert tips[1] == pytest.approx(exact, rel=3e-4)
    assert abs(tips[1] - exact) < 0.3 * abs(tips[0] - exact)


@pytest.mark.parametrize("damping", [0.0, 0.7])
def test_factor_of_implicit_euler(damping: float) -> None:
    """Against the steps themselves, and the exact motion as dt goes to 0."""
    omega, step = 3.0, 0.02
    frequency, decay = vibration.implicit_euler(omega, damping, step)
    q, v, course = 1.0, 0.0, []
    for _ in range(400):
        v = (v - step * omega**2 * q) / (1.0 + damping * step + (omega * step) ** 2)
        q += step * v
        course.append(q)
    t = step * np.arange(1, 401)
    wave = np.exp(-decay * t)[:, None] * np.column_stack(
        (np.cos(frequency * t), np.sin(frequency * t))
    )
    residue = np.linalg.lstsq(wave, np.array(course), rcond=None)[1]
    assert residue[0] < 1e-20
    near = vibration.implicit_euler(omega, damping, 1e-4)
    assert near[0] == pytest.approx(np.sqrt(omega**2 - 0.25 * damping**2), rel=1e-4)
    assert near[1] == pytest.approx(0.5 * damping, abs=1e-3)


def test_chain_at_rest_is_the_elastica() -> None:
    b = 3.0
    exact = pendulum.under_force(b, 0.5 * np.pi)  # a uniform magnet bends like a tip force
    tips = [chain.swing(np.array([0.0, b]), np.array([0.0, b]), 0.0, 1e-3, n)[0] for n in (10, 20)]
    limit = (4.0 * tips[1] - tips[0]) / 3.0
    np.testing.assert_allclose(limit, exact[1:3], atol=1e-5)


def test_small_swing_of_the_chain_is_that_of_the_beam() -> None:
    time, b, across, mu = 0.8, 2.0, 1e-3, 0.5
    start, end = np.array([b, across]), np.array([b, 0.0])
    tips = [chain.swing(start, end, mu, time, n)[1][1] / across for n in (8, 16)]
    limit = (4.0 * tips[1] - tips[0]) / 3.0
    assert limit == pytest.approx(float(vibration.tip_after_release(time, b, mu)), abs=1e-3)


@pytest.mark.parametrize("k", [0.0, 300.0, 5e4])
def test_pinned_beam_on_a_foundation(k: float) -> None:
    pinned = tube.Ends((True, False), (True, False))
    load = tube.least_load(1.0, 1.0, lambda s: k * one(s), one, none, ends=pinned, elements=60)
    waves = np.pi * np.arange(1, 12)
    assert load == pytest.approx(float((waves**2 + k / waves**2).min()), rel=1e-5)


def test_columns_without_a_foundation() -> None:
    free = tube.Ends()
    assert tube.least_load(1.0, 1.0, none, one, none, ends=free) == pytest.approx(np.pi**2 / 4)
    own = tube.least_load(1.0, 1.0, none, lambda s: 1.0 - s, none, ends=free)
    assert own == pytest.approx(7.8373, abs=1e-4)  # Greenhill


def test_long_beam_on_a_foundation() -> None:
    """2 (EI k)^(1/2) where the tip may slide but not turn, half of it where it is free."""
    k = 60.0**4
    loads = [
        tube.least_load(1.0, 1.0, lambda s: k * one(s), one, none, ends=tube.Ends(end=end))
        for end in ((False, True), (False, False))
    ]
    assert loads[0] == pytest.approx(tube.sinusoidal_load(1.0, k, 1.0), rel=2e-3)
    assert loads[1] == pytest.approx(np.sqrt(k), rel=1e-3)


def test_springs_that_push_away() -> None:
    """They bring buckling nearer where they push away, and put it off where they hold."""
    alone = tube.least_load(1.0, 1.0, none, one, none, ends=tube.Ends())
    pushed = tube.least_load(
        1.0, 1.0, none, one, none, ends=tube.Ends(), push_at={1.0 - 1e-12: -0.5}
    )
    held = tube.least_load(1.0, 1.0, none, one, none, ends=tube.Ends(), push_at={1.0 - 1e-12: 0.5})
    assert pushed < alone < held


def test_helix() -> None:
    load, offset = 50.0, 1e-4
    turn, force = tube.helix(1.0, load, offset)
    assert turn**2 == pytest.approx(load / 2.0, rel=1e-6)
    assert force == pytest.approx(load**2 * offset / 4.0, rel=1e-6)

    def energy(turn: float, offset: float) -> float:
        return 0.5 * offset**2 * turn**4 - load * (1.0 - np.sqrt(1.0 - (offset * turn) ** 2))

    wide = 0.03
    turn, force = tube.helix(1.0, load, wide)
    step = 1e-5
    by_turn = (energy(turn + step, wide) - energy(turn - step, wide)) / (2.0 * step)
    by_offset = (energy(turn, wide + step) - energy(turn, wide - step)) / (2.0 * step)
    assert abs(by_turn) < 1e-8
    assert -by_offset == pytest.approx(force, rel=1e-6)


def test_heavy_helix() -> None:
    """With a constant pitch the load of equal energy is 2 sqrt(2); a free pitch lowers it."""
    assert tube.helical_energy(2.0 * np.sqrt(2.0), waves=0) == pytest.approx(0.0, abs=1e-9)
    assert tube.helical_energy(3.0, waves=0) == pytest.approx(1.0 - 9.0 / 8.0, abs=1e-9)
    loads = tube.helical_load()
    assert 2.75 < loads < 2.0 * np.sqrt(2.0)
    assert tube.helical_energy(loads, waves=9) == pytest.approx(0.0, abs=1e-7)


@pytest.mark.parametrize("force", [1e-3, 1.0, 1e4])
def test_clearance_of_a_barrier(force: float) -> None:
    stiffness, gap = 1e3, 1e-3

    def energy(d: float) -> float:
        return float(-stiffness * (d - gap) ** 2 * np.log(d / gap))

    d = tube.barrier_clearance(force, stiffness, gap)
    step = 1e-5 * min(d, gap - d)
    assert (energy(d - step) - energy(d + step)) / (2.0 * step) == pytest.approx(force, rel=1e-5)


def test_a_wide_channel_is_not_touched() -> None:
    chain_of = hard_contact.press(10, 0.01, 1.0, 0.5)
    assert chain_of.energy == pytest.approx(0.0, abs=1e-10)
    assert np.all(chain_of.wall_force == 0.0)


@pytest.mark.parametrize(("bend", "width", "entry"), [(0.25, 0.03, 0.0), (0.2, 0.01, 0.1)])
def test_pressed_chain_meets_the_conditions(bend: float, width: float, entry: float) -> None:
    """No joint past a wall, forces away from the walls, and nothing left over."""
    found = hard_contact.press(40, 0.01, bend, width, entry=entry)
    away = found.joints - np.array([0.0, bend])
    away[:, 0] = np.maximum(away[:, 0], 0.0)
    far = np.linalg.norm(away, axis=1)
    assert np.all(np.abs(far - bend) < width + 1e-9)
    outwards = np.sum(found.wall_force * away, axis=1)
    touched = np.any(found.wall_force != 0.0, axis=1)
    assert touched[-1]
    assert np.all(np.sign(outwards[touched]) == -np.sign(far - bend)[touched])
    assert found.misfit < 1e-5


def test_a_chain_that_touches_with_its_tip_is_an_elastica() -> None:
    """Under the wall's force as a dead one, by elliptic integrals, as links get shorter."""
    errors = []
    for links in (20, 40):
        found = hard_contact.press(links, 0.3 / links, 0.25, 0.03)
        force = found.wall_force[-1]
        assert np.all(found.wall_force[:-1] == 0.0)
        size, angle = float(np.hypot(*force)), float(np.arctan2(*force[::-1]))
        bent = pendulum.under_force(size * 0.3**2, angle)
        errors.append(np.linalg.norm(found.joints[-1] / 0.3 - bent[1:3]))
    assert errors[1] < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)


def test_couples_are_the_gradient_of_the_magnetic_energy() -> None:
    rng = np.random.default_rng(3)
    nodes, flux, moment = rng.normal(size=(5, 3)), rng.normal(size=3), 0.7

    def energy(x: Array) -> float:
        edges = np.diff(x, axis=0)
        return float(-moment * (edges @ flux / np.linalg.norm(edges, axis=1)).sum())

    forces, step = _couples(nodes, moment, flux), 1e-6
    for index in np.ndindex(nodes.shape):
        moved = np.zeros_like(nodes)
        moved[index] = step
        quotient = (energy(nodes + moved) - energy(nodes - moved)) / (2.0 * step)
        assert forces[index] == pytest.approx(-quotient, abs=1e-8)

"""The references themselves: against tables, against each other, and in their limits."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

from magwire.evidence.verify.references import columns, kirchhoff, pendulum, planar, twisted
from tables import closed_form, critical_load

Array = NDArray[np.float64]

ELASTICA = [row for row in closed_form("hard_magnetic_elastica_uniform") if row[2] > 0.0]
FRAME = np.array([[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]])  # d1, d2, d3 = z, -y, x
TWISTING = 2.0 / 3.0


def uniform(b: tuple[float, float, float]) -> kirchhoff.Field:
    """The same field everywhere."""
    return lambda places: (np.tile(b, (len(places), 1)), np.zeros((len(places), 3, 3)))


@pytest.mark.parametrize("row", ELASTICA, ids=[f"{row[0]:g}, b={row[1]:g}" for row in ELASTICA])
def test_elastica_table(row: tuple[float, ...]) -> None:
    degrees, load, *expected = row
    bent = pendulum.under_force(load, np.radians(degrees))
    np.testing.assert_allclose(bent[:3], [expected[0], *expected[2:]], atol=2e-9)


def test_cantilever_table() -> None:
    for load, angle, _, across, shorter in closed_form("cantilever_tip_force_bisshopp_drucker"):
        bent = pendulum.under_force(load, 0.5 * np.pi)
        np.testing.assert_allclose(bent[:3], [angle, 1.0 - shorter, across], atol=1e-9)


def test_critical_field_table() -> None:
    for part, load, *_ in closed_form("critical_antiparallel_field"):
        assert pendulum.critical_antiparallel(part) == pytest.approx(load, rel=1e-9)


def test_critical_loads_table() -> None:
    for ends in ("clamped-free", "pinned-pinned", "clamped-pinned", "clamped-clamped"):
        load = critical_load(f"euler_{ends.replace('-', '_')}")
        assert columns.euler(ends) == pytest.approx(load, rel=1e-11)
    clamped = critical_load("twist_clamped_clamped")
    assert twisted.clamped_moment(0.0) == pytest.approx(clamped, rel=1e-11)
    assert twisted.ring_turn(1.0) == pytest.approx(critical_load("michell_zajac_ring"), rel=1e-11)
    # Long wires: the lower bound M^2 = 4 EI T.
    assert twisted.clamped_moment(1e6) ** 2 / 1e6 == pytest.approx(
        critical_load("infinite_rod"), rel=1e-4
    )


def test_own_weight() -> None:
    """Greenhill's number, and his equation by a power series: sum of (-q)^k / (3k (3k-1) ...)."""
    q = columns.own_weight()
    assert q == pytest.approx(7.8373, abs=1e-4)
    term, total = 1.0, 1.0
    for k in range(1, 30):
        term *= -q / (3 * k * (3 * k - 1))
        total += term
    assert total == pytest.approx(0.0, abs=1e-12)


def test_below_the_critical_load_there_is_no_bent_column() -> None:
    with pytest.raises(ValueError, match="No bent wire"):
        pendulum.under_force(0.999 * columns.euler("clamped-free"), np.pi)
    assert pendulum.under_force(1.001 * columns.euler("clamped-free"), np.pi).angle < 0.2


@pytest.mark.parametrize("degrees", [45.0, 90.0, 135.0])
def test_elliptic_integrals_and_boundary_value_problem_agree(degrees: float) -> None:
    angle = np.radians(degrees)
    shape = planar.elastica(force=4.0 * np.array([np.cos(angle), np.sin(angle)]))
    bent = pendulum.under_force(4.0, angle)
    last = shape.angle[-1], shape.x[-1], shape.y[-1]
    np.testing.assert_allclose(last, bent[:3], atol=1e-9)
    drawn = pendulum.shape(4.0, bent, angle, points=2001)
    np.testing.assert_allclose(drawn[:, ::20], [shape.x, shape.y], atol=1e-6)


def test_magnetised_part_in_its_limits() -> None:
    """All of the wire; and a short magnet, which acts like a rigid one."""
    whole, nearly = (pendulum.magnetised_tip(3.0, 2.0, part) for part in (1.0, 1.0 - 1e-9))
    np.testing.assert_allclose(nearly[:3], whole[:3], atol=1e-8)
    short = pendulum.magnetised_tip(2.0 / 1e-4, 1.5, 1e-4)
    np.testing.assert_allclose(short, pendulum.dipole(2.0, 1.5, 1e-4), atol=2e-4)


def test_magnetised_part_in_balance() -> None:
    """The moment at the joint is the torque on the magnet: b times the span across the field."""
    load, direction, part = 8.0, 1.9, 0.3
    bent = pendulum.magnetised_tip(load, direction, part)
    x, y = pendulum.shape(load, bent, direction, part, points=4001)
    joint = 4001
    span = np.array([x[-1] - x[joint], y[-1] - y[joint]])
    torque = load * (span[0] * np.sin(direction) - span[1] * np.cos(direction))
    assert torque == pytest.approx(bent.joint / (1.0 - part), rel=1e-5)
    np.testing.assert_allclose([x[-1], y[-1]], [bent.x, bent.y], atol=1e-6)


def test_small_deflections() -> None:
    """Beam theory: q/8, P/3, and P/6 (2 - 3a + a^3)... by a stiffness that jumps."""
    small = 1e-4
    assert planar.elastica(weight=(0.0, small)).y[-1] == pytest.approx(small / 8.0, rel=1e-6)
    assert planar.elastica(force=(0.0, small)).y[-1] == pytest.approx(small / 3.0, rel=1e-6)
    at, soft = 0.4, 0.25
    shape = planar.elastica(
        stiffness=lambda s: np.where(s < at, 1.0, soft), force=(0.0, small), joints=(at,)
    )
    # The integral of (1 - s)^2/EI.
    expected = small / 3.0 * ((1.0 - (1.0 - at) ** 3) + (1.0 - at) ** 3 / soft)
    assert shape.y[-1] == pytest.approx(expected, rel=1e-6)


def test_rest_curvature() -> None:
    arc, found = planar.arc(2.0), planar.elastica(rest_curvature=2.0)
    for exact, value in zip(arc, found, strict=True):
        np.testing.assert_allclose(value, exact, atol=1e-9)


def test_wire_in_space_bends_like_the_planar_one() -> None:
    b = (3.0 * np.cos(2.0), 0.0, 3.0 * np.sin(2.0))
    rod = kirchhoff.clamped(FRAME, (0.0, 0.0, 1.0), uniform(b), twisting=TWISTING)
    bent = pendulum.under_force(3.0, 2.0)
    np.testing.assert_allclose(rod.place[-1], [bent.x, 0.0, bent.y], atol=1e-7)
    tangent = rod.directors[-1][:, 2]
    assert np.arctan2(tangent[2], tangent[0]) == pytest.approx(bent.angle, abs=1e-7)
    np.testing.assert_allclose(
        rod.directors @ np.swapaxes(rod.directors, 1, 2),
        np.tile(np.eye(3), (101, 1, 1)),
        atol=1e-12,
    )


def test_wire_in_space_twists_like_a_pendulum() -> None:
    """Magnetised along d1, with the field across the wire: GJ theta'' = -b sin(phi - theta)."""
    angle = 1.2
    b = 1.5 * (np.cos(angle) * FRAME[:, 0] + np.sin(angle) * FRAME[:, 1])
    rod = kirchhoff.clamped(FRAME, (1.0, 0.0, 0.0), uniform(tuple(b)), twisting=TWISTING)
    np.testing.assert_allclose(rod.place[-1], [1.0, 0.0, 0.0], atol=1e-9)
    first = rod.directors[-1][:, 0]
    turned = np.arctan2(first @ FRAME[:, 1], first @ FRAME[:, 0])
    assert turned == pytest.approx(pendulum.under_force(1.5 / TWISTING, angle).angle, abs=1e-7)


def test_wire_in_space_with_rest_curvature_and_weight() -> None:
    """A helix of rest curvature and twist; and a heavy wire as in the plane."""
    k, tau = 3.0, 2.0
    helix = kirchhoff.clamped(
        FRAME, (0.0, 0.0, 0.0), uniform((0.0, 0.0, 0.0)), twisting=1.0, rest=(0.0, k, tau)
    )
    rate = np.hypot(k, tau)
    axis = (k * FRAME[:, 1] + tau * FRAME[:, 2]) / rate
    along = (helix.place[-1] @ axis) / (tau / rate)
    assert along == pytest.approx(1.0, abs=1e-8)
    away = np.linalg.norm(helix.place[-1] - (helix.place[-1] @ axis) * axis)
    assert away == pytest.approx(2.0 * k / rate**2 * abs(np.sin(0.5 * rate)), abs=1e-8)
    heavy = kirchhoff.clamped(
        FRAME, (0.0, 0.0, 0.0), uniform((0.0, 0.0, 0.0)), twisting=1.0, weight=(0.0, 0.0, -6.0)
    )
    plane = planar.elastica(weight=(0.0, -6.0))
    np.testing.assert_allclose(heavy.place[:, 0], plane.x, atol=1e-7)
    np.testing.assert_allclose(heavy.place[:, 2], plane.y, atol=1e-7)


def test_localised_helix_is_in_balance() -> None:
    """The moment t x t' + M t about each point is that of the end's: M e_x - (r - r_0) x T e_x."""
    moment, tension, points = 40.0, 625.0, 4001
    exact = twisted.localised(moment, tension, points)
    s = np.linspace(0.0, 1.0, points)
    tangent = np.gradient(exact.place, s, axis=0, edge_order=2)
    bent = np.cross(tangent, np.gradient(tangent, s, axis=0, edge_order=2)) + moment * tangent
    pull = np.array([tension, 0.0, 0.0])
    outside = np.array([moment, 0.0, 0.0]) - np.cross(exact.place - exact.place[0], pull)
    np.testing.assert_allclose(bent[2:-2], outside[2:-2], atol=2e-3 * moment)
    assert 1.0 - exact.place[-1, 0] == pytest.approx(exact.shortening, abs=1e-6)
    assert np.arccos(tangent[:, 0].min()) == pytest.approx(exact.tilt, abs=1e-3)
    azimuth = np.unwrap(np.arctan2(tangent[1:-1, 2], tangent[1:-1, 1]))
    turned = cumulative_trapezoid((1.0 - tangent[1:-1, 0]) * np.gradient(azimuth, s[1:-1]), s[1:-1])
    assert turned[-1] == pytest.approx(exact.turn, abs=1e-3)  # Fuller's writhe, times 2 pi


def test_writhe_of_plane_and_mirrored_curves() -> None:
    t = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False)
    zero = np.zeros_like(t)
    flat = np.column_stack([np.cos(t), 2.0 * np.sin(t), zero])
    speed = np.column_stack([-np.sin(t), 2.0 * np.cos(t), zero])
    assert twisted.writhe(flat, speed) == pytest.approx(0.0, abs=1e-12)
    knot = np.column_stack(
        [np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)]
    )
    speed = np.column_stack(
        [np.cos(t) + 4 * np.cos(2 * t), -np.sin(t) + 4 * np.sin(2 * t), -3 * np.cos(3 * t)]
    )
    mirror = np.array([1.0, 1.0, -1.0])
    assert abs(twisted.writhe(knot, speed)) > 3.0  # three crossings of one sign
    assert twisted.writhe(knot * mirror, speed * mirror) == -twisted.writhe(knot, speed)


def test_cone_area() -> None:
    assert twisted.cone_area(0.5 * np.pi, 7) == pytest.approx(2.0 * np.pi, abs=1e-12)
    cap = 2.0 * np.pi * (1.0 - np.cos(0.8))
    assert twisted.cone_area(0.8, 2000) == pytest.approx(cap, rel=1e-5)
    # An octant: three right angles.
    octant = float(np.arccos(1.0 / np.sqrt(3.0)))
    assert twisted.cone_area(octant, 3) == pytest.approx(0.5 * np.pi, abs=1e-12)

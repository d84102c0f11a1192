"""Magnetic sources against magpylib, closed forms in extended precision, and differences (P-25)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.kernels.sources.cylinder import cylinder
from magwire.kernels.sources.drive import drive
from magwire.kernels.sources.harmonic import first, second
from magwire.kernels.sources.inputs import by_inputs
from magwire.kernels.sources.jet import covered, jet
from magwire.kernels.sources.loop import loop
from magwire.kernels.sources.multipole import multipole
from magwire.kernels.sources.table import (
    ATAN,
    CYLINDER,
    DIPOLE,
    ERF,
    RATIONAL,
    TANH,
    Sources,
    new_strength,
    no_sources,
)

Array = NDArray[np.float64]
Field = Callable[[Array], tuple[float, ...]]
MU_0 = 1.25663706127e-6  # CODATA 2022
PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))
AXIS = np.array([0.48, -0.6, 0.64])
RADIUS, HALF = 0.08, 0.05
_side = np.cross(AXIS, [1.0, 0.0, 0.0])
SIDE = _side / np.linalg.norm(_side)
RANDOM = np.random.default_rng(16)
AROUND = 0.1 * RANDOM.normal(size=(40, 3))
ON_AXIS = np.outer(np.linspace(-0.2, 0.2, 5) + 0.003, AXIS)
NEAR_WIRE = np.array(
    [RADIUS * SIDE + d * v for d in (1e-2, 1e-3, 1e-4) for v in RANDOM.normal(size=(4, 3))]
)
PLACES = {"around": AROUND, "on the axis": ON_AXIS, "near the wire": NEAR_WIRE}


def of_loop(x: Array) -> tuple[float, ...]:
    return loop(tuple(x), tuple(AXIS), RADIUS, 3.0 * MU_0 / (2.0 * np.pi))


def of_cylinder(x: Array) -> tuple[float, ...]:
    return cylinder(tuple(x), tuple(AXIS), RADIUS, HALF, 1.3)


def gradient(h: tuple[float, ...]) -> Array:
    return np.reshape(first(h), (3, 3))


def bends(values: tuple[float, ...]) -> Array:
    """18 numbers as an array i, j, k."""
    full = np.zeros((3, 3, 3))
    for s, (j, k) in enumerate(PAIRS):
        full[:, j, k] = full[:, k, j] = np.reshape(values, (3, 6))[:, s]
    return full


def quotient(f: Callable[[Array], Array], x: Array, step: float) -> Array:
    """Derivative by each coordinate, last index, with an error of sixth order."""
    columns = []
    for e in step * np.eye(len(x)):
        d = [f(x + n * e) - f(x - n * e) for n in (1, 2, 3)]
        columns.append((45.0 * d[0] - 9.0 * d[1] + d[2]) / (60.0 * step))
    return np.stack(columns, axis=-1)


def off(value: Array, expected: Array) -> float:
    return float(np.abs(value - expected).max() / np.abs(expected).max())


@pytest.mark.parametrize("place", PLACES)
def test_loop_and_cylinder_as_magpylib(place: str) -> None:
    magpylib = pytest.importorskip("magpylib")
    rotation = pytest.importorskip("scipy.spatial.transform").Rotation
    turn = rotation.align_vectors([AXIS], [[0.0, 0.0, 1.0]])[0]
    ring = magpylib.current.Circle(diameter=2.0 * RADIUS, current=3.0, orientation=turn)
    magnet = magpylib.magnet.Cylinder(
        dimension=(2.0 * RADIUS, 2.0 * HALF), polarization=(0.0, 0.0, 1.3), orientation=turn
    )
    for x in PLACES[place]:
        assert off(np.array(of_loop(x)[:3]), ring.getB(x)) < 1e-9
    for x in PLACES[place] + (HALF * AXIS if place == "near the wire" else 0.0):
        assert off(np.array(of_cylinder(x)[:3]), magnet.getB(x)) < 1e-9


def exact_loop(rho: float, z: float) -> tuple[Array, Array]:
    """B_rho, B_z and their derivatives by rho and z, by K and E (Smythe, section 7.10)."""
    mp = pytest.importorskip("mpmath")
    mp.mp.dps = 40
    a = mp.mpf(RADIUS)
    c = mp.mpf(3.0) * mp.mpf(MU_0) / (2 * mp.pi)

    def flux(rho, z):  # type: ignore[no-untyped-def]
        far, near = (a + rho) ** 2 + z * z, (a - rho) ** 2 + z * z
        k = 4 * a * rho / far
        K, E = mp.ellipk(k), mp.ellipe(k)
        b_rho = c * z / (rho * mp.sqrt(far)) * (-K + (a * a + rho * rho + z * z) / near * E)
        b_z = c / mp.sqrt(far) * (K + (a * a - rho * rho - z * z) / near * E)
        return b_rho, b_z

    x = (mp.mpf(rho), mp.mpf(z))
    slopes = [
        [mp.diff(lambda r, s, i=i: flux(r, s)[i], x, order) for order in ((1, 0), (0, 1))]
        for i in (0, 1)
    ]
    return np.array(flux(*x), dtype=float), np.array(slopes, dtype=float)


@pytest.mark.parametrize(
    ("rho", "z"),
    [
        (1e-9, 0.03),
        (1e-4, 0.03),
        (0.02, 0.01),
        (0.06, -0.02),
        (0.0799, 1e-4),
        (0.08001, -1e-5),
        (0.3, 0.2),
    ],
)
def test_loop_as_in_extended_precision(rho: float, z: float) -> None:
    flux, slopes = exact_loop(rho, z)
    h = loop((rho, 0.0, z), (0.0, 0.0, 1.0), RADIUS, 3.0 * MU_0 / (2.0 * np.pi))
    assert off(np.array([h[0], h[2]]), flux) < 1e-9
    assert off(gradient(h)[[0, 2]][:, [0, 2]], slopes) < 1e-9


def test_loop_on_its_axis() -> None:
    h = of_loop(0.03 * AXIS)
    size = 0.5 * MU_0 * 3.0 * RADIUS**2
    s = RADIUS**2 + 0.03**2
    np.testing.assert_allclose(h[:3], size / s**1.5 * AXIS, rtol=1e-13)
    along = -3.0 * 0.03 * size / s**2.5
    expected = along * (1.5 * np.outer(AXIS, AXIS) - 0.5 * np.eye(3))
    np.testing.assert_allclose(gradient(h), expected, atol=1e-13 * abs(along))


def exact_cylinder(rho: float, z: float) -> tuple[Array, Array]:
    """The same of the cylinder, from its sheet of current, integrated with 30 digits."""
    mp = pytest.importorskip("mpmath")
    mp.mp.dps = 30
    a, rho, z = mp.mpf(RADIUS), mp.mpf(rho), mp.mpf(z)
    c = mp.mpf(1.3) / (2 * mp.pi)

    def ends(f):  # type: ignore[no-untyped-def]
        up, down = z + mp.mpf(HALF), z - mp.mpf(HALF)
        return c * mp.quad(lambda p: f(p, up) - f(p, down), [0, mp.pi / 64, mp.pi / 8, mp.pi])

    def e2(p):  # type: ignore[no-untyped-def]
        return rho**2 + a**2 - 2 * a * rho * mp.cos(p)

    def b_z(p, s):  # type: ignore[no-untyped-def]
        return (a * a - a * rho * mp.cos(p)) * s / (e2(p) * mp.sqrt(e2(p) + s * s))

    def b_rho(p, s):  # type: ignore[no-untyped-def]
        return -a * mp.cos(p) / mp.sqrt(e2(p) + s * s)

    def by_z(p, s):  # type: ignore[no-untyped-def]
        return (a * a - a * rho * mp.cos(p)) / (e2(p) + s * s) ** 1.5

    def by_z_rho(p, s):  # type: ignore[no-untyped-def]
        return a * mp.cos(p) * s / (e2(p) + s * s) ** 1.5

    def by_rho_rho(p, s):  # type: ignore[no-untyped-def]
        return a * mp.cos(p) * (rho - a * mp.cos(p)) / (e2(p) + s * s) ** 1.5

    cross = ends(by_z_rho)
    flux = [ends(b_rho), ends(b_z)]
    return np.array(flux, dtype=float), np.array(
        [[ends(by_rho_rho), cross], [cross, ends(by_z)]], dtype=float
    )


@pytest.mark.parametrize(
    ("rho", "z"), [(0.001, 0.09), (0.03, 0.06), (0.0795, 0.07), (0.081, 0.052), (0.15, 0.01)]
)
def test_cylinder_as_in_extended_precision(rho: float, z: float) -> None:
    flux, slopes = exact_cylinder(rho, z)
    h = cylinder((rho, 0.0, z), (0.0, 0.0, 1.0), RADIUS, HALF, 1.3)
    assert off(np.array([h[0], h[2]]), flux) < 1e-9
    assert off(gradient(h)[[0, 2]][:, [0, 2]], slopes) < 1e-9


def of_orders(orders: int) -> Field:
    """One source with coefficients outward and inward of all orders."""
    outward = np.array([[0.02**n for n in range(1, orders + 1)]])
    inward = np.array([[0.3 / 0.1**n for n in range(1, orders + 1)]])
    return lambda x: multipole(tuple(x), tuple(AXIS), 2.0, outward, inward, 0)


def away(x: Array) -> bool:
    """Whether differences are smooth there: far enough from wire, faces and the centre."""
    z = AXIS @ x
    rho = np.linalg.norm(x - z * AXIS)
    return (
        abs(abs(z) - HALF) > 0.02 and np.hypot(rho - RADIUS, z) > 0.03 and abs(rho) + abs(z) > 0.06
    )


@pytest.mark.parametrize("field", [of_loop, of_cylinder, of_orders(7)])
def test_derivatives_in_space(field: Field) -> None:
    for x in filter(away, [*AROUND, *ON_AXIS]):
        h = field(x)
        assert off(gradient(h), quotient(lambda y: np.array(field(y)[:3]), x, 5e-4)) < 1e-8
        assert off(bends(second(h)), quotient(lambda y: gradient(field(y)), x, 5e-4)) < 1e-8


def test_first_order_is_a_dipole_and_a_uniform_field() -> None:
    x = np.array([0.03, -0.02, 0.05])
    size = np.linalg.norm(x)
    b = 1e-6 * (3.0 * (AXIS @ x) * x / size**2 - AXIS) / size**3
    out, none = np.array([[1e-6]]), np.zeros((1, 1))
    h = multipole(tuple(x), tuple(AXIS), 1.0, out, none, 0)
    np.testing.assert_allclose(h[:3], b, rtol=1e-13)
    h = multipole(tuple(x), tuple(AXIS), 1.0, none, np.array([[0.02]]), 0)
    np.testing.assert_allclose(h[:3], -0.02 * AXIS, rtol=1e-13)


def everything() -> tuple[Sources, Array]:
    """A table with every kind of source, saturated inputs, and two magnets that move."""
    turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    frame = np.concatenate([turn.ravel(), [0.01, 0.02, -0.03]])
    affine = np.zeros((18, 12))
    affine[0, :3] = 0.01, 0.02, -0.01
    affine[17, 3:] = 0.3, 0.1, 0.2, 0.1, -0.5, 0.05, 0.2, 0.05, 0.2
    dipoles = np.array([[0.2, 0.1, 0.0, 1e-5, 2e-5, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 3e-4]]).T
    cylinders = np.array([[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.025, 0.025, 1.4]]).T
    maps = 0.01 * RANDOM.normal(size=(1, 3, 9, 8, 10))
    grid = np.concatenate([[-0.1, -0.1, -0.1], [0.05, 0.06, 0.045], [0.0, 0.01, 0.0], turn.ravel()])
    table = no_sources(17)._replace(
        length=0.1,
        flux=0.02,
        curve=np.array([0, ERF, ATAN, TANH, RATIONAL] + 12 * [0]),
        saturation=np.array(5 * [[17.0, 0.05]] + 12 * [[0.0, 0.0]]),
        affine=affine,
        dipoles=np.ascontiguousarray(dipoles),
        dipole_channel=np.array([1, 17]),
        multipoles=np.array([[-0.2, 0.1, 0.05, *AXIS]]).T.copy(),
        multipole_channel=np.array([2]),
        outward=np.array([[1e-5, 1e-7]]),
        inward=np.array([[1e-3, 1e-2]]),
        loops=np.array([[0.0, 0.0, 0.05, *AXIS, RADIUS, 2e-5]]).T.copy(),
        loop_channel=np.array([3]),
        cylinders=np.ascontiguousarray(cylinders),
        cylinder_channel=np.array([17]),
        maps=maps,
        map_channel=np.array([4]),
        map_grid=grid,
        posed=np.array([[CYLINDER, 0, 5], [DIPOLE, 1, 11]]),
        pose_frame=np.array([frame, frame]),
    )
    u = np.array([1.0, 9.0, -12.0, 20.0, 5.0, 0.1, 0.1, 0.1, 0.3, 0.9, 0.4])
    return table, np.concatenate([u, [-0.1, 0.05, 0.1, 1.0, -2.0, 0.5]])


TABLE, INPUTS = everything()


def field_at(u: Array, x: Array) -> tuple[Array, Array, Array]:
    strength = new_strength(TABLE)
    drive(TABLE, u, strength)
    b, g, d = jet(TABLE, strength, tuple(x), True)
    return np.array(b), np.reshape(g, (3, 3)), bends(d)


POINTS = (np.array([0.1, 0.2, -0.15]), np.array([-0.2, 0.05, 0.3]))


@pytest.mark.parametrize("x", POINTS)
def test_all_sources_together_in_space(x: Array) -> None:
    _, g, d = field_at(INPUTS, x)
    assert off(g, quotient(lambda y: field_at(INPUTS, y)[0], x, 2e-3)) < 1e-8
    assert off(d, quotient(lambda y: field_at(INPUTS, y)[1], x, 2e-3)) < 1e-8


@pytest.mark.parametrize("x", POINTS)
def test_derivatives_by_inputs(x: Array) -> None:
    strength = new_strength(TABLE)
    drive(TABLE, INPUTS, strength)
    by_flux, by_gradient = np.zeros((17, 3)), np.zeros((17, 9))
    by_inputs(TABLE, INPUTS, strength, tuple(x), by_flux, by_gradient)
    b = quotient(lambda u: field_at(u, x)[0], INPUTS, 2e-4)
    g = quotient(lambda u: field_at(u, x)[1].ravel(), INPUTS, 2e-4)
    for k in range(17):
        assert off(by_flux[k], b[:, k]) < 1e-7
        if np.abs(g[:, k]).max() > 1e-9:  # a uniform field has no gradient
            assert off(by_gradient[k], g[:, k]) < 1e-7


def test_second_derivatives_only_when_wanted() -> None:
    strength = new_strength(TABLE)
    drive(TABLE, INPUTS, strength)
    with_them, without = (jet(TABLE, strength, (0.1, 0.2, 0.0), wanted) for wanted in (True, False))
    assert without[:2] == with_them[:2]
    assert not any(without[2])
    assert any(with_them[2])


def test_units_of_length_and_flux() -> None:
    plain = TABLE._replace(length=1.0, flux=1.0)
    strength = new_strength(TABLE)
    drive(TABLE, INPUTS, strength)
    b, g, d = jet(TABLE, strength, (0.1, 0.2, 0.0), True)
    b_si, g_si, d_si = jet(plain, strength, (0.01, 0.02, 0.0), True)
    np.testing.assert_allclose(b, np.array(b_si) / 0.02, rtol=1e-13)
    np.testing.assert_allclose(g, np.array(g_si) * 0.1 / 0.02, rtol=1e-13)
    np.testing.assert_allclose(d, np.array(d_si) * 0.01 / 0.02, rtol=1e-13)


def test_outside_of_a_map_there_is_no_field() -> None:
    strength = new_strength(TABLE)
    drive(TABLE, INPUTS, strength)
    assert covered(TABLE, (0.0, 0.0, 0.0))
    assert not covered(TABLE, (30.0, 0.0, 0.0))
    assert np.all(np.isnan(jet(TABLE, strength, (30.0, 0.0, 0.0), True)[0]))

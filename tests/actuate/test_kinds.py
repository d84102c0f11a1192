"""Each kind of actuator: its field, its inputs and limits, where it stands."""

from __future__ import annotations

import math

import numpy as np
import pytest

from magwire.actuate import (
    Actuator,
    Box,
    Circuit,
    Coil,
    Held,
    Helmholtz,
    Input,
    Loops,
    Magnet,
    Maxwell,
    Omnimagnet,
    Pair,
    Pose,
    Together,
    Uniform,
    UniformGradient,
)
from magwire.errors import InputError

MU_0 = 1.25663706127e-6
CENTRE = [[0.0, 0.0, 0.0]]
TURN = Pose.turned([1.0, 2.0, -0.5], 0.7, (0.01, -0.02, 0.03))


def three_axes() -> Helmholtz:
    """Three nested pairs like those of the paper's platform."""
    pairs = (Pair("x", 0.12, 150.0), Pair("y", 0.10, 150.0), Pair("z", 0.08, 150.0))
    return Helmholtz(pairs=pairs)


def test_centre_of_helmholtz_pairs() -> None:
    b, g = three_axes().at(CENTRE, [1.0, 2.0, 3.0])
    sizes = 0.8**1.5 * MU_0 * 150.0 / np.array([0.12, 0.10, 0.08])
    np.testing.assert_allclose(b[0], sizes * [1.0, 2.0, 3.0], rtol=1e-12)
    assert np.abs(g).max() < 1e-12 * np.abs(b).max() / 0.08


def test_a_helmholtz_pair_is_flat_to_fourth_order() -> None:
    pair = Helmholtz(pairs=(Pair("z", 0.1, 1.0),))
    off = [
        float(pair.at([[0.0, 0.0, z]], [1.0])[0][0, 2] / pair.at(CENTRE, [1.0])[0][0, 2]) - 1.0
        for z in (0.005, 0.01)
    ]
    assert off[1] / off[0] == pytest.approx(16.0, rel=0.02)
    assert off[1] == pytest.approx(-144.0 / 125.0 * 1e-4, rel=0.02)  # Jackson, problem 5.7


def test_centre_of_a_maxwell_pair() -> None:
    radius = 0.1
    b, g = Maxwell(pairs=(Pair("z", radius, 100.0),)).at(CENTRE, [2.0])
    slope = 48.0 / 49.0 * math.sqrt(3.0 / 7.0) * MU_0 * 200.0 / radius**2
    np.testing.assert_allclose(g[0], slope * np.diag([-0.5, -0.5, 1.0]), atol=1e-12 * slope)
    assert np.abs(b).max() < 1e-12 * slope * radius


def test_a_winding_is_the_mean_of_its_loops() -> None:
    coil = Coil("I", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.05, 400.0, width=0.02, height=0.01)
    x, w = np.polynomial.legendre.leggauss(12)
    point = np.array([[0.02, 0.01, 0.03]])
    total = np.zeros(3)
    for a, v in zip(0.01 * x, w, strict=True):
        for r, s in zip(0.05 + 0.005 * x, w, strict=True):
            thin = Coil("I", (0.0, 0.0, a), (0.0, 0.0, 1.0), r, 400.0)
            total += 0.25 * v * s * Loops(coils=(thin,)).at(point, [1.0])[0][0]
    np.testing.assert_allclose(Loops(coils=(coil,)).at(point, [1.0])[0][0], total, rtol=1e-6)


def test_coils_of_one_input_are_in_series() -> None:
    one = Coil("a", (0.0, 0.0, 0.1), (0.0, 0.0, 1.0), 0.05, 10.0)
    two = Coil("b", (0.1, 0.0, 0.0), (1.0, 0.0, 0.0), 0.05, 10.0)
    series = Coil("a", two.centre, two.axis, 0.05, 10.0)
    apart, together = Loops(coils=(one, two)), Loops(coils=(one, series))
    assert [i.name for i in apart.inputs] == ["a", "b"]
    assert [i.name for i in together.inputs] == ["a"]
    np.testing.assert_allclose(
        apart.at(CENTRE, [2.0, 2.0])[0], together.at(CENTRE, [2.0])[0], rtol=1e-14
    )


def test_uniform_and_gradient() -> None:
    field = UniformGradient(pose=Pose(translation=(0.1, 0.0, 0.0)))
    b, g = field.at([[0.2, 0.1, 0.0]], [0.01, 0.02, 0.03, 1.0, 2.0, 3.0, 4.0, 5.0])
    matrix = np.array([[1.0, 2.0, 3.0], [2.0, 4.0, 5.0], [3.0, 5.0, -5.0]])
    np.testing.assert_allclose(g[0], matrix, rtol=1e-15)
    np.testing.assert_allclose(b[0], np.array([0.01, 0.02, 0.03]) + matrix @ [0.1, 0.1, 0.0])


def test_omnimagnet_is_a_dipole() -> None:
    system = Omnimagnet(moments=(5.0, 6.0, 7.0), position=(0.0, 0.0, 0.2))
    b, _ = system.at([[0.0, 0.0, 0.05]], [1.0, 0.0, 2.0])
    size = 1e-7 / 0.15**3
    np.testing.assert_allclose(b[0], [-5.0 * size, 0.0, 28.0 * size], rtol=1e-9)


def test_a_sphere_is_a_dipole_and_a_cylinder_nearly() -> None:
    aim = [0.0, 0.0, 0.1, 0.0, 0.6, -0.8]
    sphere = Magnet(radius=0.02, remanence=1.2)
    volume = 4.0 / 3.0 * math.pi * 0.02**3
    r = np.array([0.03, 0.04, -0.12])
    m = 1.2 * volume / (4.0 * math.pi) * np.array([0.0, 0.6, -0.8])
    expected = (3.0 * (m @ r) * r / (r @ r) - m) / (r @ r) ** 1.5
    np.testing.assert_allclose(sphere.at([r + [0, 0, 0.1]], aim)[0][0], expected, rtol=1e-13)
    # of this length over diameter a cylinder has no octupole moment
    radius = 0.02
    length = math.sqrt(3.0) * radius
    cylinder = Magnet(radius=radius, length=length, remanence=1.0)
    far = 30.0 * r
    m *= math.pi * radius**2 * length / (1.2 * volume)
    expected = (3.0 * (m @ far) * far / (far @ far) - m) / (far @ far) ** 1.5
    np.testing.assert_allclose(
        cylinder.at([far + [0, 0, 0.1]], aim)[0][0], expected, atol=1e-6 * np.abs(expected).max()
    )


@pytest.mark.parametrize("length", [None, 0.05])
def test_distance_from_a_magnet(length: float | None) -> None:
    magnet = Magnet(radius=0.02, length=length, remanence=1.0, pose=TURN)
    u = [0.1, 0.0, 0.0, 0.0, 0.0, 3.0]
    own = np.array([[0.1, 0.0, 0.06], [0.1, 0.05, 0.0], [0.1, 0.0, 0.0]])
    expected = [0.06 - (0.02 if length is None else 0.025), 0.03, -0.02]
    points = own @ TURN.matrix.T + TURN.shift
    np.testing.assert_allclose(magnet.distance(u, points), expected, atol=1e-14)


def kinds() -> dict[str, tuple[Actuator, np.ndarray]]:
    coil = Coil("I", (0.0, 0.1, 0.1), (1.0, 1.0, 1.0), 0.05, 50.0)
    pose = np.array([0.05, 0.1, 0.2, 0.3, -0.4, 0.7])
    return {
        "uniform": (Uniform(), np.array([0.01, 0.02, 0.03])),
        "gradient": (UniformGradient(), np.linspace(-1.0, 1.0, 8)),
        "helmholtz": (three_axes(), np.array([1.0, -2.0, 3.0])),
        "loops": (Loops(coils=(coil,)), np.array([4.0])),
        "omnimagnet": (Omnimagnet(moments=(1.0, 2.0, 3.0)), np.array([1.0, 2.0, 3.0])),
        "sphere": (Magnet(radius=0.02, remanence=1.2), pose),
        "cylinder": (Magnet(radius=0.02, length=0.05, remanence=1.2), pose),
    }


POINTS = np.array([[0.02, 0.03, -0.01], [-0.03, 0.01, 0.04]])


@pytest.mark.parametrize("kind", kinds())
def test_a_pose_turns_the_field_with_its_actuator(kind: str) -> None:
    actuator, u = kinds()[kind]
    moved = Together(parts=(actuator,), pose=TURN)
    b, g = actuator.at(POINTS, u)
    turn = TURN.matrix
    b_moved, g_moved = moved.at(POINTS @ turn.T + TURN.shift, u)
    np.testing.assert_allclose(b_moved, b @ turn.T, atol=1e-12 * np.abs(b).max())
    np.testing.assert_allclose(g_moved, turn @ g @ turn.T, atol=1e-11 * max(1, np.abs(g).max()))


@pytest.mark.parametrize("kind", kinds())
def test_what_is_held_does_not_change(kind: str) -> None:
    actuator, u = kinds()[kind]
    held = Held(actuator=actuator, values=tuple(u), pose=TURN)
    both = Together(parts=(Uniform(), held))
    assert [i.name for i in both.inputs] == ["Bx", "By", "Bz"]
    own = POINTS @ TURN.matrix.T + TURN.shift
    expected = actuator.at(POINTS, u)[0] @ TURN.matrix.T + [0.01, 0.0, 0.0]
    np.testing.assert_allclose(both.at(own, [0.01, 0.0, 0.0])[0], expected, rtol=1e-11)


@pytest.mark.parametrize("kind", kinds())
def test_no_divergence_and_no_curl(kind: str) -> None:
    actuator, u = kinds()[kind]
    h = 1e-4
    rows = [
        (8.0 * (b1 - b_1) - b2 + b_2) / (12.0 * h)
        for e in h * np.eye(3)
        for b1, b_1, b2, b_2 in [
            [actuator.at(POINTS + n * e, u)[0] for n in (1.0, -1.0, 2.0, -2.0)]
        ]
    ]
    slopes = np.stack(rows, axis=-1)
    _, g = actuator.at(POINTS, u)
    size = max(np.abs(g).max(), 1e-6)
    np.testing.assert_allclose(g, slopes, atol=1e-8 * size)
    assert np.abs(np.trace(g, axis1=1, axis2=2)).max() < 1e-9 * size
    assert np.abs(g - g.transpose(0, 2, 1)).max() < 1e-9 * size


@pytest.mark.parametrize("kind", kinds())
def test_response_to_inputs(kind: str) -> None:
    actuator, u = kinds()[kind]
    by_b, by_g = actuator.response(POINTS, u)
    for k in range(len(u)):
        e = 1e-4 * np.eye(len(u))[k]
        ends = [actuator.at(POINTS, u + n * e) for n in (1.0, -1.0, 2.0, -2.0)]
        for found, part in ((by_b, 0), (by_g, 1)):
            b1, b_1, b2, b_2 = (end[part] for end in ends)
            slope = (8.0 * (b1 - b_1) - b2 + b_2) / 12e-4
            size = max(np.abs(found).max(), 1e-6)
            np.testing.assert_allclose(found[:, k], slope, atol=1e-7 * size)


def test_rates_from_inductance_and_supply() -> None:
    coil = Input("I", "A", -10.0, 10.0, resistance=2.0, inductance=0.01, supply=30.0)
    assert coil.rates(5.0) == pytest.approx((-4000.0, 2000.0))
    assert Input("I", "A", slew=100.0).rates(5.0) == (-100.0, 100.0)


def test_limits_of_power() -> None:
    circuit = Circuit(resistance=2.0)
    coils = Helmholtz(
        pairs=(Pair("x", 0.1, 10.0, max_current=5.0, circuit=circuit),), max_power=32.0
    )
    assert coils.power([4.0]) == 32.0
    assert coils.violations([4.0]) == ()
    assert coils.violations([4.5]) == (
        "The power of all coils must be at most 32 W; received 40.5 W.",
    )


def test_axes_of_images() -> None:
    other = TURN.in_other_axes()
    flip = np.diag([-1.0, -1.0, 1.0])
    point = np.array([0.1, 0.2, 0.3])
    np.testing.assert_allclose(
        other.matrix @ (flip @ point) + other.shift, flip @ (TURN.matrix @ point + TURN.shift)
    )


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Box((0.0, 0.0, 1.0), (1.0, 1.0, 1.0)), "Corners of Box must be low, then high"),
        (lambda: Input("I", "A", 1.0, -1.0), "low, then high; received 1 and -1 A."),
        (lambda: Pose(((1.0, 0, 0), (0, 1, 0), (0, 0, -1))), "orthogonal with determinant 1"),
        (lambda: Pose.turned([0.0, 0.0, 0.0], 1.0), "must have a length"),
        (lambda: Coil("I", (0, 0, 0), (0, 0, 0), 0.1), "axis of coil I must have a length"),
        (lambda: Coil("I", (0, 0, 0), (0, 0, 1), -0.1), "radius of coil I must be positive"),
        (lambda: Loops(coils=()), "at least one coil"),
        (lambda: Helmholtz(pairs=(Pair("x", 0.1, 1), Pair("x", 0.2, 1))), "each on another axis"),
        (lambda: Pair("w", 0.1, 1), "must be 'x', 'y' or 'z'; received 'w'"),
        (lambda: Magnet(radius=0.1, remanence=-1.0), "remanence of Magnet must be positive"),
        (lambda: Together(parts=(Uniform(), Uniform())), "received Bx, By, Bz twice"),
        (lambda: Uniform().at(CENTRE, [1.0]), "must be 3 numbers (Bx, By, Bz); received 1."),
    ],
)
def test_faults(make: object, sentence: str) -> None:
    with pytest.raises(InputError) as raised:
        make()  # type: ignore[operator]
    assert sentence in str(raised.value)

"""Sensitivities of an equilibrium (P-21) against differences and against a closed form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.sensitivity import Input, Output
from magwire.engine.statics import Equilibrium
from magwire.errors import InputError
from magwire.simulation import Simulation
from magwire.wire import Wire
from wires import L, flux, free, lumen, magnet, paper_wire

Array = NDArray[np.float64]
OUTPUTS: tuple[Output, ...] = ("tip", "tip_direction", "positions")


@dataclass(frozen=True)
class Affine:
    """Any affine field; a gradient need not be one that a magnet could make."""

    flux_density: Array
    gradient: Array
    affine: bool = True

    def at(self, points: Array) -> tuple[Array, Array]:
        gradient = np.tile(self.gradient, (len(points), 1, 1))
        return self.flux_density + points @ self.gradient.T, gradient


def in_contact(release: str = "sliding") -> tuple[Simulation, float]:
    barrier = Barrier(1e3, 1e-4, wall="centreline")
    sim = Simulation(paper_wire(), lumen("half-circle"), contact=barrier, release=release)
    return sim, 0.0404


def in_space(release: str = "sliding") -> tuple[Simulation, float]:
    wire = Wire.uniform(
        L,
        0.6e-3,
        3e6,
        1e6,
        2000.0,
        60,
        magnetized_tip=0.03,
        magnetization=(20e3, -30e3, 60e3),
        rest_curvature=(10.0, 5.0),
    )
    return free(wire, release=release), 0.0704


CASES: dict[str, tuple[Callable[..., tuple[Simulation, float]], Affine]] = {
    "in contact": (
        in_contact,
        Affine(np.array([1e-3, 12e-3, 4e-3]), np.zeros((3, 3))),
    ),
    "in space": (
        in_space,
        Affine(np.array([1e-3, 2e-3, -1e-3]), np.array([[2, 3, 1], [3, -4, 2], [1, 2, 2]]) * 1e-2),
    ),
}
STEPS = {"field": 2e-6, "gradient": 2e-4, "feed": 2e-6, "twist": 1e-3}


def moved(case: str, wrt: Input, index: tuple[int, ...], step: float, release: str) -> Equilibrium:
    """The equilibrium with one input changed by a step."""
    build, field = CASES[case]
    sim, feed = build(release)
    start = sim.equilibrium(feed, field)
    if wrt == "feed":
        return sim.equilibrium(feed + step, field, start=start)
    if wrt == "twist":
        return sim.equilibrium(feed, field, start=start, twist=step)
    flux_density, gradient = field.flux_density.copy(), field.gradient.copy()
    (flux_density if wrt == "field" else gradient)[index] += step
    return sim.equilibrium(feed, Affine(flux_density, gradient), start=start)


SHAPES: dict[Input, tuple[int, ...]] = {"field": (3,), "gradient": (3, 3), "feed": (), "twist": ()}


@pytest.mark.parametrize("wrt", SHAPES)
@pytest.mark.parametrize("case", CASES)
def test_against_differences(case: str, wrt: Input) -> None:
    build, field = CASES[case]
    sim, feed = build()
    state = sim.equilibrium(feed, field)
    assert (state.tip_force > 0.0) == (case == "in contact")
    assert state.stable
    step = STEPS[wrt]
    for index in np.ndindex(*SHAPES[wrt]):
        after, before = (moved(case, wrt, index, s * step, "sliding") for s in (1.0, -1.0))
        for output in OUTPUTS:
            derivative = state.sensitivity(output, wrt=wrt)
            value = getattr(state, output)
            assert derivative.shape == value.shape + SHAPES[wrt]
            quotient = (getattr(after, output) - getattr(before, output)) / (2.0 * step)
            # A round wire magnetised along its axis does not feel a twist: round-off, not zero.
            size = max(np.abs(derivative).max(), 1e-6)
            np.testing.assert_allclose(derivative[(..., *index)], quotient, atol=1e-5 * size)


@pytest.mark.parametrize("release", ["sliding", "node"])
@pytest.mark.parametrize("feed", [0.0700, 0.0704, 0.0711])
def test_feed_wherever_the_entrance_is_in_a_cell(feed: float, release: str) -> None:
    sim, _ = in_space(release)
    field = CASES["in space"][1]
    state = sim.equilibrium(feed, field)
    step = 1e-6
    ends = [sim.equilibrium(feed + s * step, field, start=state).tip for s in (1.0, -1.0)]
    quotient = (ends[0] - ends[1]) / (2.0 * step)
    np.testing.assert_allclose(state.sensitivity("tip", wrt="feed"), quotient, atol=1e-5)


@pytest.mark.parametrize("edges", [0.0, 0.3, 1.2, 2.2, 3.2, 4.2, 5.2])
def test_hardly_fed(edges: float) -> None:
    """Few nodes are free: the band is shorter than it is wide."""
    sim, _ = in_space()
    feed, step = edges * L / 59, 1e-6
    field = CASES["in space"][1]
    state = sim.equilibrium(feed, field)
    for wrt, shape in SHAPES.items():
        assert state.sensitivity("tip", wrt=wrt).shape == (3, *shape)
    if edges == 0.0:
        return
    ends = [sim.equilibrium(feed + s * step, field, start=state).tip for s in (1.0, -1.0)]
    quotient = (ends[0] - ends[1]) / (2.0 * step)
    np.testing.assert_allclose(state.sensitivity("tip", wrt="feed"), quotient, atol=1e-5)


def test_a_wire_on_the_guide_feels_nothing() -> None:
    sim, _ = in_space()
    state = sim.equilibrium(0.0)
    assert np.all(state.sensitivity("positions", wrt="field") == 0.0)
    along = state.sensitivity("positions", wrt="feed")
    np.testing.assert_allclose(along, np.tile([1.0, 0.0, 0.0], (60, 1)))


@pytest.mark.parametrize("b", [-5.0, 0.0, 1.0, 2.0, 3.0, 5.0, 15.0])
def test_straight_wire_in_a_field_along_it(b: float) -> None:
    """Tip by a field across, in a field b antiparallel to the wire; b > pi^2/4 is unstable.

    theta'' + b theta = -beta gives y/L = -(beta/b) (1 - tan(sqrt b)/sqrt b).
    """
    wire = magnet(200)
    state = free(wire).equilibrium(L, flux(wire, b, 180.0))
    assert state.stable == (b < np.pi**2 / 4.0)
    root = np.sqrt(complex(b))
    expected = 1.0 / 3.0 if b == 0.0 else (-(1.0 - np.tan(root) / root) / b).real
    unit = np.linalg.norm(flux(wire, 1.0))
    tip = state.sensitivity("tip", wrt="field") * unit / L
    np.testing.assert_allclose(tip[[1, 2], [1, 2]], expected, rtol=2e-3)
    np.testing.assert_allclose(tip[:, 0], 0.0, atol=1e-9)


def test_unknown_names_are_refused() -> None:
    sim, feed = in_space()
    state = sim.equilibrium(feed)
    with pytest.raises(InputError, match="Input output of sensitivity must be 'tip' or"):
        state.sensitivity("tips", wrt="field")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="Input wrt of sensitivity must be 'field' or"):
        state.sensitivity("tip", wrt="time")  # type: ignore[arg-type]

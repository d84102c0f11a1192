"""The wall that fits a wire and a lumen by itself (P-11)."""

from __future__ import annotations

import numpy as np
import pytest

import magwire as mw
from magwire.engine.wall import FIRM, ROOM, fit

BEND, RADIUS = 25e-3, 3e-3


def wire(modulus: float = 3e6, radius: float = 0.6e-3, **more: object) -> mw.Wire:
    return mw.Wire.uniform(0.1, radius, modulus, modulus / 3.0, 2000.0, 100, **more)  # type: ignore[arg-type]


def test_the_gap_is_a_part_of_the_free_room() -> None:
    path = mw.Lumen.half_circle(BEND, RADIUS).path()
    assert fit(mw.Barrier(), wire(), path).activation_gap == pytest.approx(ROOM * 2.4e-3)
    along = mw.Barrier(wall="centreline")
    assert fit(along, wire(), path).activation_gap == pytest.approx(ROOM * 3e-3)


def test_the_stiffness_is_that_of_the_sharpest_bend() -> None:
    path = mw.Lumen.half_circle(BEND, RADIUS).path()
    for modulus in (1e6, 200e9):
        made = wire(modulus)
        firm = fit(mw.Barrier(), made, path)
        assert firm.stiffness * firm.activation_gap == pytest.approx(
            FIRM * made.bending_stiffness / BEND**3, rel=1e-3
        )
    hooked = wire(rest_curvature=(60.0, 80.0))
    firm = fit(mw.Barrier(), hooked, path)
    assert firm.stiffness * firm.activation_gap == pytest.approx(
        FIRM * hooked.bending_stiffness * 100.0**3
    )


def test_what_is_given_is_kept() -> None:
    path = mw.Lumen.half_circle(BEND, RADIUS).path()
    assert fit(mw.Barrier(1e3, 1e-4), wire(), path) == (1e3, 1e-4)
    assert fit(mw.Barrier(1e3), wire(), path).stiffness == 1e3
    assert fit(mw.Barrier(activation_gap=1e-5), wire(), path).activation_gap == 1e-5


def test_steel_takes_no_more_iterations_than_a_gel() -> None:
    """0.8 mm of steel against the paper's wire, in the same free room, at 10 ms."""
    counts = []
    for made in (wire(), wire(200e9, 0.4e-3)):
        lumen = mw.Lumen.half_circle(BEND, RADIUS + made.radius)
        result = mw.Simulation(made, lumen).run(mw.Feed(1e-3, 0.04), time_step=0.01)
        assert result.status == "complete"
        counts.append(int(result.dataset.attrs["newton_iterations_total"]))
    assert counts[1] <= 3 * counts[0]


@pytest.mark.parametrize("ratio", [1e2, 1e5])
@pytest.mark.parametrize("lumen", ["half-circle", "open"])
def test_a_stiff_magnet_on_a_soft_body(ratio: float, lumen: str) -> None:
    """Newton's method turns the stiff edges instead of stretching them."""
    body = mw.Section(0.095, 3e6, 1e6, 0.6e-3, 2000.0)
    tip = mw.Section(0.005, 3e6 * ratio, 1e6 * ratio, 0.6e-3, 2000.0, magnetization=(0, 0, 128e3))
    where = mw.Lumen.half_circle(BEND, 3.6e-3) if lumen == "half-circle" else mw.Lumen.open_space()
    state = mw.Simulation(mw.Wire((body, tip), 100), where).equilibrium(0.06, [0.0, 0.02, 0.0])
    assert state.stable
    assert state.iterations <= 100
    magnet = np.linalg.norm(np.diff(state.positions[-5:], axis=0), axis=1)
    np.testing.assert_allclose(magnet, 0.1 / 99.0, rtol=1e-3)


def test_a_shaft_four_decades_stiffer_than_its_tip_runs_at_the_usual_time_step() -> None:
    shaft = mw.Section(0.06, 60e9, 20e9, 0.18e-3, 6500.0)
    tip = mw.Section(0.04, 6e6, 2e6, 0.18e-3, 2000.0, magnetization=(0, 0, 100e3))
    lumen = mw.Lumen.half_circle(20e-3, 2.2e-3)
    result = mw.Simulation(mw.Wire((shaft, tip), 101), lumen).run(
        mw.Feed(2e-3, 0.07), time_step=0.01, record_every=1e-3
    )
    assert result.status == "complete"
    assert result.smallest_clearance > 0.0

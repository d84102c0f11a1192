"""The paper's passive cases: a wire pushed through its lumens without a field."""

from __future__ import annotations

import numpy as np
import pytest

from wires import PAPER, L, passive

# Peak F L^2/EI of an inextensible wire in hard contact, clamped at the entrance (no barrier).
HARD_CONTACT = {
    "half-circle-narrow": 24.6,
    "half-circle": 20.8,
    "half-circle-wide": 18.6,
    "sinusoid": 45.1,
}
# Where X first is a contact in an independent code of the same settings.
FIRST_CONTACT = {"half-circle": 0.12, "sinusoid": 0.10, "helix": 0.10}


@pytest.mark.parametrize("name", PAPER)
def test_every_step_converges_off_the_wall(name: str) -> None:
    run = passive(name)
    assert run.status == "CONVERGED"
    assert run.totals.steps == 7200
    assert run.totals.retries == 0
    smallest = min(np.nanmin(run.clearance), np.nanmin(run.between))
    assert smallest > 0.0
    assert smallest == run.totals.smallest_clearance


@pytest.mark.parametrize("name", HARD_CONTACT)
def test_peak_of_hard_contact(name: str) -> None:
    """The barrier costs less than the hundredth of the peak that the references are good for."""
    assert passive(name).peak == pytest.approx(HARD_CONTACT[name], rel=0.01)


@pytest.mark.parametrize("name", PAPER)
@pytest.mark.parametrize("coarse", [0.1])
def test_time_steps_agree(name: str, coarse: float) -> None:
    """10 and 100 ms, within 2 percent of the peak all along, and 0.1 percent of the peak."""
    fine, other = passive(name), passive(name, time_step=coarse)
    assert other.status == "CONVERGED"
    assert other.totals.smallest_clearance > 0.0
    np.testing.assert_allclose(other.X, fine.X, atol=1e-9)
    np.testing.assert_allclose(other.F, fine.F, atol=0.02 * fine.peak)
    assert other.peak == pytest.approx(fine.peak, rel=1e-3)


def test_a_millisecond_step_agrees() -> None:
    fine, other = passive("half-circle", time_step=0.001, push=0.3), passive("half-circle")
    assert fine.status == "CONVERGED"
    assert fine.totals.smallest_clearance > 0.0
    same = other.X <= 0.3 + 1e-9
    np.testing.assert_allclose(fine.F, other.F[same], atol=0.02 * other.peak)
    assert fine.peak == pytest.approx(other.peak, rel=1e-3)


def window(name: str, low: float, high: float, release: str) -> np.ndarray:
    run = passive(name, release=release)
    return run.F[(low <= run.X) & (high >= run.X)]


def test_first_contact_is_where_an_independent_code_has_it() -> None:
    for name, expected in FIRST_CONTACT.items():
        first = passive(name).totals.first_contact_feed / L
        assert first == pytest.approx(expected, abs=0.02)


@pytest.mark.parametrize(
    ("name", "low", "high", "expected"),
    [
        ("half-circle", 0.0, 0.72, 19.4),
        ("sinusoid", 0.10, 0.20, 37.5),
        ("sinusoid", 0.55, 0.70, 44.0),
        ("helix", 0.20, 0.35, 95.0),
    ],
)
def test_peaks_of_an_independent_code(name: str, low: float, high: float, expected: float) -> None:
    """It releases node by node, and so must be compared with that."""
    assert window(name, low, high, "node").max() == pytest.approx(expected, rel=0.03)


def test_plateaus_of_an_independent_code() -> None:
    assert window("half-circle", 0.4, 0.72, "node").mean() == pytest.approx(17.5, abs=0.5)
    late = window("helix", 0.43, 0.72, "node")
    assert np.all((late > 68.5) & (late < 71.5))
    assert np.all(window("sinusoid", 0.36, 0.52, "node") == 0.0)


def test_where_the_clamp_is_shows_early_and_hardly_late() -> None:
    """(P-15): node by node the clamp lies half an edge and more before the entrance."""
    early = [window("sinusoid", 0.10, 0.20, release).max() for release in ("sliding", "node")]
    late = [window("sinusoid", 0.55, 0.70, release).max() for release in ("sliding", "node")]
    assert early[0] > 1.1 * early[1]
    assert late[0] == pytest.approx(late[1], rel=0.02)


@pytest.mark.parametrize("name", PAPER)
def test_wall_pushes_inwards(name: str) -> None:
    """Frictionless contact: every wall force points from the wall to the centreline."""
    run = passive(name)
    curve = run.system.lumen.branches[0].curve
    for k in range(0, len(run.X), 40):
        size = np.linalg.norm(run.forces[k], axis=1)
        touching = size > 1e-3 * run.system.scales.force
        if not touching.any():
            continue
        points = run.positions[k][touching]
        arc, _ = run.system.lumen.locate(points)
        inwards = curve.at(arc)[:, :3] - points
        inwards /= np.linalg.norm(inwards, axis=1)[:, None]
        direction = run.forces[k][touching] / size[touching][:, None]
        np.testing.assert_allclose(np.sum(direction * inwards, axis=1), 1.0, atol=1e-9)

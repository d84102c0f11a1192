"""Vessels with a formula: the shapes they promise, seeds, and what is refused."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from magwire.errors import InputError
from magwire.lumen import Lumen
from magwire.vessel.synthetic import aortic_arch, carotid_bifurcation, coronary_tree, tortuous


def test_the_arch_is_entered_from_below_and_turns_back() -> None:
    arch = aortic_arch()
    assert arch.target == "left carotid"
    assert set(arch.outlets) == {
        "ascending aorta",
        "left subclavian",
        "left carotid",
        "brachiocephalic",
    }
    np.testing.assert_allclose(arch.direction, [0.0, 0.0, 1.0], atol=1e-4)
    aorta = arch.path("ascending aorta")
    assert aorta.length == pytest.approx(0.06 + np.pi * 0.035 + 0.05, rel=1e-4)
    assert aorta.radius_range == pytest.approx((11e-3, 14e-3))
    end, _ = aorta.centreline()
    np.testing.assert_allclose(end[-1], [0.07, 0.0, 0.01], atol=1e-6)
    heights = [arch.path(name).centreline()[0][-1, 2] for name in arch.outlets[1:]]
    assert min(heights) > 0.13  # above the arch, whose top is at 95 mm
    starts = [arch.path(name).length for name in arch.outlets[1:]]
    assert len(set(starts)) == 3


def test_the_carotids_part_to_both_sides_and_one_has_a_bulb() -> None:
    fork = carotid_bifurcation()
    ends = {name: fork.path(name).centreline()[0][-1] for name in fork.outlets}
    assert ends["internal"][0] > 5e-3
    assert ends["external"][0] < -5e-3
    inner = fork.path("internal").branches[0]
    past = inner.curve.at(np.linspace(0.055, inner.length, 200))[:, 3]
    assert past[0] > past[-1]
    assert np.argmax(past) > 0  # the bulb
    assert past[-1] == pytest.approx(0.72 * 3.2e-3, rel=1e-3)


@pytest.mark.parametrize("seed", range(6))
def test_coronary_trees_differ_by_their_seed_and_keep_to_murray(seed: int) -> None:
    tree = coronary_tree(seed=seed, diagonals=seed % 4)
    assert len(tree.outlets) == 2 + seed % 4
    assert tree.path("anterior").length == pytest.approx(0.102, rel=0.01)
    radius = tree.path("anterior").branches[0].curve.at(np.array([0.012 + 0.1 * 0.09]))[0, 3]
    untapered = radius / (1.0 - 0.4 * 0.1)
    assert 2.0 * untapered**3 == pytest.approx((2.2e-3) ** 3, rel=0.03)
    again = coronary_tree(seed=seed, diagonals=seed % 4)
    for one, two in zip(tree.branches, again.branches, strict=True):
        np.testing.assert_array_equal(one.points, two.points)
    other = coronary_tree(seed=seed + 1)
    assert np.abs(other.branches[0].points - tree.branches[0].points).max() > 1e-4


@pytest.mark.parametrize("seed", range(6))
def test_tortuous_vessels_taper_and_wind_as_much_as_asked_for(seed: int) -> None:
    vessel = tortuous(seed=seed, amplitude=5e-3)
    points, radius = vessel.centreline()
    assert (radius[0], radius[-1]) == pytest.approx((3e-3, 1.5e-3))
    np.testing.assert_allclose(vessel.direction, [1.0, 0.0, 0.0], atol=0.02)
    late = points[points[:, 0] > 0.03]
    sway = np.linalg.norm(late[:, 1:] - late[:, 1:].mean(axis=0), axis=1)
    assert 2e-3 < np.sqrt(np.mean(sway**2)) < 8e-3
    assert tortuous(amplitude=0.0).length == pytest.approx(0.12)


REFUSED: dict[str, Callable[[], Lumen]] = {
    "Input arch_radius of aortic_arch must be larger than the lumen's radius 0.014 m": (
        lambda: aortic_arch(arch_radius=12e-3)
    ),
    "Input radius of aortic_arch must be positive; received -1 m.": (
        lambda: aortic_arch(radius=-1.0)
    ),
    "Input diagonals of coronary_tree must be at most 3; received 4.": (
        lambda: coronary_tree(diagonals=4)
    ),
    "Input seed of tortuous must be at least 0; received -1.": lambda: tortuous(seed=-1),
    "Input target of Lumen must be one of the outlets 'internal', 'external'": (
        lambda: carotid_bifurcation(target="common")
    ),
}


@pytest.mark.parametrize("message", REFUSED)
def test_what_makes_no_sense_is_refused(message: str) -> None:
    with pytest.raises(InputError) as raised:
        REFUSED[message]()
    assert message in str(raised.value)

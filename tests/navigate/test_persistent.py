"""Going back and trying again, in the branch at a junction that is not the target's."""

from __future__ import annotations

import numpy as np
import pytest

import magwire as mw
from magwire.navigate.persistent import PersistentNavigator, Ways
from magwire.scenario import load, schedule_of

TREE = load("left-branch").lumen.build()
CONTACT = mw.Barrier(1e3, 1e-4, wall="centreline")


def wire(magnetization: float) -> mw.Wire:
    """The paper's wire, with a magnet that is not what it should be."""
    return mw.Wire.uniform(
        length=0.1,
        radius=0.6e-3,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=51,
        magnetized_tip=5e-3,
        magnetization=magnetization,
    )


def steered(believed: float, attempts: int = 4) -> tuple[mw.Result, PersistentNavigator]:
    """A run by a navigator that believes in another magnet than the wire has, which is 128 kA/m."""
    model = mw.Simulation(wire(believed), TREE, contact=CONTACT)
    navigator = PersistentNavigator(mw.StableNavigator(model.system), TREE, attempts)
    result = mw.Simulation(wire(128e3), TREE, contact=CONTACT).run(
        mw.Feed(speed=2e-3, distance=0.05),
        navigator,
        motion="quasi-static",
        record_every=5e-4,
        update_every=5e-4,
    )
    return result, navigator


def test_in_which_way_a_point_is() -> None:
    ways = Ways(TREE)
    for name in TREE.outlets:
        tube = TREE.paths[name]
        place = tube.curve.at(np.array([0.97 * tube.length]))[0, :3]
        assert ways.strayed(place) == (None if name == "left" else name)
        gap, arc, radius = ways.deepest(name, place)
        assert (gap, arc) == pytest.approx((radius, 0.97 * tube.length), abs=3e-4)
        trunk = tube.curve.at(np.array([0.2 * tube.length]))[0, :3]
        assert ways.strayed(trunk) is None
    past = TREE.path("left").centreline()[0][-1] + 4e-3 * np.array([0.0, 1.0, 0.0])
    assert ways.strayed(past) is None  # through the outlet


def test_where_a_way_leaves() -> None:
    ways = Ways(TREE)
    junction = ways.junction(0.0, TREE.length)
    assert junction is not None
    assert 0.025 < junction < 0.033  # the trunk is straight for 25 mm
    assert ways.junction(0.04, TREE.length) is None
    assert ways.junction(0.0, 0.02) is None


def test_a_tip_in_the_wrong_branch_is_taken_back_and_sent_anew() -> None:
    """A wire with half the magnet goes astray, and arrives with the tip nearer to the middle."""
    result, navigator = steered(256e3)
    assert result.status == "complete"
    assert len(navigator.notes) == 1
    assert "the tip is on the path to 'right', not to 'left'" in result.message
    assert "with tip_clearance 0.7" in result.message
    turn = int(np.argmax(np.diff(result.feed) < 0.0))
    back = float(result.feed[turn:].min())
    assert back < Ways(TREE).junction(0.0, TREE.length)  # type: ignore[operator]
    assert result.feed[-1] == pytest.approx(0.05)
    assert Ways(TREE).strayed(result.position[-1][-1]) is None
    assert TREE.path("left").gap(result.position[-1][-1:])[0] > 0.0


@pytest.mark.parametrize("attempts", [1, 2, 4])
def test_it_gives_up_in_the_end(attempts: int) -> None:
    """A magnet of the wrong sign: nothing that the navigator tries can help."""
    result, navigator = steered(-128e3, attempts)
    assert result.status == "no field"
    assert len(navigator.notes) == attempts - 1
    assert ", not to 'left'." in result.message
    assert ("It was tried again" in result.message) == (attempts > 1)


def test_in_the_wires_own_field_on_the_way_back() -> None:
    """On the detour the field is that of the same feeds before, and does not jump at its ends."""
    result, _ = steered(256e3)
    turn = int(np.argmax(np.diff(result.feed) < 0.0))
    low = turn + int(np.argmin(result.feed[turn:]))
    came = np.column_stack(
        [np.interp(result.feed[turn:low], result.feed[: turn + 1], f)
         for f in result.field[: turn + 1].T]
    )  # fmt: skip
    scale = np.abs(result.field).max()
    np.testing.assert_allclose(result.field[turn:low], came, rtol=0, atol=0.02 * scale)
    jumps = np.linalg.norm(np.diff(result.field, axis=0), axis=1)
    assert jumps[low : low + 3].max() < 0.1 * scale


def test_schedule_of_a_run_with_a_detour_is_that_of_the_last_try() -> None:
    result, _ = steered(256e3)
    schedule = schedule_of(result)
    low = int(np.argmax(np.diff(result.feed) < 0.0))
    low += int(np.argmin(result.feed[low:]))
    after = schedule.at(result.feed[low + 1 :])
    np.testing.assert_allclose(after, result.field[low + 1 :], rtol=0, atol=1e-12)


def test_only_trees_have_second_attempts() -> None:
    for name, kind in (("half-circle", mw.StableNavigator), ("left-branch", PersistentNavigator)):
        job = load(name).build()
        assert isinstance(job.scenario.navigate.build(job.simulation), kind)
        assert isinstance(mw.TipNavigator().start(job.simulation.system), kind)

"""A wire that is stepped from outside: against runs, back and forth, snapshots, navigators."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import magwire as mw
from magwire.operate import March

L = 0.1
DT = 0.01


def paper_wire(nodes: int = 60) -> mw.Wire:
    return mw.Wire.uniform(
        length=L,
        radius=0.6e-3,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=nodes,
        magnetized_tip=5e-3,
        magnetization=128e3,
    )


def half_circle(**options: object) -> mw.Simulation:
    lumen = mw.Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
    return mw.Simulation(paper_wire(), lumen, **options)  # type: ignore[arg-type]


def test_steps_are_those_of_a_run() -> None:
    simulation = half_circle()
    run = March(simulation.system, simulation.field, mw.Feed(4e-3, 0.03), time_step=DT)
    assert run.advance(10**6)
    with simulation.session(time_step=DT) as wire:
        for _ in range(run.steps):
            wire.step(feed_speed=4e-3)
        np.testing.assert_allclose(
            wire.record().position, run.plant.record().position, atol=1e-9 * L
        )
        seen, full = wire.observe(), run.plant.record()
    assert seen.tip_force == pytest.approx(full.tip_force, rel=1e-6)
    assert seen.tip_force > 1e-5
    assert seen.time == pytest.approx(full.time)


def test_an_observation_is_what_a_record_says() -> None:
    simulation = half_circle()
    with simulation.session(feed=0.045, record_every=10.0) as wire:
        wire.step(feed_speed=1e-3, inputs=[0.0, 0.01, 0.002])
        seen, full = wire.observe(), wire.record()
        np.testing.assert_array_equal(seen.inputs, [0.0, 0.01, 0.002])
    forces = np.linalg.norm(full.contact_force, axis=1)
    np.testing.assert_allclose(seen.tip, full.position[-1])
    assert seen.tip_force == pytest.approx(full.tip_force)
    assert seen.wall_force == pytest.approx(forces.sum())
    assert seen.clearance == pytest.approx(np.nanmin(full.clearance))
    assert seen.patch_force == pytest.approx(wire.result.dataset["patch_force"].values[-1])
    assert 0.0 < seen.patch_force <= seen.wall_force * (1.0 + 1e-12)
    assert wire.result.status == "complete"


@pytest.mark.parametrize(
    "inputs", [0.01, [0.01], [0.0, 0.0, 0.0, 0.0], [[0.0], [0.0, 0.01]], "x", np.zeros((3, 1))]
)
def test_a_step_takes_as_many_inputs_as_there_are(inputs: object) -> None:
    with half_circle().session() as wire:
        with pytest.raises(mw.InputError, match="Input inputs of Command must"):
            wire.step(feed_speed=1e-3, inputs=inputs)  # type: ignore[arg-type]
        assert wire.observe().feed == 0.0
        wire.step(feed_speed=1e-3, inputs=[0.0, 0.01, 0.0])


def test_a_watcher_that_is_none_is_refused() -> None:
    run = half_circle()
    with pytest.raises(mw.InputError, match=r"Input watch of Simulation\.run must be"):
        run.run(mw.Feed(1e-3, 0.002), watch=[3])  # type: ignore[list-item]


def test_a_result_is_there_when_the_session_has_ended() -> None:
    with half_circle().session(record_every=0.1) as wire:
        wire.step(feed_speed=1e-3, duration=0.1)
        with pytest.raises(mw.ResultError, match="ask for it after its with statement"):
            _ = wire.result
    assert wire.result.time.size == 2


def test_one_chunk_is_many_steps() -> None:
    chance = np.random.default_rng(3)
    speeds = chance.choice([2e-3, -1e-3, 4e-3], 60)
    inputs = np.cumsum(chance.uniform(-2e-4, 2e-4, (60, 3)), axis=0)
    with half_circle().session(feed=0.03, time_step=DT) as wire:
        start = wire.snapshot()
        for speed, u in zip(speeds, inputs, strict=True):
            wire.step(feed_speed=speed, twist_rate=0.5, inputs=u)
        there = wire.record().position
        wire.restore(start)
        wire.advance([mw.Command(v, 0.5, u, DT) for v, u in zip(speeds, inputs, strict=True)])
        np.testing.assert_allclose(wire.record().position, there, atol=1e-9 * L)
        assert wire.observe().twist == pytest.approx(0.3)


def test_an_interval_is_cut_into_time_steps() -> None:
    with half_circle().session(time_step=DT) as wire:
        wire.step(feed_speed=2e-3, inputs=[0.0, 6e-3, 0.0], duration=0.1)
        assert wire.plant.totals.steps == 10
        assert wire.observe().feed == pytest.approx(2e-4)
        wire.step(duration=0.5 * DT)
        assert wire.plant.totals.steps == 11
        np.testing.assert_array_equal(wire.observe().inputs, [0.0, 6e-3, 0.0])


def test_a_restored_wire_goes_on_bit_for_bit() -> None:
    """In the middle of a retraction, in contact, with inputs that change."""
    with half_circle().session(time_step=DT) as wire:
        wire.step(feed_speed=4e-3, duration=12.0)
        wire.step(feed_speed=-2e-3, inputs=[0.0, 4e-3, 1e-3], duration=1.234)
        assert wire.observe().tip_force > 0.0
        kept = wire.snapshot()
        ends = []
        for _ in range(2):
            wire.restore(kept)
            for k in range(100):
                wire.step(feed_speed=-2e-3 if k < 60 else 1e-3, inputs=[0.0, 4e-3 - 1e-5 * k, 0.0])
            ends.append((wire.record().position, wire.observe().feed))
    assert ends[0][1] == ends[1][1]
    assert np.array_equal(ends[0][0], ends[1][0])


def test_another_wire_of_the_same_kind_takes_up_a_snapshot() -> None:
    simulation = half_circle()
    with simulation.session(time_step=DT) as one, simulation.session(time_step=DT) as other:
        one.step(feed_speed=4e-3, duration=10.0)
        other.restore(one.snapshot())
        for wire in (one, other):
            wire.step(feed_speed=1e-3, duration=0.5)
        assert np.array_equal(one.record().position, other.record().position)


def test_back_to_anywhere_and_stay_there() -> None:
    """To where the wire has never stopped; it comes to rest where an equilibrium is."""
    simulation = half_circle(damping=20.0)
    with simulation.session(time_step=0.02) as wire:
        wire.step(feed_speed=4e-3, duration=11.0)
        wire.step(feed_speed=-4e-3, duration=4.2515)
        wire.step(duration=3.0)
        assert wire.observe().feed == pytest.approx(4e-3 * (11.0 - 4.2515))
        still = simulation.equilibrium(wire.observe().feed)
        np.testing.assert_allclose(wire.observe().tip, still.tip, atol=1e-4 * L)
        assert wire.stable


def test_the_guide_stops_at_its_ends() -> None:
    with half_circle().session() as wire:
        wire.step(feed_speed=-1.0)
        assert wire.observe().feed == 0.0
    straight = mw.Simulation(paper_wire(), mw.Lumen.straight(0.2, 3e-3))
    with straight.session(feed=0.99 * L) as wire:
        wire.step(feed_speed=10e-3, duration=1.0)
        assert wire.observe().feed == pytest.approx(L)


def test_a_navigator_steers_what_another_feeds() -> None:
    """Back and forth by hand, with the navigator's inputs: the tip stays free."""
    navigator = mw.TipNavigator(update_every=1e-3)
    with half_circle().session(navigator=navigator, time_step=0.05) as wire:
        pushed = []
        for speed, count in ((4e-3, 90), (-4e-3, 20), (4e-3, 40)):
            for _ in range(count):
                wire.step(feed_speed=speed)
                pushed.append(wire.observe().tip_force)
        assert wire.observe().feed == pytest.approx(4e-3 * 0.05 * 110)
        assert np.linalg.norm(wire.observe().inputs) > 1e-3
        assert max(pushed) == 0.0


def test_a_recording_is_a_result(tmp_path: Path) -> None:
    with half_circle().session(record_every=0.1, out=tmp_path / "hand.nc") as wire:
        wire.step(feed_speed=4e-3, duration=1.0)
        wire.step(feed_speed=-4e-3, duration=0.5)
    result = mw.Result.load(tmp_path / "hand.nc")
    assert result.status == "complete"
    np.testing.assert_allclose(result.time, 0.1 * np.arange(16), atol=1e-9)
    np.testing.assert_allclose(result.feed[[10, 15]], [4e-3, 2e-3], atol=1e-9)


@pytest.mark.parametrize("how", ["step", "interval", "advance", "restore"])
def test_what_is_recorded_no_more_is_not_stepped(how: str) -> None:
    with half_circle().session(record_every=0.1) as wire:
        wire.step(feed_speed=4e-3)
        before = wire.snapshot()
    acts = {
        "step": lambda: wire.step(feed_speed=4e-3),
        "interval": lambda: wire.step(feed_speed=4e-3, duration=1.0),
        "advance": lambda: wire.advance([mw.Command(4e-3)]),
        "restore": lambda: wire.restore(before),
    }
    with pytest.raises(mw.InputError, match="has ended with its 'with' statement"):
        acts[how]()
    assert wire.observe().feed == before.feed


def test_a_step_that_fails_leaves_the_wire_and_says_why() -> None:
    simulation = half_circle()
    with simulation.session(feed=0.03, record_every=1.0) as wire:
        before = []

        def shake() -> None:
            for _ in range(50):
                before.append(wire.record().position)
                wire.step(feed_speed=4e-3, inputs=[0.0, -40.0, 0.0], duration=1e-3)

        with pytest.raises(mw.ConvergenceError, match="did not converge"):
            shake()
        assert np.array_equal(wire.record().position, before[-1])
    assert wire.result.status == "not converged"


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"feed_speed": float("nan")}, "feed_speed of Command must be a finite"),
        ({"twist_rate": float("inf")}, "twist_rate of Command must be a finite"),
        ({"inputs": [0.0, float("nan"), 0.0]}, "inputs of Command must be finite"),
        ({"duration": 0.0}, "duration of Command must be positive"),
    ],
)
def test_absurd_commands_are_refused(given: dict[str, object], said: str) -> None:
    with half_circle().session() as wire, pytest.raises(mw.InputError, match=said):
        wire.step(**given)  # type: ignore[arg-type]


def test_a_force_limit_ends_a_run() -> None:
    limit = mw.ForceLimit(wall=2e-4)
    result = half_circle().run(mw.Feed(4e-3, 0.05), time_step=0.05, watch=[limit])
    assert result.status == "force limit"
    assert "the wall force is" in result.message
    assert "the limit is 0.2 mN" in result.message
    assert result.dataset["wall_force"].values[-1] > 2e-4 > result.dataset["wall_force"].values[-2]


def test_a_navigator_knows_the_background() -> None:
    """A field that is there anyhow: steering that did not know it would press on the wall."""
    simulation = half_circle(field=mw.UniformField((0.0, -0.01, 0.0)))
    result = simulation.run(mw.Feed(4e-3, 0.04), mw.TipNavigator(update_every=1e-3), time_step=0.05)
    assert result.status == "complete"
    assert result.max_tip_force == 0.0


def test_what_is_no_command_is_refused() -> None:
    with half_circle().session() as robot:
        with pytest.raises(mw.InputError, match="twist_rate of Command must be a number"):
            robot.step(2e-3, [0.0, 0.0, 0.0], 0.1)  # type: ignore[arg-type]
        with pytest.raises(mw.InputError, match="must be of Command; received tuple"):
            robot.advance([(2e-3, 0.0)])  # type: ignore[list-item]
        with pytest.raises(mw.InputError, match="must be a Snapshot; received NoneType"):
            robot.restore(None)  # type: ignore[arg-type]
        assert robot.observe().time == 0.0

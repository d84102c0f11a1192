"""Single environments: Gymnasium's own check, determinism, forces, what is observed."""

from __future__ import annotations

import itertools
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from magwire import InputError
from magwire.engine.command import Command
from magwire.engine.system import System
from magwire.env import WireEnv, from_scenario, names
from magwire.env.anatomy import draw
from magwire.env.ids import options_of
from magwire.env.task import Task
from magwire.kernels.newton import Limits

SHORT: dict[str, Any] = {"overrides": ("wire.nodes=50",), "input_limit": 40e-3}


LIMITS = System.step_limits


def hopeless(system: System) -> Limits:
    """Limits that no residual and no step can keep to."""
    return LIMITS(system)._replace(tolerance=-1.0, step=-1.0, iterations=3)


def play(env: gymnasium.Env[Any, Any], seed: int, count: int) -> list[Any]:
    """Observations, rewards and infos of random actions that mostly push."""
    chance = np.random.default_rng(seed)
    observed, info = env.reset(seed=seed)
    told: list[Any] = [(observed, 0.0, info)]
    for _ in range(count):
        action = chance.uniform([-0.2, -1, -1, -1, -1], 1.0).astype(np.float32)
        observed, reward, _, _, info = env.step(action)
        told.append((observed, reward, info))
    return told


@pytest.mark.parametrize("name", names())
def test_gymnasium_finds_nothing_to_warn_of(name: str) -> None:
    env = gymnasium.make(name, render_mode="rgb_array")
    check_env(env.unwrapped)
    env.close()


def test_the_same_seed_gives_the_same_bits() -> None:
    first, again = (play(WireEnv(**options_of("HalfCircle")), 3, 30) for _ in range(2))
    for (seen, reward, info), (other, reward_too, info_too) in zip(first, again, strict=True):
        assert np.array_equal(seen, other)
        assert reward == reward_too
        assert np.array_equal(info["command"], info_too["command"])
    assert not np.array_equal(first[-1][0], play(WireEnv(**options_of("HalfCircle")), 4, 30)[-1][0])


def test_an_episode_does_not_know_the_one_before() -> None:
    env = WireEnv(**SHORT)
    fresh = play(env, 5, 40)
    play(env, 6, 40)
    for (seen, reward, _), (other, too, _) in zip(fresh, play(env, 5, 40), strict=True):
        assert np.array_equal(seen, other)
        assert reward == too


def test_forces_are_those_of_a_replayed_session() -> None:
    env = WireEnv(input_error=0.1, **SHORT)
    told = play(env, 1, 60)
    simulation = env.episodes.anatomies[0].simulation
    with simulation.session(time_step=env.episodes.batch.time_step) as session:
        for _, _, info in told[1:]:
            speed, rate, *inputs = info["command"]
            session.advance([Command(speed, rate, inputs, env.task.action_time)])
            seen = session.observe()
            assert info["tip_force"] == seen.tip_force
            assert info["max_wall_force"] == seen.patch_force
    pressed = [info["max_wall_force"] for _, _, info in told]
    assert max(pressed) > 0.0
    assert all(
        info["cost"] == max(info["max_wall_force"] - env.task.force_limit, 0.0)
        for _, _, info in told
    )


def test_the_reward_is_what_the_documentation_says() -> None:
    env = WireEnv(force_limit=1e-5, **SHORT)
    told = play(env, 2, 30)
    for (_, _, before), (_, reward, info) in itertools.pairwise(told):
        gained = min(info["progress"], 1.0) - before["progress"]
        expected = 10.0 * gained - 0.2 / env.task.actions
        expected -= 0.05 * min((info["tip_force"] + info["cost"]) / 1e-5, 10.0)
        assert reward == pytest.approx(expected + info["success"], abs=1e-12)


def test_a_wire_that_arrives_ends_its_episode() -> None:
    env = WireEnv(goal=0.2, **SHORT)
    env.reset(seed=0)
    count, terminated = 0, False
    while not terminated and count < 60:
        _, reward, terminated, truncated, info = env.step(np.array([1, 0, 0, 0, 0], np.float32))
        count += 1
    assert info["success"]
    assert not truncated
    assert reward > 1.0
    assert count == pytest.approx(0.2 * 72e-3 / 0.5e-3, abs=4.0)


def test_a_step_that_does_not_converge_ends_the_episode(monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(System, "step_limits", hopeless)
        env = WireEnv(**SHORT)
    env.reset(seed=0)
    _, _, terminated, truncated, info = env.step(np.ones(5, np.float32))
    for _ in range(20):
        if truncated:
            break
        _, _, terminated, truncated, info = env.step(np.ones(5, np.float32))
    assert info["unconverged"]
    assert not terminated
    _, info = env.reset(seed=0)
    assert not info["unconverged"]


def test_observations_come_late_and_not_every_time() -> None:
    told = [seen for seen, _, _ in play(WireEnv(**SHORT), 7, 12)]
    late = [seen for seen, _, _ in play(WireEnv(delay=2, **SHORT), 7, 12)]
    rare = [seen for seen, _, _ in play(WireEnv(observe_every=3, **SHORT), 7, 12)]
    for k in range(13):
        assert np.array_equal(late[k], told[max(k - 2, 0)])
        assert np.array_equal(rare[k], told[k - k % 3])


def test_noise_is_as_large_as_it_is_said_to_be() -> None:
    env = WireEnv(noise=2e-4, **SHORT)
    env.reset(seed=0, options={"feed": 0.02})
    still = [env.step(np.zeros(5, np.float32))[0] for _ in range(300)]
    off = np.array(still)[50:, :2] * 3e-3  # in radii of the lumen
    assert np.std(off, axis=0) == pytest.approx([2e-4, 2e-4], rel=0.2)


def test_the_observation_is_what_the_documentation_says() -> None:
    env = WireEnv(**SHORT)
    env.reset(seed=0, options={"feed": 0.03})
    action = np.array([0.3, 0.1, 0.4, -0.3, 0.2], np.float32)
    for _ in range(3):
        seen, *_ = env.step(action)
    sight = env.episodes.batch.observe()
    path = env.episodes.anatomies[0].simulation.system.path
    arc = sight.tip_arc[0]
    off = np.hypot(*(seen[:2] * 3e-3))
    assert off == pytest.approx(float(path.offset(sight.tip)[0]), rel=1e-3)
    curve = path.branches[0].curve
    along = curve.at(np.array([arc]), 1)[0, :3]
    assert seen[2] == pytest.approx(along @ sight.tip_direction[0], abs=1e-4)
    assert np.linalg.norm(seen[2:5]) == pytest.approx(1.0, abs=1e-4)
    assert seen[5] * env.episodes.anatomies[0].goal == pytest.approx(arc, rel=1e-5)
    assert seen[12:17] == pytest.approx(action)
    way = curve.at(np.array([arc, arc + 5e-3]))[:, :3]
    assert np.linalg.norm(seen[21:24]) == pytest.approx(
        np.linalg.norm(way[1] - way[0]) / 5e-3, rel=1e-3
    )
    assert np.linalg.norm(seen[9:12] * 40e-3) == pytest.approx(
        np.linalg.norm(sight.inputs[0]), rel=1e-3
    )


def test_inputs_change_no_faster_than_they_may() -> None:
    env = WireEnv(axes="world", input_rate=0.1, **SHORT)
    env.reset(seed=0)
    fields = [env.step(np.array([0, 0, 1, -1, 0.05], np.float32))[-1]["command"][2:] for _ in "ab"]
    assert fields[0] == pytest.approx([5e-3, -5e-3, 2e-3], rel=1e-6)
    assert fields[1] == pytest.approx([10e-3, -10e-3, 2e-3], rel=1e-6)


def test_every_reset_of_the_random_vessel_is_another_one() -> None:
    env = WireEnv(**options_of("RandomVessel"))
    vessels = []
    for seed in (0, 1, 0):
        env.reset(seed=seed)
        vessels.append(env.episodes.anatomies[0].path)
    assert np.array_equal(vessels[0], vessels[2])
    assert not np.array_equal(vessels[0], vessels[1])


def test_seeds_to_train_and_to_test_are_apart() -> None:
    drawn: dict[str, set[str]] = {"train": set(), "test": set()}
    for split, found in drawn.items():
        task = Task(randomise={"lumen.seed": (0, 9)}, split=split)  # type: ignore[arg-type]
        for seed in range(60):
            found |= set(draw(task, np.random.default_rng(seed)))
    assert drawn["train"] == {f"lumen.seed={k}" for k in range(5)}
    assert drawn["test"] == {f"lumen.seed={k}" for k in range(5, 10)}


def test_keys_of_the_scenario_are_drawn_from_their_ranges() -> None:
    env = WireEnv(
        randomise={"wire.youngs_modulus": ("2 MPa", "4 MPa"), "lumen.radius": ("2.5 mm", "3 mm")},
        **SHORT,
    )
    moduli = []
    for seed in range(8):
        env.reset(seed=seed)
        scenario = env.episodes.anatomies[0].job.scenario
        moduli.append(scenario.wire.youngs_modulus)  # type: ignore[union-attr]
        assert 2.5e-3 <= scenario.lumen.radius <= 3e-3  # type: ignore[union-attr]
    assert all(2e6 <= value <= 4e6 for value in moduli)
    assert len(set(moduli)) == 8


def test_ranges_that_make_no_sense_are_refused() -> None:
    chance = np.random.default_rng(0)
    for pair, words in (
        (("2 MPa", "4 kPa"), "in the same unit"),
        (("thick", "thin"), "as numbers or quantities"),
    ):
        with pytest.raises(InputError, match=words):
            draw(Task(randomise={"wire.radius": pair}), chance)


def test_a_scenario_of_the_library_is_an_environment() -> None:
    env = from_scenario(
        "straight", overrides=("wire.nodes=30",), image=True, render_mode="rgb_array"
    )
    check_env(env, skip_render_check=True)  # which takes an id
    observed, _ = env.reset(seed=0)
    assert observed["image"].shape == (84, 84, 1)
    for _ in range(30):
        later, *_ = env.step(np.array([1, 0, 0, 0, 0], np.float32))
    darker = later["image"].astype(int) < observed["image"].astype(int)
    assert 5 < darker.sum() < 200  # a thin dark wire has come into the picture
    frame = env.render()
    assert frame is not None
    red = (frame[..., 0] > 150) & (frame[..., 1] < 80)
    assert 10 < red.sum() < 2000  # the magnet

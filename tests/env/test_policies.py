"""Baselines, the trained example's pieces, and the adapter to Stable-Baselines3."""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from magwire import InputError
from magwire.env import TASKS, WireVectorEnv, to_sb3
from magwire.env.baselines import Chance, Linear, Navigator, interval, retract, score, still
from magwire.env.ids import options_of

SHORT: dict[str, Any] = {"overrides": ("wire.nodes=40",), "input_limit": 40e-3}


def wires(count: int, **more: Any) -> WireVectorEnv:
    return WireVectorEnv(count, autoreset_mode="Disabled", **{**SHORT, **more})


def test_baselines_come_in_their_order() -> None:
    env = wires(3, scenario="half-circle", starts=(0.0, 2e-3))
    returns = {}
    for name, policy in {
        "still": still,
        "retract": retract,
        "random": Chance(1),
        "navigator": Navigator(),
    }.items():
        total = score(env, policy, [1, 2, 3])
        returns[name] = total["returns"].mean()
        assert np.all(total["length"] <= env.task.actions)
    assert returns["still"] == pytest.approx(-0.2)
    assert returns["retract"] <= returns["still"]
    assert returns["random"] < 2.0
    assert returns["navigator"] > 10.0


def test_the_navigator_gets_the_field_that_it_planned() -> None:
    env = wires(2, scenario="half-circle", input_error=0.2)
    policy = Navigator()
    observed, _ = env.reset(seed=[1, 2])
    assert np.array_equal(env.episodes.measured_factors(), np.ones((2, 3)))
    for _ in range(40):
        env.episodes.act(policy(env, observed))
    seen = env.episodes.batch.observe()
    (_, plan), *_ = policy._plans.values()
    factors = env.episodes.measured_factors()
    assert np.abs(factors - 1.0).max() > 0.1
    assert np.linalg.norm(seen.inputs, axis=1).min() > 5e-3
    np.testing.assert_allclose(seen.inputs, plan.at(seen.feed), atol=1e-6)


def test_a_linear_policy_is_its_weights() -> None:
    env = wires(2)
    observed, _ = env.reset(seed=0)
    weights = np.random.default_rng(0).normal(size=(5, 34))
    expected = observed @ weights[:, :-1].T + weights[:, -1]
    assert Linear(weights)(env, observed) == pytest.approx(expected, abs=1e-9)
    each = Linear(np.stack([weights, -weights]))(env, observed)
    assert each[1] == pytest.approx(-expected[1], abs=1e-9)


def test_the_interval_is_that_of_a_normal_mean() -> None:
    mean, half = interval(np.array([1.0, 2.0, 3.0, 4.0]))
    assert mean == 2.5
    assert half == pytest.approx(1.96 * np.sqrt(5.0 / 3.0 / 4.0))


def test_options_of_a_name_are_its_task() -> None:
    assert set(TASKS) >= {"HalfCircle", "RandomVessel"}
    options = options_of("Helix", split="test")
    assert options["scenario"] == "helix"
    assert options["split"] == "test"


class StandIn:
    """What ``to_sb3`` uses of VecEnv of Stable-Baselines3 2.x."""

    def __init__(self, num_envs: int, observation_space: Any, action_space: Any) -> None:
        self.num_envs = num_envs
        self.observation_space, self.action_space = observation_space, action_space
        self.reset_infos: list[Any] = [{} for _ in range(num_envs)]
        self._reset_seeds()
        self._reset_options()
        self.get_attr("render_mode")  # type: ignore[attr-defined]

    def _reset_seeds(self) -> None:
        self._seeds: list[int | None] = [None] * self.num_envs

    def _reset_options(self) -> None:
        self._options: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]

    def seed(self, seed: int) -> None:
        self._seeds = [seed + i for i in range(self.num_envs)]


@pytest.fixture
def _baselines(monkeypatch: pytest.MonkeyPatch) -> None:
    module = ModuleType("stable_baselines3.common.vec_env")
    module.VecEnv = StandIn  # type: ignore[attr-defined]
    for name in ("stable_baselines3", "stable_baselines3.common"):
        monkeypatch.setitem(sys.modules, name, ModuleType(name))
    monkeypatch.setitem(sys.modules, module.__name__, module)


@pytest.mark.usefixtures("_baselines")
def test_stable_baselines_gets_what_it_expects() -> None:
    task: dict[str, Any] = {**SHORT, "actions": 6}
    here = to_sb3(WireVectorEnv(2, autoreset_mode="SameStep", **task))
    same = WireVectorEnv(2, autoreset_mode="SameStep", **task)
    here.seed(4)
    assert np.array_equal(here.reset(), same.reset(seed=4)[0])
    push = np.array([[1, 0, 0, 0, 0]] * 2, np.float32)
    for step in range(1, 8):
        here.step_async(push)
        observed, rewards, dones, infos = here.step_wait()
        expected = same.step(push)
        assert np.array_equal(observed, expected[0])
        assert np.array_equal(rewards, expected[1])
        assert dones.tolist() == [step == 6] * 2
        assert infos[0]["TimeLimit.truncated"] is (step == 6)
        if step == 6:
            assert np.array_equal(infos[1]["terminal_observation"], expected[4]["final_obs"][1])
            assert infos[1]["progress"] == expected[4]["final_info"]["progress"][1]
            assert here.reset_infos[1]["progress"] == 0.0
    assert here.env_is_wrapped(object) == [False, False]


@pytest.mark.usefixtures("_baselines")
def test_stable_baselines_resets_in_the_same_step() -> None:
    with pytest.raises(InputError, match="must be 'SameStep' for to_sb3; received 'NextStep'"):
        to_sb3(WireVectorEnv(1, **SHORT))

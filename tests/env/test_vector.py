"""The native vector environment does what single ones do, one after the other."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode, SyncVectorEnv

from magwire import InputError
from magwire.env import WireEnv, WireVectorEnv

TASK: dict[str, Any] = {
    "overrides": ("wire.nodes=40",),
    "starts": (0.0, 2e-3, 4e-3),
    "input_error": 0.05,
    "noise": 1e-4,
    "goal": 0.1,
    "actions": 14,
    "delay": 1,
}
WIRES = 5


def equal(one: Any, other: Any) -> bool:
    """Whether two infos or observations are the same, bit for bit."""
    if isinstance(one, dict):
        return set(one) == set(other) and all(equal(one[name], other[name]) for name in one)
    if isinstance(one, np.ndarray) and one.dtype == object:
        return all(equal(a, b) for a, b in zip(one, other, strict=True))
    return bool(np.array_equal(one, other))


def actions(step: int) -> Any:
    chance = np.random.default_rng(step)
    return chance.uniform([-0.1, -1, -1, -1, -1], 1.0, (WIRES, 5)).astype(np.float32)


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
def test_it_is_gymnasiums_own_loop_over_single_ones(mode: AutoresetMode, threads: int) -> None:
    here = WireVectorEnv(WIRES, autoreset_mode=mode, threads=threads, **TASK)
    there = SyncVectorEnv([lambda: WireEnv(**TASK)] * WIRES, autoreset_mode=mode)
    assert here.metadata["autoreset_mode"] is mode
    assert here.observation_space == there.observation_space
    assert here.action_space == there.action_space
    ours, theirs = here.reset(seed=11), there.reset(seed=11)
    assert equal(ours[0], theirs[0])
    ended = 0
    for step in range(40):
        ours, theirs = here.step(actions(step)), there.step(actions(step))
        ended += int(np.sum(ours[2] | ours[3]))
        for mine, other in zip(ours[:4], theirs[:4], strict=True):
            assert equal(mine, other)
        kept = {k: v for k, v in ours[4].items() if k.strip("_") != "final_info"}
        assert equal(kept, {k: v for k, v in theirs[4].items() if k.strip("_") != "final_info"})
        for name in theirs[4].get("final_info", {}):
            assert equal(ours[4]["final_info"][name], theirs[4]["final_info"][name])
    assert ended > WIRES


def test_disabled_waits_for_a_reset_by_mask() -> None:
    env = WireVectorEnv(WIRES, autoreset_mode="Disabled", **TASK)
    env.reset(seed=11)
    ended = np.zeros(WIRES, dtype=bool)
    step = 0
    while not ended.any():
        observed, _, terminated, truncated, _ = env.step(actions(step))
        ended = terminated | truncated
        step += 1
    with pytest.raises(InputError, match="must be reset by"):
        env.step(actions(step))
    before = observed.copy()
    observed, info = env.reset(options={"reset_mask": ended})
    assert np.array_equal(observed[~ended], before[~ended])
    assert not np.array_equal(observed[ended], before[ended])
    assert np.array_equal(info["_progress"], ended)
    env.step(actions(step))


def test_order_and_number_of_threads_do_not_matter() -> None:
    seeds = [3, 1, 4, 15, 9]
    order = [2, 0, 4, 3, 1]
    plain = WireVectorEnv(WIRES, threads=1, autoreset_mode="Disabled", **{**TASK, "actions": 99})
    mixed = WireVectorEnv(WIRES, threads=2, autoreset_mode="Disabled", **{**TASK, "actions": 99})
    plain.reset(seed=seeds)
    mixed.reset(seed=[seeds[i] for i in order])
    for step in range(10):
        given = actions(step)
        given[:, 0] *= 0.5
        one, other = plain.step(given), mixed.step(given[order])
        for mine, shuffled in zip(one[:4], other[:4], strict=True):
            assert equal(mine[order], shuffled)


def test_sixty_four_are_what_each_is_alone() -> None:
    """Bit for bit, in contact, in another order, by one thread and by two."""
    task = {**TASK, "starts": (0.0, 0.03, 0.05), "goal": 2.0}
    chance = np.random.default_rng(1)
    given = chance.uniform(-1.0, 1.0, (10, 64, 5)).astype(np.float32)
    given[..., 0] = np.abs(given[..., 0])
    order = chance.permutation(64)
    plain = WireVectorEnv(64, threads=1, autoreset_mode="Disabled", **task)
    mixed = WireVectorEnv(64, threads=2, autoreset_mode="Disabled", **task)
    alone = WireEnv(**task)
    plain.reset(seed=list(range(64)))
    mixed.reset(seed=[int(i) for i in order])
    ours = [plain.step(one) for one in given]
    for step, one in enumerate(given):
        theirs = mixed.step(one[order])
        for mine, shuffled in zip(ours[step][:4], theirs[:4], strict=True):
            assert equal(mine[order], shuffled)
        assert equal(ours[step][4]["max_wall_force"][order], theirs[4]["max_wall_force"])
    assert ours[-1][4]["max_wall_force"].max() > 1e-4
    for i in range(64):
        alone.reset(seed=i)
        for step, one in enumerate(given):
            observed, reward, *ended, info = alone.step(one[i])
            told = ours[step]
            assert np.array_equal(observed, told[0][i])
            assert [reward, *ended] == [values[i] for values in told[1:4]]
            assert info["max_wall_force"] == told[4]["max_wall_force"][i]


def test_masks_and_seeds_that_do_not_fit_are_refused() -> None:
    env = WireVectorEnv(2, **TASK)
    with pytest.raises(InputError, match="reset_mask of WireVectorEnv must be booleans"):
        env.reset(options={"reset_mask": np.ones(2)})
    with pytest.raises(InputError, match="one number or 2; received 3"):
        env.reset(seed=[1, 2, 3])


def test_gymnasium_makes_it() -> None:
    env = gymnasium.make_vec(
        "magwire/HalfCircle-v0", num_envs=3, vectorization_mode="vector_entry_point"
    )
    assert isinstance(env.unwrapped, WireVectorEnv)
    observed, _ = env.reset(seed=0)
    assert observed.shape == (3, 33)
    env.step(env.action_space.sample())
    env.close()

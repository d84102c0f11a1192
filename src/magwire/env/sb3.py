"""The vector environment as Stable-Baselines3 wants one: it takes none of Gymnasium's."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode

from magwire.env.vector_env import WireVectorEnv
from magwire.env.wire_env import row_of
from magwire.errors import InputError


class _Wires:
    """What Stable-Baselines3 asks of a ``VecEnv``, next to which it is a base class."""

    num_envs: int
    _seeds: list[int | None]
    _options: list[dict[str, Any]]

    def __init__(self, env: WireVectorEnv) -> None:
        self._env = env
        self._actions: Any = None
        start: Any = super().__init__
        start(env.num_envs, env.single_observation_space, env.single_action_space)

    def reset(self) -> Any:
        """Start all episodes."""
        feeds = {options.get("feed") for options in self._options}
        options = {"feed": feeds.pop()} if len(feeds) == 1 else None
        observed, _ = self._env.reset(seed=list(self._seeds), options=options)
        self.reset_infos = _rows(self._env)
        self._seeds = [None] * self.num_envs
        self._options = [{} for _ in range(self.num_envs)]
        return observed

    def step_async(self, actions: Any) -> None:
        """Keep the actions of the next step."""
        self._actions = actions

    def step_wait(self) -> Any:
        """Carry them out."""
        observed, rewards, terminated, truncated, info = self._env.step(self._actions)
        told = _rows(self._env)
        for i in np.flatnonzero(terminated | truncated).tolist():
            self.reset_infos[i] = told[i]
            final = info["final_info"]
            told[i] = row_of({k: v for k, v in final.items() if k[0] != "_"}, i)
            told[i]["terminal_observation"] = info["final_obs"][i]
        for i in range(self.num_envs):
            told[i]["TimeLimit.truncated"] = bool(truncated[i] and not terminated[i])
        return observed, rewards, terminated | truncated, told

    def close(self) -> None:
        """End the threads."""
        self._env.close()

    def get_images(self) -> Any:
        """A picture of each wire."""
        return self._env.render() or [None] * self.num_envs

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """An attribute of the vector environment, for each wire."""
        return [getattr(self._env, attr_name) for _ in self._chosen(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Refused: wires of a batch have no attributes of their own."""
        raise AttributeError(f"Wires of a batch have no attribute {attr_name!r} of their own.")

    def env_method(
        self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any
    ) -> list[Any]:
        """Refused: wires of a batch have no methods of their own."""
        raise AttributeError(f"Wires of a batch have no method {method_name!r} of their own.")

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        """No wire has a wrapper of its own."""
        return [False for _ in self._chosen(indices)]

    def _chosen(self, indices: int | Iterable[int] | None) -> list[int]:
        if indices is None:
            return list(range(self.num_envs))
        return [indices] if isinstance(indices, int) else list(indices)


def to_sb3(env: WireVectorEnv) -> Any:
    """A ``VecEnv`` of Stable-Baselines3 that steps the wires of a vector environment.

    ::

        env = WireVectorEnv(64, autoreset_mode="SameStep", **options_of("HalfCircle"))
        stable_baselines3.PPO("MlpPolicy", to_sb3(env)).learn(1_000_000)

    Parameters
    ----------
    env
        The wires; with ``autoreset_mode="SameStep"``, as Stable-Baselines3 has it.

    Raises
    ------
    InputError
        If its episodes begin in another way.
    ModuleNotFoundError
        If Stable-Baselines3 is not installed.
    """
    from stable_baselines3.common.vec_env import VecEnv

    if env.autoreset_mode is not AutoresetMode.SAME_STEP:
        raise InputError(
            "Input autoreset_mode of WireVectorEnv must be 'SameStep' for to_sb3; received "
            f"{env.autoreset_mode.value!r}."
        )

    made: Any = type("Wires", (_Wires, VecEnv), {})
    return made(env)


def _rows(env: WireVectorEnv) -> list[dict[str, Any]]:
    """What was last told of each wire."""
    return [row_of(env.episodes.info, i) for i in range(env.num_envs)]

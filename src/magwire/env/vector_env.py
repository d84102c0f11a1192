"""Many wires as one Gymnasium vector environment, stepped together by threads."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from magwire.env.episodes import Episodes
from magwire.env.spaces import action_space, observation, observation_space
from magwire.env.task import Task
from magwire.env.wire_env import FRAMES_PER_SECOND, picture
from magwire.errors import InputError, one_of, whole

Flags = NDArray[np.bool_]


class WireVectorEnv(VectorEnv[Any, NDArray[np.float32], NDArray[Any]]):
    """``WireEnv`` many times over, in one call of compiled code and in several threads.

    A wire gives bit for bit what it would give alone with the same seed. Wires in the same
    anatomy share it.

    Parameters
    ----------
    num_envs
        Number of wires.
    autoreset_mode
        When a wire whose episode has ended starts its next one: with the next step, in the same
        step (what was last seen is then in ``info["final_obs"]``), or only by ``reset`` with
        ``options={"reset_mask": mask}``.
    threads
        That work at once; one for each processor if left out.
    render_mode
        ``"rgb_array"``, or nothing.
    **task
        Fields of ``Task``.
    """

    def __init__(
        self,
        num_envs: int = 1,
        *,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        threads: int | None = None,
        render_mode: str | None = None,
        **task: Any,
    ) -> None:
        self.num_envs = whole("WireVectorEnv", "num_envs", num_envs, minimum=1)
        if render_mode is not None:
            one_of("WireVectorEnv", "render_mode", render_mode, ("rgb_array",))
        self.render_mode = render_mode
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = {
            "render_modes": ["rgb_array"],
            "render_fps": FRAMES_PER_SECOND,
            "autoreset_mode": self.autoreset_mode,
        }
        self.task = Task(**task)
        self.episodes = Episodes(self.task, self.num_envs, threads=threads)
        self.single_action_space = action_space(self.episodes.inputs)
        self.single_observation_space = observation_space(self.task, self.episodes.inputs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._chances = [seeding.np_random()[0] for _ in range(num_envs)]
        self._ended = np.zeros(num_envs, dtype=bool)

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Start episodes of all wires, or of some.

        Parameters
        ----------
        seed
            That of each wire, or of the first one: the others' follow it.
        options
            ``reset_mask``: which wires, booleans of shape (num_envs,), all if left out; ``feed``:
            length of wire past the entrance to start with [m].
        """
        options = options or {}
        mask = options.get("reset_mask", np.ones(self.num_envs, dtype=bool))
        if not isinstance(mask, np.ndarray) or mask.dtype != bool or mask.shape != (self.num_envs,):
            raise InputError(
                f"Input reset_mask of WireVectorEnv must be booleans of shape ({self.num_envs},); "
                f"received {mask!r}."
            )
        seeds = (
            [None if seed is None else seed + i for i in range(self.num_envs)]
            if seed is None or isinstance(seed, int)
            else list(seed)
        )
        if len(seeds) != self.num_envs:
            raise InputError(
                f"Input seed of WireVectorEnv must be one number or {self.num_envs}; received "
                f"{len(seeds)}."
            )
        for i in np.flatnonzero(mask):
            if seeds[i] is not None:
                self._chances[i] = seeding.np_random(seeds[i])[0]
        self._begin(mask, options.get("feed"))
        self._ended[mask] = False
        return self.observed(), self._info(mask)

    def _begin(self, mask: Flags, feed: float | None = None) -> None:
        chosen = np.flatnonzero(mask).tolist()
        if chosen:
            self.episodes.begin(chosen, [self._chances[i] for i in chosen], feed)

    def step(
        self, actions: NDArray[np.float32]
    ) -> tuple[Any, NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Carry out an action for each wire."""
        now, ended = self.episodes, self._ended
        if self.autoreset_mode is AutoresetMode.DISABLED and ended.any():
            raise InputError(
                "Wires of WireVectorEnv whose episodes have ended must be reset by "
                f"options={{'reset_mask': ...}}; received a step with {ended.sum()} of them."
            )
        now.act(actions, ~ended)
        if ended.any():  # these start anew with this step, whatever the action
            self._begin(ended)
        result = now.reward.copy(), now.terminated.copy(), now.truncated.copy()
        self._ended = result[1] | result[2]
        more: dict[str, Any] = {}
        if self.autoreset_mode is AutoresetMode.SAME_STEP and self._ended.any():
            more = self._start_again()
        everybody = np.ones(self.num_envs, dtype=bool)
        return self.observed(), *result, {**self._info(everybody), **more}

    def _start_again(self) -> dict[str, Any]:
        """Begin the next episodes of those that have ended; what was last of the old ones."""
        now, ended = self.episodes, self._ended
        last, told = now.seen, now.info
        final = np.full(self.num_envs, None, dtype=object)
        for i in np.flatnonzero(ended):
            final[i] = observation(self.task, last, int(i))
        kept = {name: np.where(_like(ended, values), values, 0) for name, values in told.items()}
        self._begin(ended)
        self._ended = np.zeros(self.num_envs, dtype=bool)
        return {
            "final_obs": final,
            "_final_obs": ended,
            "final_info": {**kept, **{f"_{name}": ended for name in kept}},
            "_final_info": ended,
        }

    def observed(self) -> Any:
        """What is observed of all wires now."""
        return observation(self.task, self.episodes.seen)

    def _info(self, mask: Flags) -> dict[str, Any]:
        told = self.episodes.info
        return {**told, **{f"_{name}": mask for name in told}}

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """A picture of each wire in its lumen, shape (400, 400, 3)."""
        if self.render_mode is None:
            return None
        return tuple(picture(self.episodes, i) for i in range(self.num_envs))

    def close_extras(self, **_: Any) -> None:
        """End the threads."""
        self.episodes.batch.close()


def _like(mask: Flags, values: NDArray[Any]) -> Flags:
    """The mask with as many axes as some values."""
    return mask if values.ndim == 1 else mask[:, None]

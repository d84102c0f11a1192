"""One wire as a Gymnasium environment."""

from __future__ import annotations

from typing import Any, ClassVar

import gymnasium
import numpy as np
from numpy.typing import NDArray

from magwire.env.episodes import Episodes
from magwire.env.spaces import action_space, observation, observation_space
from magwire.env.task import Task
from magwire.errors import one_of

FRAMES_PER_SECOND = 20


class WireEnv(gymnasium.Env[Any, NDArray[np.float32]]):
    """A magnetic wire that is fed, turned and steered through a vessel, with contact.

    ## Description
    A thin wire with a magnet in its tip leaves a straight guide at the entrance of a vessel. Feed
    and twist move the guide's end of the wire; a field, the same everywhere, turns the magnet. The
    tip is to come to the end of the way to the target, with as little force on the wall as can be.
    The wire is a discrete elastic rod, the wall a barrier; see the theory pages.

    ## Action Space
    ``Box(-1, 1, (5,), float32)``; an action lasts ``action_time``, 0.05 s.

    | Num | Action | In units of |
    |-----|--------|-------------|
    | 0 | feed speed; negative retracts | ``feed_speed`` |
    | 1 | twist rate of the guide | ``twist_rate`` |
    | 2 to 4 | field at the end of the action, along the path's tangent at the tip and two normals
      of it (``axes="world"``: along x, y and z) | ``input_limit`` |

    The field changes by no more than ``input_rate`` times ``action_time`` in each component.

    ## Observation Space
    ``Box(-10, 10, (33,), float32)``:

    | Num | Observation | In units of |
    |-----|-------------|-------------|
    | 0, 1 | tip off the centreline, along the path's two normals | radius of the lumen there |
    | 2 to 4 | direction of the tip, along tangent and normals | |
    | 5, 6 | arc length that the tip has come; feed | arc length of the goal |
    | 7, 8 | sine and cosine of the guide's twist | |
    | 9 to 11 | field that was asked for, along the action's axes | ``input_limit`` |
    | 12 to 16 | last action | |
    | 17 to 32 | 2.5, 5, 10 and 20 mm ahead: the centreline from here, along tangent and normals,
      over that distance (3), and the lumen's radius there over that here (1) | |

    With ``image=True`` it is a ``Dict`` of that ``vector`` and an ``image``,
    ``Box(0, 255, (84, 84, 1), uint8)``. ``noise``, ``delay`` and ``observe_every`` make it worse.

    ## Rewards
    10 times the share of the way that the tip has gained, or lost, in the action, up to the goal; 1
    on arrival; less 0.2 over the number of actions that an episode may have; less 0.05 times the
    sum of the wall's force on the tip and ``info["cost"]``, in units of ``force_limit``, of which
    no more than 10 count. What presses behind the tip below that limit costs nothing.

    ## Starting State
    The wire rests at one of the feeds ``starts``. With ``randomise`` the models are drawn anew.

    ## Episode End
    Terminated when the tip has come to the goal. Truncated after ``actions`` actions, or when a
    time step does not converge; ``info["unconverged"]`` is true then, and the wire is as it was
    before that step.

    ## Information
    ``tip_force`` and ``max_wall_force`` [N] at the end of the action, ``cost``: by how much the
    latter is above ``force_limit`` [N], ``progress``: part of the way to the goal, ``success``,
    ``branch``: number of the lumen's branch that the tip is in, -1 in none, ``unconverged``,
    and ``command``: feed speed [m/s], twist rate [rad/s] and inputs [T] that were carried out,
    with which a ``Session`` gives the same forces.

    ## Arguments
    The fields of ``magwire.env.Task``, and ``render_mode``. ``reset(options={"feed": 0.06})``
    starts with the wire at rest at that feed [m].

    ## Version History
    * v0: first release; rewards and observations may change until magwire 1.0, with a new version.
    """

    metadata: ClassVar[dict[str, Any]] = {  # type: ignore[misc]
        "render_modes": ["rgb_array"],
        "render_fps": FRAMES_PER_SECOND,
    }

    def __init__(self, *, render_mode: str | None = None, **task: Any) -> None:
        if render_mode is not None:
            one_of("WireEnv", "render_mode", render_mode, self.metadata["render_modes"])
        self.render_mode = render_mode
        self.task = Task(**task)
        self.episodes = Episodes(self.task, 1, threads=1)
        self.action_space: Any = action_space(self.episodes.inputs)
        self.observation_space = observation_space(self.task, self.episodes.inputs)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Start an episode.

        Parameters
        ----------
        seed
            That of all chance from here on.
        options
            ``feed``: length of wire past the entrance to start with [m].
        """
        super().reset(seed=seed)
        feed = None if options is None else options.get("feed")
        self.episodes.begin([0], [self.np_random], feed)
        return self._observation(), self._info()

    def step(self, action: NDArray[np.float32]) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Carry out an action."""
        now = self.episodes
        now.act(np.asarray(action)[None])
        ended = bool(now.terminated[0]), bool(now.truncated[0])
        return self._observation(), float(now.reward[0]), *ended, self._info()

    def render(self) -> NDArray[np.uint8] | None:
        """A picture of wire and lumen, shape (400, 400, 3); none without a ``render_mode``."""
        return None if self.render_mode is None else picture(self.episodes, 0)

    def close(self) -> None:
        """End the threads."""
        self.episodes.batch.close()

    def _observation(self) -> Any:
        return observation(self.task, self.episodes.seen, 0)

    def _info(self) -> dict[str, Any]:
        return row_of(self.episodes.info, 0)


def row_of(info: dict[str, NDArray[Any]], i: int) -> dict[str, Any]:
    """What is told of one wire: plain numbers, and arrays."""
    return {
        name: values[i].copy() if values.ndim > 1 else values[i].item()
        for name, values in info.items()
    }


def picture(episodes: Episodes, i: int) -> NDArray[np.uint8]:
    """A picture of a wire in its lumen."""
    now = episodes.anatomies[i]
    magnet = np.any(now.simulation.system.mesh.moment != 0.0, axis=1)
    row = min(round(now.goal / now.spacing), len(now.path) - 1)
    return episodes.view(i).frame(episodes.nodes(i), magnet, now.path[row, :3])

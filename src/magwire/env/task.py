"""What an environment asks for: a scenario, limits of actions, what is observed, what counts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from magwire.errors import InputError, nonnegative, one_of, positive, whole

Split = Literal["train", "test"]
Axes = Literal["path", "world"]
Range = tuple[float | str, float | str]

AHEAD = (2.5e-3, 5e-3, 10e-3, 20e-3)
"""How far ahead of the tip the path is observed, along it [m]."""


@dataclass(frozen=True)
class Task:
    """What an environment is, apart from the wires that are in it at the moment.

    Parameters
    ----------
    scenario
        Name of a scenario of the library, or a TOML file. Its feed's largest value is how far a
        wire may be fed, its ``time_step`` the longest one.
    overrides
        Keys of the scenario to set, ``key=value`` each.
    randomise
        Keys of the scenario and the range of each, from which a value is drawn at every reset: two
        numbers or two quantities in the same unit, such as ``("2 MPa", "4 MPa")``; whole numbers
        give whole numbers. The models are built anew then. The range of a ``seed`` is split in
        two halves, one for training and one for testing.
    split
        ``"train"`` or ``"test"``: which half of the seeds.
    starts
        Feeds to start from, one of which is drawn at every reset [m].
    feed_speed, twist_rate
        What an action of one stands for [m/s, rad/s].
    input_limit, input_rate
        The actuator's inputs': what an action of one stands for, and how fast they may change. A
        uniform flux density [T, T/s].
    axes
        ``"path"``: the inputs of an action are components along the path at the tip and two normals
        of it, and their length is at most the limit; ``"world"``: each is an input itself.
    input_error
        Standard deviation of each input's factor, drawn at every reset: how well the actuator is
        calibrated.
    action_time
        How long an action lasts [s].
    actions
        After which an episode is cut off.
    force_limit
        Wall force, over a patch of the wire, up to which there is no cost [N].
    goal
        Part of the largest feed that the tip has to come along the path.
    noise
        Standard deviation of the tip's observed position, each component [m].
    delay
        Actions by which what is observed is late.
    observe_every
        Actions from one observation to the next; in between the last one is repeated.
    image
        Whether an image is observed, too, 84 x 84, like that of a fluoroscope.
    """

    scenario: str | Path = "half-circle"
    overrides: tuple[str, ...] = ()
    randomise: Mapping[str, Range] = field(default_factory=dict)
    split: Split = "train"
    starts: tuple[float, ...] = (0.0,)
    feed_speed: float = 10e-3
    twist_rate: float = 3.0
    input_limit: float = 20e-3
    input_rate: float = 0.4
    axes: Axes = "path"
    input_error: float = 0.0
    action_time: float = 0.05
    actions: int = 300
    force_limit: float = 1e-3
    goal: float = 0.95
    noise: float = 0.0
    delay: int = 0
    observe_every: int = 1
    image: bool = False

    def __post_init__(self) -> None:
        one_of("Task", "split", self.split, ("train", "test"))
        one_of("Task", "axes", self.axes, ("path", "world"))
        for name, unit in _POSITIVE.items():
            positive("Task", name, getattr(self, name), unit)
        for name, unit in (("input_error", ""), ("noise", "m")):
            nonnegative("Task", name, getattr(self, name), unit)
        for name, least in (("actions", 1), ("delay", 0), ("observe_every", 1)):
            whole("Task", name, getattr(self, name), minimum=least)
        if not self.starts or min(self.starts) < 0.0:
            raise InputError(
                "Input starts of Task must hold at least one feed, none of them negative; "
                f"received {self.starts}."
            )
        object.__setattr__(self, "overrides", tuple(self.overrides))
        object.__setattr__(self, "starts", tuple(self.starts))
        object.__setattr__(self, "randomise", dict(self.randomise))


_POSITIVE = {
    "feed_speed": "m/s",
    "twist_rate": "rad/s",
    "input_limit": "T",
    "input_rate": "T/s",
    "action_time": "s",
    "force_limit": "N",
    "goal": "",
}

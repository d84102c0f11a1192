"""The runs that the page is made of."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from magwire.evidence.reproduce.outcome import Outcome

if TYPE_CHECKING:
    from magwire.navigate import Navigator, Observation
    from magwire.navigate.navigator import Course
    from magwire.results import Result

METHODS = ("stable", "newton", "paper")


@dataclass(frozen=True)
class Replay:
    """How a recorded field is applied again: a factor on it, and the feed between kept values."""

    scale: float = 1.0
    resample: float | None = None

    @property
    def name(self) -> str:
        """In words."""
        if self.resample is not None:
            return f"every {1e3 * self.resample:g} mm"
        return "as is" if self.scale == 1.0 else f"{100.0 * (self.scale - 1.0):+.0f} %"


REPLAYS = (Replay(), Replay(resample=2e-3), Replay(scale=0.97), Replay(scale=1.03))


@dataclass(frozen=True)
class Ask:
    """A run to be made.

    Attributes
    ----------
    scenario
        Its name in the library.
    method
        Who steers.
    changes
        Keys to set, ``key=value`` each.
    replay
        The recorded field of the run without this is applied open loop, in this way.
    """

    scenario: str
    method: str = "none"
    changes: tuple[str, ...] = ()
    replay: Replay | None = None

    @property
    def name(self) -> str:
        """In words, for the progress bar."""
        how = "passive" if self.method == "none" else self.method
        return f"{self.scenario}, {how}" + (f", replay {self.replay.name}" if self.replay else "")

    @property
    def source(self) -> Ask:
        """The run whose field is replayed."""
        return Ask(self.scenario, self.method, self.changes)


@dataclass(frozen=True)
class Run:
    """A run that was made.

    Attributes
    ----------
    result
        What came out.
    plans
        Time that the navigator took for each answer [s].
    """

    result: Result
    plans: tuple[float, ...] = ()

    @property
    def steering(self) -> float:
        """Time spent in the navigator [s]."""
        return sum(self.plans)

    @property
    def steering_pace(self) -> float:
        """The same over simulated time; NaN if the run stopped at once."""
        simulated = float(self.result.time[-1])
        return self.steering / simulated if simulated > 0.0 else float("nan")

    @cached_property
    def outcome(self) -> Outcome:
        """Its numbers."""
        return Outcome.of(self.result)


Runs = dict[Ask, Run]


class Timed:
    """A navigator with a watch: ``plans`` is the time that each of its plans has taken [s]."""

    def __init__(self, navigator: Navigator) -> None:
        self.navigator = navigator
        self.plans: list[float] = []

    def plan(self, observation: Observation, until: float) -> Course:
        """The navigator's plan; see ``Navigator.plan``."""
        begin = time.perf_counter()
        schedule = self.navigator.plan(observation, until)
        self.plans.append(time.perf_counter() - begin)
        return schedule


def perform(ask: Ask, runs: Runs, common: Sequence[str] = ()) -> Run | None:
    """Make a run.

    Parameters
    ----------
    ask
        What to run.
    runs
        The runs made so far; a replay finds its field there.
    common
        Keys to set in all runs, before those of the run itself.

    Returns
    -------
    Run
        None for the replay of a run that did not reach its end.
    """
    from magwire.scenario import load
    from magwire.scenario.replays import replayed

    if ask.replay is None:
        scenario = load(ask.scenario, (*common, f"navigate.method={ask.method}", *ask.changes))
    else:
        source = runs[ask.source].result
        if not source.converged:
            return None
        scenario = replayed(source, scale=ask.replay.scale, resample=ask.replay.resample)
    job = scenario.build()
    navigator = scenario.navigate.build(job.simulation)
    timed = None if navigator is None else Timed(navigator)
    result = job.simulation.run(
        job.feed,
        timed,
        update_every=scenario.navigate.interval,
        time_step=job.time_step,
        record_every=job.record_every,
        title=scenario.title,
        scenario=scenario.to_toml(),
    )
    return Run(result, () if timed is None else tuple(timed.plans))


def make_all(asks: Iterable[Ask], watch: Callable[[str], None], common: Sequence[str] = ()) -> Runs:
    """Make runs one after the other; equal ones once.

    Parameters
    ----------
    asks
        What to run; a replay comes after the run whose field it takes.
    watch
        Called with the name of each run before it starts.
    common
        Keys to set in all runs.
    """
    runs: Runs = {}
    for ask in dict.fromkeys(asks):
        watch(ask.name)
        run = perform(ask, runs, common)
        if run is not None:
            runs[ask] = run
    return runs

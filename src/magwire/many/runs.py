"""Independent runs, as many at a time as there are cores."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from magwire.errors import offering, refuse, whole
from magwire.many.children import cores
from magwire.many.cluster import run_there
from magwire.many.job import Job
from magwire.many.outcome import Outcome
from magwire.many.processes import run_here
from magwire.report.progress import WIDTH, bar

if TYPE_CHECKING:
    from magwire.scenario import Scenario


def run_many(
    scenarios: Iterable[Scenario],
    *,
    workers: int | None = None,
    out: str | Path | None = None,
    cluster: str | None = None,
    watch: Callable[[Outcome], None] | None = None,
) -> list[Outcome]:
    """Run independent scenarios, several at a time.

    A run gives the same numbers alone, next to others and with any number of workers. One that
    fails, or brings down its process, is an outcome with the status "failed" and leaves the others
    alone.

    Parameters
    ----------
    scenarios
        What to run, see ``magwire.load_scenario``.
    workers
        Processes of this machine, each on one core; one for each core if left out.
    out
        Folder for the result files, ``0000.nc`` and so on by the place of the scenario; those of a
        former call are overwritten. If left out, nothing is kept but the outcomes.
    cluster
        Address of a Dask scheduler that has the runs done, such as "tcp://10.0.0.1:8786", or
        "local" for a Dask cluster on this machine; needs ``magwire[cluster]``.
    watch
        Called with every outcome as it comes; a progress bar on a terminal if left out.

    Returns
    -------
    list
        An outcome for each scenario, in the order of the scenarios.

    Raises
    ------
    InputError
        If ``workers`` or ``cluster`` cannot be used.
    """
    given: object = scenarios
    if isinstance(given, (str, bytes)) or not isinstance(given, Iterable):
        raise refuse("run_many", "scenarios", "a list of scenarios", given)
    scenarios = list(scenarios)
    for scenario in scenarios:
        expected = "scenarios as magwire.load_scenario gives them"
        offering("run_many", "scenarios", scenario, [("to_toml",)], expected)
    count = whole("run_many", "workers", cores() if workers is None else workers, minimum=1)
    folder = None if out is None else Path(out)
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    jobs = [
        Job(number, scenario.to_toml(), str(folder / f"{number:04d}.nc") if folder else None)
        for number, scenario in enumerate(scenarios)
    ]
    for job in jobs:
        if job.file is not None:
            Path(job.file).unlink(missing_ok=True)
    outcomes: dict[int, Outcome] = {}
    with progress(len(jobs)) as show, closing(outcomes_of(jobs, count, cluster)) as coming:
        for outcome in coming:
            outcomes[outcome.number] = outcome
            (watch or show)(outcome)
    return [outcomes[job.number] for job in jobs]


def outcomes_of(
    jobs: list[Job], workers: int, cluster: str | None
) -> Generator[Outcome, None, None]:
    """Outcomes as the runs end."""
    files = {job.number: job.file for job in jobs}
    if not jobs:
        return
    begun = run_here(jobs, workers) if cluster is None else run_there(jobs, cluster, workers)
    with closing(begun) as answers:
        for number, done in answers:
            file = files[number]
            kept = Path(file) if file is not None and Path(file).exists() else None
            yield Outcome(number, done["status"], done["message"], kept, done["numbers"])


@contextmanager
def progress(total: int, done: int = 0) -> Iterator[Callable[[Outcome], None]]:
    """A progress bar for runs.

    Parameters
    ----------
    total
        Number of runs.
    done
        How many of them were done before.

    Yields
    ------
    callable
        To be called with every outcome.
    """
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        TextColumn("runs"),
        BarColumn(bar_width=WIDTH),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.description}"),
    )
    early = 0
    with bar(*columns) as shown:
        task = shown.add_task("", total=total, completed=done)

        def show(outcome: Outcome) -> None:
            nonlocal early
            early += not outcome.complete
            shown.update(task, advance=1, description=f"{early} ended early" if early else "")

        yield show

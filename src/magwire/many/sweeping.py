"""Carry out a sweep in a folder, or take up one that was interrupted there."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from magwire.errors import MagwireError
from magwire.files import clear, write_whole
from magwire.many.job import Job
from magwire.many.outcome import QUANTITIES
from magwire.many.runs import outcomes_of, progress
from magwire.many.sweep import Sweep
from magwire.many.table import PENDING, Table, blank, load

if TYPE_CHECKING:
    import xarray as xr

TABLE, SWEEP, RUNS = "sweep.nc", "sweep.toml", "runs"


def begun(folder: Path, sweep: Sweep) -> bool:
    """Whether a folder holds the beginning of this very sweep."""
    if not (folder / TABLE).is_file():
        return False
    try:
        table = load(folder / TABLE)
    except MagwireError:
        return False
    same = table.attrs["sweep"] == sweep.text and set(QUANTITIES) <= set(table)
    return same and bool((table["status"] == PENDING).any())


def carry_out(
    sweep: Sweep,
    folder: Path,
    *,
    workers: int,
    keep: bool = False,
    cluster: str | None = None,
) -> xr.Dataset:
    """Do all runs of a sweep that have not been done.

    Parameters
    ----------
    sweep
        The sweep.
    folder
        For its table, which grows as the runs end; it goes on from there if it holds the beginning
        of this sweep, and overwrites what is there if not.
    workers
        Processes of this machine.
    keep
        Keep the result file of each run, in ``runs``.
    cluster
        Address of a Dask scheduler, or "local"; see ``run_many``.

    Returns
    -------
    Dataset
        The table.
    """
    scenarios = sweep.scenarios
    dataset = load(folder / TABLE) if begun(folder, sweep) else blank(sweep)
    results = folder / RUNS if keep else folder
    results.mkdir(parents=True, exist_ok=True)
    clear(results)
    write_whole(folder / SWEEP, sweep.text)
    with Table(dataset, folder / TABLE) as table:
        jobs = [
            Job(n, scenarios[n].to_toml(), str(results / f"{n:04d}.nc") if keep else None)
            for n in table.pending
        ]
        with (
            progress(len(scenarios), len(scenarios) - len(jobs)) as tell,
            closing(outcomes_of(jobs, workers, cluster)) as outcomes,
        ):
            for outcome in outcomes:
                table.take(outcome)
                tell(outcome)
    return dataset

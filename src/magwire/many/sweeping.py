"""Carry out a sweep in a folder, or take up one that was interrupted there."""

from __future__ import annotations

from collections import Counter
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from magwire.errors import MagwireError
from magwire.files import clear, write_whole
from magwire.many.job import Job
from magwire.many.outcome import QUANTITIES
from magwire.many.runs import outcomes_of, progress
from magwire.many.sweep import Sweep
from magwire.many.table import PENDING, Table, blank, load
from magwire.units import show

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


def lines(table: xr.Dataset) -> list[str]:
    """What to know of a sweep, a line each."""
    status = Counter(str(word) for word in table["status"].values)
    ended = ", ".join(f"{count} {word}" for word, count in status.most_common())
    whole = table["status"].values == "complete"  # one that stopped early had not met all of it
    tips, wires = (
        int(np.count_nonzero(table[f"{part}_contact_free"].values[whole] == 1.0))
        for part in ("tip", "wire")
    )
    rows = {
        "runs": f"{table.sizes['run']}: {ended}",
        "varied": str(table.attrs["parameters"]),
        "tip clear throughout": f"in {tips} of {int(whole.sum())} complete runs",
        "wire clear, too": f"in {wires} of {int(whole.sum())} complete runs",
    }
    for name, label, dimension in (
        ("max_tip_force", "peak tip force", "force"),
        ("max_wall_force", "peak wire force", "force"),
        ("max_push_force", "peak push at guide", "force"),
        ("peak_field", "peak field", "flux_density"),
    ):
        values = table[name].values[np.isfinite(table[name].values)]
        if values.size:
            low, high = (show(float(f"{x:.4g}"), dimension) for x in (values.min(), values.max()))
            rows[label] = f"{low} to {high}" if low != high else low
    return [f"{name:22}{text}" for name, text in rows.items()]

"""The command ``magwire sweep``."""

from __future__ import annotations

from pathlib import Path

from magwire.cli.folders import occupied, writing_to
from magwire.cli.options import Flag
from magwire.cli.words import INTERRUPTED, complain, say
from magwire.status import RunStatus


def sweep(
    file: Path,
    /,
    *,
    workers: int | None = None,
    out: Path | None = None,
    keep: Flag = False,
    cluster: str | None = None,
    force: Flag = False,
) -> int:
    """Run a scenario for many values of its keys: one table, and a figure.

    Parameters
    ----------
    file
        TOML file with a table [sweep], which says what varies.
    workers
        Processes, one on each core; one for each core if left out.
    out
        Folder for the output; NAME-sweep in the working folder if left out. A sweep that was
        interrupted there is taken up again.
    keep
        Keep the result file of each run.
    cluster
        Address of a Dask scheduler, such as tcp://10.0.0.1:8786, or local.
    force
        Overwrite what is there.
    """
    from magwire.errors import whole
    from magwire.many import sweep as sweeps
    from magwire.many import sweeping
    from magwire.many.children import cores
    from magwire.report import sweep as report

    count = whole("sweep", "workers", cores() if workers is None else workers, minimum=1)
    described = sweeps.read(file)
    runs = len(described.scenarios)  # all faults of the file before anything is written
    folder = out or Path(f"{file.stem}-sweep")
    if described.note:
        complain(described.note)
    again = not force and sweeping.begun(folder, described)
    if again:
        complain(f"Taking up the sweep in '{folder}'.")
    with occupied(folder, force=force or again), writing_to(folder):
        if force:
            (folder / sweeping.TABLE).unlink(missing_ok=True)
        try:
            table = sweeping.carry_out(described, folder, workers=count, keep=keep, cluster=cluster)
            from magwire.plot import save_sweep

            save_sweep(table, folder)
        except KeyboardInterrupt:
            complain(f"Interrupted; the same command takes up the sweep in '{folder}' again.")
            return INTERRUPTED
    for line in report.lines(table):
        say(line)
    say(f"{'written to':22}{folder}")
    early = [str(word) for word in table["status"].values if word != RunStatus.COMPLETE]
    if early:
        complain(
            f"{len(early)} of {runs} runs did not reach their end; the table's messages say why."
        )
    return 1 if early else 0

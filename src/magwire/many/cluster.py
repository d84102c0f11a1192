"""Runs on a cluster through Dask."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Generator, Sequence
from contextlib import nullcontext
from itertools import islice
from pathlib import Path
from typing import Any

from magwire.errors import InputError
from magwire.files import write_whole
from magwire.many.job import Answer, Job
from magwire.status import RunStatus

AHEAD = 2  # runs given to the cluster for each of its threads: what waits there costs memory
LOCAL = "local"


def run_there(jobs: Sequence[Job], address: str, workers: int) -> Generator[Answer, None, None]:
    """Do runs on a Dask cluster, yielded as they end.

    Result files come back as bytes and are written here: the machines need no common folder.

    Parameters
    ----------
    jobs
        The runs, begun in this order.
    address
        Address of the scheduler, such as "tcp://10.0.0.1:8786"; "local" starts one on this machine.
    workers
        Number of processes of the local cluster.

    Raises
    ------
    InputError
        If Dask is not installed, or nobody answers at the address.
    """
    try:
        from distributed import Client, LocalCluster, as_completed
    except ImportError:
        raise InputError(
            "Input cluster of run_many needs the package distributed, which is not installed; "
            "install it with: pip install 'magwire[cluster]'."
        ) from None
    waiting = iter(jobs)
    try:
        if address == LOCAL:
            local: Any = LocalCluster(
                n_workers=workers, threads_per_worker=1, dashboard_address=None
            )
            client = Client(local)
        else:
            local = nullcontext()
            client = Client(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise InputError(
            f"Input cluster of run_many must be the address of a Dask scheduler; nobody answers at "
            f"{address!r}: {error}."
        ) from None
    with local, client:
        threads = max(1, sum(client.nthreads().values()))
        known: dict[Any, Job] = {}

        def send(count: int) -> list[Any]:
            sent = []
            for job in islice(waiting, count):
                future = client.submit(carry_out, job.scenario, job.file is not None, pure=False)
                known[future.key] = job
                sent.append(future)
            return sent

        coming = as_completed(send(AHEAD * threads))
        for future in coming:
            job = known.pop(future.key)
            lost = future.exception()
            done, data = (_lost(lost), b"") if lost else future.result()
            del future  # the cluster may forget it
            if job.file is not None and data:
                write_whole(Path(job.file), data)
            for sent in send(1):
                coming.add(sent)
            yield Answer(job.number, done)


def carry_out(scenario: str, keep: bool) -> tuple[dict[str, Any], bytes]:
    """Run a scenario on a machine of the cluster: how it ended, and the result file's bytes."""
    from magwire.many.task import run

    if not keep:
        return run(scenario, None), b""
    with tempfile.TemporaryDirectory(prefix="magwire-") as folder:
        file = os.path.join(folder, "result.nc")
        done = run(scenario, file)
        return done, Path(file).read_bytes() if os.path.exists(file) else b""


def _lost(error: BaseException) -> dict[str, Any]:
    return {
        "status": RunStatus.FAILED,
        "message": f"The cluster lost the run: {error}",
        "numbers": {},
    }

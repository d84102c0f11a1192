"""Runs on the cores at hand, in worker processes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import threading
from collections.abc import Generator, Sequence
from contextlib import suppress
from typing import Any

from magwire.errors import MagwireError
from magwire.many.children import Child, side_by_side
from magwire.many.job import Answer, Job
from magwire.status import RunStatus

GRACE = 5.0  # time that a worker gets to end when it is told to [s]


class Worker(Child):
    """A process that does runs one after the other; a new one after it has died."""

    def __init__(self) -> None:
        super().__init__("magwire.many.worker")
        self._busy = False

    def run(self, job: Job, stopping: threading.Event) -> dict[str, Any]:
        """Have a scenario run; a process that dies is replaced, unless all is being stopped."""
        answer = b""
        self._busy = True
        with suppress(OSError):
            order = {"scenario": job.scenario, "file": job.file}
            self.orders.write(json.dumps(order).encode() + b"\n")
            self.orders.flush()
            answer = self.answers.readline()
        self._busy = False
        if answer:
            done: dict[str, Any] = json.loads(answer)
            return done
        message = f"The process of the run ended with {self.last_words()}."
        self.hang_up()
        if not stopping.is_set():
            self.start()
        return {"status": RunStatus.FAILED, "message": message, "numbers": {}}

    def stop(self) -> None:
        """End the process; a run that goes on leaves a result file that says "interrupted"."""
        if self._busy and os.name == "posix":
            self.process.send_signal(signal.SIGINT)
            with suppress(subprocess.TimeoutExpired):
                self.process.wait(GRACE)
        self.kill()


def run_here(jobs: Sequence[Job], workers: int) -> Generator[Answer, None, None]:
    """Do runs in worker processes of this machine, yielded as they end.

    Parameters
    ----------
    jobs
        The runs, begun in this order.
    workers
        Number of processes.

    Raises
    ------
    MagwireError
        If a worker cannot be used.
    """
    yield from side_by_side([Worker() for _ in range(min(workers, len(jobs)))], jobs, _run)


def _run(worker: Worker, job: Job, stopping: threading.Event) -> Answer:
    try:
        return Answer(job.number, worker.run(job, stopping))
    except BaseException as error:
        raise MagwireError(f"A worker process cannot be used: {error}.") from error

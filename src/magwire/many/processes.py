"""Runs on the cores at hand: worker processes, each with a thread that hands it its next run.

A navigator plans in Python between kernels, and threads would queue for the interpreter there.
The workers are started as programmes of their own, not by ``multiprocessing``: that would import
the caller's script once more in each of them, and a run that brings down its process would bring
down the pool.
"""

from __future__ import annotations

import json
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Generator, Sequence
from contextlib import suppress
from typing import IO, Any

from magwire.errors import MagwireError
from magwire.many.job import Answer, Job
from magwire.status import RunStatus

GRACE = 5.0  # time that a worker gets to end when it is told to [s]
THREADS = ("OMP", "OPENBLAS", "MKL", "NUMBA", "VECLIB_MAXIMUM")
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in THREADS}  # a worker is to use one core


class Worker:
    """A process that does runs one after the other; a new one after it has died."""

    def __init__(self) -> None:
        self._errors: IO[bytes] = tempfile.TemporaryFile()  # noqa: SIM115
        self._process = self._start()
        self._busy = False

    def run(self, job: Job, stopping: threading.Event) -> dict[str, Any]:
        """Have a scenario run; a process that dies is replaced, unless all is being stopped."""
        self._busy = True
        try:
            order = {"scenario": job.scenario, "file": job.file}
            self._stream("stdin").write(json.dumps(order) + "\n")
            self._stream("stdin").flush()
            answer = self._stream("stdout").readline()
        except OSError:
            answer = ""
        self._busy = False
        if answer:
            done: dict[str, Any] = json.loads(answer)
            return done
        message = self._obituary()
        self._hang_up()
        if not stopping.is_set():
            self._process = self._start()
        return {"status": RunStatus.FAILED, "message": message, "numbers": {}}

    def stop(self) -> None:
        """End the process; a run that goes on leaves a result file that says "interrupted"."""
        if self._busy and os.name == "posix":
            self._process.send_signal(signal.SIGINT)
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(GRACE)
        self.kill()

    def kill(self) -> None:
        """End the process at once."""
        self._process.kill()
        self._process.wait()

    def close(self) -> None:
        """Let go of what belongs to a process that has been stopped."""
        self._hang_up()
        self._errors.close()

    def _hang_up(self) -> None:
        for name in ("stdin", "stdout"):
            with suppress(OSError):
                self._stream(name).close()

    def _start(self) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, "-m", "magwire.many.worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            env=os.environ | ONE_THREAD | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            text=True,
            encoding="utf-8",
            start_new_session=True,  # Ctrl-C in the terminal is for the caller
        )

    def _stream(self, name: str) -> IO[str]:
        stream: IO[str] = getattr(self._process, name)
        return stream

    def _obituary(self) -> str:
        """Why the process has died, by the last line that it wrote."""
        status = self._process.wait()
        self._errors.seek(0)
        lines = self._errors.read().decode(errors="replace").strip().splitlines()
        self._errors.seek(0)
        self._errors.truncate()
        last = f": {lines[-1]}" if lines else ""
        return f"The process of the run ended with exit status {status}{last}."


def run_here(jobs: Sequence[Job], workers: int) -> Generator[Answer, None, None]:
    """Do runs in worker processes of this machine, yielded as they end.

    Parameters
    ----------
    jobs
        The runs, begun in this order.
    workers
        Number of processes.
    """
    waiting: queue.SimpleQueue[Job] = queue.SimpleQueue()
    for job in jobs:
        waiting.put(job)
    ended: queue.SimpleQueue[Answer | BaseException] = queue.SimpleQueue()
    stopping = threading.Event()
    pool = [Worker() for _ in range(min(workers, len(jobs)))]
    threads = [
        threading.Thread(target=_lead, args=(worker, waiting, ended, stopping), daemon=True)
        for worker in pool
    ]
    try:
        for thread in threads:
            thread.start()
        for _ in jobs:
            answer = ended.get()
            if isinstance(answer, BaseException):
                raise MagwireError(f"A worker process cannot be used: {answer}.") from answer
            yield answer
    finally:
        stopping.set()
        for worker in pool:
            worker.stop()
        for thread in threads:
            thread.join()
        for worker in pool:
            worker.close()


def _lead(
    worker: Worker,
    waiting: queue.SimpleQueue[Job],
    ended: queue.SimpleQueue[Answer | BaseException],
    stopping: threading.Event,
) -> None:
    """Hand a worker one run after the other."""
    try:
        while not stopping.is_set():
            job = waiting.get_nowait()
            ended.put(Answer(job.number, worker.run(job, stopping)))
    except queue.Empty:
        return
    except BaseException as error:  # must reach the caller, who would wait for ever
        ended.put(error)

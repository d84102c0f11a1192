"""Processes of magwire's own that work side by side, each with a thread that hands it its next job.

A navigator plans in Python between kernels, and threads would queue for the interpreter there.
They are started as programmes of their own, not by ``multiprocessing``: that would import the
caller's script once more in each of them, and a job that brings down its process would bring down
the pool.
"""

from __future__ import annotations

import os
import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Generator, Sequence
from contextlib import suppress
from functools import partial
from typing import IO, TypeVar

THREADS = ("OMP", "OPENBLAS", "MKL", "NUMBA", "VECLIB_MAXIMUM")
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in THREADS}  # a child is to use one core


def cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class Child:
    """A process that takes orders on one stream and answers on another.

    Parameters
    ----------
    module
        What it runs.
    """

    def __init__(self, module: str) -> None:
        self._module = module
        self._errors: IO[bytes] = tempfile.TemporaryFile()  # noqa: SIM115
        self.start()

    def start(self) -> None:
        """Start it, or another one in place of one that has died."""
        self.process = subprocess.Popen(
            [sys.executable, "-m", self._module],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            env=os.environ | ONE_THREAD | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            start_new_session=True,  # Ctrl-C in the terminal is for the caller
        )

    @property
    def orders(self) -> IO[bytes]:
        """Where it listens."""
        assert self.process.stdin is not None
        return self.process.stdin

    @property
    def answers(self) -> IO[bytes]:
        """Where it speaks."""
        assert self.process.stdout is not None
        return self.process.stdout

    def last_words(self) -> str:
        """How it has died: its exit status, and the last line that it wrote."""
        status = self.process.wait()
        self._errors.seek(0)
        lines = self._errors.read().decode(errors="replace").strip().splitlines()
        self._errors.seek(0)
        self._errors.truncate()
        last = f": {lines[-1]}" if lines else ""
        return f"exit status {status}{last}"

    def kill(self) -> None:
        """End it at once."""
        self.process.kill()
        self.process.wait()

    def stop(self) -> None:
        """End it, whatever it does."""
        self.kill()

    def hang_up(self) -> None:
        """Let go of the streams of one that has ended."""
        for stream in (self.orders, self.answers):
            with suppress(OSError):
                stream.close()

    def close(self) -> None:
        """Let go of all that belongs to one that has ended."""
        self.hang_up()
        self._errors.close()


C = TypeVar("C", bound=Child)
J = TypeVar("J")
A = TypeVar("A")


def side_by_side(
    children: Sequence[C], jobs: Sequence[J], do: Callable[[C, J, threading.Event], A]
) -> Generator[A, None, None]:
    """Have jobs done, yielded as they are; whatever ends this ends the children.

    Parameters
    ----------
    children
        Each does one job at a time.
    jobs
        Begun in this order.
    do
        Called in threads with a child, a job and whether all is being stopped; what it raises ends
        all, and is raised here.
    """
    waiting: queue.SimpleQueue[J] = queue.SimpleQueue()
    for job in jobs:
        waiting.put(job)
    ended: queue.SimpleQueue[A | BaseException] = queue.SimpleQueue()
    stopping = threading.Event()

    def one(child: C) -> A:
        return do(child, waiting.get_nowait(), stopping)

    threads = [
        threading.Thread(target=_lead, args=(partial(one, child), ended, stopping), daemon=True)
        for child in children
    ]
    try:
        for thread in threads:
            thread.start()
        for _ in jobs:
            answer = ended.get()
            if isinstance(answer, BaseException):
                raise answer
            yield answer
    finally:
        stopping.set()
        for child in children:
            child.stop()
        for thread in threads:
            thread.join()
        for child in children:
            child.close()


def _lead(
    one: Callable[[], A],
    ended: queue.SimpleQueue[A | BaseException],
    stopping: threading.Event,
) -> None:
    """Have a child do one job after the other."""
    try:
        while not stopping.is_set():
            ended.put(one())
    except queue.Empty:
        return
    except BaseException as error:  # must reach the caller, who would wait for ever
        ended.put(error)

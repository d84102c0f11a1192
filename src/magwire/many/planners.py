"""Plans for several outlets at a time, in processes of their own.

A navigator plans in Python between kernels, and threads would queue for the interpreter there; see
``magwire.many.processes``. What travels are the models themselves, pickled, to the bit.
"""

from __future__ import annotations

import os
import pickle
import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import IO, NamedTuple

from magwire.contact import Barrier
from magwire.errors import MagwireError
from magwire.lumen import Lumen
from magwire.many.processes import ONE_THREAD
from magwire.navigate.demands import Demands
from magwire.planning import Prospect
from magwire.wire import Wire


class Task(NamedTuple):
    """What is planned for every outlet; see ``magwire.planning.plan``."""

    lumen: Lumen
    wire: Wire
    demands: Demands
    contact: Barrier | None


class Planner:
    """A process that plans a task for one outlet after the other."""

    def __init__(self, task: Task) -> None:
        self._errors: IO[bytes] = tempfile.TemporaryFile()  # noqa: SIM115
        self._process = subprocess.Popen(
            [sys.executable, "-m", "magwire.many.planner"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            env=os.environ | ONE_THREAD | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            start_new_session=True,  # Ctrl-C in the terminal is for the caller
        )
        self._task: Task | None = task

    def plan(self, name: str) -> Prospect:
        """What to expect on the path to an outlet.

        Raises
        ------
        MagwireError
            What planning raises, in its words; or that the process has died, and its last words.
        """
        orders, answers = self._process.stdin, self._process.stdout
        assert orders is not None
        assert answers is not None
        try:
            if self._task is not None:
                pickle.dump(self._task, orders)
                self._task = None
            pickle.dump(name, orders)
            orders.flush()
            answer: Prospect | str = pickle.load(answers)
        except (OSError, EOFError, pickle.UnpicklingError) as error:
            raise MagwireError(self._obituary(name)) from error
        if isinstance(answer, str):
            raise MagwireError(answer)
        return answer

    def stop(self) -> None:
        """End the process at once."""
        self._process.kill()
        self._process.wait()

    def close(self) -> None:
        """Let go of what belongs to a process that has been stopped."""
        for stream in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                if stream is not None:
                    stream.close()
        self._errors.close()

    def _obituary(self, name: str) -> str:
        """Why the process has died, by the last line that it wrote."""
        status = self._process.wait()
        self._errors.seek(0)
        lines = self._errors.read().decode(errors="replace").strip().splitlines()
        last = f": {lines[-1]}" if lines else ""
        return f"The process that planned for '{name}' ended with exit status {status}{last}."


def plan_at_once(task: Task, names: Sequence[str], workers: int) -> Iterator[Prospect]:
    """Plan for outlets in processes, yielded as they are done.

    Each is bit for bit what ``magwire.planning.plan`` gives for it alone.

    Parameters
    ----------
    task
        What is planned.
    names
        Outlets, begun in this order.
    workers
        Number of processes.

    Raises
    ------
    MagwireError
        If planning fails, or a process dies.
    """
    waiting: queue.SimpleQueue[str] = queue.SimpleQueue()
    for name in names:
        waiting.put(name)
    ended: queue.SimpleQueue[Prospect | BaseException] = queue.SimpleQueue()
    pool = [Planner(task) for _ in range(min(workers, len(names)))]
    threads = [
        threading.Thread(target=_lead, args=(planner, waiting, ended), daemon=True)
        for planner in pool
    ]
    try:
        for thread in threads:
            thread.start()
        for _ in names:
            answer = ended.get()
            if isinstance(answer, BaseException):
                raise answer
            yield answer
    finally:
        while not waiting.empty():
            with suppress(queue.Empty):
                waiting.get_nowait()
        for planner in pool:
            planner.stop()
        for thread in threads:
            thread.join()
        for planner in pool:
            planner.close()


def _lead(
    planner: Planner,
    waiting: queue.SimpleQueue[str],
    ended: queue.SimpleQueue[Prospect | BaseException],
) -> None:
    """Hand a process one outlet after the other."""
    try:
        while True:
            ended.put(planner.plan(waiting.get_nowait()))
    except queue.Empty:
        return
    except BaseException as error:  # must reach the caller, who would wait for ever
        ended.put(error)

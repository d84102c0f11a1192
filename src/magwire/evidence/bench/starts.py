"""Imports, and the way to the first time step, each in a fresh process."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from magwire.evidence.bench.repeats import Sample, interleaved

CHILD = Path(__file__).with_name("child.py")
COLD_REPEATS = 1  # tens of seconds each


def start(*words: str, cache: str | None = None) -> Sample:
    """Seconds from the start of a process to each of its marks."""
    environment = dict(os.environ)
    if cache is not None:
        environment["MAGWIRE_CACHE"] = cache
        environment.pop("NUMBA_CACHE_DIR", None)
    command = [sys.executable, str(CHILD), *words]
    began = time.time()
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, text=True, check=True)
    stamps: Sample = json.loads(done.stdout)
    return {name: at if name == "peak" else at - began for name, at in stamps.items()}


def first_step(*, cold: bool) -> Sample:
    """Way to the first step, with machine code from the cache or into an empty one."""
    with tempfile.TemporaryDirectory(prefix="magwire-bench-") as folder:
        return start("step", folder, cache=folder if cold else None)


def peak_memory(name: str) -> Sample:
    """Peak memory of a process that runs a scenario and writes its result [bytes]."""
    with tempfile.TemporaryDirectory(prefix="magwire-bench-") as folder:
        return {"peak": start("memory", name, folder)["peak"]}


def run_memory(names: Sequence[str], tell: Callable[[str], None]) -> dict[str, list[Sample]]:
    """Samples for scenarios of the library; none where the system does not tell."""
    if not Path("/proc/self/status").exists():
        return {}
    return interleaved({name: partial(peak_memory, name) for name in names}, 1, tell)


def run_starts(
    repeats: int, *, quick: bool, tell: Callable[[str], None]
) -> dict[str, list[Sample]]:
    """Samples of all starts; the cache is warm unless it says cold."""
    jobs: dict[str, Callable[[], Sample]] = {
        "import": partial(start, "bare"),
        "warm": partial(first_step, cold=False),
    }
    if quick:
        return interleaved(jobs, repeats, tell)
    jobs["names"] = partial(start, "names")
    cold = {"cold": partial(first_step, cold=True)}
    return interleaved(jobs, repeats, tell) | interleaved(cold, COLD_REPEATS, tell)

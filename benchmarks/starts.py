"""Imports, and the way to the first time step, each in a fresh process."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from repeats import Sample, interleaved

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
    return {name: at - began for name, at in json.loads(done.stdout).items()}


def first_step(*, cold: bool) -> Sample:
    """Way to the first step, with machine code from the cache or into an empty one."""
    with tempfile.TemporaryDirectory(prefix="magwire-bench-") as folder:
        return start("step", folder, cache=folder if cold else None)


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

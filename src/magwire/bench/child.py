"""Run by ``starts.py`` in a process of its own: prints when it got where, in seconds since 1970."""

from __future__ import annotations

import json
import sys
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from magwire.engine.record import Record

stamps = {"python": time.time()}


def mark(name: str) -> None:
    stamps[name] = time.time()


def bare() -> None:
    import magwire  # noqa: F401

    mark("magwire")


def names() -> None:
    import magwire

    mark("magwire")
    for name in magwire.__all__:
        getattr(magwire, name)
    mark("names")


def step(out: str) -> None:
    """What ``magwire run half-circle`` does up to the end of its first time step."""
    from pathlib import Path

    from magwire.progress import running
    from magwire.scenario import load

    described = load("half-circle", ("feed.distance=0.1 mm", "output.record_every=0.01 mm"))
    mark("scenario")
    job = described.build()
    mark("models")
    with running(job.feed.duration) as show:

        def watch(record: Record) -> None:
            if record.totals.steps > 0 and "step" not in stamps:
                mark("step")
            show(record)

        job.run(Path(out) / "result.nc", watch=watch)


def memory(name: str, out: str) -> None:
    """A whole run with its result file; the peak memory of the process, in bytes."""
    from pathlib import Path

    from magwire.scenario import load

    load(name).build().run(Path(out) / "result.nc")
    # Not getrusage: that remembers how large the process was that started this one.
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    stamps["peak"] = 1024.0 * next(int(line.split()[1]) for line in lines if "VmHWM" in line)


if __name__ == "__main__":
    globals()[sys.argv[1]](*sys.argv[2:])
    sys.stdout.write(json.dumps(stamps) + "\n")

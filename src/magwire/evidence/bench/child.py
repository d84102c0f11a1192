"""Run by ``starts.py`` in a process of its own: prints when it got where, in seconds since 1970."""

from __future__ import annotations

import json
import sys
import time
from contextlib import redirect_stdout
from io import StringIO

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
    """``magwire run half-circle`` up to the end of its first time step, and on to a short end."""
    from magwire.cli import main

    mark("command line")
    from magwire.operate import March

    advance = March.advance

    def watched(march: March, steps: int) -> bool:
        done = advance(march, steps)
        stamps.setdefault("step", time.time())
        return done

    March.advance = watched  # type: ignore[method-assign, assignment]
    short = ("--set", "feed.distance=0.1 mm", "--set", "output.record_every=0.01 mm")
    with redirect_stdout(StringIO()):
        status = main(("run", "half-circle", *short, "--out", f"{out}/run"))
    if status != 0:
        sys.exit(status)


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

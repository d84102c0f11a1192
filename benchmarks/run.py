"""Measure magwire and print one page of times, counts and ratios (``make bench``).

One thread, one run, repeats interleaved (A B C A B C ...): what is compared was measured side by
side.
"""

from __future__ import annotations

import argparse
import json
import os
import time
from pathlib import Path

# Before numpy and numba are imported; subprocesses inherit it.
for name in ("NUMBA", "OMP", "OPENBLAS", "MKL", "VECLIB_MAXIMUM"):
    os.environ[f"{name}_NUM_THREADS"] = "1"


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all samples to FILE")
    parser.add_argument("--repeats", type=int, default=5, metavar="N", help="repeats (default 5)")
    parser.add_argument(
        "--quick", action="store_true", help="one repeat of a short feed: shows that it works"
    )
    given = parser.parse_args()
    if given.repeats < 1:
        parser.error(f"--repeats must be at least 1; received {given.repeats}")
    return given


def main() -> None:
    given = arguments()
    import numba
    from cases import QUICK, WHOLE, run_all
    from machine import load_average, machine
    from page import show
    from rich.console import Console
    from starts import run_starts

    numba.set_num_threads(1)
    extent, repeats = (QUICK, 1) if given.quick else (WHOLE, given.repeats)
    began, before = time.perf_counter(), load_average()
    with Console(stderr=True).status("measuring ...") as status:
        runs = run_all(extent, repeats, status.update)
        starts = run_starts(repeats, quick=given.quick, tell=status.update)
    results = {
        "machine": machine(),
        "settings": {
            "repeats": repeats,
            "push": extent.push,
            "quick": given.quick,
            "load_average": [before, load_average()],
            "total_seconds": time.perf_counter() - began,
        },
        **runs,
        "starts": starts,
    }
    show(results)
    if given.json:
        given.json.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

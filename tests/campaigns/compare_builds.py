"""Run the shipped scenarios with two checkouts and compare every result variable bit for bit.

    python tests/campaigns/compare_builds.py OLD NEW [--only NAME ...] [--passive] [--keep DIR]

OLD and NEW are checkouts of magwire; the Python that runs this must have magwire's dependencies.
Wall times differ between any two runs and are left out. Prints a line for each scenario and
variable that differs, with the largest difference over the variable's largest value; exit status 1
if any does. With ``--keep`` the results stay, and results that are there already are not made again.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import xarray as xr

TIMED = {"wall_time"}


def names(checkout: Path) -> list[str]:
    """Scenarios of a checkout's library."""
    return sorted(path.stem for path in (checkout / "src/magwire/scenario/library").glob("*.toml"))


def run(checkout: Path, name: str, out: Path, passive: bool) -> bool:
    """Run a scenario with a checkout, unless its result is there already."""
    if (out / "result.nc").exists():
        return True
    command = [sys.executable, "-m", "magwire", "run", name, "--out", str(out)]
    if passive:
        command += ["--set", "navigate.method=none"]
    environment = {**os.environ, "PYTHONPATH": str(checkout / "src")}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if not (out / "result.nc").exists():
        print(f"{name}: {checkout} left no result: {done.stderr.strip()[-300:]}")
        return False
    return True


def differences(old: Path, new: Path) -> list[str]:
    """Variables of two results that are not the same bits."""
    found = []
    with xr.open_dataset(old) as a, xr.open_dataset(new) as b:
        for name in a.variables:
            if name in TIMED:
                continue
            if name not in b.variables:
                found.append(f"{name} is gone")
                continue
            x, y = a[name].values, b[name].values
            if x.shape != y.shape:
                found.append(f"{name} has shape {y.shape}, had {x.shape}")
            elif x.dtype.kind in "fc":
                if not np.array_equal(x, y, equal_nan=True):
                    size = np.nanmax(np.abs(x)) or 1.0
                    found.append(f"{name} differs by {np.nanmax(np.abs(x - y)) / size:.2g}")
            elif not np.array_equal(x, y):
                found.append(f"{name} differs")
    return found


def main() -> int:
    """Compare."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--only", nargs="*")
    parser.add_argument("--passive", action="store_true", help="without steering")
    parser.add_argument("--keep", type=Path, help="folder for the results")
    options = parser.parse_args()
    kept = options.keep or Path(tempfile.mkdtemp())
    bad = 0
    for name in options.only or names(options.old.resolve()):
        kind = "passive" if options.passive else "steered"
        places = [kept / which / kind / name for which in ("old", "new")]
        checkouts = (options.old.resolve(), options.new.resolve())
        if not all(
            [run(c, name, p, options.passive) for c, p in zip(checkouts, places, strict=True)]
        ):
            bad += 1
            continue
        found = differences(*(place / "result.nc" for place in places))
        print(f"{name}: {'; '.join(found) or 'the same'}", flush=True)
        bad += bool(found)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

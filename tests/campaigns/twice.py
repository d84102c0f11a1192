"""The same run twice, alone and among others, cold and warm, one and two workers: bit for bit."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import magwire as mw

SETTINGS = ("feed.distance=30 mm", "wire.nodes=60", "solver.time_step=20 ms")
CLOCKS = {"wall_time"}
"""Variables that say how long it took."""
PROGRAM = "import magwire, sys; magwire.load_scenario(sys.argv[1]).run(sys.argv[2])"


def differing(one: Path, other: Path) -> list[str]:
    """Variables of two results that are not the same bits."""
    a, b = (mw.Result.load(path).dataset for path in (one, other))
    names = sorted({str(name) for name in (*a.variables, *b.variables)} - CLOCKS)
    return [n for n in names if n not in a or n not in b or _bits(a[n]) != _bits(b[n])]


def _bits(variable: object) -> bytes:
    return np.asarray(variable).tobytes()


def apart(scenario: Path, out: Path, cache: Path | None) -> Path:
    """The run in a process of its own, with a cold cache if one is given."""
    env = os.environ | ({} if cache is None else {"MAGWIRE_CACHE": str(cache)})
    subprocess.run([sys.executable, "-c", PROGRAM, str(scenario), str(out)], env=env, check=True)
    return out


def main() -> int:
    """Run as a script."""
    wrong = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for method in ("none", "stable"):
            base = mw.load_scenario("half-circle", (*SETTINGS, f"navigate.method={method}"))
            file = folder / f"{method}.toml"
            file.write_text(base.to_toml())
            first = folder / f"{method}.nc"
            base.run(first)
            ways = {"again": folder / f"{method}-again.nc"}
            base.run(ways["again"])
            ways["in another process"] = apart(file, folder / f"{method}-apart.nc", None)
            ways["with a cold cache"] = apart(file, folder / f"{method}-cold.nc", folder / "cold")
            for workers in (1, 2):
                out = folder / f"{method}-{workers}"
                others = mw.load_scenario("sinusoid", ("feed.distance=5 mm",))
                mw.run_many([others, base, others], workers=workers, out=out)
                ways[f"among others, {workers} workers"] = out / "0001.nc"
            for way, path in ways.items():
                different = differing(first, path)
                wrong += bool(different)
                verdict = f"differs in {', '.join(different)}" if different else "the same bits"
                sys.stdout.write(f"{method:8}{way:32}{verdict}\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

"""Broken files of vessels, in every format: each is read, or refused in a sentence."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import vessel_files
from campaigns.harness import Tally, child, count_and_seed, state_file, warm
from corrupted_files import SELDOM, broken

SLOW = (".stl", ".ply", ".obj")


def reading(path: Path) -> Callable[[], int]:
    """Read a file, join its tubes and make its walls; 1 with the sentence if it is refused."""

    def act() -> int:
        from magwire.errors import MagwireError
        from magwire.vessel import Vessel

        try:
            radius = 2e-3 if path.suffix == ".pth" else None
            vessel = Vessel.read(path, "mm", radius=radius)
            vessel.lumen()
            if vessel.wall is not None:
                vessel.lumen(wall="surface").arrays()
        except MagwireError as error:
            sys.stderr.write(f"{error}\n")
            return 1
        return 0

    return act


def main() -> int:
    """Run as a script."""
    count, seed = count_and_seed(10_000)
    tally = Tally("vessels", state_file())
    warm()
    import magwire.vessel  # noqa: F401

    seeds = {name: make() for name, make in vessel_files.EVERY.items()}
    slow = [name for name in sorted(seeds) if name.endswith(SLOW)]
    names = [name for name in sorted(seeds) if name not in slow] * SELDOM + slow
    with tempfile.TemporaryDirectory() as folder:
        for number, rng in tally.cases(count, seed):
            name = names[number % len(names)]
            path = Path(folder) / name
            path.write_bytes(broken(seeds[name], rng))
            tally.take(path.suffix, child(reading(path), after=60.0), "", [path])
    return tally.close()


if __name__ == "__main__":
    sys.exit(main())

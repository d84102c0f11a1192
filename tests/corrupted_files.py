"""Broken vessel files: each is read or refused in one sentence, in little time and memory.

``python tests/corrupted_files.py 10000`` tries that many and says what it took; further
arguments are files to start from, next to the small ones of ``vessel_files``.
"""

from __future__ import annotations

import random
import resource
import shutil
import signal
import sys
import tempfile
import time
import warnings
from collections import Counter
from pathlib import Path

import vessel_files
from magwire.errors import MagwireError
from magwire.vessel import Vessel

PATIENCE = 60
"""Seconds after which a file counts as a hang."""
SELDOM = 5
"""Files of lines for each surface, which takes about a second."""


def broken(data: bytes, rng: random.Random) -> bytes:
    """The bytes with flips, a cut, a repeated or a lost part, or another number."""
    work = bytearray(data)
    kind = rng.randrange(6)
    if kind == 0:
        for _ in range(rng.choice((1, 1, 2, 8, 64))):
            work[rng.randrange(len(work))] = rng.randrange(256)
    elif kind == 1:
        del work[rng.randrange(len(work)) :]
    elif kind == 2:
        a = rng.randrange(len(work))
        del work[a : a + rng.randrange(1, 200)]
    elif kind == 3:
        a = rng.randrange(len(work))
        work[a:a] = work[a : a + rng.randrange(1, 2000)]
    elif kind == 4:
        a = rng.randrange(min(len(work), 1500))
        work[a] = rng.choice(b"0123456789-e.<>\"' \n")
    else:
        digits = [i for i, c in enumerate(work) if 48 <= c <= 57]
        for _ in range(3):
            i = rng.choice(digits or [0])
            work[i : i + 1] = rng.choice((b"99999999", b"-1", b"nan", b"1e300", b"", b"0"))
    return bytes(work)


def attempt(path: Path) -> str:
    """What becomes of a file: "read", or the first words of the sentence that refuses it."""
    try:
        Vessel.read(path, "mm", radius=2e-3 if path.suffix == ".pth" else None).lumen()
    except MagwireError as error:
        text = str(error)
        assert text.strip(), "a refusal without words"
        assert len(text) < 2000, text[:200]
        return "refused"
    return "read"


def _lost_patience(number: int, frame: object) -> None:
    raise TimeoutError(f"no answer after {PATIENCE} s")


def campaign(count: int, seed: int, seeds: dict[str, bytes]) -> Counter[str]:
    """Break that many files, in turn of the formats; what became of them, by format."""
    rng, found = random.Random(seed), Counter[str]()
    slow = [name for name in sorted(seeds) if name.endswith((".stl", ".ply", ".obj"))]
    names = [name for name in sorted(seeds) if name not in slow] * SELDOM + slow
    signal.signal(signal.SIGALRM, _lost_patience)
    with tempfile.TemporaryDirectory() as folder:
        for number in range(count):
            name = names[number % len(names)]
            path = Path(folder) / name
            path.write_bytes(broken(seeds[name], rng))
            begin = time.perf_counter()
            try:
                signal.alarm(PATIENCE)
                found[f"{path.suffix} {attempt(path)}"] += 1
            except BaseException:
                sys.stderr.write(f"file {number} of seed {seed}: {name}\n")
                shutil.copy(path, Path(tempfile.gettempdir()) / f"broken-{name}")
                raise
            finally:
                signal.alarm(0)
            found["slowest, ms"] = max(
                found["slowest, ms"], round(1e3 * (time.perf_counter() - begin))
            )
    return found


def main() -> None:
    """Run as a script."""
    warnings.simplefilter("error")
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    seeds = {name: make() for name, make in vessel_files.EVERY.items()}
    seeds |= {Path(file).name: Path(file).read_bytes() for file in sys.argv[2:]}
    for what, number in sorted(campaign(count, 0, seeds).items()):
        print(f"{what:20}{number:8}")  # noqa: T201
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{'largest memory, MB':20}{peak:8.0f}")  # noqa: T201


if __name__ == "__main__":
    main()

"""Results with flipped bytes: each is summed up, drawn and replayed, or refused in a sentence."""

from __future__ import annotations

import random
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from campaigns.harness import Tally, child, command, count_and_seed, state_file, warm

DRAWN = 10
"""Of so many results one is drawn, which takes seconds."""


def reading(path: Path, draw: bool) -> Callable[[], int]:
    """All that reads a result: summary, schedule, replay and, if asked for, the figure."""

    def act() -> int:
        from magwire import plot
        from magwire.errors import MagwireError
        from magwire.report import run as summary
        from magwire.results import Result
        from magwire.scenario.replays import replayed

        try:
            result = Result.load(path)
            summary.lines(result, steered=True)
            replayed(result).build()
            if draw:
                plot.draw(result.dataset)
        except MagwireError as error:
            sys.stderr.write(f"{error}\n")
            return 1
        return 0

    return act


def flipped(data: bytes, rng: random.Random) -> bytes:
    """Bytes changed one by one, most of them where the file describes itself; or a cut."""
    work = bytearray(data)
    if rng.random() < 0.1:
        del work[rng.randrange(len(work)) :]
        return bytes(work)
    for _ in range(rng.choice((1, 1, 2, 8, 64))):
        end = len(work) if rng.random() < 0.3 else min(len(work), 20_000)
        work[rng.randrange(end)] ^= 1 << rng.randrange(8)
    return bytes(work)


def main() -> int:
    """Run as a script."""
    count, seed = count_and_seed(500)
    tally = Tally("results", state_file())
    warm()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        words = ("--set", "feed.distance=10 mm", "wire.nodes=24", "output.record_every=0.5 mm")
        made = child(command("run", "half-circle", *words, "--out", folder / "out"), after=120.0)
        tally.take("made", made)
        data = (folder / "out" / "result.nc").read_bytes()
        for number, rng in tally.cases(count, seed):
            path = folder / "flipped.nc"
            path.write_bytes(flipped(data, rng))
            draw = number % DRAWN == 0
            ended = child(reading(path, draw), after=60.0)
            tally.take("drawn" if draw else "read", ended, "", [path])
    return tally.close()


if __name__ == "__main__":
    sys.exit(main())

"""Every command killed at random moments: what was flushed is readable, and nothing stays."""

from __future__ import annotations

import shutil
import signal
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from campaigns.harness import Tally, child, command, count_and_seed, left_over, state_file, warm

SWEEP = """
[sweep]
scenario = "half-circle"
[sweep.ranges]
lumen.radius = { from = "2.5 mm", to = "3.5 mm", count = 6 }
navigate.method = ["none"]
feed.distance = ["10 mm"]
wire.nodes = [30]
solver.time_step = ["20 ms"]
"""
RUN = ("--set", "feed.distance=40 mm", "wire.nodes=40", "output.record_every=0.2 mm")
SOONER, LATER = 0.05, 5.0
"""When the signal comes, at random between these [s of the processor]."""


def commands(folder: Path) -> dict[str, tuple[Callable[[], int], Path]]:
    """What is killed, and the folder that it writes to."""
    sweep = folder / "tubes.toml"
    sweep.write_text(SWEEP)
    ready, out = folder / "ready", folder / "out"
    words: dict[str, tuple[object, ...]] = {
        "run": ("run", "half-circle", *RUN),
        "compare": ("run", "half-circle", "--compare", "none", *RUN),
        "replay": ("replay", ready),
        "sweep": ("sweep", sweep, "--workers", "1", "--keep"),
        "plan": ("plan", "half-circle", "--max-field", "50 mT"),
        "reproduce": ("reproduce", "--only", "setup"),
        "verify": ("verify", "--only", "consistency"),
        "export": ("export", ready, "--to", "csv"),
    }
    made = {name: (command(*parts, "--out", out, "--force"), out) for name, parts in words.items()}
    film = ("animate", ready, "--out", out / "film.gif", "--seconds", "2", "--force")
    return made | {
        "animate": (command(*film), out),
        "plot": (command("plot", ready, "--out", out, "--force"), out),
        "view": (command("view", ready, "--out", out / "view.html", "--force"), out),
    }


def unreadable(folder: Path) -> str:
    """What cannot be read of what a command left."""
    from magwire.errors import MagwireError
    from magwire.many.table import load
    from magwire.results import Result

    for path in folder.rglob("[!.]*.nc"):
        try:
            load(path) if path.name == "sweep.nc" else Result.load(path)
        except MagwireError as error:
            return f"lost: {error}"
    for path in folder.rglob("[!.]*.png"):
        if not path.read_bytes().endswith(b"IEND\xaeB`\x82"):
            return f"{path.name} is half there"
    for path in folder.rglob("[!.]*.html"):
        if not path.read_text(encoding="utf-8").rstrip().endswith("</html>"):
            return f"{path.name} is half there"
    return ""


def main() -> int:
    """Run as a script."""
    count, seed = count_and_seed(300)
    tally = Tally("kills", state_file())
    warm()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ready = command("run", "half-circle", *RUN, "--out", folder / "ready")
        tally.take("made", child(ready, after=120.0))
        short = ("--set", "feed.distance=2 mm", "wire.nodes=24", "navigate.method=none")
        kinds = commands(folder)
        for number, rng in tally.cases(count, seed):
            kind = list(kinds)[number % len(kinds)]
            act, out = kinds[kind]
            gentle = rng.random() < 0.25
            how = rng.choice((signal.SIGTERM, signal.SIGINT)) if gentle else signal.SIGKILL
            ended = child(act, after=rng.uniform(SOONER, LATER), number=how)
            wrong = unreadable(out) if out.exists() else ""
            if gentle and out.exists() and left_over(out):
                wrong = wrong or f"left after {how.name}: {left_over(out)}"
            right = ended.status in (-how, 128 + how)
            if right and ended.fault.startswith(("exit status", "no word")):
                tally.counts[f"{kind} {how.name}{' WRONG' if wrong else ''}"] += 1
                if wrong:
                    tally.fault(f"{kind}, {how.name}: {wrong}")
            else:
                tally.take(kind, ended, wrong)
            again = ("--out", out, "--force", "--no-figure")
            after = child(command("run", "straight", *short, *again), after=60.0)
            left = [path for path in left_over(out) if path.parent == out]  # runs/ is the sweep's
            tally.take("next run", after, f"after {kind}: {left} are left" if left else "")
            shutil.rmtree(out, ignore_errors=True)
    return tally.close()


if __name__ == "__main__":
    sys.exit(main())

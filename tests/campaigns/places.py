"""Where magwire runs: with another one beside it, folders that go, caches, homes, extras."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from campaigns.harness import Ended, Tally, child, command, left_over, warm
from campaigns.kills import SWEEP, unreadable

SHORT = ("--set", "feed.distance=3 mm", "wire.nodes=24", "navigate.method=none")
LONG = ("--set", "solver.time_step=0.1 ms", "navigate.method=none")


def process(folder: Path, *words: object, patience: float = 1800.0, **environment: str) -> Ended:
    """A command as a process of its own; an empty value takes a variable away.

    Its patience is for a cold cache on a machine that others use.
    """
    begin = time.monotonic()
    env = {name: value for name, value in (os.environ | environment).items() if value}
    done = subprocess.run(
        [sys.executable, "-m", "magwire", *map(str, words)],
        cwd=folder, env=env, capture_output=True, text=True, check=False, timeout=patience,
    )  # fmt: skip
    return Ended(done.returncode, done.stderr, time.monotonic() - begin, 0.0)


def together(acts: list[Callable[[], Ended]]) -> list[Ended]:
    """How several commands end that start at once."""
    ended: list[Ended] = []
    threads = [threading.Thread(target=lambda act: ended.append(act()), args=(a,)) for a in acts]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return ended


def two_at_once(tally: Tally, folder: Path) -> None:
    """The same command twice into one folder: at most one is refused, and all is readable."""
    (folder / "tubes.toml").write_text(SWEEP)
    kinds: dict[str, tuple[object, ...]] = {
        "run": ("run", "straight", *SHORT),
        "sweep": ("sweep", "tubes.toml", "--workers", "1"),
        "reproduce": ("reproduce", "--only", "setup"),
        "plan": ("plan", "half-circle", "--max-field", "50 mT"),
    }
    for kind, words in kinds.items():
        out = folder / f"two-{kind}"
        both = together([partial(process, folder, *words, "--out", out, "--force")] * 2)
        for ended in both:
            tally.take(f"two at once, {kind}", ended, unreadable(out))
        if all(ended.status for ended in both) or left_over(out):
            tally.fault(f"two at once, {kind}: none ended well, or drafts are left")


def folder_that_goes(tally: Tally, folder: Path) -> None:
    """The output folder is removed while a run writes to it."""
    out = folder / "goes"

    def remove() -> None:
        time.sleep(4.0)
        shutil.rmtree(out, ignore_errors=True)

    thread = threading.Thread(target=remove)
    thread.start()
    ended = child(command("run", "half-circle", *LONG, "--out", out), after=60.0)
    thread.join()
    tally.take("folder that goes", ended, "" if ended.status == 1 else "it did not notice")


def caches(tally: Tally, folder: Path) -> None:
    """Cold by two at once, read-only, of another processor; no home, or one that is read-only."""
    run = ("run", "straight", *SHORT, "--force")
    cold = {"MAGWIRE_CACHE": str(folder / "cold")}
    acts = [partial(process, folder, *run, "--out", f"cold{n}", **cold) for n in range(2)]
    for ended in together(acts):
        tally.take("cold cache, two at once", ended)
    generic = process(folder, *run, "--out", "generic", NUMBA_CPU_NAME="generic", **cold)
    tally.take("cache of another processor", generic)
    kept = sorted((folder / "cold").rglob("*.nbc"))
    for path in kept[:3]:
        path.write_bytes(path.read_bytes()[:100])
    tally.take("damaged cache", process(folder, *run, "--out", "damaged", **cold))
    nowhere = {
        "HOME": "/proc/none",
        "XDG_CACHE_HOME": "",
        "MAGWIRE_CACHE": "",
        "NUMBA_CACHE_DIR": "",
    }
    (folder / "temporary").mkdir()
    own = {**nowhere, "TMPDIR": str(folder / "temporary")}
    tally.take("home that cannot be written", process(folder, *run, "--out", "home", **own))
    unwritable = {**own, "MAGWIRE_CACHE": "/proc"}
    tally.take("read-only cache", process(folder, *run, "--out", "ro", **unwritable))
    modes = {path.stat().st_mode & 0o777 for path in (folder / "temporary").glob("magwire-*")}
    if modes != {0o700}:
        tally.fault(f"the cache for want of a home has the modes {modes}")
    planted = folder / "planted"
    (planted / f"magwire-{os.getuid()}").mkdir(parents=True, mode=0o777)
    (planted / f"magwire-{os.getuid()}").chmod(0o777)
    ended = process(folder, *run, "--out", "planted", **{**nowhere, "TMPDIR": str(planted)})
    used = any((planted / f"magwire-{os.getuid()}").iterdir())
    tally.take("folder that others can write", ended, "it was used" if used else "")


def without(name: str, act: Callable[[], int]) -> Callable[[], int]:
    """The same where a package is not installed."""

    def held() -> int:
        sys.modules[name] = None  # type: ignore[assignment]
        return act()

    return held


def extras(tally: Tally, folder: Path) -> None:
    """Commands whose optional packages are not there say which."""
    (folder / "tubes.toml").write_text(SWEEP)
    (folder / "box.stl").write_text("solid\nendsolid\n")
    ready = process(folder, "run", "straight", *SHORT, "--out", "ready", "--force")
    tally.take("made", ready)
    cases = {
        "trimesh": ("lumen", "inspect", folder / "box.stl"),
        "imageio_ffmpeg": ("animate", folder / "ready", "--out", folder / "a.mp4"),
        "distributed": (
            "sweep",
            folder / "tubes.toml",
            "--cluster",
            "local",
            "--out",
            folder / "d",
        ),
    }
    for name, words in cases.items():
        ended = child(without(name, command(*words)), after=60.0)
        right = ended.status == 1 and "install" in ended.said
        tally.take(f"without {name}", ended, "" if right else f"it says {ended.said!r}")


def clocks(tally: Tally, folder: Path) -> None:
    """The clock of the day jumps by a day forth and back all the time, as when it is set.

    Needs ``faketime`` (Debian's package), which leaves the clock for durations alone.
    """
    if shutil.which("faketime") is None:
        tally.counts["clock that jumps: not run, faketime is not installed"] += 1
        return
    day = folder / "day"
    changing = {"FAKETIME_TIMESTAMP_FILE": str(day), "FAKETIME_NO_CACHE": "1"}
    library = subprocess.run(
        ["faketime", "-m", "-f", "+0", "printenv", "LD_PRELOAD"],
        capture_output=True, text=True, check=True,
    ).stdout.strip()  # fmt: skip
    own = {**changing, "LD_PRELOAD": library, "FAKETIME_DONT_FAKE_MONOTONIC": "1"}
    day.write_text("+0\n")
    over = threading.Event()

    def jump() -> None:
        while not over.wait(0.2):
            for by in ("+1d", "-1d", "+30d", "+0"):
                day.write_text(f"{by}\n")
                over.wait(0.1)

    thread = threading.Thread(target=jump)
    thread.start()
    (folder / "tubes.toml").write_text(SWEEP)
    for kind, words in {
        "run": ("run", "half-circle", *SHORT),
        "sweep": ("sweep", "tubes.toml", "--workers", "1"),
    }.items():
        out = folder / kind
        ended = process(folder, *words, "--out", out, "--force", **own)
        wrong = unreadable(out) or ("" if ended.status == 0 else "it did not end well")
        tally.take(f"clock that jumps, {kind}", ended, wrong)
    over.set()
    thread.join()


def main() -> int:
    """Run as a script."""
    tally = Tally("places")
    warm()
    signal.signal(signal.SIGINT, signal.default_int_handler)
    with tempfile.TemporaryDirectory() as name:
        for part in (extras, two_at_once, folder_that_goes, clocks, caches):
            folder = Path(name) / part.__name__
            folder.mkdir()
            part(tally, folder)
    return tally.close()


if __name__ == "__main__":
    sys.exit(main())

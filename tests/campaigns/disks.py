"""Disks that fill up, at ten places of a run, a sweep and a plan: a sentence, and nothing lost.

As root on Linux the disk is a small ``tmpfs``; elsewhere the size of each file is limited.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from campaigns.harness import Tally, child, command, count_and_seed, left_over, warm
from campaigns.kills import RUN, SWEEP, unreadable


@contextmanager
def disk(folder: Path, size: int) -> Iterator[bool]:
    """A folder of so many bytes; whether it really is one."""
    root = hasattr(os, "geteuid") and os.geteuid() == 0 and sys.platform == "linux"
    mount = ["mount", "-t", "tmpfs", "-o", f"size={size}", "none", str(folder)]
    mounted = root and subprocess.run(mount, check=False, capture_output=True).returncode == 0
    try:
        yield mounted
    finally:
        if mounted:
            subprocess.run(["umount", str(folder)], check=True)


def limited(act: Callable[[], int], size: int) -> Callable[[], int]:
    """The same with files of at most ``size`` bytes."""

    def held() -> int:
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        return act()

    return held


def main() -> int:
    """Run as a script."""
    places, _ = count_and_seed(10)
    tally = Tally("disks")
    warm()
    with tempfile.TemporaryDirectory() as name:
        folder, held = Path(name), Path(name) / "disk"
        held.mkdir()
        (folder / "tubes.toml").write_text(SWEEP)
        kinds = {
            "run": ("run", "half-circle", *RUN),
            "sweep": ("sweep", folder / "tubes.toml", "--workers", "1", "--keep"),
            "plan": ("plan", "half-circle", "--max-field", "50 mT"),
        }
        for kind, words in kinds.items():
            act = command(*words, "--out", held / "out")
            ended = child(act, after=300.0)
            tally.take(f"{kind}, room enough", ended)
            most = sum(path.stat().st_size for path in held.rglob("*") if path.is_file())
            subprocess.run(["rm", "-rf", str(held / "out")], check=True)
            for place in range(places):
                size = max(1, int(most * (place / places) ** 2)) // 4096 * 4096 + 4096
                with disk(held, size) as real:
                    ended = child(act if real else limited(act, size), after=300.0)
                    wrong = unreadable(held)
                    if left_over(held):
                        wrong = wrong or f"left: {left_over(held)}"
                    if ended.status == 1 and len(ended.said.strip().splitlines()) > 1:
                        wrong = wrong or f"more than one sentence: {ended.said}"
                    tally.take(f"{kind}, {'small disk' if real else 'small files'}", ended, wrong)
                subprocess.run(["rm", "-rf", str(held / "out")], check=True)
    return tally.close()


if __name__ == "__main__":
    sys.exit(main())

"""A case in a child process: how it ended, and whether that was right."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

PATIENCE, LONG = 30.0, 10.0
"""Time after which a case is a hang, and after which it is interrupted [s]."""
SLOWER = 10.0
"""By how much others on the machine may slow a case down; more counts as waiting for ever."""
LARGEST = 1024.0
"""Memory of a case, at most [MB]."""
RIGHT = (0, 1, 130)


@dataclass(frozen=True)
class Ended:
    """How a child ended: exit status (negative: by a signal), what it said, what it took."""

    status: int
    said: str
    seconds: float
    megabytes: float
    hung: bool = False

    @property
    def fault(self) -> str:
        """What was wrong with that; "" if nothing was."""
        if "Traceback" in self.said:
            return "traceback"
        if self.hung:
            return "hang"
        if self.megabytes > LARGEST:
            return "memory"
        if self.status not in RIGHT:
            return f"exit status {self.status}"
        if self.status and not self.said.strip():
            return "no word"
        return ""


def child(act: Callable[[], int | None], after: float = LONG, number: int = signal.SIGINT) -> Ended:
    """Do something in a child process, which gets a signal after a time if it has not ended.

    Parameters
    ----------
    act
        What to do; its value is the exit status.
    after
        Time of the processor until the signal [s].
    number
        The signal.
    """
    begin = time.monotonic()
    with tempfile.TemporaryFile("w+b") as said:
        pid = os.fork()
        if pid == 0:
            _be_child(act, said.fileno())
        sent = hung = False
        while True:
            done, how, used = os.wait4(pid, os.WNOHANG)
            if done:
                break
            passed = _spent(pid, begin)
            if not sent and passed > after:
                os.kill(pid, number)
                sent = True
            if not hung and passed > max(PATIENCE, after + PATIENCE - LONG):
                os.kill(pid, signal.SIGKILL)
                hung = True
            time.sleep(0.002)
        said.seek(0)
        text = said.read().decode(errors="replace")
    status = os.waitstatus_to_exitcode(how)
    return Ended(status, text, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024.0, hung)


def _spent(pid: int, begin: float) -> float:
    """Time of the processor that a child has had, so that a busy machine makes no hangs [s]."""
    wall = time.monotonic() - begin
    try:
        words = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    except OSError:
        return wall
    cpu = (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")
    return max(cpu, wall / SLOWER)


def _be_child(act: Callable[[], int | None], said: int) -> None:
    """Never returns."""
    status = 99
    try:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        os.dup2(said, 2)
        status = act() or 0
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(status)


def command(*words: object) -> Callable[[], int]:
    """A command of magwire's."""

    def act() -> int:
        from magwire.cli import main

        return main([str(word) for word in words])

    return act


def left_over(folder: Path) -> list[Path]:
    """Drafts and locks anywhere in a folder."""
    return [path for path in folder.rglob(".*") if path.is_file()]


@dataclass
class Tally:
    """Counts of how cases ended; faults are printed as they come, and their inputs kept.

    With a file, ``cases`` go on where an earlier call, which may have been killed, stood in it.
    """

    name: str
    state: Path | None = None
    done: int = 0
    counts: Counter[str] = field(default_factory=Counter)
    faults: int = 0
    slowest: float = 0.0
    largest: float = 0.0
    kept: Path = field(default_factory=lambda: Path(tempfile.mkdtemp(prefix="magwire-campaign-")))

    def __post_init__(self) -> None:
        if self.state is not None and self.state.exists():
            stood = json.loads(self.state.read_text(encoding="utf-8"))
            self.done, self.faults = stood["done"], stood["faults"]
            self.slowest, self.largest = stood["slowest"], stood["largest"]
            self.counts.update(stood["counts"])

    def cases(self, count: int, seed: int) -> Iterator[tuple[int, random.Random]]:
        """Numbers of the cases that are to be done yet, each with its own source of chance."""
        for number in range(self.done, count):
            yield number, random.Random(f"{seed}, {number}")
            self.done = number + 1
            self._remember()

    def _remember(self) -> None:
        if self.state is None:
            return
        stood = {name: getattr(self, name) for name in ("done", "faults", "slowest", "largest")}
        draft = self.state.with_suffix(".draft")
        draft.write_text(json.dumps(stood | {"counts": self.counts}), encoding="utf-8")
        draft.replace(self.state)

    def take(self, kind: str, ended: Ended, wrong: str = "", inputs: Sequence[Path] = ()) -> None:
        """Count a case; ``wrong`` says what else was not right with it."""
        self.slowest = max(self.slowest, ended.seconds)
        self.largest = max(self.largest, ended.megabytes)
        words = {0: "done", 1: "refused", 130: "interrupted"}
        fault = ended.fault or wrong
        self.counts[f"{kind} {'WRONG' if fault else words.get(ended.status, 'killed')}"] += 1
        if fault:
            self.fault(f"{kind}: {fault}: {ended.said[-1500:]}", inputs)

    def fault(self, what: str, inputs: Sequence[Path] = ()) -> None:
        """Something that was not right."""
        self.faults += 1
        sys.stdout.write(f"FAULT {self.faults}, {what}\n")
        sys.stdout.flush()
        for path in inputs:
            if path.is_file():
                shutil.copy(path, self.kept / f"{self.faults:03d}-{path.name}")

    def close(self) -> int:
        """Print the counts; the exit status."""
        if self.done:
            sys.stdout.write(f"{'cases':44}{self.done:8}\n")
        for kind, count in sorted(self.counts.items()):
            sys.stdout.write(f"{kind:44}{count:8}\n")
        sys.stdout.write(f"{'slowest case, s':44}{self.slowest:8.1f}\n")
        sys.stdout.write(f"{'largest memory, MB':44}{self.largest:8.0f}\n")
        sys.stdout.write(f"{'faults':44}{self.faults:8}\n")
        if self.faults:
            sys.stdout.write(f"Inputs of faults are in {self.kept}.\n")
        else:
            shutil.rmtree(self.kept)
        return 1 if self.faults else 0


def count_and_seed(default: int) -> tuple[int, int]:
    """The numbers on the command line."""
    given = [int(word) for word in sys.argv[1:3]]
    return (given + [default, 0][len(given) :])[0], (given + [default, 0][len(given) :])[1]


def state_file() -> Path | None:
    """The file on the command line that keeps how far a campaign has come; none if left out."""
    return Path(sys.argv[3]) if len(sys.argv) > 3 else None


def warm() -> None:
    """Load in the parent what every child needs, and compile kernels that are not in the cache."""
    import magwire
    import magwire.plot.animation
    import magwire.plot.prospects
    from magwire.kernels._jit import compiled_before

    if not compiled_before():
        child(_compile, after=600.0)
    magwire.load_scenario("straight").build()


def _compile() -> None:
    import magwire

    for steer in ("none", "stable"):
        settings = (f"navigate.method={steer}", "feed.distance=5 mm", "wire.nodes=40")
        magwire.load_scenario("half-circle", settings).run()

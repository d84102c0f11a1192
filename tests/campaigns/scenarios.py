"""Broken scenarios: each is run, or refused in sentences."""

from __future__ import annotations

import random
import re
import shutil
import sys
import tempfile
from pathlib import Path

from campaigns.harness import Tally, child, command, count_and_seed, left_over, state_file, warm

SHORT = (
    "feed.distance=4 mm",
    "solver.time_step=50 ms",
    "wire.nodes=48",
    "output.record_every=1 mm",
)
DRAWN = 4
"""Of so many scenarios one is drawn, which takes seconds."""
VALUES = (
    "-1", "0", "1e-320", "1e400", "nan", "inf", "true", "[]", "{}", "''", '"x"', "0x" + "f" * 5000,
    "9" * 5000, "[" * 3000, '"1e999999999 mm"', '"-5 mm"', '"0 mm"', '"1e-300 mm"', '"1e30 m"',
    '"3 kg"', '"5"', '"5 µm"', '"\\u0000"', '"a $\\\\frac{$ b"', '"漢字"', "1979-05-27",
    "[1, 2, 3]",
    '["1 mm", "2 mm", "3 mm"]', '[["1 mm", "1 mm"]]', "1_000_000", "[[[[]]]]", '"none"', '"stable"',
)  # fmt: skip
WORDS = ("=", "[", "]", "#", "\n", '"', "[wire]\n", "a.b.c = 1\n", "\x00", "\\", "'''", ",", "..")


def bases() -> list[str]:
    """Short scenarios of every kind, complete and as the library has them."""
    from magwire.scenario import load, names

    made = []
    for name in names():
        try:
            made.append(load(name, SHORT).to_toml())
            made.append(load(name, (*SHORT, "navigate.method=none")).to_toml())
        except Exception as error:
            sys.stdout.write(f"{name} cannot be made short: {error}\n")
    return [text for text in made if len(text) < 20_000]


def broken(text: str, rng: random.Random) -> str:
    """A scenario with one to three things wrong with it."""
    for _ in range(rng.choice((1, 1, 2, 3))):
        lines = text.splitlines()
        at = rng.randrange(len(lines))
        kind = rng.randrange(7)
        if kind < 3:
            given = [i for i, line in enumerate(lines) if "=" in line]
            at = rng.choice(given or [0])
            lines[at] = lines[at].split("=")[0] + "= " + rng.choice(VALUES)
        elif kind == 3:
            number = re.sub(r"\d", lambda m: rng.choice("0123456789"), lines[at])
            lines[at] = number
        elif kind == 4:
            del lines[at]
        elif kind == 5:
            lines.insert(at, rng.choice(lines))
        else:
            place = rng.randrange(len(lines[at]) + 1)
            lines[at] = lines[at][:place] + rng.choice(WORDS) + lines[at][place:]
        text = "\n".join(lines) or "x"
    return text


def main() -> int:
    """Run as a script."""
    count, seed = count_and_seed(2000)
    tally = Tally("scenarios", state_file())
    warm()
    texts = bases()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for text in texts if tally.done == 0 else ():  # compiles what the cases need
            file, out = folder / "sound.toml", folder / "sound"
            file.write_text(text, encoding="utf-8")
            ended = child(command("run", file, "--out", out, "--no-figure"), after=600.0)
            tally.take("run, not broken", ended, "refused" if ended.status else "", [file])
            shutil.rmtree(out)
        for number, rng in tally.cases(count, seed):
            file, out = folder / "broken.toml", folder / f"out{number}"
            file.write_text(broken(rng.choice(texts), rng), encoding="utf-8")
            draw = number % DRAWN == 0
            how = () if draw else ("--no-figure",)
            ended = child(command("run", file, "--out", out, *how))
            wrong = "drafts are left" if not ended.hung and left_over(out) else ""
            if ended.status == 0 and draw and not (out / "figure.png").exists():
                wrong = "no figure"
            tally.take("run, drawn" if draw else "run", ended, wrong, [file])
            shutil.rmtree(out, ignore_errors=True)
    return tally.close()


if __name__ == "__main__":
    sys.exit(main())

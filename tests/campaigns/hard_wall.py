"""Computes tests/data/hard_wall in minutes: `python tests/campaigns/hard_wall.py [CASE ...]`."""

from __future__ import annotations

import csv
import sys
from pathlib import Path

from magwire.evidence.verify.references.pushed import CASES, COLUMNS, curve

DATA = Path(__file__).parents[1] / "data" / "hard_wall"
LINKS = 800
EVERY = 0.005


def main(names: list[str]) -> None:
    for name in names or CASES:
        rows = curve(name, LINKS, 0.6 if name == "thin" else 0.72)
        kept = rows[(rows[:, 0] * LINKS).round().astype(int) % round(EVERY * LINKS) == 0]
        with (DATA / f"{name}.csv").open("w", newline="", encoding="utf-8") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(COLUMNS)
            table.writerows([f"{value:.4f}" for value in row] for row in kept)
        print(name, rows.max(axis=0))


if __name__ == "__main__":
    main(sys.argv[1:])

"""The page of `make bench`: that it comes out whole. Speed is never a test."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"
TABLES = ("1  Time step by case", "2  Against the number of nodes", "3  Against the number of")
OTHERS = ("4  Starts", "5  What recording and the result file cost")


@pytest.fixture(scope="module")
def quick(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, dict[str, Any]]:
    """What a quick run prints, and what it writes."""
    file = tmp_path_factory.mktemp("bench") / "bench.json"
    command = [sys.executable, BENCHMARKS / "run.py", "--quick", "--json", file]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    return done.stdout, json.loads(file.read_text(encoding="utf-8"))


def test_all_tables_are_printed(quick: tuple[str, dict[str, Any]]) -> None:
    page, _ = quick
    positions = [page.index(title) for title in (*TABLES, *OTHERS)]
    assert positions == sorted(positions)
    assert "dt [ms]" in page
    assert "Counts and peaks are the same in all repeats." in page
    assert "nan" not in page
    assert "…" not in page


def test_counts_stand_next_to_the_times(quick: tuple[str, dict[str, Any]]) -> None:
    _, results = quick
    for row in (*results["cases"], *results["nodes"], *results["points"]):
        for sample in row["samples"]:
            assert sample["converged"]
            assert sample["steps"] == round(sample["simulated"] / row["time_step"])
            assert sample["factorisations"] >= sample["newton_iterations"] > 0
            assert sample["seconds"] > 0.0


def test_same_march_is_measured_once(quick: tuple[str, dict[str, Any]]) -> None:
    _, results = quick
    rows = [*results["cases"], *results["nodes"], *results["points"]]
    known: dict[tuple[object, ...], object] = {}
    for row in rows:
        key = tuple(value for name, value in row.items() if name != "samples")
        assert known.setdefault(key, row["samples"]) == row["samples"]
    assert len(known) < len(rows)


def test_exponent_is_a_slope(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    from repeats import exponent

    sizes = np.array([50.0, 100.0, 200.0, 400.0, 800.0])
    assert exponent(sizes, 3e-6 * sizes**1.07) == pytest.approx(1.07)


def test_repeats_are_interleaved(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    from repeats import interleaved, least, median

    order: list[str] = []

    def job(name: str) -> dict[str, float]:
        order.append(name)
        return {"seconds": float(len(order))}

    jobs = {name: lambda name=name: job(name) for name in "ABC"}
    samples = interleaved(jobs, 3, lambda text: None, slow="C")
    assert "".join(order) == "ABCABABC"
    assert [len(samples[name]) for name in "ABC"] == [3, 3, 2]
    assert (median(samples["A"], "seconds"), least(samples["B"], "seconds")) == (4.0, 2.0)

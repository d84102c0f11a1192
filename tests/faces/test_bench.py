"""The page of `make bench`: that it comes out whole. Speed is never a test."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from magwire.cli import main
from magwire.evidence.bench import learning
from magwire.evidence.bench.others import by_driving, by_environment
from magwire.evidence.bench.page import load, text
from magwire.evidence.bench.repeats import exponent, interleaved, least, median

ROOT = Path(__file__).parents[2]
TABLES = ("1  Time step by case", "2  Against the number of nodes", "3  Against the number of")
OTHERS = ("4  Against the size", "5  Update", "6  Relative compute time", "7  Starts", "8  What")


@pytest.fixture(scope="module")
def quick() -> tuple[str, dict[str, Any]]:
    """The page of a quick run, and the samples that it is made of."""
    command = [sys.executable, "-m", "magwire", "bench", "--quick", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    results = json.loads(done.stdout)
    return text(results), results


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
    for row in (*results["cases"], *results["nodes"], *results["points"], *results["tree"]):
        for sample in row["samples"]:
            assert sample["converged"]
            assert sample["steps"] == round(sample["simulated"] / row["time_step"])
            assert sample["factorisations"] >= sample["newton_iterations"] > 0
            assert sample["seconds"] > 0.0


def test_same_march_is_measured_once(quick: tuple[str, dict[str, Any]]) -> None:
    _, results = quick
    rows = [*results["cases"], *results["nodes"], *results["points"], *results["tree"]]
    known: dict[tuple[object, ...], object] = {}
    for row in rows:
        key = tuple(value for name, value in row.items() if name != "samples")
        assert known.setdefault(key, row["samples"]) == row["samples"]
    assert len(known) < len(rows)


def test_updates_count_equilibria(quick: tuple[str, dict[str, Any]]) -> None:
    _, results = quick
    solves = {row["method"]: row["samples"][0]["solves"] for row in results["updates"]}
    assert solves["paper"] > 5 * solves["newton"] > 0
    assert not any(row["samples"][0]["stopped"] for row in results["updates"])


def test_steps_from_python_lead_to_the_same_place(quick: tuple[str, dict[str, Any]]) -> None:
    page, results = quick
    rows = results["by_hand"]
    assert [row["how"] for row in rows] == ["in one call", "one by one", "and observed"]
    tips = np.array([row["samples"][0]["tip"] for row in rows])
    assert np.ptp(tips, axis=0).max() < 1e-12  # round-off of the feed, in metres
    assert "15  Steps given from Python" in page


def test_fields_of_coils_stand_next_to_a_uniform_one(quick: tuple[str, dict[str, Any]]) -> None:
    page, results = quick
    uniform, *coils = results["actuators"]
    assert not uniform["points"]
    assert all(row["points"][0]["seconds"] > 0.0 for row in coils)
    assert {row["samples"][0]["steps"] for row in results["actuators"]} == {1000}
    assert "16  Fields of coils" in page


def test_page_of_the_documentation_is_made_of_its_samples(
    capsys: pytest.CaptureFixture[str],
) -> None:
    samples = ROOT / "docs" / "_static" / "bench.json"
    assert main(["bench", "--read", str(samples)]) == 0
    page = (ROOT / "docs" / "benchmarks.md").read_text(encoding="utf-8")
    assert text(load(samples)) in page
    assert "11  Other engines" in capsys.readouterr().out


def test_environments_have_a_row_each(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(learning, "WIRES", 2)
    deep, whole = (learning.batch(1, deep=deep, steps=2) for deep in (True, False))
    assert deep["rate"] > 0.0
    assert deep["newton"] >= 1.0
    rows = [{"what": name, "threads": 1, "samples": [s]} for name, s in (("a", deep), ("b", whole))]
    assert by_environment(rows).row_count == 2
    assert learning.resets(1, new=False)["rate"] > 0.0


def test_keys_and_pictures_have_a_table() -> None:
    row = {"what": "a", "painter": "canvas", "latencies": [0.04, 0.02], "pictures": 30.0}
    made = by_driving([row | {"clock": 1.0}])
    assert [list(column.cells) for column in made.columns[2:4]] == [["40"], ["40"]]


def test_exponent_is_a_slope() -> None:
    sizes = np.array([50.0, 100.0, 200.0, 400.0, 800.0])
    assert exponent(sizes, 3e-6 * sizes**1.07) == pytest.approx(1.07)


def test_repeats_are_interleaved() -> None:
    order: list[str] = []

    def job(name: str) -> dict[str, float]:
        order.append(name)
        return {"seconds": float(len(order))}

    jobs = {name: lambda name=name: job(name) for name in "ABC"}
    samples = interleaved(jobs, 3, lambda text: None, slow="C")
    assert "".join(order) == "ABCABABC"
    assert [len(samples[name]) for name in "ABC"] == [3, 3, 2]
    assert (median(samples["A"], "seconds"), least(samples["B"], "seconds")) == (4.0, 2.0)

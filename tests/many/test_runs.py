"""Many runs: the same numbers as one by one, in order, whatever becomes of the others."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import magwire as mw
from magwire.many.job import Job
from magwire.many.outcome import QUANTITIES, Outcome
from magwire.many.processes import Worker

SHORT = ("feed.distance=24 mm", "solver.time_step=100 ms", "wire.nodes=40", "navigate.method=none")
RADII = (2.5, 3.0, 3.5)


def scenarios() -> list[mw.Scenario]:
    return [mw.load_scenario("half-circle", (*SHORT, f"lumen.radius={r} mm")) for r in RADII]


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> tuple[list[Outcome], list[Outcome]]:
    """Outcomes of the three scenarios by two workers, the second one without a place to write."""
    out = tmp_path_factory.mktemp("many")
    (out / ".0001.nc.lock").mkdir()
    seen: list[Outcome] = []
    return mw.run_many(scenarios(), workers=2, out=out, watch=seen.append), seen


def test_outcomes_are_in_the_order_of_the_scenarios(
    done: tuple[list[Outcome], list[Outcome]],
) -> None:
    outcomes, seen = done
    assert [outcome.number for outcome in outcomes] == [0, 1, 2]
    assert sorted(seen, key=lambda outcome: outcome.number) == outcomes


def test_a_run_that_fails_leaves_the_others_alone(
    done: tuple[list[Outcome], list[Outcome]],
) -> None:
    first, failed, last = done[0]
    assert first.complete
    assert last.complete
    assert failed.status == "failed"
    assert "cannot be written" in failed.message
    assert not failed.numbers
    with pytest.raises(mw.ResultError, match="Run 1 left no result file"):
        failed.result()


def test_numbers_are_those_of_a_run_alone(done: tuple[list[Outcome], list[Outcome]]) -> None:
    for place in (0, 2):
        outcome, alone = done[0][place], scenarios()[place].run()
        assert list(outcome.numbers) == list(QUANTITIES)
        assert outcome.numbers["max_tip_force"] == alone.max_tip_force > 0.0
        assert outcome.numbers["first_contact"] == alone.first_contact
        np.testing.assert_array_equal(outcome.result().position, alone.position)


def test_worker_that_dies_is_replaced() -> None:
    job = Job(0, scenarios()[0].to_toml(), None)
    worker, going_on = Worker(), threading.Event()
    try:
        worker.kill()
        died = worker.run(job, going_on)
        assert died["status"] == "failed"
        assert died["message"].startswith("The process of the run ended with exit status ")
        assert worker.run(job, going_on)["status"] == "complete"
    finally:
        worker.stop()
        worker.close()


@pytest.mark.skipif(sys.platform == "win32", reason="sends a signal to itself")
def test_worker_whose_caller_is_gone_ends_its_run(tmp_path: Path) -> None:
    file = tmp_path / "result.nc"
    long = mw.load_scenario("half-circle", ("solver.time_step=0.2 ms", "navigate.method=none"))
    order = json.dumps({"scenario": long.to_toml(), "file": str(file)}) + "\n"
    command = [sys.executable, "-m", "magwire.many.worker"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdin is not None
        process.stdin.write(order.encode())
        process.stdin.flush()
        until = time.monotonic() + 240.0
        while time.monotonic() < until and not (file.exists() and mw.Result.load(file).time.size):
            time.sleep(0.05)
        process.stdin.close()
        process.wait(timeout=120)
    assert mw.Result.load(file).status == "interrupted"


def test_nothing_to_do() -> None:
    assert mw.run_many([]) == []


def test_workers_are_a_whole_number() -> None:
    with pytest.raises(mw.InputError, match="Input workers of run_many must be at least 1"):
        mw.run_many(scenarios(), workers=0)


def test_dask(tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    outcomes = mw.run_many(scenarios(), workers=1, cluster="local", out=tmp_path)
    for outcome, scenario in zip(outcomes, scenarios(), strict=True):
        np.testing.assert_array_equal(outcome.result().position, scenario.run().position)

"""Every example runs, and those with a closed form agree with it."""

from __future__ import annotations

import json
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

EXAMPLES = Path(__file__).parent.parent / "examples"
Names = dict[str, Any]


def magnetic_cantilever(names: Names) -> None:
    assert names["error"] < 1e-4
    assert np.degrees(names["expected"][3]) == pytest.approx(44.79, abs=0.005)
    assert all(state.stable for state in names["states"])


def antiparallel_buckling(names: Names) -> None:
    assert names["errors"][-1] < 1e-3
    assert names["order"] == pytest.approx(2.0, abs=0.1)


def half_circle(names: Names) -> None:
    assert names["result"].status == "complete"
    assert names["clearance"] > 0.0
    assert names["peak"] == pytest.approx(20.8, rel=0.1)


def own_wire(names: Names) -> None:
    assert names["result"].status == "complete"
    assert names["turned"] == pytest.approx(names["expected"], rel=1e-3)


def friction_in_a_spiral(names: Names) -> None:
    assert names["slope"] == pytest.approx(names["expected"], rel=0.03)
    assert names["rough"].status == names["smooth"].status == "complete"
    assert 0.5 < names["share"] < 1.0


def own_controller(names: Names) -> None:
    assert names["largest"]["steered"] < 0.5 * names["largest"]["pushed"]


def coronary_tree(names: Names) -> None:
    assert list(names["vessel"].tubes) == ["end-2", "end-3", "end-4", "end-5", "end-6"]
    assert names["lumen"].length == pytest.approx(0.135, abs=0.003)
    assert names["lumen"].path("end-5").narrowest > 0.8e-3
    assert names["result"].status == "complete"
    assert names["result"].smallest_clearance > 0.0


def train_policy(names: Names) -> None:
    told: list[str] = []
    search = names["Search"](iterations=2, directions=2, best=1)
    weights = names["train"]("Branch", search, 0, told.append)
    assert weights.shape == (5, 34)
    assert len(told) == 2
    assert np.all(weights[:, :-1] != 0.0)  # it has gone somewhere


def score_policies(names: Names) -> None:
    with_push = np.zeros((5, 34))
    with_push[0, -1] = 1.0
    found = names["scores"]("HalfCircle", with_push, 2)["policies"]
    returns = [found[kind]["mean"] for kind in ("stand still", "trained", "navigator")]
    assert returns == sorted(returns)
    docs = EXAMPLES.parent / "docs"
    kept = json.loads((docs / "_static" / "scores.json").read_text(encoding="utf-8"))
    page = (docs / "learning.md").read_text(encoding="utf-8")
    assert names["table"](kept) in page
    for one in kept.values():
        means = {kind: policy["mean"] for kind, policy in one["policies"].items()}
        idle = max(means[kind] for kind in ("stand still", "retract", "random"))
        assert idle < means["trained"]
        lead = one["navigator_lead"]
        assert lead["mean"] > lead["half_interval"]


CHECKS: dict[str, Callable[[Names], None]] = {
    "plot_magnetic_cantilever": magnetic_cantilever,
    "plot_antiparallel_buckling": antiparallel_buckling,
    "plot_half_circle": half_circle,
    "plot_own_wire": own_wire,
    "plot_coronary_tree": coronary_tree,
    "score_policies": score_policies,
    "train_policy": train_policy,
    "plot_friction_in_a_spiral": friction_in_a_spiral,
    "plot_own_controller": own_controller,
}


def test_every_example_has_a_check() -> None:
    assert {path.stem for path in EXAMPLES.glob("*.py")} == set(CHECKS)


@pytest.mark.parametrize("name", sorted(CHECKS))
def test_example(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    import matplotlib.pyplot as plt

    monkeypatch.setattr(plt, "show", lambda: None)
    try:
        CHECKS[name](runpy.run_path(str(EXAMPLES / f"{name}.py")))
    finally:
        plt.close("all")

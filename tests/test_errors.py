from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from magwire import errors


@pytest.mark.parametrize(
    ("check", "message"),
    [
        (
            lambda: errors.positive("Section", "radius", -0.1, "m"),
            "Input radius of Section must be positive; received -0.1 m.",
        ),
        (
            lambda: errors.positive("Section", "radius", 0, "m"),
            "Input radius of Section must be positive; received 0 m.",
        ),
        (
            lambda: errors.nonnegative("Simulation", "damping", -1.0, "1/s"),
            "Input damping of Simulation must be zero or positive; received -1 1/s.",
        ),
        (
            lambda: errors.finite("Feed", "twist", float("nan"), "rad"),
            "Input twist of Feed must be a finite number; received nan rad.",
        ),
        (
            lambda: errors.finite("Feed", "twist", "a", "rad"),
            "Input twist of Feed must be a number; received 'a'.",
        ),
        (
            lambda: errors.within("Simulation", "feed", 0.2, "m", low=0.0, high=0.1),
            "Input feed of Simulation must be between 0 and 0.1 m; received 0.2 m.",
        ),
        (
            lambda: errors.whole("Wire", "nodes", 2, minimum=4),
            "Input nodes of Wire must be at least 4; received 2.",
        ),
        (
            lambda: errors.whole("Wire", "nodes", 2.5, minimum=4),
            "Input nodes of Wire must be a whole number; received 2.5.",
        ),
        (
            lambda: errors.array("Lumen", "points", np.zeros((4, 2)), (None, 3), "m"),
            "Input points of Lumen must have shape (n, 3); received shape (4, 2).",
        ),
        (
            lambda: errors.array("UniformField", "flux_density", [0, np.inf, 0], (3,), "T"),
            "Input flux_density of UniformField must be finite; received [ 0., inf,  0.] T.",
        ),
        (
            lambda: errors.one_of("Barrier", "wall", "top", ("surface", "centreline")),
            "Input wall of Barrier must be 'surface' or 'centreline'; received 'top'.",
        ),
    ],
)
def test_messages(check: Callable[[], object], message: str) -> None:
    with pytest.raises(errors.InputError) as caught:
        check()
    assert str(caught.value) == message


@pytest.mark.parametrize("value", [0.02, "stable", None, dict, object()])
def test_what_lacks_a_member_is_refused(value: object) -> None:
    with pytest.raises(errors.InputError, match="Input a of B must be a mapping; received "):
        errors.offering("B", "a", value, [("keys", "values"), ("mapping",)], "a mapping")


def test_one_choice_of_members_is_enough() -> None:
    errors.offering("B", "a", {}, [("mapping",), ("keys", "values")], "a mapping")


def test_what_may_be_left_out() -> None:
    errors.instance("B", "a", None, dict, or_none=True)
    with pytest.raises(errors.InputError, match="must be a dict; received None"):
        errors.instance("B", "a", None, dict)


def test_good_values_pass() -> None:
    assert errors.positive("A", "b", np.float32(2.0)) == 2.0
    assert errors.whole("A", "b", np.int64(5), minimum=5) == 5
    assert errors.array("A", "b", [1, 2, 3], (3,)).dtype == np.float64
    assert errors.within("A", "b", 1, low=0, high=1) == 1.0


def test_scenario_error_holds_every_fault() -> None:
    error = errors.ScenarioError(["One.", "Two."])
    assert error.faults == ("One.", "Two.")
    assert str(error) == "One.\nTwo."
    assert errors.ScenarioError("One.").faults == ("One.",)

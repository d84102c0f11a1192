"""Runs through hardware: the wire is in the field that the hardware makes."""

from __future__ import annotations

import numpy as np
import pytest

import magwire as mw
from magwire.actuate import Hardware, Uniform
from magwire.navigate.inputs import InputSchedule

from .test_allocation import half_circle, platform

FEED = mw.Feed(4e-3, 0.02)
NAMES = (("Ix", "A"), ("Iy", "A"), ("Iz", "A"))
RAMP = InputSchedule(
    np.array([0.0, 0.005, 0.02]), np.array([[0.0, 0, 0], [6.0, 2, 0], [8.0, 10, 1]]), NAMES
)


def run(hardware: Hardware | None) -> mw.Result:
    return half_circle(platform()).run(
        FEED, mw.Prescribed(RAMP), time_step=0.02, record_every=8e-5, hardware=hardware
    )


@pytest.fixture(scope="module")
def plain() -> mw.Result:
    return run(None)


def test_hardware_that_does_as_told_changes_nothing(plain: mw.Result) -> None:
    same = run(Hardware(ramps=False))
    np.testing.assert_array_equal(same.position, plain.position)
    np.testing.assert_array_equal(same.field, plain.field)


def test_the_wire_is_in_the_field_that_the_hardware_makes(plain: mw.Result) -> None:
    """Recorded inputs are those that flow; the field is theirs, of tilted coils."""
    tilts = ((0.0, 0.0, 0.02), (0.0, 0.0, -0.01), (0.01, 0.0, 0.0))
    hardware = Hardware(
        quantum=0.01, delay=0.04, gain_errors=(0.03, -0.03, 0.03), tilts=tilts, ramps=False
    )
    made = run(hardware)
    late = np.maximum(made.time - 0.04, 0.0)
    told = RAMP.at(4e-3 * late)
    flows = made.dataset["inputs"].values
    np.testing.assert_allclose(flows[1:], ([1.03, 0.97, 1.03] * told)[1:], atol=0.0052)
    set_to = flows / [1.03, 0.97, 1.03] / 0.01
    np.testing.assert_allclose(set_to, np.round(set_to), atol=1e-6)
    there = hardware.built(platform()).at(made.position[-1, -1:], flows[-1])[0][0]
    np.testing.assert_allclose(made.field[-1], there, rtol=1e-9)
    assert np.linalg.norm(made.position[-1, -1] - plain.position[-1, -1]) > 2e-6


def test_a_weak_supply_holds_the_current_back() -> None:
    weak = platform()
    slow = mw.Simulation(
        half_circle(weak).system.wire, half_circle(weak).system.lumen, actuator=Uniform(slew=2e-3)
    )
    jump = InputSchedule(
        np.array([0.0, 1e-9, 0.02]),
        np.array([[0.0, 0, 0], [0, 8e-3, 0], [0, 8e-3, 0]]),
        (("Bx", "T"), ("By", "T"), ("Bz", "T")),
    )
    made = slow.run(
        FEED, mw.Prescribed(jump), time_step=0.02, record_every=8e-5, hardware=Hardware()
    )
    expected = np.minimum(2e-3 * made.time, 8e-3)
    np.testing.assert_allclose(made.field[:, 1], expected, atol=1e-9)


def test_a_number_of_errors_that_is_not_the_inputs() -> None:
    with pytest.raises(mw.InputError, match="one for each of 3 inputs, or one for all; received 2"):
        run(Hardware(gain_errors=(0.01, 0.02)))

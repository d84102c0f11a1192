"""Keys of walls that give way and move: what they build, what they refuse, that they read back."""

from __future__ import annotations

import pytest

from magwire.engine.system import System
from magwire.errors import ScenarioError
from magwire.scenario import load
from magwire.scenario.reader import parse

BREATH = (
    'breathing.amplitude=["0 mm", "1 mm", "0 mm"]',
    "breathing.period=4 s",
    "breathing.ramp=20 mm",
)


def built(*settings: str) -> System:
    keys = [f"contact.{setting}" for setting in settings]
    return load("half-circle", ["navigate.method=none", *keys]).build().simulation.system


def test_they_are_built_as_they_are_written() -> None:
    pulse = [key.replace("breathing", "pulsation") for key in BREATH]
    system = built("foundation=200 MPa/m", *BREATH, *pulse)
    assert system.contact.foundation == 2e8
    assert len(system.wall_motion) == 2
    breath = system.wall_motion[0]
    assert (list(breath.amplitude), breath.period, breath.ramp) == ([0.0, 1e-3, 0.0], 4.0, 0.02)  # type: ignore[arg-type]
    assert system.smooth.wall_motion == system.still.wall_motion == ()
    assert system.smooth.contact.foundation == 2e8


def test_they_read_back() -> None:
    scenario = load("half-circle", [f"contact.{key}" for key in ("foundation=1 kPa/mm", *BREATH)])
    again = parse(scenario.to_toml())
    assert again == scenario
    assert again.contact.foundation == 1e6
    assert again.contact.pulsation is None


def test_walls_are_rigid_and_at_rest_unless_it_is_asked_for() -> None:
    system = built()
    assert system.contact.foundation is None
    assert system.wall_motion == ()
    bed = system.new_wall().bed
    assert bed.deepest == 0.0
    assert not bed.ratio.any()
    assert system.new_moving() == ()


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (("foundation=0 Pa/m",), r"contact\.foundation must be positive"),
        (("foundation=1 Pa",), r"contact\.foundation needs a unit of pressure per depth"),
        (BREATH[:2], r"contact\.breathing\.ramp"),
        ((*BREATH[:2], "breathing.ramp=2 mm"), r"contact\.breathing\.ramp must be at least"),
        ((*BREATH, "breathing.phase=0"), r"contact\.breathing\.phase"),
    ],
)
def test_faults_are_told(settings: tuple[str, ...], words: str) -> None:
    with pytest.raises(ScenarioError, match=words):
        built(*settings)

"""The table of friction: what it builds, what it refuses, and that it reads back."""

from __future__ import annotations

import pytest

from magwire.contact import Friction
from magwire.errors import ScenarioError
from magwire.scenario import load
from magwire.scenario.reader import parse


def set_to(*settings: str) -> Friction | None:
    keys = [f"contact.friction.{setting}" for setting in settings]
    return load("half-circle", ["navigate.method=none", *keys]).build().simulation.system.friction


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        (("static=0.1",), Friction(0.1)),
        (("static=0.1", "kinetic=0.08"), Friction(0.1, 0.08)),
        (("static=[0.1, 0.2]", "kinetic=0.05"), Friction((0.1, 0.2), 0.05)),
        (('drag="20 mN s/m^2"',), Friction(drag=0.02)),
        (
            ("static=0.1", 'along=[["10 mm", 1.0], ["40 mm", 2]]'),
            Friction(0.1, along=((0.01, 1.0), (0.04, 2.0))),
        ),
    ],
)
def test_it_is_built_as_it_is_written(settings: tuple[str, ...], expected: Friction) -> None:
    built = set_to(*settings)
    assert built is not None
    assert built.of_sections(2)[0].tolist() == expected.of_sections(2)[0].tolist()
    assert built.of_sections(2)[1].tolist() == expected.of_sections(2)[1].tolist()
    assert (built.drag, built.along) == (expected.drag, expected.along)


def test_it_reads_back() -> None:
    keys = ("static=[0.1, 0.2]", "kinetic=0.05", 'along=[["10 mm", 1.0], ["40 mm", 2.0]]')
    scenario = load("half-circle", [f"contact.friction.{key}" for key in keys])
    again = parse(scenario.to_toml())
    assert again == scenario
    assert again.contact.friction.static == (0.1, 0.2)


def test_there_is_none_unless_it_is_asked_for() -> None:
    scenario = load("half-circle")
    assert not scenario.build().simulation.system.rubs
    assert "static = 0.0" in scenario.to_toml()


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("static=-0.1", "contact.friction.static must be zero or positive"),
        ('static="0.1 mm"', "contact.friction.static must be a plain number"),
        ("static=[]", "contact.friction.static must have at least one entry"),
        ("kinetic=0.2", "contact.friction.kinetic must be at most static"),
        ("static=[0.1, 0.1, 0.1]", "contact.friction.static must have one value, or one for each"),
        ("drag=3", "contact.friction.drag needs a unit of viscous drag"),
        ('along=[["10 mm"]]', "contact.friction.along must be a list of rows"),
        ('along=[["10 mm", 1.0], ["5 mm", 1.0]]', "contact.friction.along must have rising arcs"),
        ("coefficient=0.1", "contact.friction.coefficient"),
    ],
)
def test_faults_are_told(setting: str, words: str) -> None:
    with pytest.raises(ScenarioError, match=words.replace(".", r"\.")):
        set_to(setting)

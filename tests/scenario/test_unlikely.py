"""Values that no material or magnet has are run, and told."""

from __future__ import annotations

import pytest
import tomli_w

import magwire as mw
from magwire.scenario import names
from magwire.scenario.reader import parse


@pytest.mark.parametrize(
    ("override", "note"),
    [
        ("wire.youngs_modulus=3 Pa", "wire.youngs_modulus is 3 Pa; gels have some kPa"),
        ("wire.shear_modulus=1 Pa", "wire.shear_modulus is 1 Pa; gels"),
        ("wire.density=2 kg/m^3", "wire.density is 2 kg/m^3; foams"),
        ("wire.magnetization=1.2 A/m", "wire.magnetization is 0.0012 kA/m; soft composites"),
        ("wire.magnetization=['0 A/m', '3 MA/m', '4 MA/m']", "is 5000 kA/m; soft composites"),
        (
            "field.flux_density=['0 T', '0 T', '20 T']",
            "field.flux_density is 20000 mT; laboratories'",
        ),
    ],
)
def test_a_wrong_unit_is_asked_about(override: str, note: str) -> None:
    scenario = mw.load_scenario("half-circle", (override,))
    (said,) = scenario.notes
    assert note in said
    assert said.endswith(": is its unit right?")


def test_sections_are_asked_about_one_by_one() -> None:
    section = {"length": "50 mm", "radius": "0.3 mm", "density": "2000 kg/m^3"}
    soft = {**section, "youngs_modulus": "60 Pa", "shear_modulus": "20 MPa"}
    hard = {**section, "youngs_modulus": "60 MPa", "shear_modulus": "20 MPa"}
    text = tomli_w.dumps(
        {
            "wire": {"nodes": 40, "sections": [hard, soft]},
            "lumen": {"shape": "straight", "length": "100 mm", "radius": "3 mm"},
            "feed": {"speed": "1 mm/s", "distance": "20 mm"},
        }
    )
    (note,) = parse(text).notes
    assert note.startswith("wire.sections[1].youngs_modulus is 60 Pa; gels have some kPa")


@pytest.mark.parametrize("name", names())
def test_nothing_is_said_of_the_library(name: str) -> None:
    assert mw.load_scenario(name).notes == ()


@pytest.mark.parametrize(
    "zero", ["wire.magnetization=0 A/m", "field.flux_density=['0 T','0 T','0 T']"]
)
def test_zero_is_no_slip(zero: str) -> None:
    assert mw.load_scenario("half-circle", (zero, "navigate.method=none")).notes == ()

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from magwire.errors import InputError
from magwire.units import DIMENSIONS, parse, show, write


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("5 mm", "length", 0.005),
        ("5mm", "length", 0.005),
        ("  -2.5e-1 cm ", "length", -0.0025),
        ("0.6 mm", "length", 0.0006),
        ("3 µm", "length", 3e-6),
        ("3 μm", "length", 3e-6),
        ("0.014 in", "length", 0.0003556),
        ("0.014 inch", "diameter", 0.0003556),
        ("3 Fr", "diameter", 0.001),
        ("1.5 Fr", "diameter", 0.0005),
        ("10 Fr", "diameter", 0.01 / 3.0),
        ("20 N mm²", "bending_stiffness", 20e-6),
        ("2e-5 N·m^2", "bending_stiffness", 2e-5),
        ("0.8 g/m", "mass_per_length", 0.0008),
        ("100 rad/m", "twist", 100.0),
        ("10 ms", "time", 0.01),
        ("2 min", "time", 120.0),
        ("1 mm/s", "speed", 0.001),
        ("3 MPa", "pressure", 3e6),
        ("1 N/mm^2", "pressure", 1e6),
        ("2000 kg/m³", "density", 2000.0),
        ("2 g/cm^3", "density", 2000.0),
        ("128 kA/m", "magnetization", 128e3),
        ("1 MA/m", "magnetization", 1e6),
        ("10 mT", "flux_density", 0.01),
        ("100 G", "flux_density", 0.01),
        ("5 uT", "flux_density", 5e-6),
        ("0.5 T/mm", "flux_gradient", 500.0),
        ("90 deg", "angle", math.pi / 2),
        ("180°", "angle", math.pi),
        ("1 turn", "angle", 2 * math.pi),
        ("2 1/mm", "curvature", 2000.0),
        ("2 1 / mm", "curvature", 2000.0),
        ("9.81 m/s^2", "acceleration", 9.81),
        ("0.01 1/s", "rate", 0.01),
        ("1.2 mN", "force", 0.0012),
        ("250 mA", "current", 0.25),
        ("5 A/mm²", "current_density", 5e6),
        ("48 V", "voltage", 48.0),
        ("0.5 Ω", "resistance", 0.5),
        ("0.5 \u2126", "resistance", 0.5),
        ("300 mohm", "resistance", 0.3),
        ("20 mH", "inductance", 0.02),
        ("1.5 kW", "power", 1500.0),
        ("2 A m²", "magnetic_moment", 2.0),
        ("2 A·m^2", "magnetic_moment", 2.0),
        ("7 emu", "magnetic_moment", 0.007),
        ("0.1 N s/m", "viscous_coefficient", 0.1),
        ("3 mN·s/m", "viscous_coefficient", 0.003),
        ("10 MPa/m", "pressure_per_depth", 1e7),
        ("12 uN m", "torque", 12e-6),
        ("0.5", "dimensionless", 0.5),
        (3, "dimensionless", 3.0),
    ],
)
def test_text_becomes_si(text: str | int, dimension: str, value: float) -> None:
    assert parse(text, dimension) == value


@pytest.mark.parametrize(
    ("given", "dimension", "message"),
    [
        (10, "time", "Input x needs a unit of time such as '10 ms'; received 10."),
        ("7", "time", "Input x needs a unit of time such as '10 ms'; received 7."),
        (
            "10 mm",
            "time",
            "Input x needs a unit of time such as '10 ms'; received '10 mm', which is a length.",
        ),
        (
            "3 Fr",
            "length",
            "Input x needs a unit of length such as '5 mm'; received '3 Fr', which is a diameter.",
        ),
        (
            "3 mH",
            "resistance",
            "Input x needs a unit of resistance such as '0.5 ohm'; received '3 mH', which is an "
            "inductance.",
        ),
        (
            "3 A m^2",
            "magnetization",
            "Input x needs a unit of magnetisation such as '128 kA/m'; received '3 A m^2', which "
            "is a magnetic moment.",
        ),
        ("3 ells", "length", "Input x needs a unit of length such as '5 mm'; received '3 ells'."),
        ("5 MM", "length", "Input x needs a unit of length such as '5 mm'; received '5 MM'."),
        (
            "wide",
            "length",
            "Input x must be a number with a unit of length such as '5 mm'; received 'wide'.",
        ),
        (
            "",
            "length",
            "Input x must be a number with a unit of length such as '5 mm'; received ''.",
        ),
        ("nan mm", "length", "Input x must be a finite number; received nan mm."),
        (math.inf, "length", "Input x must be a finite number; received inf."),
        ("1e999 m", "length", "Input x must be a finite number; received 1e999 m."),
        (True, "length", "Input x must be text such as '5 mm'; received True."),
        ([1], "length", "Input x must be text such as '5 mm'; received [1]."),
        ("3 m", "dimensionless", "Input x takes no unit; received '3 m'."),
        ("a", "dimensionless", "Input x must be a plain number such as 0.5; received 'a'."),
    ],
)
def test_faulty_text_is_refused(given: object, dimension: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse(given, dimension, "x")
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("value", "dimension", "text"),
    [
        (0.072, "length", "72 mm"),
        (0.0, "length", "0 mm"),
        (0.0012, "force", "1.2 mN"),
        (3e6, "pressure", "3 MPa"),
        (1e3, "pressure", "1 kPa"),
        (0.01, "time", "10 ms"),
        (72.0, "time", "72 s"),
        (0.02, "inductance", "20 mH"),
        (2e6, "pressure_per_depth", "2 MPa/m"),
        (0.003, "viscous_coefficient", "3 mN s/m"),
        (128e3, "magnetization", "128 kA/m"),
        (math.pi / 2, "angle", "90 deg"),
    ],
)
def test_show_uses_customary_units(value: float, dimension: str, text: str) -> None:
    assert show(value, dimension) == text


@given(
    value=st.floats(allow_nan=False, allow_infinity=False, min_value=-1e12, max_value=1e12),
    dimension=st.sampled_from(sorted(DIMENSIONS)),
)
def test_written_text_reads_back_exactly(value: float, dimension: str) -> None:
    assert parse(write(value, dimension), dimension) == value

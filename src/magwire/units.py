"""Quantities as people write them: text with a unit in, SI out, and back.

>>> parse("5 mm", "length")
0.005
>>> show(0.005, "length")
'5 mm'
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cache

from magwire.errors import InputError, shortened

_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", re.DOTALL)
_PLAIN = re.compile(r"[+-]?[0-9]+\.?[0-9]*(?:[eE][+-]?[0-9]{1,3})?")
_NOT_A_NUMBER = re.compile(r"\s*([+-]?(?:nan|inf|infinity))\b\s*(.*?)\s*", re.IGNORECASE)
# Other spellings of the same thing: both micro signs, both ohms, middle dot, superscripts, "1 / m".
_SPELLINGS = str.maketrans(
    {
        "µ": "u",
        "μ": "u",
        "·": " ",
        "²": "^2",
        "³": "^3",
        "°": "deg",
        "⁻": "-",
        "¹": "^1",
        "Ω": "ohm",
        "\u2126": "ohm",
    }
)


@dataclass(frozen=True)
class Dimension:
    """A kind of quantity and the units it may be written in.

    Attributes
    ----------
    name
        As messages call it ("a unit of <name>").
    example
        What a well-formed value looks like.
    units
        Factor of each unit to SI; a fraction where no short decimal number will do.
    preferred
        Units that ``show`` picks from, largest first; the last one serves for what is smaller.
    """

    name: str
    example: str
    units: dict[str, float | Fraction]
    preferred: tuple[str, ...]


_LENGTH: dict[str, float | Fraction] = {
    "m": 1.0,
    "dm": 0.1,
    "cm": 1e-2,
    "mm": 1e-3,
    "um": 1e-6,
    "nm": 1e-9,
}
_LENGTH |= {"in": 0.0254, "inch": 0.0254}
_FRENCH: dict[str, float | Fraction] = {
    "Fr": Fraction(1, 3000)
}  # French gauge: thirds of a millimetre, of a diameter
_TIME: dict[str, float | Fraction] = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "min": 60.0, "h": 3600.0}
_FLUX: dict[str, float | Fraction] = {"T": 1.0, "mT": 1e-3, "uT": 1e-6, "G": 1e-4, "kG": 0.1}

DIMENSIONS: dict[str, Dimension] = {
    "length": Dimension("length", "5 mm", _LENGTH, ("mm",)),
    "diameter": Dimension("diameter", "0.6 mm", _LENGTH | _FRENCH, ("mm",)),
    "time": Dimension("time", "10 ms", _TIME, ("s", "ms")),
    "speed": Dimension(
        "speed",
        "1 mm/s",
        {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3, "um/s": 1e-6, "mm/min": 1e-3 / 60.0},
        ("mm/s",),
    ),
    "acceleration": Dimension(
        "acceleration",
        "9.81 m/s^2",
        {"m/s^2": 1.0, "m/s2": 1.0, "mm/s^2": 1e-3, "mm/s2": 1e-3},
        ("m/s^2",),
    ),
    "pressure": Dimension(
        "pressure",
        "3 MPa",
        {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "N/m^2": 1.0, "N/mm^2": 1e6, "bar": 1e5},
        ("GPa", "MPa", "kPa", "Pa"),
    ),
    "density": Dimension(
        "density",
        "2000 kg/m^3",
        {"kg/m^3": 1.0, "kg/m3": 1.0, "g/cm^3": 1e3, "g/cm3": 1e3, "g/ml": 1e3, "kg/l": 1e3},
        ("kg/m^3",),
    ),
    "magnetization": Dimension(
        "magnetisation",
        "128 kA/m",
        {"A/m": 1.0, "kA/m": 1e3, "MA/m": 1e6, "A/mm": 1e3, "emu/cm^3": 1e3, "emu/cm3": 1e3},
        ("kA/m",),
    ),
    "flux_density": Dimension("flux density", "10 mT", _FLUX, ("mT",)),
    "flux_gradient": Dimension(
        "flux gradient",
        "0.5 T/m",
        {
            "T/m": 1.0,
            "mT/m": 1e-3,
            "uT/m": 1e-6,
            "T/mm": 1e3,
            "mT/mm": 1.0,
            "mT/cm": 0.1,
            "G/cm": 1e-2,
        },
        ("T/m",),
    ),
    "angle": Dimension(
        "angle",
        "90 deg",
        {"rad": 1.0, "mrad": 1e-3, "deg": math.pi / 180.0, "turn": 2 * math.pi},
        ("deg",),
    ),
    "curvature": Dimension(
        "curvature", "10 1/m", {"1/m": 1.0, "1/cm": 1e2, "1/mm": 1e3, "rad/m": 1.0}, ("1/m",)
    ),
    "rate": Dimension("rate", "0.01 1/s", {"1/s": 1.0, "1/ms": 1e3, "1/min": 1 / 60.0}, ("1/s",)),
    "rate_squared": Dimension(
        "squared rate", "1 1/s^2", {"1/s^2": 1.0, "rad^2/s^2": 1.0, "1/ms^2": 1e6}, ("1/s^2",)
    ),
    "drag": Dimension(
        "viscous drag per length",
        "10 N s/m^2",
        {"N s/m^2": 1.0, "mN s/m^2": 1e-3, "Pa s": 1.0, "mPa s": 1e-3, "mN s/mm^2": 1e3},
        ("N s/m^2",),
    ),
    "twist": Dimension(
        "twist per length",
        "100 rad/m",
        {
            "rad/m": 1.0,
            "rad/mm": 1e3,
            "1/m": 1.0,
            "deg/m": math.pi / 180.0,
            "deg/mm": math.pi / 0.18,
            "turn/m": 2.0 * math.pi,
        },
        ("rad/m",),
    ),
    "bending_stiffness": Dimension(
        "bending stiffness",
        "20 N mm^2",
        {
            "N m^2": 1.0,
            "N*m^2": 1.0,
            "Nm^2": 1.0,
            "N mm^2": 1e-6,
            "N*mm^2": 1e-6,
            "Nmm^2": 1e-6,
            "mN m^2": 1e-3,
            "uN m^2": 1e-6,
            "mN mm^2": 1e-9,
        },
        ("N mm^2", "mN mm^2"),
    ),
    "mass_per_length": Dimension(
        "mass per length",
        "1.2 g/m",
        {"kg/m": 1.0, "g/m": 1e-3, "mg/mm": 1e-3, "g/cm": 0.1, "mg/m": 1e-6},
        ("g/m",),
    ),
    "force": Dimension("force", "1 mN", {"N": 1.0, "mN": 1e-3, "uN": 1e-6, "nN": 1e-9}, ("mN",)),
    "torque": Dimension(
        "torque",
        "1 uN m",
        {
            "N m": 1.0,
            "N*m": 1.0,
            "Nm": 1.0,
            "mN m": 1e-3,
            "uN m": 1e-6,
            "mN mm": 1e-6,
            "N mm": 1e-3,
        },
        ("mN m", "uN m"),
    ),
    "current": Dimension("current", "5 A", {"A": 1.0, "mA": 1e-3, "uA": 1e-6, "kA": 1e3}, ("A",)),
    "current_density": Dimension(
        "current density", "5 A/mm^2", {"A/m^2": 1.0, "A/cm^2": 1e4, "A/mm^2": 1e6}, ("A/mm^2",)
    ),
    "voltage": Dimension("voltage", "48 V", {"V": 1.0, "mV": 1e-3, "kV": 1e3}, ("V",)),
    "resistance": Dimension(
        "resistance", "0.5 ohm", {"ohm": 1.0, "mohm": 1e-3, "kohm": 1e3}, ("ohm", "mohm")
    ),
    "inductance": Dimension(
        "inductance", "20 mH", {"H": 1.0, "mH": 1e-3, "uH": 1e-6}, ("H", "mH", "uH")
    ),
    "power": Dimension("power", "500 W", {"W": 1.0, "mW": 1e-3, "kW": 1e3}, ("W", "mW")),
    "flux_rate": Dimension(
        "rate of flux density", "1 T/s", {"T/s": 1.0, "mT/s": 1e-3, "G/s": 1e-4}, ("T/s", "mT/s")
    ),
    "flux_gradient_rate": Dimension(
        "rate of flux gradient", "1 T/m/s", {"T/m/s": 1.0, "mT/m/s": 1e-3}, ("T/m/s",)
    ),
    "angular_speed": Dimension(
        "angular speed",
        "90 deg/s",
        {"rad/s": 1.0, "deg/s": math.pi / 180.0, "turn/s": 2.0 * math.pi},
        ("deg/s",),
    ),
    "magnetic_moment": Dimension(
        "magnetic moment",
        "2 A m^2",
        {
            "A m^2": 1.0,
            "A*m^2": 1.0,
            "Am^2": 1.0,
            "mA m^2": 1e-3,
            "A mm^2": 1e-6,
            "J/T": 1.0,
            "emu": 1e-3,
        },
        ("A m^2", "mA m^2"),
    ),
    "viscous_coefficient": Dimension(
        "viscous coefficient",
        "0.1 N s/m",
        {"N s/m": 1.0, "N*s/m": 1.0, "Ns/m": 1.0, "mN s/m": 1e-3, "mN s/mm": 1.0, "kg/s": 1.0},
        ("N s/m", "mN s/m"),
    ),
    "pressure_per_depth": Dimension(
        "pressure per depth",
        "10 MPa/m",
        {"Pa/m": 1.0, "kPa/m": 1e3, "MPa/m": 1e6, "GPa/m": 1e9, "kPa/mm": 1e6, "N/m^3": 1.0},
        ("GPa/m", "MPa/m", "kPa/m", "Pa/m"),
    ),
    "dimensionless": Dimension("none", "0.5", {"": 1.0, "1": 1.0}, ("",)),
}


def parse(value: object, dimension: str, name: str = "") -> float:
    """A quantity in SI.

    Parameters
    ----------
    value
        Text such as ``"5 mm"``. Zero needs its unit, too; a plain number passes only where the
        dimension is "dimensionless".
    dimension
        A key of ``DIMENSIONS``.
    name
        What messages call the input; "value" if left out.

    Returns
    -------
    float
        The value in the SI unit of the dimension, always finite.

    Raises
    ------
    InputError
        If the text is no number with a unit of this dimension.
    """
    kind = DIMENSIONS[dimension]
    if isinstance(value, str):  # as most are; what follows is for other spellings, and for faults
        digits, _, unit = value.partition(" ")
        if unit in kind.units and _PLAIN.fullmatch(digits):
            number = float(Decimal(digits) * _exact(kind.units[unit]))
            if math.isfinite(number):
                return number
    what = f"Input {name or 'value'}"
    plain = isinstance(value, (int, float)) and not isinstance(value, bool)
    text = shortened(value)
    if not plain and not isinstance(value, str):
        raise InputError(f"{what} must be text such as '{kind.example}'; received {value!r}.")
    cleaned = text.translate(_SPELLINGS)
    if _NOT_A_NUMBER.fullmatch(cleaned):
        raise InputError(f"{what} must be a finite number; received {text}.")
    match = _NUMBER.fullmatch(cleaned)
    if match is None:
        raise InputError(
            f"{what} must be a number with a unit of {kind.name} such as '{kind.example}'; "
            f"received {text!r}."
            if dimension != "dimensionless"
            else f"{what} must be a plain number such as {kind.example}; received {text!r}."
        )
    unit = re.sub(r"\s*([/^*])\s*", r"\1", match[2])
    if unit not in kind.units:
        raise InputError(_wrong_unit(what, kind, unit, text))
    # Decimal arithmetic: "0.6 mm" is 0.0006 exactly, not 0.0006 and some rounding.
    try:
        number = float(Decimal(match[1]) * _exact(kind.units[unit]))
    except ArithmeticError:  # an exponent that is beyond even a decimal number's
        number = 0.0 if "e-" in match[1].lower() else math.inf
    if not math.isfinite(number):
        raise InputError(f"{what} must be a finite number; received {text}.")
    return number


def parse_column(texts: Sequence[str], unit: str, dimension: str) -> list[float]:
    """Numbers that share a unit, in SI: what ``parse`` makes of each with the unit, but faster.

    Parameters
    ----------
    texts
        Numbers without their unit.
    unit
        The one that they all have.
    dimension
        A key of ``DIMENSIONS``.

    Raises
    ------
    InputError
        If one is no number.
    """
    factor = _exact(DIMENSIONS[dimension].units[unit])
    if factor.as_tuple().digits == (1,) and "_" not in "".join(texts):
        tail = f"e{factor.adjusted()}"  # moving the point is exact, as decimal arithmetic is
        try:
            values = [float(text + tail) for text in texts]
        except ValueError:  # one has an exponent of its own, or is no number
            values = _moved(texts, factor.adjusted())
        if math.isfinite(sum(values)):
            return values
    return [parse(f"{text} {unit}", dimension) for text in texts]


def _moved(texts: Sequence[str], places: int) -> list[float]:
    """Numbers, with an exponent or without one, times a power of ten; one NaN if one is none."""
    tail, values = f"e{places}", []
    try:
        for text in texts:
            if "e" in text or "E" in text:
                digits, _, power = text.strip().lower().partition("e")
                values.append(float(f"{digits}e{int(power) + places}"))
            else:
                values.append(float(text.strip() + tail))
    except ValueError:
        return [math.nan]
    return values


def show(value: float, dimension: str) -> str:
    """A quantity in SI as people write it, in the unit that is customary for it.

    The text is short (six digits); ``write`` gives the one that reads back to the same number.
    """
    unit = _customary(value, DIMENSIONS[dimension])
    number = value / float(DIMENSIONS[dimension].units[unit])
    return f"{number:.6g} {unit}".rstrip()


def write(value: float, dimension: str) -> str:
    """A quantity in SI as text that ``parse`` reads back to exactly the same number."""
    kind = DIMENSIONS[dimension]
    unit = _customary(value, kind)
    factor = kind.units[unit]
    for digits in (6, 12, 15, 16, 17):
        text = f"{value / float(factor):.{digits}g}"
        if float(Decimal(text) * _exact(factor)) == value:
            return f"{text} {unit}".rstrip()
    base = next(name for name, factor in kind.units.items() if factor == 1.0)
    return f"{value!r} {base}".rstrip()


@cache
def _exact(factor: float | Fraction) -> Decimal:
    """A factor as decimal number, to the digits that it is written with."""
    if isinstance(factor, Fraction):
        return Decimal(factor.numerator) / Decimal(factor.denominator)
    return Decimal(repr(factor)).normalize()


def _customary(value: float, kind: Dimension) -> str:
    for unit in kind.preferred:
        if abs(value) >= kind.units[unit] or value == 0.0:
            return unit
    return kind.preferred[-1]


def _wrong_unit(what: str, kind: Dimension, unit: str, text: str) -> str:
    if kind.name == "none":
        return f"{what} takes no unit; received {text!r}."
    needs = f"{what} needs a unit of {kind.name} such as '{kind.example}'; received"
    if not unit:
        return f"{needs} {text}."
    other = [k.name for k in DIMENSIONS.values() if unit in k.units and k is not kind]
    if other:
        article = "an" if other[0][0] in "aeiou" else "a"
        return f"{needs} {text!r}, which is {article} {other[0]}."
    return f"{needs} {text!r}."

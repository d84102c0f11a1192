"""Fields of a scenario: text with a unit in the file, SI in the model."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from magwire import units
from magwire.errors import InputError, received, shortened
from magwire.scenario.measured import Measured, Numbers

SLACK = 1e-9
"""Relative room for rounding in comparisons of lengths."""
FAULT = "magwire"
"""Error type whose message continues a sentence that starts with ``Input <key>``."""

_SIGNS: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "any": ("", lambda x: x == x),
    "positive": ("positive", lambda x: x > 0.0),
    "nonnegative": ("zero or positive", lambda x: x >= 0.0),
}


def fault(text: str) -> PydanticCustomError:
    """The fault "Input <key> <text>", to be raised by a validator."""
    return PydanticCustomError(FAULT, "{text}", {"text": text})


class Notation:
    """What a value is in the file: how it is read and written, and its JSON schema."""

    def read(self, value: Any) -> Any:
        """The value as the model has it; raises the fault if it is not of this kind."""
        raise NotImplementedError

    def write(self, value: Any) -> Any:
        """The value as the file has it; it reads back to the same."""
        return value

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the value in the file."""
        raise NotImplementedError

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(
            self.read,
            serialization=core_schema.plain_serializer_function_ser_schema(self.write),
        )

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        return self.schema()


@dataclass(frozen=True)
class Quantity(Notation):
    """One number with a unit.

    Attributes
    ----------
    dimension
        A key of ``magwire.units.DIMENSIONS``.
    sign
        "any", "positive" or "nonnegative".
    """

    dimension: str
    sign: str = "any"

    @property
    def expected(self) -> str:
        """What a well-formed value is, for messages."""
        kind = units.DIMENSIONS[self.dimension]
        return f"a {kind.name} such as '{kind.example}'"

    def read(self, value: object) -> float:
        """The value in SI; raises the fault if it is not of this kind."""
        try:
            number = units.parse(value, self.dimension)
        except InputError as error:
            raise fault(str(error).removeprefix("Input value ").removesuffix(".")) from None
        expected, fits = _SIGNS[self.sign]
        if not fits(number):
            raise fault(f"must be {expected}; received {shortened(value)}")
        return number

    def fits(self, numbers: NDArray[np.float64]) -> bool:
        """Whether all of these numbers in SI are finite and of the right sign."""
        return bool(np.isfinite(numbers).all() and _SIGNS[self.sign][1](numbers).all())

    def write(self, value: float) -> str:
        """Text that reads back to the same number."""
        return units.write(value, self.dimension)

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the text."""
        kind = units.DIMENSIONS[self.dimension]
        note = f"{kind.name}, in one of: {', '.join(kind.units)}"
        return {"type": "string", "description": note, "examples": [kind.example]}


@dataclass(frozen=True)
class Row(Notation):
    """A list of a fixed number of quantities: a vector, or a row of a table.

    Attributes
    ----------
    columns
        What each entry is.
    scalar
        Entry that a lone quantity stands for, the others being zero; none if left out.
    """

    columns: tuple[Quantity, ...]
    scalar: int | None = None

    @property
    def expected(self) -> str:
        """What a well-formed value is, for messages."""
        example = ", ".join(f"'{units.DIMENSIONS[c.dimension].example}'" for c in self.columns)
        return f"a list such as [{example}]"

    def read(self, value: object) -> tuple[float, ...]:
        """The entries in SI; raises the fault of the first entry that has one."""
        if self.scalar is not None and not isinstance(value, list):
            row = [0.0] * len(self.columns)
            row[self.scalar] = self.columns[self.scalar].read(value)
            return tuple(row)
        if not isinstance(value, list):
            raise fault(f"must be {self.expected}; received {received(value)}")
        if len(value) != len(self.columns):
            raise fault(f"must have {len(self.columns)} entries; received {len(value)}")
        return tuple(c.read(entry) for c, entry in zip(self.columns, value, strict=True))

    def write(self, value: tuple[float, ...]) -> list[str]:
        """Texts that read back to the same numbers."""
        return [c.write(entry) for c, entry in zip(self.columns, value, strict=True)]

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the list, or of the list and the lone quantity."""
        row: JsonSchemaValue = {
            "type": "array",
            "prefixItems": [c.schema() for c in self.columns],
            "minItems": len(self.columns),
            "maxItems": len(self.columns),
        }
        if self.scalar is None:
            return row
        return {"anyOf": [self.columns[self.scalar].schema(), row]}


@dataclass(frozen=True)
class Rows(Notation):
    """A list of rows, at least ``least`` and at most ``most`` of them."""

    row: Row
    least: int = 1
    most: int | None = None

    @property
    def expected(self) -> str:
        """What a well-formed value is, for messages."""
        return f"a list of rows, each {self.row.expected}"

    def read(self, value: object) -> Numbers:
        """The rows in SI; raises the fault of the first row that has one."""
        if isinstance(value, Measured):
            enough = self.least <= len(value.values) <= (self.most or len(value.values))
            columns = zip(self.row.columns, value.values.T, strict=True)
            if enough and all(column.fits(numbers) for column, numbers in columns):
                return Numbers(value.values)
            value = value.written()
        if not isinstance(value, list):
            raise fault(f"must be {self.expected}; received {received(value)}")
        if len(value) < self.least:
            raise fault(f"must have at least {self.least} rows; received {len(value)}")
        if self.most is not None and len(value) > self.most:
            raise fault(f"must have at most {self.most} rows; received {len(value)}")
        rows = []
        for number, entry in enumerate(value, start=1):
            try:
                rows.append(self.row.read(entry))
            except PydanticCustomError as error:
                raise fault(f"(row {number}) {error.message()}") from None
        return Numbers(rows)

    def write(self, value: Numbers) -> list[list[str]]:
        """Rows of texts that read back to the same numbers."""
        return [self.row.write(row) for row in value]

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the list."""
        return {"type": "array", "items": self.row.schema(), "minItems": self.least}


@dataclass(frozen=True)
class OneOrEach(Notation):
    """One quantity for all, or a list with one for each."""

    item: Quantity

    @property
    def expected(self) -> str:
        """What a well-formed value is, for messages."""
        return f"{self.item.expected} or a list of them"

    def read(self, value: object) -> tuple[float, ...]:
        """The values in SI, a single one for "all the same"."""
        if isinstance(value, Measured):
            if len(value.values) and self.item.fits(value.values):
                return tuple(value.values.tolist())
            value = value.written()
        if not isinstance(value, list):
            return (self.item.read(value),)
        if not value:
            raise fault("must have at least one entry; received none")
        return tuple(self.item.read(entry) for entry in value)

    def write(self, value: tuple[float, ...]) -> str | list[str]:
        """Text or texts that read back to the same numbers."""
        texts = [self.item.write(entry) for entry in value]
        return texts[0] if len(texts) == 1 else texts

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the quantity, or of the list."""
        item = self.item.schema()
        return {"anyOf": [item, {"type": "array", "items": item, "minItems": 1}]}


@dataclass(frozen=True)
class Whole(Notation):
    """A whole number without a unit, from ``minimum`` to ``maximum``."""

    minimum: int
    maximum: int

    @property
    def expected(self) -> str:
        """What a well-formed value is, for messages."""
        return f"a whole number from {self.minimum} to {self.maximum}"

    def read(self, value: object) -> int:
        """The number; raises the fault if it is no whole number or too small."""
        if isinstance(value, float) and math.isfinite(value) and value == int(value):
            value = int(value)
        if isinstance(value, bool) or not isinstance(value, int):
            raise fault(f"must be a whole number without a unit; received {received(value)}")
        if value < self.minimum:
            raise fault(f"must be at least {self.minimum}; received {shortened(value)}")
        if value > self.maximum:
            raise fault(f"must be at most {self.maximum}; received {shortened(value)}")
        return value

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the number."""
        return {"type": "integer", "minimum": self.minimum, "maximum": self.maximum}


@dataclass(frozen=True)
class Share(Notation):
    """A plain number, from ``low`` to ``high``."""

    low: float
    high: float

    @property
    def expected(self) -> str:
        """What a well-formed value is, for messages."""
        return f"a plain number from {self.low:g} to {self.high:g}"

    def read(self, value: object) -> float:
        """The number; raises the fault if it is none or out of range."""
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise fault(f"must be {self.expected}; received {received(value)}")
        if not self.low <= value <= self.high:
            raise fault(f"must be from {self.low:g} to {self.high:g}; received {shortened(value)}")
        return float(value)

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the number."""
        return {"type": "number", "minimum": self.low, "maximum": self.high}


@dataclass(frozen=True)
class Direction(Notation):
    """A list of three plain numbers, of which only the direction counts."""

    @property
    def expected(self) -> str:
        """What a well-formed value is, for messages."""
        return "a list of three plain numbers such as [0, 0, 1]"

    def read(self, value: object) -> tuple[float, float, float]:
        """The numbers; raises the fault if they are none, or all zero."""
        plain = isinstance(value, list) and not any(isinstance(x, bool) for x in value)
        if not isinstance(value, list) or not plain or len(value) != 3:
            raise fault(f"must be {self.expected}; received {received(value)}")
        if not all(isinstance(x, (int, float)) and math.isfinite(x) for x in value):
            raise fault(f"must be {self.expected}; received {received(value)}")
        if not any(value):
            raise fault("must have a length; received [0, 0, 0]")
        return float(value[0]), float(value[1]), float(value[2])

    def write(self, value: tuple[float, float, float]) -> list[float]:
        """The numbers."""
        return list(value)

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the list."""
        return {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}


def at_least_one(what: str) -> BeforeValidator:
    """Refuses an empty list or table of ``what``."""

    def some(value: Any) -> Any:
        if value in ([], {}):
            raise fault(f"must have at least one {what}; received none")
        return value

    return BeforeValidator(some)


def _vector(dimension: str) -> Row:
    return Row((Quantity(dimension),) * 3)


Nodes = Annotated[int, Whole(4, 100_000)]
Length = Annotated[float, Quantity("length", "positive")]
Diameter = Annotated[float, Quantity("diameter", "positive")]
DiameterOrZero = Annotated[float, Quantity("diameter", "nonnegative")]
BendingStiffness = Annotated[float, Quantity("bending_stiffness", "positive")]
StretchingStiffness = Annotated[float, Quantity("force", "positive")]
MassPerLength = Annotated[float, Quantity("mass_per_length", "positive")]
PoissonRatio = Annotated[float, Share(0.0, 0.5)]
LengthOrZero = Annotated[float, Quantity("length", "nonnegative")]
Time = Annotated[float, Quantity("time", "positive")]
Speed = Annotated[float, Quantity("speed", "positive")]
Pressure = Annotated[float, Quantity("pressure", "positive")]
Foundation = Annotated[float, Quantity("pressure_per_depth", "positive")]
Density = Annotated[float, Quantity("density", "positive")]
DensityOrZero = Annotated[float, Quantity("density", "nonnegative")]
Rate = Annotated[float, Quantity("rate", "nonnegative")]
Angle = Annotated[float, Quantity("angle")]
PositiveAngle = Annotated[float, Quantity("angle", "positive")]
Vector3 = tuple[float, float, float]
FluxDensity = Annotated[Vector3, _vector("flux_density")]
Place = Annotated[Vector3, _vector("length")]
Force = Annotated[Vector3, _vector("force")]
Acceleration = Annotated[Vector3, _vector("acceleration")]
Magnetization = Annotated[Vector3, Row((Quantity("magnetization"),) * 3, scalar=2)]
Remanence = Annotated[Vector3, Row((Quantity("flux_density"),) * 3, scalar=2)]
RestTwist = Annotated[float, Quantity("twist")]
RestCurvature = Annotated[tuple[float, float], Row((Quantity("curvature"),) * 2)]

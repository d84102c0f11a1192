"""The table of the wall's friction."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from pydantic.json_schema import JsonSchemaValue

from magwire.errors import received, shortened
from magwire.scenario.quantity import Notation, Quantity, fault
from magwire.scenario.table import Table, preset

if TYPE_CHECKING:
    from magwire.contact import Friction


@dataclass(frozen=True)
class Plain(Notation):
    """A plain number that is not negative, such as a coefficient of friction."""

    expected = "a plain number such as 0.1"

    def read(self, value: object) -> float:
        """The number; raises the fault if it is none, or negative."""
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise fault(f"must be {self.expected}; received {received(value)}")
        if not (value >= 0.0 and math.isfinite(value)):
            raise fault(f"must be zero or positive; received {shortened(value)}")
        return float(value)

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the number."""
        return {"type": "number", "minimum": 0.0}


PLAIN = Plain()
ARC = Quantity("length", "nonnegative")


@dataclass(frozen=True)
class OnePlainOrEach(Notation):
    """One coefficient for the whole wire, or a list with one for each of its sections."""

    expected = f"{PLAIN.expected} or a list of them"

    def read(self, value: object) -> tuple[float, ...]:
        """The numbers, a single one for "all the same"."""
        if not isinstance(value, list):
            return (PLAIN.read(value),)
        if not value:
            raise fault("must have at least one entry; received none")
        return tuple(PLAIN.read(entry) for entry in value)

    def write(self, value: tuple[float, ...]) -> float | list[float]:
        """What reads back to the same numbers."""
        return value[0] if len(value) == 1 else list(value)

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the number or of the list."""
        item = PLAIN.schema()
        return {"anyOf": [item, {"type": "array", "items": item, "minItems": 1}]}


@dataclass(frozen=True)
class Factors(Notation):
    """A list of arc lengths and factors."""

    expected = "a list of rows, each a list such as ['20 mm', 2.0]"

    def read(self, value: object) -> tuple[tuple[float, float], ...]:
        """The rows in SI; raises the fault of the first row that has one."""
        if not isinstance(value, list):
            raise fault(f"must be {self.expected}; received {received(value)}")
        for row in value:
            if not isinstance(row, list) or len(row) != 2:
                raise fault(f"must be {self.expected}; received {received(row)} in it")
        return tuple((ARC.read(arc), PLAIN.read(factor)) for arc, factor in value)

    def write(self, value: tuple[tuple[float, float], ...]) -> list[list[Any]]:
        """Rows that read back to the same numbers."""
        return [[ARC.write(arc), factor] for arc, factor in value]

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the list."""
        row = {"type": "array", "prefixItems": [ARC.schema(), PLAIN.schema()], "minItems": 2}
        return {"type": "array", "items": {**row, "maxItems": 2}}


Coefficients = Annotated[tuple[float, ...], OnePlainOrEach()]


class FrictionTable(Table):
    """Friction of the wall; see ``Friction``."""

    static: Coefficients = preset(0.0)
    kinetic: Coefficients | None = None
    drag: Annotated[float, Quantity("drag", "nonnegative")] = preset("0 N s/m^2")
    along: Annotated[tuple[tuple[float, float], ...], Factors()] = preset([])

    def build(self) -> Friction:
        """The friction as a model."""
        from magwire.contact import Friction

        return Friction(self.static, self.kinetic, self.drag, self.along)

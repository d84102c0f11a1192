"""A table of columns with names: feed or time, and inputs of an actuator at each."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from pydantic.json_schema import JsonSchemaValue

from magwire import units
from magwire.errors import InputError, received
from magwire.scenario.measured import Columns
from magwire.scenario.quantity import Notation, fault

DIMENSIONS = {
    "A": "current",
    "T": "flux_density",
    "T/m": "flux_gradient",
    "m": "length",
    "": "dimensionless",
}
"""What an input may be, by its SI unit."""
FEED, TIME = "feed", "time"
KEYS = {FEED: ("length", "m", "'0 mm', '10 mm'"), TIME: ("time", "s", "'0 s', '2 s'")}
"""Dimension, SI unit and examples of what a table may go by."""


@dataclass(frozen=True)
class NamedColumns(Notation):
    """A table of lists: ``feed`` or ``time``, which rises, and one of an input by its name."""

    by: str = FEED

    @property
    def expected(self) -> str:
        """What a well-formed value is, for messages."""
        return f"a table of lists such as {{{self.by} = [{KEYS[self.by][2]}], Ix = ['0 A', '5 A']}}"

    def read(self, value: object) -> Columns:
        """The columns in SI; raises the fault of the first one that has one."""
        if isinstance(value, Columns):
            return value
        if not isinstance(value, dict) or not all(isinstance(v, list) for v in value.values()):
            raise fault(f"must be {self.expected}; received {received(value)}")
        by = self.by
        if by not in value or len(value) < 2:
            raise fault(f"must have a list of {by}s and one of an input; received {list(value)}")
        knots = value[by]
        columns, names = [_column(by, knots, KEYS[by][0])], []
        for name, texts in value.items():
            if name == by:
                continue
            if len(texts) != len(knots):
                raise fault(
                    f"must have one {name} for each of {len(knots)} {by}s; received {len(texts)}"
                )
            unit = _unit(texts[0]) if texts else ""
            columns.append(_column(name, texts, DIMENSIONS[unit]))
            names.append((name, unit))
        _look_at(columns[0], knots, by)
        return Columns(tuple(names), np.array(columns).T)

    def write(self, value: Columns) -> dict[str, list[str] | list[float]]:
        """Lists of texts that read back to the same numbers."""
        heads = ((self.by, KEYS[self.by][0]), *((name, DIMENSIONS[u]) for name, u in value.names))
        return {
            name: [units.write(number, dimension) for number in column.tolist()]
            for (name, dimension), column in zip(heads, value.values.T, strict=True)
        }

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the table."""
        texts = {"type": "array", "items": {"type": ["string", "number"]}, "minItems": 1}
        return {
            "type": "object",
            "properties": {self.by: texts},
            "required": [self.by],
            "additionalProperties": texts,
        }


def _look_at(knots: list[float], texts: list[object], by: str) -> None:
    """Refuse knots that are none, negative, or do not increase."""
    if not knots:
        raise fault(f"must have at least one {by}; received none")
    if knots[0] < 0.0:
        raise fault(f"must have {by}s that are zero or positive; received {texts[0]}")
    for k, (before, after) in enumerate(itertools.pairwise(knots)):
        if after <= before:
            raise fault(f"must have {by}s that increase; received {texts[k + 1]} after {texts[k]}")


def _column(name: str, texts: list[object], dimension: str) -> list[float]:
    try:
        return [units.parse(text, dimension) for text in texts]
    except InputError as error:
        said = str(error).removeprefix("Input value ").removesuffix(".")
        raise fault(f"({name}) {said}") from None


def _unit(text: object) -> str:
    """The SI unit of what a text is; of one that is nothing of the kind, that of a current."""
    for unit, dimension in DIMENSIONS.items():
        try:
            units.parse(text, dimension)
        except InputError:
            continue
        return unit
    return "A"

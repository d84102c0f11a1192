"""A table of columns with names: the feed, and inputs of an actuator at each."""

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
FEED = "feed"


@dataclass(frozen=True)
class NamedColumns(Notation):
    """A table of lists: ``feed``, which rises, and one of an input by its name."""

    @property
    def expected(self) -> str:
        """What a well-formed value is, for messages."""
        return "a table of lists such as {feed = ['0 mm', '10 mm'], Ix = ['0 A', '5 A']}"

    def read(self, value: object) -> Columns:
        """The columns in SI; raises the fault of the first one that has one."""
        if isinstance(value, Columns):
            return value
        if not isinstance(value, dict) or not all(isinstance(v, list) for v in value.values()):
            raise fault(f"must be {self.expected}; received {received(value)}")
        if FEED not in value or len(value) < 2:
            raise fault(f"must have a list of feeds and one of an input; received {list(value)}")
        feeds = value[FEED]
        columns, names = [_column(FEED, feeds, "length")], []
        for name, texts in value.items():
            if name == FEED:
                continue
            if len(texts) != len(feeds):
                raise fault(
                    f"must have one {name} for each of {len(feeds)} feeds; received {len(texts)}"
                )
            unit = _unit(texts[0]) if texts else ""
            columns.append(_column(name, texts, DIMENSIONS[unit]))
            names.append((name, unit))
        _look_at(columns[0], feeds)
        return Columns(tuple(names), np.array(columns).T)

    def write(self, value: Columns) -> dict[str, list[str] | list[float]]:
        """Lists of texts that read back to the same numbers."""
        heads = ((FEED, "m"), *value.names)
        return {
            name: [units.write(number, DIMENSIONS[unit]) for number in column.tolist()]
            for (name, unit), column in zip(heads, value.values.T, strict=True)
        }

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the table."""
        texts = {"type": "array", "items": {"type": ["string", "number"]}, "minItems": 1}
        return {
            "type": "object",
            "properties": {FEED: texts},
            "required": [FEED],
            "additionalProperties": texts,
        }


def _look_at(feed: list[float], texts: list[object]) -> None:
    """Refuse feeds that are none, negative, or do not increase."""
    if not feed:
        raise fault("must have at least one feed; received none")
    if feed[0] < 0.0:
        raise fault(f"must have feeds that are zero or positive; received {texts[0]}")
    for k, (before, after) in enumerate(itertools.pairwise(feed)):
        if after <= before:
            raise fault(f"must have feeds that increase; received {texts[k + 1]} after {texts[k]}")


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

"""A surface in a scenario file: a million numbers, which are kept as two long texts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic.json_schema import JsonSchemaValue

from magwire.errors import received
from magwire.scenario.quantity import Notation, fault

EXPECTED = (
    "a table of two texts: points, with three numbers for each and the unit 'm' at the end, and "
    "triangles, with three indices of points for each"
)


@dataclass(frozen=True, eq=False)
class Triangles:
    """Points, shape (n, 3) [m], and indices of those that are corners of each triangle, (m, 3)."""

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Triangles)
            and np.array_equal(self.points, other.points)
            and np.array_equal(self.triangles, other.triangles)
        )

    def __hash__(self) -> int:
        return hash((self.points.tobytes(), self.triangles.tobytes()))


class TrianglesText(Notation):
    """How a surface is written."""

    def read(self, value: object) -> Triangles:
        """The surface; raises the fault if it is none."""
        if isinstance(value, Triangles):
            return value
        if not isinstance(value, dict) or set(value) != {"points", "triangles"}:
            raise fault(f"must be {EXPECTED}; received {received(value)}")
        points, triangles = value["points"], value["triangles"]
        if not (isinstance(points, str) and isinstance(triangles, str)):
            raise fault(f"must be {EXPECTED}; received {received(value)}")
        words = points.split()
        if not words or words[-1] != "m":
            raise fault(f"must be {EXPECTED}; received points that end in {words[-1:]}")
        return Triangles(
            _numbers("points", words[:-1], np.float64),
            _numbers("triangles", triangles.split(), np.int64),
        )

    def write(self, value: Triangles) -> dict[str, str]:
        """Texts that read back to the same numbers."""
        return {
            "points": " ".join(map(repr, value.points.ravel().tolist())) + " m",
            "triangles": " ".join(map(str, value.triangles.ravel().tolist())),
        }

    def schema(self) -> JsonSchemaValue:
        """JSON schema of the table."""
        text = {"type": "string"}
        return {
            "type": "object",
            "description": EXPECTED,
            "properties": {"points": text, "triangles": text},
            "required": ["points", "triangles"],
            "additionalProperties": False,
        }


def _numbers(name: str, words: list[str], kind: type) -> NDArray[Any]:
    """Numbers by threes."""
    try:
        found: NDArray[Any] = np.array(words, dtype=kind)
    except ValueError as error:
        raise fault(f"must be {EXPECTED}; received {name} with an error: {error}") from None
    except OverflowError:
        raise fault(f"must be {EXPECTED}; received {name} with too large a number") from None
    if len(found) == 0 or len(found) % 3 != 0:
        raise fault(f"must be {EXPECTED}; received {len(found)} numbers in {name}")
    return found.reshape(-1, 3)

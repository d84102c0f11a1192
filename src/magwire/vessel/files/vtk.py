"""VTK PolyData, legacy (.vtk): lines or polygons, as text or binary, versions 2 to 5."""

from __future__ import annotations

from itertools import pairwise
from typing import Any
from urllib.parse import unquote

import numpy as np
from numpy.typing import NDArray

from magwire.vessel.files.drawing import (
    MOST_CELLS,
    MOST_POINTS,
    Array,
    Drawing,
    FileFaultError,
    Indices,
)
from magwire.vessel.files.polydata import MARK, PolyData, drawn, texts

TYPES = {
    "char": "i1", "unsigned_char": "u1", "short": "i2", "unsigned_short": "u2", "int": "i4",
    "unsigned_int": "u4", "long": "i8", "unsigned_long": "u8", "vtktypeint64": "i8",
    "vtkidtype": "i8", "float": "f4", "double": "f8",
}  # fmt: skip
COMPONENTS = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9}
CELLS = {"LINES": "lines", "POLYGONS": "polygons", "VERTICES": "", "TRIANGLE_STRIPS": ""}


def read(data: bytes, radius: str | None) -> Drawing:
    """The contents of a file.

    Parameters
    ----------
    data
        The bytes of the file.
    radius
        Name of the array that holds the radius; one of the usual names if left out.
    """
    source = _Source(data)
    if not source.line().startswith("# vtk DataFile"):
        raise FileFaultError("is not a legacy VTK file: it does not start with '# vtk DataFile'")
    source.line()
    style = source.line().strip().upper()
    if style not in ("ASCII", "BINARY"):
        raise FileFaultError(f"is {style[:20]!r}; expected ASCII or BINARY in its third line")
    source.binary = style == "BINARY"
    words = source.words()
    if [word.upper() for word in words] != ["DATASET", "POLYDATA"]:
        raise FileFaultError(f"holds {' '.join(words)[:40]!r}; expected 'DATASET POLYDATA'")
    try:
        return drawn(_Contents(source).all(), radius)
    except (IndexError, ValueError, OverflowError):
        raise FileFaultError(f"is broken near byte {source.place}") from None


class _Source:
    """The bytes of a file, read from the front."""

    def __init__(self, data: bytes) -> None:
        self.data, self.place, self.binary = data, 0, False

    @property
    def over(self) -> bool:
        return self.place >= len(self.data)

    def line(self) -> str:
        """The next line."""
        end = self.data.find(b"\n", self.place)
        end = len(self.data) if end < 0 else end
        text = self.data[self.place : end].decode("latin-1")
        self.place = end + 1
        return text

    def words(self) -> list[str]:
        """The words of the next line that has some; none at the end of the file."""
        while not self.over:
            words = self.line().split()
            if words:
                return words
        return []

    def numbers(self, count: int, kind: str) -> NDArray[Any]:
        """The next numbers."""
        if not 0 <= count <= 16 * MOST_POINTS:
            raise ValueError
        code = TYPES.get(kind.lower(), "")
        if not code:
            raise ValueError
        if self.binary:
            size = count * int(code[1])
            if self.place + size > len(self.data):
                raise ValueError
            found = np.frombuffer(self.data[self.place : self.place + size], dtype=">" + code)
            self.place += size
            return found
        texts: list[str] = []
        while len(texts) < count:
            if self.over:
                raise ValueError
            texts += self.line().split()
        if len(texts) > count:
            raise ValueError
        return np.array(texts, dtype=code)

    def text(self) -> str:
        """The next text of an array of texts.

        In binary files its length stands before it, in one, two, four or eight bytes, of which the
        first two bits say which (as VTK 9.7 writes it).
        """
        if not self.binary:
            return unquote(self.line().strip())
        width = 8 >> (self.data[self.place] >> 6)
        packed = int.from_bytes(self.data[self.place : self.place + width], "big")
        size = packed & ((1 << (8 * width - 2)) - 1)
        begin, self.place = self.place + width, self.place + width + size
        if self.place > len(self.data):
            raise ValueError
        return self.data[begin : self.place].decode("latin-1")


class _Contents:
    """The sections of a file, one after the other."""

    def __init__(self, source: _Source) -> None:
        self.source = source
        self.points: Array = np.zeros((0, 3))
        self.cells: dict[str, list[Indices]] = {"lines": [], "polygons": []}
        self.arrays: dict[str, Array] = {}
        self.fields: dict[str, tuple[str, ...]] = {}
        self.at_points, self.count = False, 0

    def all(self) -> PolyData:
        """Read to the end."""
        while words := self.source.words():
            self._section(words[0].upper(), words)
        return PolyData(
            self.points, self.arrays, self.cells["lines"], self.cells["polygons"], self.fields
        )

    def _section(self, key: str, words: list[str]) -> None:
        source = self.source
        if key == "POINTS":
            count = int(words[1])
            found = source.numbers(3 * count, words[2]).astype(np.float64)
            self.points = found.reshape(-1, 3)
        elif key in CELLS:
            found_cells = self._cells(int(words[1]), int(words[2]))
            if CELLS[key]:
                self.cells[CELLS[key]] = found_cells
        elif key in ("POINT_DATA", "CELL_DATA"):
            self.at_points, self.count = key == "POINT_DATA", int(words[1])
        elif key == "METADATA":
            self._skip()
        elif key == "FIELD":
            self._field(int(words[2]))
        else:
            self._attribute(key, words)

    def _attribute(self, key: str, words: list[str]) -> None:
        source = self.source
        if key == "SCALARS":
            components = int(words[3]) if len(words) > 3 else 1
            table = source.words()  # LOOKUP_TABLE default
            if table[0].upper() != "LOOKUP_TABLE":
                raise ValueError
            values = source.numbers(self.count * components, words[2])
            self._keep(unquote(words[1]), components, values)
        elif key in COMPONENTS:
            source.numbers(self.count * COMPONENTS[key], words[2])
        elif key == "TEXTURE_COORDINATES":
            source.numbers(self.count * int(words[2]), words[3])
        elif key == "LOOKUP_TABLE":
            source.numbers(4 * int(words[2]), "unsigned_char" if source.binary else "float")
        else:
            raise FileFaultError(f"has an unknown section {key[:30]!r}")

    def _field(self, count: int) -> None:
        done = 0
        while done < count:
            words = self.source.words()
            if words[0].upper() == "METADATA":
                self._skip()
                continue
            components, rows = int(words[1]), int(words[2])
            name = unquote(words[0])
            if words[3] == "string":
                count = min(components * rows, MOST_POINTS)
                self.fields[name] = tuple(self.source.text() for _ in range(count))
            else:
                values = self.source.numbers(components * rows, words[3])
                if name == MARK:
                    self.fields[name] = texts(name, values)
                self._keep(name, components, values)
            done += 1

    def _skip(self) -> None:
        """Read past an empty line."""
        while not self.source.over and self.source.line().strip():
            pass

    def _keep(self, name: str, components: int, values: NDArray[Any]) -> None:
        if self.at_points and components == 1 and len(values) == len(self.points):
            self.arrays[name] = values.astype(np.float64)

    def _cells(self, count: int, size: int) -> list[Indices]:
        """Point indices of each cell, in the old layout or that of version 5."""
        if not 0 <= count <= MOST_CELLS:
            raise FileFaultError(f"has {count} cells; expected at most {MOST_CELLS}")
        before = self.source.place
        words = self.source.words()
        if words and words[0].upper() == "OFFSETS":
            stops = self.source.numbers(count, words[1]).astype(np.int64)
            kind = self.source.words()[1]
            indices = self.source.numbers(size, kind).astype(np.int64)
            if np.any(np.diff(stops) < 0) or stops[0] != 0 or stops[-1] != size:
                raise ValueError
            return [indices[a:b] for a, b in pairwise(stops.tolist())]
        self.source.place = before
        packed = self.source.numbers(size, "int").astype(np.int64)
        cells, at = [], 0
        for _ in range(count):
            stop = at + 1 + int(packed[at])
            if stop > size or stop <= at:
                raise ValueError
            cells.append(packed[at + 1 : stop])
            at = stop
        return cells

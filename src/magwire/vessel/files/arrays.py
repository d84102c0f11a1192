"""Data arrays of VTK's XML files: text, base64 or appended, compressed or not."""

from __future__ import annotations

import base64
import binascii
import lzma
import zlib
from dataclasses import dataclass
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from magwire.vessel.files import lz4
from magwire.vessel.files.drawing import LARGEST_FILE, FileFaultError

TYPES = {
    "Int8": "i1", "UInt8": "u1", "Int16": "i2", "UInt16": "u2", "Int32": "i4", "UInt32": "u4",
    "Int64": "i8", "UInt64": "u8", "Float32": "f4", "Float64": "f8", "String": "u1",
}  # fmt: skip
COMPRESSORS = ("", "vtkZLibDataCompressor", "vtkLZMADataCompressor", "vtkLZ4DataCompressor")


@dataclass(frozen=True)
class Encoding:
    """How a file packs its arrays.

    Attributes
    ----------
    order
        Byte order as numpy has it.
    header
        Type of the numbers in front of an array.
    compressor
        One of ``COMPRESSORS``.
    appended
        The block at the end of the file.
    appended_raw
        Whether that block is bytes, not base64.
    """

    order: str
    header: str
    compressor: str
    appended: bytes
    appended_raw: bool

    @classmethod
    def of(cls, root: Element, appended: bytes, *, raw: bool) -> Encoding:
        """What the file's first element says."""
        compressor = root.get("compressor", "")
        if compressor not in COMPRESSORS:
            raise FileFaultError(
                f"is compressed by {compressor!r}; expected zlib, LZMA, LZ4 or none"
            )
        order = ">" if root.get("byte_order") == "BigEndian" else "<"
        header = order + ("u8" if root.get("header_type") == "UInt64" else "u4")
        return cls(order, header, compressor, appended, raw)

    def read(self, element: Element) -> NDArray[Any]:
        """The numbers of one array, shape (n,) or (n, components)."""
        name, kind = element.get("Name", "?"), TYPES.get(element.get("type", ""))
        if kind is None:
            raise FileFaultError(f"has an array {name!r} of unknown type {element.get('type')!r}")
        style = element.get("format", "ascii")
        try:
            if style == "ascii":
                values = np.array((element.text or "").split(), dtype=kind)
            else:
                packed = self._packed(element, style)
                values = np.frombuffer(packed, dtype=self.order + kind)
            components = int(element.get("NumberOfComponents") or 1)
            return values.reshape(-1, components) if components > 1 else values
        except (ValueError, OverflowError, binascii.Error, zlib.error, lzma.LZMAError):
            raise FileFaultError(f"has an array {name!r} that cannot be decoded") from None

    def _packed(self, element: Element, style: str) -> bytes:
        if style == "binary":
            return self._unpack("".join((element.text or "").split()).encode("ascii", "replace"))
        if style != "appended":
            raise FileFaultError(f"has an array of unknown format {style!r}")
        offset = int(element.get("offset") or 0)
        if not 0 <= offset <= len(self.appended):
            raise ValueError
        return self._unpack(self.appended[offset:], raw=self.appended_raw)

    def _unpack(self, block: bytes, *, raw: bool = False) -> bytes:
        """The bytes of an array, which starts at the beginning of a block."""
        if not self.compressor:
            size = int(self._numbers(block, 1, raw=raw)[0])
            whole = self._bytes(block, self._width + size, raw=raw)
            return whole[self._width :]
        blocks = int(self._numbers(block, 1, raw=raw)[0])
        if blocks == 0:
            return b""
        if blocks * self._width > len(block):
            raise ValueError
        head = self._numbers(block, 3 + blocks, raw=raw)
        start = self._coded((3 + blocks) * self._width, raw=raw)
        sizes = [int(size) for size in head[3:]]
        packed = self._bytes(block[start:], sum(sizes), raw=raw)
        largest = int(head[1])
        if blocks * largest > LARGEST_FILE:
            raise ValueError
        parts, place = [], 0
        for size in sizes:
            parts.append(self._expand(packed[place : place + size], largest))
            place += size
        return b"".join(parts)

    def _expand(self, packed: bytes, largest: int) -> bytes:
        if self.compressor == "vtkZLibDataCompressor":
            return zlib.decompressobj().decompress(packed, max(largest, 1))
        if self.compressor == "vtkLZ4DataCompressor":
            return lz4.expand(packed, largest)
        return lzma.LZMADecompressor(memlimit=LARGEST_FILE).decompress(packed, max(largest, 1))

    @property
    def _width(self) -> int:
        return int(self.header[-1])

    def _numbers(self, block: bytes, count: int, *, raw: bool) -> NDArray[Any]:
        return np.frombuffer(self._bytes(block, count * self._width, raw=raw), dtype=self.header)

    @staticmethod
    def _coded(size: int, *, raw: bool) -> int:
        """Length in the file of so many bytes."""
        return size if raw else -(-size // 3) * 4

    def _bytes(self, block: bytes, size: int, *, raw: bool) -> bytes:
        part = block[: self._coded(size, raw=raw)]
        found = part if raw else base64.b64decode(part, validate=True)
        if len(found) < size:
            raise ValueError
        return found[:size]

"""Entries of files of electromagnetic systems; each fault is one sentence."""

from __future__ import annotations

import math
from dataclasses import dataclass

from magwire.actuate.calibration.yaml import Value
from magwire.errors import InputError, received


@dataclass(frozen=True)
class Entry:
    """A mapping somewhere in a file.

    Parameters
    ----------
    file
        Kind and name of the file, for messages.
    path
        Where the mapping is, such as "Coil_0: Src_1"; empty at the top.
    values
        Its keys.
    """

    file: str
    path: str
    values: dict[str, Value]

    def fault(self, what: str) -> InputError:
        """The error, to be raised by the caller."""
        return InputError(f"{self.file} {what}.")

    def name(self, key: str) -> str:
        """What messages call a key of this mapping."""
        return f"{self.path}: {key}" if self.path else key

    def get(self, key: str) -> Value:
        """What a key holds; it must be there."""
        if key not in self.values:
            where = f" of {self.path}" if self.path else ""
            raise self.fault(f"lacks the key {key}{where}")
        return self.values[key]

    def below(self, key: str) -> Entry:
        """The mapping that a key holds."""
        value = self.get(key)
        if not isinstance(value, dict):
            raise self.fault(f"must have keys below {self.name(key)}; received {received(value)}")
        return Entry(self.file, self.name(key), value)

    def names(self, key: str) -> tuple[str, ...]:
        """A list of names, at least one and none twice."""
        value = self.get(key)
        if not isinstance(value, list) or not value or not all(isinstance(v, str) for v in value):
            raise self.fault(f"must have a list of names in {self.name(key)}")
        names = tuple(str(v) for v in value)
        if len(set(names)) < len(names):
            raise self.fault(f"must not name an entry of {self.name(key)} twice")
        return names

    def numbers(self, key: str, count: int | None = None) -> tuple[float, ...]:
        """A list of finite numbers, so many if ``count`` is given; null is none."""
        value = self.get(key)
        items = [] if value is None else value
        if not isinstance(items, list):
            raise self.fault(f"must have a list of numbers in {self.name(key)}")
        if count is not None and len(items) != count:
            raise self.fault(
                f"must have {count} numbers in {self.name(key)}; received {len(items)}"
            )
        return tuple(self._finite(key, item) for item in items)

    def number(self, key: str) -> float:
        """A finite number."""
        return self._finite(key, self.get(key))

    def _finite(self, key: str, item: Value) -> float:
        plain = isinstance(item, (int, float)) and not isinstance(item, bool)
        if not plain or not math.isfinite(item):  # type: ignore[arg-type]
            raise self.fault(
                f"must have finite numbers in {self.name(key)}; received {received(item)}"
            )
        return float(item)  # type: ignore[arg-type]

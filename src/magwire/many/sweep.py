"""A sweep: a scenario with ranges, read from a file with a ``[sweep]`` table."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import tomli_w

from magwire.errors import MagwireError, ScenarioError, received
from magwire.files import TextFaultError, parse_toml, read_text
from magwire.many.sampling import Choice, Range, Span, Value, samples, split
from magwire.scenario import Scenario, load, parse
from magwire.scenario.faults import suggestion
from magwire.scenario.reader import text_of

METHODS = ("grid", "random", "sobol")
KEYS = ("scenario", "method", "samples", "seed", "ranges")
SPAN = ("from", "to", "count")
LARGEST = 1_000_000
"""Runs of a sweep, at most."""
SHOWN = 20
"""Faults that are told, at most: each of many runs may have its own."""


@dataclass(frozen=True)
class Sweep:
    """A scenario with ranges.

    Attributes
    ----------
    base
        The scenario as TOML, without what the ranges set.
    folder
        What file names in it start from.
    ranges
        One for each key that varies.
    values
        Values of these keys, for each run.
    text
        The whole sweep as TOML: the same text is the same sweep.
    note
        What was made of it that is not in the file, a sentence; "" if nothing was.
    """

    base: str
    folder: Path
    ranges: tuple[Range, ...]
    values: tuple[tuple[Value, ...], ...]
    text: str
    note: str = ""

    @cached_property
    def scenarios(self) -> list[Scenario]:
        """The scenario of each run, checked when they are first asked for.

        Raises
        ------
        ScenarioError
            With all faults of all runs.
        """
        made: list[Scenario] = []
        faults: dict[str, list[int]] = {}
        for number, values in enumerate(self.values):
            settings = [
                f"{r.key}={json.dumps(value, ensure_ascii=False)}"
                for r, value in zip(self.ranges, values, strict=True)
            ]
            try:
                made.append(parse(self.base, settings, folder=self.folder, source="of the sweep"))
            except ScenarioError as error:
                for fault in error.faults:
                    faults.setdefault(fault, []).append(number)
        if faults:
            raise ScenarioError(_told(faults, len(self.values)))
        return made


def read(path: str | Path) -> Sweep:
    """A sweep from a TOML file.

    Raises
    ------
    ScenarioError
        With all faults of its ``[sweep]`` table.
    """
    path = Path(path)
    try:
        raw = parse_toml(read_text(path))
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise ScenarioError(f"Sweep '{path}' cannot be read: {reason}.") from None
    except (TextFaultError, UnicodeDecodeError) as error:
        raise ScenarioError(f"Sweep '{path}' is not valid TOML: {error}.") from None
    table = raw.pop("sweep", None)
    if not isinstance(table, dict):
        raise ScenarioError(f"Sweep '{path}' has no table [sweep], which says what varies.")
    faults = [
        f"Input sweep.{key} is not a key of [sweep]; {suggestion(key, KEYS)}"
        for key in table
        if key not in KEYS
    ]
    base = _base(table, raw, path.parent, faults)
    ranges = _ranges(table, faults)
    method, count, seed = _method(table, faults)
    if method == "grid" and not faults:
        count = 1
        for each in ranges:
            count *= each.count
        if count > LARGEST:
            faults.append(f"Input sweep.ranges must make at most {LARGEST} runs; received {count}.")
    if faults:
        raise ScenarioError(faults)
    values = tuple(samples(ranges, method, count, seed))
    asked = table.get("samples", count)
    note = f"Method '{method}' needs a power of two: {count} runs in place of {asked}."
    text = base + tomli_w.dumps({"sweep": table})
    return Sweep(base, path.parent, ranges, values, text, note if count != asked else "")


def _base(table: dict[str, Any], raw: dict[str, Any], folder: Path, faults: list[str]) -> str:
    """The scenario as TOML: the file's own tables, or another one that the file names."""
    name = table.get("scenario")
    if name is None:
        if not raw:
            faults.append(
                "Input sweep.scenario is missing; expected a scenario's name or file, or the "
                "scenario's own tables next to [sweep]."
            )
        return tomli_w.dumps(_placed(raw, folder))
    if not isinstance(name, str):
        faults.append(f"Input sweep.scenario must be text; received {received(name)}.")
    elif raw:
        tables = ", ".join(f"[{key}]" for key in raw)
        faults.append(f"Input sweep.scenario cannot stand next to {tables}; remove one of them.")
    else:
        try:
            return _other(folder / name if (folder / name).is_file() else name, table)
        except MagwireError as error:
            faults += str(error).splitlines()
    return ""


def _other(source: str | Path, table: dict[str, Any]) -> str:
    """A scenario that the sweep names: with its files read, unless a range says how to read one."""
    whole = load(source)
    text, folder = text_of(source)
    raw, given = parse_toml(text), table.get("ranges")
    keys = [key for key, _ in _flat(given)] if isinstance(given, dict) else []
    for part in ("lumen", "navigate"):
        if "file" in raw.get(part, {}) and any(key.startswith(f"{part}.") for key in keys):
            return tomli_w.dumps(_placed(raw, folder))
    return whole.to_toml()


def _placed(raw: dict[str, Any], folder: Path) -> dict[str, Any]:
    """The tables with names of files that hold from any folder."""
    placed = dict(raw)
    for part in ("lumen", "navigate"):
        table = raw.get(part)
        if isinstance(table, dict) and isinstance(table.get("file"), str):
            placed[part] = {**table, "file": str((folder / table["file"]).resolve())}
    return placed


def _ranges(table: dict[str, Any], faults: list[str]) -> tuple[Range, ...]:
    given = table.get("ranges")
    if not isinstance(given, dict) or not given:
        faults.append(
            "Input sweep.ranges must be a table with at least one key of the scenario, such as "
            f'"lumen.radius"; received {received(given) if given else "none"}.'
        )
        return ()
    ranges = []
    on_grid = table.get("method", "grid") == "grid"
    for key, entry in _flat(given):
        try:
            ranges.append(_range(key, entry, on_grid))
        except ValueError as error:
            faults.append(f'Input sweep.ranges."{key}" {error}.')
    return tuple(ranges)


def _flat(given: dict[str, Any], before: str = "") -> list[tuple[str, Any]]:
    """Keys with dots and their ranges, also where the file has them without quotes, as tables."""
    found = []
    for key, entry in given.items():
        if isinstance(entry, dict) and entry and not set(entry) & set(SPAN):
            found += _flat(entry, f"{before}{key}.")
        else:
            found.append((before + key, entry))
    return found


def _range(key: str, entry: object, on_grid: bool) -> Range:
    """A range; ValueError with the rest of a sentence if it is none."""
    if isinstance(entry, list):
        if not entry or not all(isinstance(value, (str, int, float, bool)) for value in entry):
            raise ValueError(f"must list at least one value; received {entry!r}")
        return Choice(key, tuple(entry))
    if not isinstance(entry, dict):
        raise ValueError(
            "must be a list of values, or a range such as { from = '2 mm', to = '4 mm', count = 5 }"
            f"; received {received(entry)}"
        )
    wanted = set(SPAN) if on_grid else {"from", "to"}
    if set(entry) != wanted:
        words = " and ".join(f"'{name}'" for name in SPAN if name in wanted)
        have = ", ".join(f"'{name}'" for name in entry)
        raise ValueError(f"must have {words}, and nothing else; received {have}")
    low, high, count = split(entry["from"]), split(entry["to"]), entry.get("count", 1)
    if low is None or high is None or low[1] != high[1]:
        raise ValueError(
            "must go from a number to a number of the same unit; received "
            f"{entry['from']!r} and {entry['to']!r}"
        )
    if isinstance(count, bool) or not isinstance(count, int) or count < (2 if on_grid else 1):
        raise ValueError(f"must have a count of at least 2; received {count!r}")
    whole = isinstance(entry["from"], int) and isinstance(entry["to"], int)
    return Span(key, low[0], high[0], low[1], whole, count)


def _method(table: dict[str, Any], faults: list[str]) -> tuple[str, int, int]:
    method = table.get("method", "grid")
    if method not in METHODS:
        words = ", ".join(f"'{word}'" for word in METHODS)
        faults.append(f"Input sweep.method must be one of {words}; received {received(method)}.")
        return "grid", 1, 0
    if method == "grid":
        faults += [
            f"Input sweep.{key} is of no use to method 'grid'; remove it."
            for key in ("samples", "seed")
            if key in table
        ]
        return method, 1, 0
    count, seed = table.get("samples"), table.get("seed", 0)
    if isinstance(count, bool) or not isinstance(count, int) or not 1 <= count <= LARGEST:
        faults.append(
            f"Input sweep.samples must be a whole number from 1 to {LARGEST}; "
            f"received {'none' if count is None else received(count)}."
        )
        count = 1
    elif method == "sobol":  # it fills the ranges evenly with a power of two only
        count = 1 << (count - 1).bit_length()
    if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
        faults.append(
            f"Input sweep.seed must be a whole number, zero or larger; received {received(seed)}."
        )
        seed = 0
    return method, count, seed


def _told(faults: dict[str, list[int]], runs: int) -> Sequence[str]:
    """Faults with the runs that have them, unless all have."""
    told = []
    for fault, numbers in faults.items():
        more = f" and {len(numbers) - 1} more" if len(numbers) > 1 else ""
        told.append(fault if len(numbers) == runs else f"Run {numbers[0]}{more}: {fault}")
    if len(told) > SHOWN:
        told[SHOWN:] = [f"And {len(told) - SHOWN} faults more."]
    return told

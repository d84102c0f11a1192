"""Inputs of an actuator in files: read from CSV or from a result, written as CSV."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from magwire.errors import InputError
from magwire.files import read_text, write_whole
from magwire.navigate.inputs import InputSchedule
from magwire.navigate.schedule import last_tries
from magwire.scenario.columns import DIMENSIONS, FEED, KEYS
from magwire.scenario.measured import Columns
from magwire.scenario.schedules import table_of

if TYPE_CHECKING:
    from magwire.results import Result

_HEAD = re.compile(r"\s*([^\s\[]+)\s*\[([^\]]*)\]\s*")


def read_inputs(path: str | Path) -> InputSchedule:
    """Inputs of an actuator from a file.

    Parameters
    ----------
    path
        CSV file with a header such as ``feed [m],Ix [A],Iy [A]``, in SI units; or a result file or
        the folder that holds one, see ``inputs_of``.

    Raises
    ------
    InputError
        If the file is no such schedule.
    ResultError
        If the result file is none.
    """
    path = Path(path)
    if path.suffix == ".nc" or path.is_dir():
        from magwire.results import Result

        return inputs_of(Result.load(path))
    found = read_columns(path, FEED)
    return InputSchedule(found.values[:, 0], found.values[:, 1:], found.names)


def read_columns(path: Path, by: str) -> Columns:
    """A CSV file with a header such as ``feed [m],Ix [A]``, or ``time [s],Ix [A]``.

    Parameters
    ----------
    path
        The file, in SI units.
    by
        The first column, which rises: "feed" or "time".

    Raises
    ------
    InputError
        If it is no such file.
    """
    try:
        text = read_text(path)
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise InputError(f"Schedule file '{path}' cannot be read: {reason}.") from None
    except UnicodeDecodeError:
        raise InputError(f"Schedule file '{path}' is not a text file.") from None
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    head, *rows = list(csv.reader(lines, skipinitialspace=True)) or [[""]]
    return _columns(path, (by, KEYS[by][1]), head, rows)


def write_inputs(course: InputSchedule, path: str | Path) -> Path:
    """Write inputs as a CSV file that ``read_inputs`` reads back to the same numbers.

    Parameters
    ----------
    course
        The inputs.
    path
        File to write; an existing one is overwritten.
    """
    path = Path(path)
    heads = [f"{name} [{unit}]" for name, unit in ((FEED, "m"), *course.names)]
    rows = np.column_stack([course.feed, course.inputs]).tolist()
    lines = [",".join(heads), *(",".join(map(repr, row)) for row in rows)]
    write_whole(path, "\n".join(lines) + "\n")
    return path


def inputs_of(result: Result) -> InputSchedule:
    """The inputs that steered a run to its farthest feed, of what was tried again the last try.

    Raises
    ------
    InputError
        If the result has no records.
    """
    if result.feed.size == 0:
        raise InputError("Input result of inputs_of must hold at least one record; received 0.")
    course = last_tries(result.feed)
    return InputSchedule(result.feed[course], result.inputs[course], result.input_names)


def columns_of(course: InputSchedule) -> Columns:
    """Inputs as a scenario's table has them."""
    return Columns(course.names, np.column_stack([course.feed, course.inputs]))


def _columns(path: Path, first: tuple[str, str], head: list[str], rows: list[list[str]]) -> Columns:
    heads = [match.groups() if (match := _HEAD.fullmatch(word)) else None for word in head]
    known = [one for one in heads[1:] if one is not None and one[1] in DIMENSIONS]
    if len(known) != len(head) - 1 or len(head) < 2 or heads[0] != first:
        raise InputError(
            f"Schedule file '{path}' must start with a header such as '{first[0]} [{first[1]}],"
            f"Ix [A],Iy [A]', in SI units; received '{','.join(head)}'."
        )
    names = [first[0], *(name for name, _ in known)]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(f"Schedule file '{path}' must have each column once; {twice} comes twice.")
    table = table_of(path, len(head), rows, first)
    return Columns(tuple((a, b) for a, b in known), table)

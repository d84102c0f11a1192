"""Field schedules in files: read from CSV or from a result, written as CSV."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import tomli_w
from numpy.typing import NDArray

from magwire.errors import InputError, finite, positive
from magwire.files import parse_toml, read_text, write_whole
from magwire.navigate import Schedule
from magwire.navigate.schedule import last_tries

if TYPE_CHECKING:
    from magwire.results import Result
    from magwire.scenario.model import Scenario

HEADER = ("feed [m]", "Bx [T]", "By [T]", "Bz [T]")


def read_schedule(path: str | Path) -> Schedule:
    """A field schedule from a file.

    Parameters
    ----------
    path
        CSV file with the header ``feed [m],Bx [T],By [T],Bz [T]``; or a result file or the folder
        that holds one, see ``schedule_of``.

    Raises
    ------
    InputError
        If the file is no schedule.
    ResultError
        If the result file is none.
    """
    path = Path(path)
    if path.suffix == ".nc" or path.is_dir():
        from magwire.results import Result

        return schedule_of(Result.load(path))
    try:
        text = read_text(path)
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise InputError(f"Schedule file '{path}' cannot be read: {reason}.") from None
    except UnicodeDecodeError:
        raise InputError(f"Schedule file '{path}' is not a text file.") from None
    return _schedule(text, path)


def write_schedule(schedule: Schedule, path: str | Path) -> Path:
    """Write a field schedule as a CSV file that ``read_schedule`` reads back to the same numbers.

    Parameters
    ----------
    schedule
        The schedule.
    path
        File to write; an existing one is overwritten.
    """
    path = Path(path)
    rows = np.column_stack([schedule.feed, schedule.flux_density]).tolist()
    lines = [",".join(HEADER), *(",".join(map(repr, row)) for row in rows)]
    write_whole(path, "\n".join(lines) + "\n")
    return path


def schedule_of(result: Result) -> Schedule:
    """The field that steered a run to its farthest feed, of what was tried again the last try.

    Parameters
    ----------
    result
        A result. The field of its scenario, if it has one, is taken off the recorded field: that
        is there anyway when the schedule is applied to the scenario.

    Raises
    ------
    InputError
        If the result has no records.
    """
    fed = result.feed
    if fed.size == 0:
        raise InputError("Input result of schedule_of must hold at least one record; received 0.")
    course = last_tries(fed)
    flux = result.field[course]
    if result.scenario:
        from magwire.pieces import spans
        from magwire.scenario.reader import parse

        own = parse(result.scenario, source="of the result").field.build()
        nodes = result.held.variables["position"]
        tips = [nodes[records, -1].values for records in spans(result.held, "position")]
        flux = flux - own.at(np.concatenate(tips)[course])[0]
    return Schedule(fed[course], flux)


def replayed(
    result: Result,
    overrides: Sequence[str] = (),
    *,
    scale: float = 1.0,
    resample: float | None = None,
) -> Scenario:
    """The scenario of a result in dynamic motion, steered by the field that the result recorded.

    With an actuator, by the inputs that it recorded.

    Parameters
    ----------
    result
        A result with a scenario.
    overrides
        Keys to set in the scenario, ``key=value`` each.
    scale
        Factor on the field.
    resample
        Feed between two values that are kept [m]; all are kept if left out.

    Raises
    ------
    InputError
        If the result has no records, or no scenario.
    ScenarioError
        If the scenario has faults.
    """
    from magwire.scenario.kinds.navigate.timed import TimedSteering
    from magwire.scenario.reader import parse

    if not result.scenario:
        raise InputError(
            "Input result of a replay must have a scenario; received one of a run that was set up "
            "in Python; run it again there, with mw.Prescribed."
        )
    finite("a replay", "scale", scale)
    if resample is not None:
        positive("a replay", "resample", resample, "m")
    whole = parse(result.scenario, source="of the result")  # a file may be damaged
    raw = parse_toml(result.scenario)
    if isinstance(whole.navigate, TimedSteering):
        raw["navigate"] = whole.navigate.scaled(scale).model_dump(exclude_none=True)
    else:
        raw["navigate"] = _recorded(result, scale, resample, inputs="actuator" in raw)
    raw.setdefault("solver", {})["motion"] = "dynamic"  # where a schedule proves itself (P-23)
    return parse(tomli_w.dumps(raw), overrides, source="of the result")


def _recorded(
    result: Result, scale: float, resample: float | None, *, inputs: bool
) -> dict[str, Any]:
    """The navigator's table of what a result recorded: its field, or its actuator's inputs."""
    if inputs:
        from magwire.scenario.columns import NamedColumns
        from magwire.scenario.courses import columns_of, inputs_of

        course = inputs_of(result).scaled(scale)
        course = course if resample is None else course.resampled(resample)
        return {"method": "inputs", "table": NamedColumns().write(columns_of(course))}
    schedule = schedule_of(result).scaled(scale)
    schedule = schedule if resample is None else schedule.resampled(resample)
    return {"method": "schedule", "table": rows_of(schedule)}


def rows_of(schedule: Schedule) -> list[list[str]]:
    """The schedule as rows of a scenario's ``navigate.table``."""
    rows = np.column_stack([schedule.feed, schedule.flux_density]).tolist()
    return [[f"{row[0]!r} m", *(f"{b!r} T" for b in row[1:])] for row in rows]


def _schedule(text: str, path: Path) -> Schedule:
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    head, *rows = csv.reader(lines, skipinitialspace=True) if lines else [[]]
    if tuple(word.strip() for word in head) != HEADER:
        raise InputError(
            f"Schedule file '{path}' must start with the header '{','.join(HEADER)}'; "
            f"received '{','.join(head)}'."
        )
    table = table_of(path, len(HEADER), rows)
    return Schedule(table[:, 0], table[:, 1:])


def table_of(
    path: Path, width: int, rows: Sequence[Sequence[str]], by: tuple[str, str] = ("feed", "m")
) -> NDArray[np.float64]:
    """The numbers of a schedule file's rows, shape (n, width); the first column rises.

    Raises
    ------
    InputError
        If there are none, one is no finite number, or the first column does not increase.
    """
    if not rows:
        raise InputError(f"Schedule file '{path}' must have at least one row; received none.")
    table = np.empty((len(rows), width))
    for number, row in enumerate(rows, start=1):
        try:
            table[number - 1] = [float(word) for word in row]
        except ValueError:
            table[number - 1] = np.nan
        if not np.isfinite(table[number - 1]).all():
            raise InputError(
                f"Schedule file '{path}' must have {width} finite numbers in every row; "
                f"received '{','.join(row)}' in row {number}."
            )
    rises = np.diff(table[:, 0]) > 0.0
    if not rises.all():
        number = int(np.argmin(rises))
        raise InputError(
            f"Schedule file '{path}' must have {by[0]}s that increase; received "
            f"{table[number + 1, 0]:g} {by[1]} after {table[number, 0]:g} {by[1]} in row "
            f"{number + 2}."
        )
    return table

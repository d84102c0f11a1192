"""A result as a scenario again, steered by what it recorded."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import tomli_w

from magwire.errors import InputError, finite, positive
from magwire.files import parse_toml
from magwire.scenario.columns import NamedColumns
from magwire.scenario.courses import columns_of, inputs_of
from magwire.scenario.kinds.navigate.timed import TimedSteering
from magwire.scenario.model import Scenario
from magwire.scenario.reader import parse
from magwire.scenario.schedules import rows_of, schedule_of

if TYPE_CHECKING:
    from magwire.results import Result


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
        course = inputs_of(result).scaled(scale)
        course = course if resample is None else course.resampled(resample)
        return {"method": "inputs", "table": NamedColumns().write(columns_of(course))}
    schedule = schedule_of(result).scaled(scale)
    schedule = schedule if resample is None else schedule.resampled(resample)
    return {"method": "schedule", "table": rows_of(schedule)}

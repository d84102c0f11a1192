"""What to know of a schedule of inputs, and of its dry run, as lines of text."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from magwire.report.run import COLUMN

if TYPE_CHECKING:
    from magwire.actuate import Actuator, Timetable, Violation


def lines(table: Timetable, planned: float) -> Iterator[str]:
    """What a schedule is, a line each.

    Parameters
    ----------
    table
        The schedule.
    planned
        How long the plan takes [s].
    """
    samples, duration = len(table.time), float(table.time[-1])
    step = duration / max(samples - 1, 1)
    yield _row("samples", f"{samples}, every {1e3 * step:.4g} ms")
    waits = duration - planned
    more = f"; the plan takes {planned:.4g} s" if abs(waits) > 0.5 * step else ""
    yield _row("duration", f"{duration:.4g} s{more}")
    yield from _feeding(table)


def figures(table: Timetable, actuator: Actuator, tolerance: float | None) -> Iterator[str]:
    """The largest figures of a schedule on an actuator, a line each.

    Parameters
    ----------
    table, actuator, tolerance
        As of ``dry_run``.
    """
    from magwire.actuate.dry_run import field_made, usual_tolerance

    yield _row("duration", f"{float(table.time[-1]):.4g} s in {len(table.time)} samples")
    for name, unit, values in zip(table.names, table.units, table.inputs.T, strict=True):
        low, high = float(values.min()), float(values.max())
        yield _row(f"input {name}", f"{low:.4g} to {high:.4g} {unit}".rstrip())
    watts = float(max(actuator.power(u) for u in table.inputs))
    if watts > 0.0:
        yield _row("largest power", f"{watts:.4g} W")
    yield from _feeding(table)
    planned = np.isfinite(table.flux_density).all(axis=1)
    if planned.any():
        away = np.linalg.norm(field_made(table, actuator) - table.flux_density, axis=1)[planned]
        most = usual_tolerance(table) if tolerance is None else tolerance
        limit = f" (tolerance {1e3 * most:.4g} mT)" if math.isfinite(most) else ""
        yield _row("field error", f"at most {1e3 * float(away.max()):.4g} mT{limit}")


def verdict(found: Sequence[Violation]) -> str:
    """The last line of a dry run."""
    if not found:
        return "All limits are kept, and the field is the planned one."
    kinds = dict.fromkeys(one.kind for one in found)
    count = f"{len(found)} violation" + ("s" if len(found) > 1 else "")
    return f"{count}: {', '.join(kinds)}."


def _feeding(table: Timetable) -> Iterator[str]:
    fastest = float(np.abs(table.feed_speed).max())
    text = f"{1e3 * float(table.feed.max()):.4g} mm, at up to {1e3 * fastest:.4g} mm/s"
    rate = table.step_rate
    if table.steps is not None and rate is not None:
        text += f"; {int(table.steps.max())} steps, at up to {float(np.abs(rate).max()):.4g} 1/s"
    yield _row("inserted", text)


def _row(name: str, text: str) -> str:
    return f"{name:{COLUMN}}{text}"

"""3D Slicer's markups (.mrk.json): curves of control points, with or without radii."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from magwire.vessel.files.drawing import Array, Drawing, FileFaultError, Line, right_handed

SPACES = {"LPS": "LPS", "1": "LPS", "RAS": "RAS", "0": "RAS"}
LEAP = 5  # step along a curve that is none, over its median: the first point is stored elsewhere


def read(data: bytes, radius: str | None) -> Drawing:
    """The contents of a file.

    Parameters
    ----------
    data
        The bytes of the file.
    radius
        Name of the measurement that holds the radius of each control point; ``Radius`` if left out.
    """
    try:
        whole = json.loads(data.decode("utf-8-sig"))
        curves = [c for c in whole["markups"] if c.get("type") in ("Curve", "Line", "ClosedCurve")]
        lines = [_line(curve, radius) for curve in curves]
        units = {_unit(curve.get("coordinateUnits", "mm")) for curve in curves}
    except RecursionError:
        raise FileFaultError("is nested too deeply to be a markups file") from None
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError):
        raise FileFaultError("is not a markups file of 3D Slicer") from None
    unit = units.pop() if len(units) == 1 else "mm"
    notes = tuple(dict.fromkeys(note for _, said in lines for note in said))
    return Drawing(tuple(line for line, _ in lines if len(line.points) > 1), unit=unit, notes=notes)


def _unit(stated: Any) -> str:
    """The unit of a curve: text, or the code, the system and the meaning of a coded entry."""
    return str(stated[0] if isinstance(stated, list) and stated else stated)


def _line(curve: dict[str, Any], radius: str | None) -> tuple[Line, tuple[str, ...]]:
    """A curve as a line, and what was done to it."""
    controls = curve["controlPoints"]
    if any(point.get("positionStatus", "defined") != "defined" for point in controls):
        controls = [p for p in controls if p.get("positionStatus", "defined") == "defined"]
    points = np.array([point["position"] for point in controls], dtype=np.float64).reshape(-1, 3)
    if curve["type"] == "ClosedCurve":
        raise FileFaultError("holds a closed curve; expected open ones")
    system = str(curve.get("coordinateSystem", "LPS"))
    if system not in SPACES:
        raise FileFaultError(f"has the coordinate system {system[:20]!r}; expected LPS or RAS")
    points, notes = right_handed(points, SPACES[system])
    wide, name = _radii(curve, len(points), radius or "Radius"), str(curve.get("name", ""))
    first = _first(points)
    if first:
        points, wide = np.roll(points, -first, axis=0), np.roll(wide, -first)
        notes = (*notes, f"The curve {name!r} begins at its control point {first + 1}.")
    return Line(name, points, wide), notes


def _first(points: Array) -> int:
    """The control point at which a curve begins: where it leaps, if it is closed but for that."""
    if len(points) < 2 * LEAP:
        return 0
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    usual, leap = float(np.median(steps)), int(np.argmax(steps))
    round_about = float(np.linalg.norm(points[-1] - points[0]))
    return leap + 1 if steps[leap] > LEAP * usual and round_about < 3.0 * usual else 0


def _radii(curve: dict[str, Any], count: int, name: str) -> Array:
    """Radius of each control point, from the measurement of that name: one number or one each."""
    for measurement in curve.get("measurements", ()):
        if str(measurement.get("name", "")).lower() == name.lower():
            given = measurement.get("controlPointValues", measurement.get("value"))
            values = np.asarray(given, dtype=np.float64)
            if values.shape in ((), (count,)):
                return np.broadcast_to(values, (count,)).copy()
            raise FileFaultError(f"has {values.size} radii for {count} control points")
    return np.full(count, np.nan)

"""3D Slicer's markups (.mrk.json): curves of control points, with or without radii."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from magwire.vessel.files.drawing import Array, Drawing, FileFaultError, Line

FLIP = {"LPS": 1.0, "1": 1.0, "RAS": -1.0, "0": -1.0}
"""Sign of x and y: what is read is in LPS, as in DICOM."""


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
        units = {curve.get("coordinateUnits", "mm") for curve in curves}
    except RecursionError:
        raise FileFaultError("is nested too deeply to be a markups file") from None
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError):
        raise FileFaultError("is not a markups file of 3D Slicer") from None
    unit = units.pop() if len(units) == 1 else "mm"
    return Drawing(tuple(line for line in lines if len(line.points) > 1), unit=str(unit))


def _line(curve: dict[str, Any], radius: str | None) -> Line:
    controls = curve["controlPoints"]
    if any(point.get("positionStatus", "defined") != "defined" for point in controls):
        controls = [p for p in controls if p.get("positionStatus", "defined") == "defined"]
    points = np.array([point["position"] for point in controls], dtype=np.float64).reshape(-1, 3)
    if curve["type"] == "ClosedCurve":
        raise FileFaultError("holds a closed curve; expected open ones")
    system = str(curve.get("coordinateSystem", "LPS"))
    if system not in FLIP:
        raise FileFaultError(f"has the coordinate system {system[:20]!r}; expected LPS or RAS")
    points[:, :2] *= FLIP[system]
    return Line(str(curve.get("name", "")), points, _radii(curve, len(points), radius or "Radius"))


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

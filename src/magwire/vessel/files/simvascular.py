"""SimVascular paths (.pth): points of one path, without radii, in centimetres."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np

from magwire.vessel.files.drawing import Drawing, FileFaultError, Line

DECLARATION = re.compile(rb"<\?xml[^>]*\?>")


def read(data: bytes, radius: str | None) -> Drawing:
    """The contents of a file.

    Parameters
    ----------
    data
        The bytes of the file.
    radius
        Not used: a path has no radius.
    """
    try:  # the file has two elements at its top, which XML does not allow
        root = ElementTree.fromstring(b"<file>" + DECLARATION.sub(b"", data, count=1) + b"</file>")
        step = root.find("path/timestep/path_element")
        points = [] if step is None else step.findall("path_points/path_point/pos")
        if step is not None and not points:
            points = step.findall("control_points/point")
        places = np.array([[float(p.get(axis, "nan")) for axis in "xyz"] for p in points])
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise FileFaultError(f"is not a SimVascular path: {error}") from None
    if len(places) < 2:
        raise FileFaultError("is not a SimVascular path with two points or more")
    return Drawing((Line("", places, np.full(len(places), np.nan)),), unit="cm")

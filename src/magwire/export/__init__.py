"""Results in the formats of other programs: ParaView, tables, robots' logs."""

from __future__ import annotations

from magwire.export.frames import FRAMES, Frame
from magwire.export.mcap import write_mcap
from magwire.export.pvd import write_pvd
from magwire.export.tables import write_tables
from magwire.export.timetables import plan_of, read_timetable, write_timetable

__all__ = [
    "FRAMES",
    "Frame",
    "plan_of",
    "read_timetable",
    "write_mcap",
    "write_pvd",
    "write_tables",
    "write_timetable",
]

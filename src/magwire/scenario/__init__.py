"""Scenarios: runs described in TOML with units, validated, and the library of ready ones."""

from __future__ import annotations

from magwire.scenario.model import Scenario
from magwire.scenario.reader import json_schema, load, names, parse
from magwire.scenario.schedules import read_schedule, schedule_of, write_schedule

__all__ = [
    "Scenario",
    "json_schema",
    "load",
    "names",
    "parse",
    "read_schedule",
    "schedule_of",
    "write_schedule",
]

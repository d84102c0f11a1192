"""Scenarios: runs described in TOML with units, validated, and the library of ready ones."""

from __future__ import annotations

from magwire.scenario.actuators import load_actuator
from magwire.scenario.courses import inputs_of, read_inputs, write_inputs
from magwire.scenario.model import Scenario
from magwire.scenario.reader import json_schema, load, names, parse
from magwire.scenario.schedules import read_schedule, schedule_of, write_schedule

__all__ = [
    "Scenario",
    "inputs_of",
    "json_schema",
    "load",
    "load_actuator",
    "names",
    "parse",
    "read_inputs",
    "read_schedule",
    "schedule_of",
    "write_inputs",
    "write_schedule",
]

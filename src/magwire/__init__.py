"""Simulator of magnetic soft continuum robots: a magnetic wire pushed through a lumen in a field.

Everything is in SI units. Names are imported when they are first asked for, so that
``import magwire`` itself costs next to nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from magwire.batch import Batch as Batch
    from magwire.contact import Barrier as Barrier
    from magwire.contact import Friction as Friction
    from magwire.contact import WallMotion as WallMotion
    from magwire.devices import Device as Device
    from magwire.devices import load as load_device
    from magwire.devices import names as device_names
    from magwire.engine.command import Command as Command
    from magwire.engine.feed import Feed as Feed
    from magwire.engine.hold import Hold as Hold
    from magwire.engine.observation import Observation as Observation
    from magwire.engine.plant import Snapshot as Snapshot
    from magwire.engine.record import Record as Record
    from magwire.engine.statics import Equilibrium as Equilibrium
    from magwire.errors import ConvergenceError as ConvergenceError
    from magwire.errors import InputError as InputError
    from magwire.errors import MagwireError as MagwireError
    from magwire.errors import ResultError as ResultError
    from magwire.errors import ScenarioError as ScenarioError
    from magwire.field import FieldSource as FieldSource
    from magwire.field import GradientField as GradientField
    from magwire.field import UniformField as UniformField
    from magwire.lumen import Lumen as Lumen
    from magwire.many import Outcome as Outcome
    from magwire.many import run_many as run_many
    from magwire.navigate import NavigationError as NavigationError
    from magwire.navigate import Navigator as Navigator
    from magwire.navigate import Prescribed as Prescribed
    from magwire.navigate import Schedule as Schedule
    from magwire.navigate import Steering as Steering
    from magwire.navigate.allocation import Allocated as Allocated
    from magwire.navigate.demands import Demands as Demands
    from magwire.navigate.stable import StableNavigator as StableNavigator
    from magwire.navigate.timed import TimedInputs as TimedInputs
    from magwire.navigate.tip import TipNavigator as TipNavigator
    from magwire.operate import Ending as Ending
    from magwire.operate import ForceLimit as ForceLimit
    from magwire.planning import Prospect as Prospect
    from magwire.planning import Trial as Trial
    from magwire.planning import plan as plan
    from magwire.planning import robustness as robustness
    from magwire.results import Result as Result
    from magwire.scenario import Scenario as Scenario
    from magwire.scenario import load as load_scenario
    from magwire.scenario import load_actuator as load_actuator
    from magwire.scenario import names as scenario_names
    from magwire.session import Session as Session
    from magwire.simulation import Simulation as Simulation
    from magwire.status import RunStatus as RunStatus
    from magwire.vessel import Vessel as Vessel
    from magwire.wire import Make as Make
    from magwire.wire import Section as Section
    from magwire.wire import Wire as Wire
    from magwire.wire import across as across
    from magwire.wire import axial as axial

    __version__: str

_HOMES: dict[str, tuple[str, str]] = {
    "Allocated": ("magwire.navigate.allocation", "Allocated"),
    "Barrier": ("magwire.contact", "Barrier"),
    "Batch": ("magwire.batch", "Batch"),
    "Command": ("magwire.engine.command", "Command"),
    "ConvergenceError": ("magwire.errors", "ConvergenceError"),
    "Demands": ("magwire.navigate.demands", "Demands"),
    "Device": ("magwire.devices", "Device"),
    "Ending": ("magwire.operate", "Ending"),
    "Equilibrium": ("magwire.engine.statics", "Equilibrium"),
    "Feed": ("magwire.engine.feed", "Feed"),
    "FieldSource": ("magwire.field", "FieldSource"),
    "ForceLimit": ("magwire.operate", "ForceLimit"),
    "Friction": ("magwire.contact", "Friction"),
    "GradientField": ("magwire.field", "GradientField"),
    "Hold": ("magwire.engine.hold", "Hold"),
    "InputError": ("magwire.errors", "InputError"),
    "Lumen": ("magwire.lumen", "Lumen"),
    "MagwireError": ("magwire.errors", "MagwireError"),
    "Make": ("magwire.wire", "Make"),
    "NavigationError": ("magwire.navigate", "NavigationError"),
    "Navigator": ("magwire.navigate", "Navigator"),
    "Observation": ("magwire.engine.observation", "Observation"),
    "Outcome": ("magwire.many", "Outcome"),
    "Prescribed": ("magwire.navigate", "Prescribed"),
    "Prospect": ("magwire.planning", "Prospect"),
    "Record": ("magwire.engine.record", "Record"),
    "Result": ("magwire.results", "Result"),
    "ResultError": ("magwire.errors", "ResultError"),
    "Scenario": ("magwire.scenario", "Scenario"),
    "ScenarioError": ("magwire.errors", "ScenarioError"),
    "Schedule": ("magwire.navigate", "Schedule"),
    "RunStatus": ("magwire.status", "RunStatus"),
    "Section": ("magwire.wire", "Section"),
    "Session": ("magwire.session", "Session"),
    "Simulation": ("magwire.simulation", "Simulation"),
    "Snapshot": ("magwire.engine.plant", "Snapshot"),
    "StableNavigator": ("magwire.navigate.stable", "StableNavigator"),
    "Steering": ("magwire.navigate", "Steering"),
    "TimedInputs": ("magwire.navigate.timed", "TimedInputs"),
    "Trial": ("magwire.planning", "Trial"),
    "TipNavigator": ("magwire.navigate.tip", "TipNavigator"),
    "UniformField": ("magwire.field", "UniformField"),
    "Vessel": ("magwire.vessel", "Vessel"),
    "WallMotion": ("magwire.contact", "WallMotion"),
    "Wire": ("magwire.wire", "Wire"),
    "across": ("magwire.wire", "across"),
    "axial": ("magwire.wire", "axial"),
    "device_names": ("magwire.devices", "names"),
    "load_device": ("magwire.devices", "load"),
    "load_actuator": ("magwire.scenario", "load_actuator"),
    "load_scenario": ("magwire.scenario", "load"),
    "plan": ("magwire.planning", "plan"),
    "robustness": ("magwire.planning", "robustness"),
    "run_many": ("magwire.many", "run_many"),
    "scenario_names": ("magwire.scenario", "names"),
}

__all__ = [
    "Allocated",
    "Barrier",
    "Batch",
    "Command",
    "ConvergenceError",
    "Demands",
    "Device",
    "Ending",
    "Equilibrium",
    "Feed",
    "FieldSource",
    "ForceLimit",
    "Friction",
    "GradientField",
    "Hold",
    "InputError",
    "Lumen",
    "MagwireError",
    "Make",
    "NavigationError",
    "Navigator",
    "Observation",
    "Outcome",
    "Prescribed",
    "Prospect",
    "Record",
    "Result",
    "ResultError",
    "RunStatus",
    "Scenario",
    "ScenarioError",
    "Schedule",
    "Section",
    "Session",
    "Simulation",
    "Snapshot",
    "StableNavigator",
    "Steering",
    "TimedInputs",
    "TipNavigator",
    "Trial",
    "UniformField",
    "Vessel",
    "WallMotion",
    "Wire",
    "__version__",
    "across",
    "axial",
    "device_names",
    "load_actuator",
    "load_device",
    "load_scenario",
    "plan",
    "robustness",
    "run_many",
    "scenario_names",
]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        value: Any = _version()
    elif name in _HOMES:
        module, attribute = _HOMES[name]
        value = getattr(import_module(module), attribute)
    else:
        raise AttributeError(f"module 'magwire' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("magwire")
    except PackageNotFoundError:  # run from a source tree that is not installed
        return "0+unknown"

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
    from magwire.engine.command import Command as Command
    from magwire.engine.feed import Feed as Feed
    from magwire.engine.hold import Hold as Hold
    from magwire.engine.statics import Equilibrium as Equilibrium
    from magwire.errors import ConvergenceError as ConvergenceError
    from magwire.errors import InputError as InputError
    from magwire.errors import MagwireError as MagwireError
    from magwire.errors import ResultError as ResultError
    from magwire.errors import ScenarioError as ScenarioError
    from magwire.field import GradientField as GradientField
    from magwire.field import UniformField as UniformField
    from magwire.lumen import Lumen as Lumen
    from magwire.many import Outcome as Outcome
    from magwire.many import run_many as run_many
    from magwire.navigate import Prescribed as Prescribed
    from magwire.navigate import Schedule as Schedule
    from magwire.navigate.demands import Demands as Demands
    from magwire.navigate.stable import StableNavigator as StableNavigator
    from magwire.navigate.tip import TipNavigator as TipNavigator
    from magwire.planning import Prospect as Prospect
    from magwire.planning import plan as plan
    from magwire.results import Result as Result
    from magwire.scenario import Scenario as Scenario
    from magwire.scenario import load as load_scenario
    from magwire.scenario import names as scenario_names
    from magwire.simulation import Simulation as Simulation
    from magwire.vessel import Vessel as Vessel
    from magwire.wire import Make as Make
    from magwire.wire import Section as Section
    from magwire.wire import Wire as Wire

    __version__: str

_HOMES: dict[str, tuple[str, str]] = {
    "Barrier": ("magwire.contact", "Barrier"),
    "Batch": ("magwire.batch", "Batch"),
    "Command": ("magwire.engine.command", "Command"),
    "ConvergenceError": ("magwire.errors", "ConvergenceError"),
    "Demands": ("magwire.navigate.demands", "Demands"),
    "Equilibrium": ("magwire.engine.statics", "Equilibrium"),
    "Feed": ("magwire.engine.feed", "Feed"),
    "GradientField": ("magwire.field", "GradientField"),
    "Hold": ("magwire.engine.hold", "Hold"),
    "InputError": ("magwire.errors", "InputError"),
    "Lumen": ("magwire.lumen", "Lumen"),
    "MagwireError": ("magwire.errors", "MagwireError"),
    "Make": ("magwire.wire", "Make"),
    "Outcome": ("magwire.many", "Outcome"),
    "Prescribed": ("magwire.navigate", "Prescribed"),
    "Prospect": ("magwire.planning", "Prospect"),
    "Result": ("magwire.results", "Result"),
    "ResultError": ("magwire.errors", "ResultError"),
    "Scenario": ("magwire.scenario", "Scenario"),
    "ScenarioError": ("magwire.errors", "ScenarioError"),
    "Schedule": ("magwire.navigate", "Schedule"),
    "Section": ("magwire.wire", "Section"),
    "Simulation": ("magwire.simulation", "Simulation"),
    "StableNavigator": ("magwire.navigate.stable", "StableNavigator"),
    "TipNavigator": ("magwire.navigate.tip", "TipNavigator"),
    "UniformField": ("magwire.field", "UniformField"),
    "Vessel": ("magwire.vessel", "Vessel"),
    "Wire": ("magwire.wire", "Wire"),
    "load_scenario": ("magwire.scenario", "load"),
    "plan": ("magwire.planning", "plan"),
    "run_many": ("magwire.many", "run_many"),
    "scenario_names": ("magwire.scenario", "names"),
}

__all__ = [
    "Barrier",
    "Batch",
    "Command",
    "ConvergenceError",
    "Demands",
    "Equilibrium",
    "Feed",
    "GradientField",
    "Hold",
    "InputError",
    "Lumen",
    "MagwireError",
    "Make",
    "Outcome",
    "Prescribed",
    "Prospect",
    "Result",
    "ResultError",
    "Scenario",
    "ScenarioError",
    "Schedule",
    "Section",
    "Simulation",
    "StableNavigator",
    "TipNavigator",
    "UniformField",
    "Vessel",
    "Wire",
    "__version__",
    "load_scenario",
    "plan",
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

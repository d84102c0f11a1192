"""Kinds of wire, lumen, field, feed, navigator, actuator: one file each, which nothing else names.

What a kind of one's own needs is here: ``kind`` and the tables to start from. Importing the module
that has it makes it known; the environment variable MAGWIRE_KINDS names modules, or files, that are
to be imported with magwire's own.
"""

from __future__ import annotations

import os
from importlib import import_module, util
from pkgutil import iter_modules

from magwire.errors import MagwireError
from magwire.scenario.kind import FAMILIES, Faults, Inlined, kind, refusals
from magwire.scenario.kinds.actuator import ActuatorTable
from magwire.scenario.kinds.feed import FeedTable
from magwire.scenario.kinds.field import FieldTable
from magwire.scenario.kinds.lumen import LumenTable, RoundLumen
from magwire.scenario.kinds.navigate import ModelSteering, NavigatorTable
from magwire.scenario.kinds.wire import WireTable

__all__ = [
    "ActuatorTable",
    "Faults",
    "FeedTable",
    "FieldTable",
    "Inlined",
    "LumenTable",
    "ModelSteering",
    "NavigatorTable",
    "RoundLumen",
    "WireTable",
    "kind",
    "refusals",
]

OWN = "MAGWIRE_KINDS"
FIRST = (
    *("straight", "half_circle", "sinusoid", "helix", "tree"),
    *("aortic_arch", "carotid_bifurcation", "coronary_tree", "tortuous", "points", "vessel"),
    *("none", "stable", "newton", "paper", "schedule", "uniform"),
)
"""Modules whose kinds messages name first, in this order; the others follow by their names."""


def _import_kinds() -> None:
    """Make magwire's own kinds known, and those that the environment names."""
    for family in FAMILIES:
        package = import_module(f"{__name__}.{family}")
        names = [module.name for module in iter_modules(package.__path__)]
        rank = {name: place for place, name in enumerate(FIRST)}
        for name in sorted(names, key=lambda name: (rank.get(name, len(FIRST)), name)):
            import_module(f"{__name__}.{family}.{name}")
    for place in filter(None, os.environ.get(OWN, "").split(os.pathsep)):
        _import_own(place)


def _import_own(place: str) -> None:
    if place.endswith(".py"):
        spec = util.spec_from_file_location(os.path.basename(place).removesuffix(".py"), place)
        if spec is None or spec.loader is None or not os.path.isfile(place):
            raise MagwireError(f"File '{place}' of {OWN} does not exist.")
        spec.loader.exec_module(util.module_from_spec(spec))
    else:
        try:
            import_module(place)
        except ModuleNotFoundError as error:
            if error.name != place:  # it is there, and lacks something itself
                raise
            raise MagwireError(f"Module '{place}' of {OWN} is not installed.") from None


_import_kinds()

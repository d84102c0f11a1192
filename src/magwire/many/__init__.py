"""Many runs at once, and sweeps over the parameters of a scenario.

Names are imported when they are first asked for: processes are started before all that is loaded.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from magwire.many.outcome import Outcome as Outcome
    from magwire.many.runs import run_many as run_many

_HOMES = {"Outcome": "magwire.many.outcome", "run_many": "magwire.many.runs"}

__all__ = ["Outcome", "run_many"]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'magwire.many' has no attribute {name!r}")
    value = getattr(import_module(_HOMES[name]), name)
    globals()[name] = value
    return value

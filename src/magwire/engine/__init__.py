"""The solver: implicit Euler, statics, feeding, sensitivities."""

from magwire.engine.feed import Feed
from magwire.engine.statics import Equilibrium

__all__ = ["Equilibrium", "Feed"]

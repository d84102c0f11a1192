"""The lumen: branches of balls along centrelines, and the gap to their wall."""

from __future__ import annotations

from magwire.lumen.branch import Bend, Branch
from magwire.lumen.lumen import Lumen

__all__ = ["Bend", "Branch", "Lumen"]

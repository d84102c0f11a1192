"""Pictures of results, drawn from a dataset that follows the result file's contract."""

from __future__ import annotations

from magwire.plot.figure import draw, save
from magwire.plot.sweep import draw_sweep, save_sweep

__all__ = ["draw", "draw_sweep", "save", "save_sweep"]

"""Pictures of results, drawn from a dataset that follows the result file's contract."""

from __future__ import annotations

from magwire.plot.figure import draw, save

__all__ = ["draw", "save"]

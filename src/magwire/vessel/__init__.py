"""Vessels from files: lines cleaned, joined into a tree and smoothed."""

from __future__ import annotations

from magwire.vessel.reading import Source, Spot
from magwire.vessel.vessel import Vessel

__all__ = ["Source", "Spot", "Vessel"]

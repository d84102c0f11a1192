"""Vessels from files: lines cleaned, joined into a tree and smoothed."""

from __future__ import annotations

from magwire.vessel.reading import Spot, Vessel

__all__ = ["Spot", "Vessel"]

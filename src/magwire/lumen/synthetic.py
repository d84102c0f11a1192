"""The name that ``magwire.vessel.synthetic`` had before; its functions are the same."""

from __future__ import annotations

from magwire.vessel.synthetic import aortic_arch, carotid_bifurcation, coronary_tree, tortuous

__all__ = ["aortic_arch", "carotid_bifurcation", "coronary_tree", "tortuous"]

"""The evidence that the physics is right: magwire against answers that do not come from magwire."""

from magwire.evidence.verify.evidence import Curve, Line, Skipped
from magwire.evidence.verify.report import GROUPS, Report, gather

__all__ = ["GROUPS", "Curve", "Line", "Report", "Skipped", "gather"]

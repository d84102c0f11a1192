"""Many runs at once, and sweeps over the parameters of a scenario."""

from __future__ import annotations

from magwire.many.outcome import Outcome
from magwire.many.runs import run_many

__all__ = ["Outcome", "run_many"]

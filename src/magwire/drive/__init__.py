"""A wire driven by a person, live, in a browser; ``pip install magwire[drive]``."""

from __future__ import annotations

from magwire.drive.account import Account, Sight
from magwire.drive.outcome import Outcome
from magwire.drive.pilot import DEAD_MAN, Pilot
from magwire.drive.serving import DriveError, check_package, serve

__all__ = [
    "DEAD_MAN",
    "Account",
    "DriveError",
    "Outcome",
    "Pilot",
    "Sight",
    "check_package",
    "serve",
]

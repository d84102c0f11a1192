"""A wire driven by a person, live."""

from magwire.drive.pilot import DEAD_MAN, Pilot

__all__ = ["DEAD_MAN", "Pilot"]

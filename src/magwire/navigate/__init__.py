"""What field comes next."""

from magwire.navigate.navigator import (
    NavigationError,
    Navigator,
    Observation,
    Prescribed,
    Steering,
)
from magwire.navigate.schedule import Schedule

__all__ = ["NavigationError", "Navigator", "Observation", "Prescribed", "Schedule", "Steering"]

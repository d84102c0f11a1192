"""What field comes next."""

from magwire.navigate.navigator import (
    Course,
    NavigationError,
    Navigator,
    Observation,
    Prescribed,
    Steering,
)
from magwire.navigate.schedule import Schedule

__all__ = [
    "Course",
    "NavigationError",
    "Navigator",
    "Observation",
    "Prescribed",
    "Schedule",
    "Steering",
]

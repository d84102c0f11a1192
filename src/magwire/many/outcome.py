"""What is kept of each of many runs: how it ended, and a few numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from magwire.results import Result
from magwire.status import RunStatus


class Quantity(NamedTuple):
    """A number that is kept: its unit ("1" for a plain one), what it is, where it comes from."""

    units: str
    long_name: str
    read: Callable[[Result], float]


QUANTITIES: dict[str, Quantity] = {
    "fed": Quantity("m", "insertion length in the end", lambda r: r.feed.max(initial=0.0)),
    "max_tip_force": Quantity(
        "N", "largest force of the wall on the tip", lambda r: r.max_tip_force
    ),
    "mean_tip_force": Quantity(
        "N", "mean force of the wall on the tip", lambda r: r.mean_tip_force
    ),
    "peak_field": Quantity(
        "T", "largest magnitude of the flux density at the tip", lambda r: r.peak_field
    ),
    "max_wall_force": Quantity(
        "N", "largest force of the wall on the wire, summed over it", lambda r: r.max_wall_force
    ),
    "max_patch_force": Quantity(
        "N", "largest force of the wall on a patch of the wire", lambda r: r.max_patch_force
    ),
    "force_patch": Quantity("m", "length of that patch", lambda r: r.force_patch),
    "max_magnet_force": Quantity(
        "N", "largest force of the wall on the distal magnet", lambda r: r.max_magnet_force
    ),
    "longest_contact": Quantity("m", "largest contact length", lambda r: r.longest_contact),
    "max_push_force": Quantity("N", "largest push at the guide", lambda r: r.max_push_force),
    "max_insertion_force": Quantity(
        "N", "largest force that feeds the wire", lambda r: r.max_insertion_force
    ),
    "max_guide_torque": Quantity(
        "N m", "largest size of the torque at the guide", lambda r: r.max_guide_torque
    ),
    "max_friction": Quantity(
        "N",
        "largest friction of the wall on the wire, summed over it",
        lambda r: r.largest_friction,
    ),
    "friction_work": Quantity("J", "what friction took", lambda r: r.work_of_friction),
    "largest_indentation": Quantity(
        "m", "deepest that the wall is pressed in", lambda r: r.largest_indentation
    ),
    "wall_work": Quantity(
        "J", "what a wall that moves has done to the wire", lambda r: r.work_of_wall
    ),
    "largest_twist_lag": Quantity(
        "rad", "largest difference of the twists of guide and tip", lambda r: r.largest_lag
    ),
    "tip_contact_free": Quantity(
        "1", "whether the tip never felt the wall", lambda r: r.tip_contact_free
    ),
    "wire_contact_free": Quantity(
        "1", "whether no part of the wire ever felt the wall", lambda r: r.wire_contact_free
    ),
    "contact_free": Quantity("1", "another name of tip_contact_free", lambda r: r.contact_free),
    "first_contact": Quantity(
        "m",
        "insertion length at which some node first felt the wall",
        lambda r: np.nan if r.first_contact is None else r.first_contact,
    ),
    "smallest_clearance": Quantity(
        "m", "smallest distance to the wall", lambda r: r.smallest_clearance
    ),
    "largest_tip_offset": Quantity(
        "m", "largest distance of the tip from the centreline", lambda r: r.largest_tip_offset
    ),
    "largest_tip_departure": Quantity(
        "m",
        "largest distance of the tip from where the navigator's model has it",
        lambda r: r.largest_tip_departure,
    ),
    "stable": Quantity(
        "1", "whether the wire was stable at every record", lambda r: float(r.stable.all())
    ),
    "force_scale": Quantity("N", "EI / L^2", lambda r: r.force_scale),
    "steps": Quantity("1", "number of time steps", lambda r: r.steps),
    "newton_iterations": Quantity(
        "1", "Newton iterations per step, mean", lambda r: r.newton_iterations_per_step
    ),
    "wall_time": Quantity("s", "time that the run took", lambda r: r.wall_time),
}
"""By name. Plain numbers: 1 and 0 are yes and no, NaN is what there is not."""


@dataclass(frozen=True)
class Outcome:
    """How one of many runs ended.

    Attributes
    ----------
    number
        Place of its scenario among those given, from 0.
    status
        That of its result (see ``Result.status``), or "failed" if there is none.
    message
        Why it ended so; "" for a complete run.
    file
        Its result file; None if none was asked for, or the run failed.
    numbers
        Values by the names of ``QUANTITIES``, in SI units; empty if the run failed.
    """

    number: int
    status: str
    message: str = ""
    file: Path | None = None
    numbers: Mapping[str, float] = field(default_factory=dict)

    @property
    def complete(self) -> bool:
        """Whether the run went to its end."""
        return self.status == RunStatus.COMPLETE

    def result(self) -> Result:
        """The whole result, from its file.

        Raises
        ------
        ResultError
            If it has none.
        """
        from magwire.errors import ResultError

        if self.file is None:
            raise ResultError(
                f"Run {self.number} left no result file; it ended as '{self.status}'."
            )
        return Result.load(self.file)


def numbers_of(result: Result) -> dict[str, float]:
    """The values of all quantities."""
    return {name: float(quantity.read(result)) for name, quantity in QUANTITIES.items()}

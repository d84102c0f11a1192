"""What is known of the way to an outlet: planned, replayed, and tried where something was off."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from magwire.lumen.branch import Bend
from magwire.navigate.schedule import Schedule

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Trial:
    """How the way to an outlet went where something was off; see ``mw.robustness``.

    Attributes
    ----------
    change
        What was off, such as "E +5 %".
    reached
        Whether the tip got there.
    came
        How far along the path it came [m].
    peak_field
        Largest flux density [T].
    tip_force
        Largest force of the wall on the tip [N].
    clearance
        Smallest clearance [m]; NaN if the wire did not set out.
    reason
        Why it did not get there, or "".
    """

    change: str
    reached: bool
    came: float
    peak_field: float
    tip_force: float
    clearance: float
    reason: str


@dataclass(frozen=True)
class Prospect:
    """What to expect on the path to an outlet.

    Attributes
    ----------
    outlet
        Its name.
    reached
        Whether the tip gets there, up to one radius before the end.
    length, fed, came
        Length of the path; insertion length of the wire; and how far along the path the tip came
        [m]. A wire that cuts the bends is shorter than the path.
    narrowest, narrowest_at
        Smallest radius on the path and the arc parameter where it is [m].
    bend
        Tightest bend on the path.
    peak_field
        Largest flux density [T].
    tip_force, wall_force
        Largest force of the wall on the tip, and on the whole wire, summed over its nodes [N].
    patch_force, force_patch
        Largest force of the wall on a patch of the wire [N], and the length of the patch [m].
    push_force, guide_torque
        Largest push [N] and size of the torque [N m] at the guide.
    clearance
        Smallest clearance, also midway between the nodes [m]; NaN if it did not set out.
    reason
        Why it does not get there; of an outlet that is reached, what was tried again, or "".
    feed, arc, flux_density, force
        The same along the path: feed [m], how far the tip came [m], flux density [T] and force on
        the whole wire [N], shapes (n,).
    field_components
        The flux density along x, y and z, shape (n, 3) [T].
    trials
        How it went where something was off; none if that was not tried (``mw.robustness``).
    """

    outlet: str
    reached: bool
    length: float
    fed: float
    came: float
    narrowest: float
    narrowest_at: float
    bend: Bend
    peak_field: float
    tip_force: float
    wall_force: float
    patch_force: float
    force_patch: float
    push_force: float
    guide_torque: float
    clearance: float
    reason: str
    feed: Array = field(repr=False)
    arc: Array = field(repr=False)
    flux_density: Array = field(repr=False)
    force: Array = field(repr=False)
    field_components: Array = field(repr=False)
    trials: tuple[Trial, ...] = ()

    @property
    def schedule(self) -> Schedule:
        """The field as a function of the feed, to be replayed with ``mw.Prescribed``."""
        return Schedule.along(list(zip(self.feed.tolist(), self.field_components, strict=True)))

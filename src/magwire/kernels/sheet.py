"""What is read off a wire for a record: a row of numbers, in SI, and where each of them is."""

from __future__ import annotations

from typing import NamedTuple

from magwire.kernels.arrays import Array

NUMBERS = (
    "time", "feed", "clearance_midpoint", "clearance_along", "tip_force", "tip_offset",
    "friction_work", "wall_work", "guide_twist", "tip_twist", "push_force", "insertion_force",
    "guide_torque", "newton_iterations", "stable", "tip_departure", "max_tip_force",
    "mean_tip_force", "first_contact_feed", "smallest_clearance", "steps",
    "newton_iterations_total", "factorisations", "retries", "wall_time",
)  # fmt: skip
"""Single numbers, in their order."""
TIME = NUMBERS.index("time")
FEED = NUMBERS.index("feed")
CLEARANCE_MIDPOINT = NUMBERS.index("clearance_midpoint")
CLEARANCE_ALONG = NUMBERS.index("clearance_along")
TIP_FORCE = NUMBERS.index("tip_force")
TIP_OFFSET = NUMBERS.index("tip_offset")
FRICTION_WORK = NUMBERS.index("friction_work")
WALL_WORK = NUMBERS.index("wall_work")
GUIDE_TWIST = NUMBERS.index("guide_twist")
TIP_TWIST = NUMBERS.index("tip_twist")
PUSH_FORCE = NUMBERS.index("push_force")
INSERTION_FORCE = NUMBERS.index("insertion_force")
GUIDE_TORQUE = NUMBERS.index("guide_torque")
NEWTON_ITERATIONS = NUMBERS.index("newton_iterations")
STABLE = NUMBERS.index("stable")
TIP_DEPARTURE = NUMBERS.index("tip_departure")
MAX_TIP_FORCE = NUMBERS.index("max_tip_force")
MEAN_TIP_FORCE = NUMBERS.index("mean_tip_force")
FIRST_CONTACT_FEED = NUMBERS.index("first_contact_feed")
SMALLEST_CLEARANCE = NUMBERS.index("smallest_clearance")
STEPS = NUMBERS.index("steps")
NEWTON_ITERATIONS_TOTAL = NUMBERS.index("newton_iterations_total")
FACTORISATIONS = NUMBERS.index("factorisations")
RETRIES = NUMBERS.index("retries")
WALL_TIME = NUMBERS.index("wall_time")


class Sheet(NamedTuple):
    """Places of a row, for kernels to write to; see ``engine.record.Record``.

    numbers [NUMBERS]; flux_density [3]; inputs [m]; then of the nodes: clearance, slip,
    wall_indentation [N], position, contact_force, friction_force, wall_displacement,
    material_director [N, 3].
    """

    numbers: Array
    flux_density: Array
    inputs: Array
    clearance: Array
    slip: Array
    wall_indentation: Array
    position: Array
    contact_force: Array
    friction_force: Array
    wall_displacement: Array
    material_director: Array

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

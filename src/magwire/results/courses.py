"""The variables of a result along its records, as arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Courses:
    """How each variable of a result went, with the records as first axis.

    Attributes
    ----------
    held
        The variables by name, with ``values``.
    """

    held: Any

    @property
    def time(self) -> Array:
        """Simulated time, shape (t,) [s]."""
        return self._array("time")

    @property
    def feed(self) -> Array:
        """Insertion: length of wire inside the lumen, shape (t,) [m]."""
        return self._array("feed")

    @property
    def position(self) -> Array:
        """Positions of the nodes, shape (t, nodes, 3) [m]."""
        return self._array("position")

    @property
    def field(self) -> Array:
        """Flux density at the tip, shape (t, 3) [T]."""
        return self._array("field")

    @property
    def contact_force(self) -> Array:
        """Force of the wall on the nodes, shape (t, nodes, 3) [N]."""
        return self._array("contact_force")

    @property
    def clearance(self) -> Array:
        """Distance of the nodes to the wall, shape (t, nodes) [m]; NaN on the guide."""
        return self._array("clearance")

    @property
    def tip_force(self) -> Array:
        """Magnitude of the force of the wall on the tip, shape (t,) [N]."""
        return self._array("tip_force")

    @property
    def tip_offset(self) -> Array:
        """Distance of the tip from the centreline, shape (t,) [m]."""
        return self._array("tip_offset")

    @property
    def tip_departure(self) -> Array:
        """Distance of the tip from where the navigator's model has it, shape (t,) [m].

        The largest since the record before; NaN where nobody compared.
        """
        return self._array("tip_departure")

    @property
    def friction_force(self) -> Array:
        """Force of the wall on the nodes along the wall, shape (t, nodes, 3) [N]; see P-30."""
        return self._array("friction_force")

    @property
    def slip(self) -> Array:
        """How far each node's surface has slid on the wall so far, shape (t, nodes) [m]."""
        return self._array("slip")

    @property
    def friction_work(self) -> Array:
        """What friction has taken so far, shape (t,) [J]."""
        return self._array("friction_work")

    @property
    def wall_indentation(self) -> Array:
        """How far each node presses the wall in, shape (t, nodes) [m]; see P-39."""
        return self._array("wall_indentation")

    @property
    def wall_displacement(self) -> Array:
        """How far the wall has moved at each node, shape (t, nodes, 3) [m]; see P-40."""
        return self._array("wall_displacement")

    @property
    def wall_work(self) -> Array:
        """What the wall that moves has done to the wire so far, shape (t,) [J]."""
        return self._array("wall_work")

    @property
    def guide_twist(self) -> Array:
        """Angle by which the guide has turned the wire about its axis, shape (t,) [rad]."""
        return self._array("guide_twist")

    @property
    def tip_twist(self) -> Array:
        """Angle by which the tip is turned, against an untwisted wire, shape (t,) [rad]."""
        return self._array("tip_twist")

    @property
    def push_force(self) -> Array:
        """Force of the guide on the wire, along the guide, shape (t,) [N] (P-38)."""
        return self._array("push_force")

    @property
    def insertion_force(self) -> Array:
        """Force that feeds the wire through the guide, shape (t,) [N] (P-38)."""
        return self._array("insertion_force")

    @property
    def guide_torque(self) -> Array:
        """Torque of the guide on the wire, about the guide, shape (t,) [N m] (P-38)."""
        return self._array("guide_torque")

    @property
    def wall_force(self) -> Array:
        """Force of the wall on the wire, sizes summed over its nodes, shape (t,) [N]."""
        return self._array("wall_force")

    @property
    def patch_force(self) -> Array:
        """Largest force of the wall on any ``force_patch`` of wire, shape (t,) [N] (P-37)."""
        return self._array("patch_force")

    @property
    def magnet_force(self) -> Array:
        """Force of the wall on the distal magnet, shape (t,) [N]; NaN without one."""
        return self._array("magnet_force")

    @property
    def contact_length(self) -> Array:
        """Shortest length of wire that carries 95 percent of the wall's force, shape (t,) [m]."""
        return self._array("contact_length")

    @property
    def force_per_length(self) -> Array:
        """Force of the wall per length of wire, smoothed, shape (t, nodes) [N/m] (P-37)."""
        return self._array("force_per_length")

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Whether the tangent stiffness is positive definite, shape (t,)."""
        return self._array("stable") > 0.0

    @property
    def normalized_push(self) -> Array:
        """Insertion length over length of the wire, shape (t,)."""
        return self._array("normalized_push")

    @property
    def normalized_tip_force(self) -> Array:
        """Tip force times L^2 / EI, shape (t,)."""
        return self._array("normalized_tip_force")

    @property
    def inputs(self) -> Array:
        """Inputs of the actuator, shape (t, m), in the units of ``input_names``."""
        return self._array("inputs")

    def _array(self, name: str) -> Array:
        return np.asarray(self.held[name].values, dtype=np.float64)

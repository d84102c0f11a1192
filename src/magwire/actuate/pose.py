"""Where an actuator stands against the vessel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate.inputs import Vector3
from magwire.errors import InputError, array, finite

Array = NDArray[np.float64]
Matrix3 = tuple[Vector3, Vector3, Vector3]
UNTURNED: Matrix3 = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class Pose:
    """A rotation and a translation: x = R x_own + t.

    Parameters
    ----------
    rotation
        R, shape (3, 3), orthogonal with determinant 1.
    translation
        t, shape (3,) [m].

    Raises
    ------
    InputError
        If the matrix is no rotation.
    """

    rotation: Matrix3 = UNTURNED
    translation: Vector3 = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        matrix = array("Pose", "rotation", self.rotation, (3, 3))
        away = array("Pose", "translation", self.translation, (3,), "m")
        if np.abs(matrix @ matrix.T - np.eye(3)).max() > 1e-9 or np.linalg.det(matrix) < 0.0:
            raise InputError(
                "Input rotation of Pose must be orthogonal with determinant 1; "
                f"received {matrix.tolist()}."
            )
        object.__setattr__(self, "rotation", tuple(tuple(row) for row in matrix.tolist()))
        object.__setattr__(self, "translation", tuple(away.tolist()))

    @classmethod
    def turned(cls, axis: ArrayLike, angle: float, translation: Vector3 = (0.0, 0.0, 0.0)) -> Pose:
        """A turn by ``angle`` [rad] about ``axis``, shape (3,), then a translation [m]."""
        vector = array("Pose", "axis", axis, (3,))
        size = float(np.linalg.norm(vector))
        if size == 0.0:
            raise InputError("Input axis of Pose must have a length; received [0, 0, 0].")
        x, y, z = vector / size
        skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        phi = finite("Pose", "angle", angle, "rad")
        matrix = np.eye(3) + np.sin(phi) * skew + (1.0 - np.cos(phi)) * skew @ skew
        return cls(tuple(tuple(row) for row in matrix.tolist()), translation)  # type: ignore[arg-type]

    def in_other_axes(self) -> Pose:
        """The same place where x and y point the other way: from RAS to LPS, or back."""
        flip = np.diag([-1.0, -1.0, 1.0])
        return Pose.of(flip @ self.matrix @ flip, flip @ self.shift)

    @classmethod
    def of(cls, matrix: Array, shift: Array) -> Pose:
        """A pose from arrays."""
        return cls(tuple(tuple(r) for r in matrix.tolist()), tuple(shift.tolist()))  # type: ignore[arg-type]

    @property
    def matrix(self) -> Array:
        """R, shape (3, 3)."""
        return np.array(self.rotation)

    @property
    def shift(self) -> Array:
        """t, shape (3,) [m]."""
        return np.array(self.translation)

    def after(self, inner: Pose) -> Pose:
        """The pose applied to what ``inner`` has placed."""
        return Pose.of(self.matrix @ inner.matrix, self.matrix @ inner.shift + self.shift)

    def direction(self, vector: ArrayLike) -> Array:
        """A vector of the actuator's own frame, shape (3,), in space."""
        along: Array = self.matrix @ np.asarray(vector, dtype=np.float64)
        return along

    def placed(self, point: ArrayLike) -> Array:
        """A point of the actuator's own frame, shape (3,) [m], in space."""
        return self.direction(point) + self.shift

    def own(self, points: Array) -> Array:
        """Points, shape (n, 3) [m], in the actuator's own frame."""
        return (points - self.shift) @ self.matrix


HERE = Pose()
"""Neither turned nor moved."""

"""A permanent magnet on an arm: its pose is the input (P-25, P-27)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from magwire.actuate.actuator import Actuator
from magwire.actuate.inputs import Box, Input
from magwire.actuate.tables import Desk
from magwire.errors import InputError, positive


@dataclass(frozen=True, kw_only=True)
class Magnet(Actuator):
    """A sphere or a cylinder that an arm moves and turns.

    Its inputs are the position of its centre [m], and its direction of magnetisation as three
    numbers of which only the direction counts.

    Parameters
    ----------
    radius
        [m].
    remanence
        [T].
    length
        Length of a cylinder, magnetised along its axis [m]; None is a sphere.
    reach
        Where its centre may be, in the arm's frame; anywhere if left out.
    keep_out
        Least distance of its surface from the vessel [m].
    parked
        Position [m] and direction before anybody moves it, in the arm's frame: a metre away if left
        out.
    speed
        Speed of its centre along each axis [m/s].
    turning
        Angular speed [rad/s].

    Raises
    ------
    InputError
        If a value is not positive.
    """

    radius: float
    remanence: float
    length: float | None = None
    reach: Box | None = None
    keep_out: float = 0.0
    parked: tuple[float, float, float, float, float, float] = (0.0, 0.0, 1.0, 0.0, 0.0, 1.0)
    speed: float = math.inf
    turning: float = math.inf

    def __post_init__(self) -> None:
        positive("Magnet", "radius", self.radius, "m")
        positive("Magnet", "remanence", self.remanence, "T")
        if self.length is not None:
            positive("Magnet", "length", self.length, "m")

    @property
    def idle(self) -> np.ndarray:
        """Where it is parked."""
        return np.array(self.parked)

    @property
    def inputs(self) -> tuple[Input, ...]:
        """x, y, z [m] and the direction."""
        low = self.reach.low if self.reach else (-math.inf,) * 3
        high = self.reach.high if self.reach else (math.inf,) * 3
        where = (
            Input(axis, "m", a, b, self.speed) for axis, a, b in zip("xyz", low, high, strict=True)
        )
        aim = (Input(f"d{axis}", "", -1.0, 1.0, self.turning) for axis in "xyz")
        return (*where, *aim)

    def lay(self, desk: Desk) -> None:
        """Lay the magnet; a sphere is a dipole from outside."""
        # mu0 m/(4 pi) of a sphere is Br/(4 pi) times its volume
        moment = self.remanence * self.radius**3 / 3.0
        shape = None if self.length is None else (self.radius, 0.5 * self.length)
        desk.magnet(moment, shape, self.remanence)

    def aimed(self, u: ArrayLike, place: ArrayLike, flux: ArrayLike) -> np.ndarray:
        """Inputs that make a flux density at a place as a dipole would, on the line to the magnet.

        A dipole m makes 2 m along the line from it and -m across, over the distance cubed; so that
        of b is b/2 along and -b across.

        Parameters
        ----------
        u
            Inputs whose position gives the line, shape (6,).
        place, flux
            Shape (3,) [m] and (3,) [T].
        """
        where, values = self._checked(np.reshape(place, (1, 3)), u)
        wanted = self.pose.matrix.T @ np.asarray(flux, dtype=np.float64)
        line = _unit(values[:3] - self.pose.own(where)[0])
        along = (wanted @ line) * line
        moment = 0.5 * along - (wanted - along)
        length = 4.0 / 3.0 * self.radius if self.length is None else self.length
        volume = np.pi * self.radius**2 * length
        strength = self.remanence * volume / (4.0 * np.pi)
        distance = (strength / np.linalg.norm(moment)) ** (1.0 / 3.0)
        found: np.ndarray = np.concatenate(
            (self.pose.own(where)[0] + distance * line, _unit(moment))
        )
        return found

    def distance(self, u: ArrayLike, points: ArrayLike) -> np.ndarray:
        """Distance of points, shape (n, 3) [m], from the magnet's surface at inputs ``u`` [m].

        Negative inside.
        """
        where, values = self._checked(points, u)
        away = self.pose.own(where) - values[:3]
        if self.length is None:
            far: np.ndarray = np.linalg.norm(away, axis=1) - self.radius
            return far
        along = away @ _unit(values[3:])
        across = np.sqrt(np.maximum(np.sum(away * away, axis=1) - along * along, 0.0))
        over = np.stack([np.abs(along) - 0.5 * self.length, across - self.radius], axis=1)
        outside = np.linalg.norm(np.maximum(over, 0.0), axis=1)
        near: np.ndarray = outside + np.minimum(over.max(axis=1), 0.0)
        return near


def _unit(vector: np.ndarray) -> np.ndarray:
    size = float(np.linalg.norm(vector))
    if size == 0.0:
        raise InputError("The direction of a magnet must have a length; received [0, 0, 0].")
    unit: np.ndarray = vector / size
    return unit

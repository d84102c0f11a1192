"""What makes a field: inputs, limits, and B and its gradient at points (P-24, P-27)."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate.inputs import Box, Input
from magwire.actuate.pose import HERE, Pose
from magwire.actuate.tables import Desk, Slot, Tables
from magwire.errors import InputError, array
from magwire.kernels.sources.drive import drive
from magwire.kernels.sources.sample import respond, sample
from magwire.kernels.sources.table import Sources, new_strength

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Actuator(ABC):
    """A field that inputs u change.

    To add a kind, write a class with ``inputs`` and ``lay``.

    Parameters
    ----------
    pose
        Where it stands: its own frame in that of the vessel.
    workspace
        Where it is calibrated, in its own frame; None if it holds everywhere.
    max_power
        Of all coils together [W] (P-27).
    """

    pose: Pose = HERE
    workspace: Box | None = None
    max_power: float = math.inf

    @property
    @abstractmethod
    def inputs(self) -> tuple[Input, ...]:
        """What can be set."""

    @property
    def idle(self) -> Array:
        """Inputs before anybody sets them, shape (K,): zero, or where a magnet is parked."""
        return np.zeros(len(self.inputs))

    @abstractmethod
    def lay(self, desk: Desk) -> None:
        """Lay out its sources, in its own frame."""

    def arrays(self, length: float = 1.0, flux: float = 1.0) -> Sources:
        """The table of its sources for kernels.

        Parameters
        ----------
        length
            Unit of the positions that kernels will ask for [m].
        flux
            Unit of the flux densities that they will get [T].
        """
        slots = tuple(Slot(k, None) for k in range(len(self.inputs)))
        tables = Tables(len(slots))
        self.lay(Desk(tables, slots, self.pose))
        return tables.sources(length, flux)

    @cached_property
    def _sources(self) -> Sources:
        return self.arrays()

    def at(self, points: ArrayLike, u: ArrayLike) -> tuple[Array, Array]:
        """Flux density and its gradient.

        Parameters
        ----------
        points
            Shape (n, 3) [m].
        u
            Inputs, shape (K,), in the units of ``inputs``.

        Returns
        -------
        tuple
            Flux density, shape (n, 3) [T], and G[n, i, j] = dB_i/dx_j, shape (n, 3, 3) [T/m]; NaN
            outside of a map.
        """
        where, values = self._checked(points, u)
        strength = new_strength(self._sources)
        drive(self._sources, values, strength)
        flux, gradient = np.empty((len(where), 3)), np.empty((len(where), 9))
        sample(self._sources, strength, where, flux, gradient)
        return flux, gradient.reshape(-1, 3, 3)

    def response(self, points: ArrayLike, u: ArrayLike) -> tuple[Array, Array]:
        """Derivatives by the inputs: of B, shape (n, K, 3), and of G, shape (n, K, 3, 3)."""
        where, values = self._checked(points, u)
        strength = new_strength(self._sources)
        drive(self._sources, values, strength)
        n, count = len(where), len(values)
        flux, gradient = np.zeros((n, count, 3)), np.zeros((n, count, 9))
        respond(self._sources, values, strength, where, flux, gradient)
        return flux, gradient.reshape(n, count, 3, 3)

    def outside(self, points: ArrayLike) -> Array:
        """How far points, shape (n, 3) [m], are outside of the workspace, shape (n,) [m]."""
        where = array(type(self).__name__, "points", points, (None, 3), "m")
        if self.workspace is None:
            return np.zeros(len(where))
        return self.workspace.outside(self.pose.own(where))

    def power(self, u: ArrayLike) -> float:
        """What the coils turn into heat, sum of R u^2 [W]."""
        values = array(type(self).__name__, "u", u, (len(self.inputs),))
        return float(sum(i.resistance * v * v for i, v in zip(self.inputs, values, strict=True)))

    def violations(self, u: ArrayLike) -> tuple[str, ...]:
        """A sentence for each limit that inputs, shape (K,), do not keep."""
        values = array(type(self).__name__, "u", u, (len(self.inputs),))
        said = [
            f"Input {i.name} must be between {i.low:g} and {i.high:g} {i.unit}".rstrip()
            + f"; received {v:g} {i.unit}".rstrip()
            + "."
            for i, v in zip(self.inputs, values, strict=True)
            if not i.low <= v <= i.high
        ]
        if self.power(values) > self.max_power:
            said.append(
                f"The power of all coils must be at most {self.max_power:g} W; "
                f"received {self.power(values):g} W."
            )
        return tuple(said)

    def _checked(self, points: ArrayLike, u: ArrayLike) -> tuple[Array, Array]:
        kind = type(self).__name__
        where = array(kind, "points", points, (None, 3), "m")
        values = np.array(u, dtype=np.float64)
        if values.shape != (len(self.inputs),):
            raise InputError(
                f"Inputs of {kind} must be {len(self.inputs)} numbers "
                f"({', '.join(i.name for i in self.inputs)}); received {values.size}."
            )
        return where, array(kind, "u", values, (len(self.inputs),))

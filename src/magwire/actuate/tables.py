"""Laying actuators out as a table of sources (P-24)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate.pose import HERE, Pose
from magwire.errors import InputError
from magwire.kernels.sources import table
from magwire.kernels.sources.drive import saturated
from magwire.kernels.sources.table import Sources, no_sources

Array = NDArray[np.float64]
CURVES = {"erf": table.ERF, "atan": table.ATAN, "tanh": table.TANH, "rational": table.RATIONAL}
"""Saturation by its name in files: a erf(b u), a atan(b u), a tanh(b u) and a u/(|u| + b)."""


class Saturation(NamedTuple):
    """A curve s(u) of an iron core: its kind among ``CURVES`` and its two parameters."""

    kind: str
    a: float
    b: float

    def at(self, u: float) -> float:
        """Effective input."""
        return float(saturated(CURVES[self.kind], self.a, self.b, u)[0])


class Slot(NamedTuple):
    """What an actuator's input is on the table: a channel, or a value that is held."""

    channel: int
    value: float | None


@dataclass
class Tables:
    """Rows by kind while they are collected."""

    inputs: int
    affine: Array = field(init=False)
    curve: NDArray[np.int64] = field(init=False)
    saturation: Array = field(init=False)
    dipoles: list[tuple[int, Array]] = field(default_factory=list)
    multipoles: list[tuple[int, Array, Array, Array]] = field(default_factory=list)
    loops: list[tuple[int, Array]] = field(default_factory=list)
    cylinders: list[tuple[int, Array]] = field(default_factory=list)
    maps: list[tuple[int, Array]] = field(default_factory=list)
    grid: Array | None = None
    posed: list[tuple[int, int, int]] = field(default_factory=list)
    frames: list[Array] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.affine = np.zeros((self.inputs + 1, 12))
        self.curve = np.zeros(self.inputs, dtype=np.int64)
        self.saturation = np.zeros((self.inputs, 2))

    def sources(self, length: float, flux: float) -> Sources:
        """The table."""
        empty = no_sources(self.inputs)
        orders = max((max(len(m[2]), len(m[3])) for m in self.multipoles), default=0)
        shape = self.maps[0][1].shape if self.maps else (3, 4, 4, 4)
        return empty._replace(
            length=float(length),
            flux=float(flux),
            curve=self.curve,
            saturation=self.saturation,
            affine=self.affine,
            dipoles=_rows([row for _, row in self.dipoles], table.DIPOLE),
            dipole_channel=_channels(self.dipoles),
            multipoles=_rows([m[1] for m in self.multipoles], 6),
            multipole_channel=np.array([m[0] for m in self.multipoles], dtype=np.int64),
            outward=_padded([m[2] for m in self.multipoles], orders),
            inward=_padded([m[3] for m in self.multipoles], orders),
            loops=_rows([row for _, row in self.loops], table.LOOP),
            loop_channel=_channels(self.loops),
            cylinders=_rows([row for _, row in self.cylinders], table.CYLINDER),
            cylinder_channel=_channels(self.cylinders),
            maps=np.array([m for _, m in self.maps]).reshape((len(self.maps), *shape)),
            map_channel=_channels(self.maps),
            map_grid=np.zeros(18) if self.grid is None else self.grid,
            posed=np.array(self.posed, dtype=np.int64).reshape(-1, 3),
            pose_frame=np.array(self.frames).reshape(-1, 12),
        )


def _rows(rows: list[Array], size: int) -> Array:
    return np.ascontiguousarray(np.array(rows, dtype=np.float64).reshape(-1, size).T)


def _channels(rows: list[tuple[int, Array]]) -> NDArray[np.int64]:
    return np.array([channel for channel, _ in rows], dtype=np.int64)


def _padded(rows: list[Array], size: int) -> Array:
    filled = np.zeros((len(rows), size))
    for i, row in enumerate(rows):
        filled[i, : len(row)] = row
    return filled


class Desk:
    """Where one actuator lays out its sources: it knows its own inputs and its own frame only.

    Parameters
    ----------
    tables
        What is being filled.
    slots
        What each input of the actuator is there.
    pose
        Where the actuator's frame is.
    turns
        A frame inside of that for what is laid for each channel; none if empty.
    """

    def __init__(
        self,
        tables: Tables,
        slots: tuple[Slot, ...],
        pose: Pose,
        turns: Mapping[int, Pose] | None = None,
    ) -> None:
        self.tables, self.slots, self.pose = tables, slots, pose
        self._held = [slot.value for slot in slots]
        self._turns = turns or {}

    def within(self, pose: Pose, slots: tuple[Slot, ...] | None = None) -> Desk:
        """A desk in a frame inside of this one, with other slots if they are given."""
        chosen = self.slots if slots is None else slots
        return Desk(self.tables, chosen, self.pose.after(pose), self._turns)

    def tilted(self, turns: Sequence[Pose]) -> Desk:
        """The same desk with a frame of its own for what is laid for each input."""
        own = {
            slot.channel: self._turns.get(slot.channel, HERE).after(turn)
            for slot, turn in zip(self.slots, turns, strict=True)
        }
        return Desk(self.tables, self.slots, self.pose, own)

    def saturate(self, k: int, curve: Saturation) -> None:
        """Give input ``k`` a curve; before any source of its is laid."""
        slot = self.slots[k]
        if slot.value is not None:
            self._held[k] = curve.at(slot.value)
            return
        self.tables.curve[slot.channel] = CURVES[curve.kind]
        self.tables.saturation[slot.channel] = curve.a, curve.b

    def _channel(self, k: int | None) -> tuple[int, float]:
        """Channel and factor of input ``k``; None is what needs no input."""
        if k is None:
            return self.tables.inputs, 1.0
        held = self._held[k]
        return (self.slots[k].channel, 1.0) if held is None else (self.tables.inputs, held)

    def _frame(self, channel: int) -> Pose:
        """Where what is laid for a channel stands."""
        turn = self._turns.get(channel)
        return self.pose if turn is None else self.pose.after(turn)

    def affine(
        self, k: int | None, flux: ArrayLike, gradient: ArrayLike = ((0.0,) * 3,) * 3
    ) -> None:
        """A field B + G x for input 1: B, shape (3,) [T], and G, shape (3, 3) [T/m]."""
        channel, factor = self._channel(k)
        frame = self._frame(channel)
        turn = frame.matrix
        g = turn @ np.asarray(gradient, dtype=np.float64) @ turn.T
        b = frame.direction(flux) - g @ frame.shift
        self.tables.affine[channel] += factor * np.concatenate([b, g.ravel()])

    def dipole(self, k: int | None, position: ArrayLike, moment: ArrayLike) -> None:
        """A dipole with mu0 m/(4 pi), shape (3,) [T m^3], for input 1."""
        channel, factor = self._channel(k)
        frame = self._frame(channel)
        row = np.concatenate([frame.placed(position), factor * frame.direction(moment)])
        self.tables.dipoles.append((channel, row))

    def multipole(
        self, k: int | None, place: tuple[Array, Array], outward: Array, inward: Array
    ) -> None:
        """A source of any order at ``place`` = (position, direction), for input 1."""
        channel, factor = self._channel(k)
        frame = self._frame(channel)
        row = np.concatenate([frame.placed(place[0]), frame.direction(place[1])])
        self.tables.multipoles.append((channel, row, factor * outward, factor * inward))

    def loop(self, k: int | None, place: tuple[Array, Array], radius: float, gain: float) -> None:
        """A loop at ``place`` = (centre, axis); gain is mu0 N/(2 pi) [T m] for input 1."""
        channel, factor = self._channel(k)
        frame, size = self._frame(channel), [radius, factor * gain]
        row = np.concatenate([frame.placed(place[0]), frame.direction(place[1]), size])
        self.tables.loops.append((channel, row))

    def map(self, k: int | None, coefficients: Array, first: Array, step: Array) -> None:
        """A map's spline coefficients for input 1, in this frame."""
        channel, factor = self._channel(k)
        frame = self._frame(channel)
        grid = np.concatenate([first, step, frame.shift, frame.matrix.ravel()])
        other = self.tables.grid
        if other is not None and not np.array_equal(other, grid):
            raise InputError("Maps that act together must be on one grid; received two grids.")
        self.tables.grid = grid
        self.tables.maps.append((channel, factor * coefficients))

    def magnet(self, moment: float, shape: tuple[float, float] | None, remanence: float) -> None:
        """A magnet whose six inputs are position [m] and direction.

        Parameters
        ----------
        moment
            mu0 m/(4 pi) [T m^3], of a sphere.
        shape
            Radius and half of the length of a cylinder [m]; None is a sphere.
        remanence
            Remanence of a cylinder [T].
        """
        tables = self.tables
        free = all(slot.value is None for slot in self.slots)
        if not free and any(slot.value is None for slot in self.slots):
            raise InputError("The pose of a magnet must be held as a whole; received a part of it.")
        if shape is None:
            row, kind, rows = np.array([0.0, 0, 0, 0, 0, moment]), table.DIPOLE, tables.dipoles
        else:
            row = np.array([0.0, 0, 0, 0, 0, 1.0, *shape, remanence])
            kind, rows = table.CYLINDER, tables.cylinders
        if not free:
            values = np.array([slot.value for slot in self.slots], dtype=np.float64)
            axis = self.pose.direction(values[3:] / np.linalg.norm(values[3:]))
            row[:3] = self.pose.placed(values[:3])
            row[3:6] = axis * (moment if shape is None else 1.0)
        else:
            frame = np.concatenate([self.pose.matrix.ravel(), self.pose.shift])
            tables.posed.append((kind, len(rows), self.slots[0].channel))
            tables.frames.append(frame)
        rows.append((tables.inputs, row))

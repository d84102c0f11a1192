"""The table of all sources of a field, and the state that a set of inputs puts them in.

Inputs are in SI units (A, m, T). Positions travel in units of ``length`` [m] and flux densities in
units of ``flux`` [T], as the kernels have them (P-17); both are 1 for plain SI.

``drive`` turns the inputs into a state, an array that has all that does not depend on where one
looks; ``jet`` looks. The state holds, one after the other: the strength of each channel, its
derivative by the input, the affine part [12], and by kind, quantity after quantity: dipoles
(position, moment), multipoles (position, direction, strength), loops (centre, axis, radius,
factor), cylinders (centre, axis, radius, half of the length, remanence).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.kernels._jit import kernel

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

DIPOLE, MULTIPOLE, LOOP, CYLINDER = 6, 7, 8, 9
"""Numbers that a source of each kind has in the state."""
LINEAR, ERF, ATAN, TANH, RATIONAL = 0, 1, 2, 3, 4
"""Curves of saturation."""


class Sources(NamedTuple):
    """All sources, by kind. A channel is an input's strength; the last channel is always 1.

    length, flux
        Units of positions [m] and of flux densities [T].
    curve, saturation
        [K], [K, 2] kind of each input's curve and its two parameters.
    affine
        [K + 1, 12] flux density at the origin [T] and gradient by rows [T/m], for each channel.
    dipoles, dipole_channel
        [6, n] position [m] and mu0 m/(4 pi) [T m^3] for strength 1.
    multipoles, multipole_channel, outward, inward
        [6, n] position, direction; [n, orders] coefficients b and a, orders 1, 2, ...
    loops, loop_channel
        [8, n] centre [m], axis, radius [m], mu0 N / (2 pi) [T m] for strength 1.
    cylinders, cylinder_channel
        [9, n] centre [m], axis, radius, half of the length [m], remanence [T].
    maps, map_channel, map_grid
        [n, 3, i + 2, j + 2, k + 2] coefficients of the splines through i, j, k points [T]; [18]
        first point, step, translation [m], rotation by rows.
    posed, pose_frame
        [p, 3] kind (DIPOLE or CYLINDER), its number and its first input; [p, 12] rotation by rows
        and translation of the frame in which position and direction are given as inputs.
    """

    length: float
    flux: float
    curve: Integers
    saturation: Array
    affine: Array
    dipoles: Array
    dipole_channel: Integers
    multipoles: Array
    multipole_channel: Integers
    outward: Array
    inward: Array
    loops: Array
    loop_channel: Integers
    cylinders: Array
    cylinder_channel: Integers
    maps: Array
    map_channel: Integers
    map_grid: Array
    posed: Integers
    pose_frame: Array


@kernel
def offsets(sources):
    """Where the parts of the state begin: slopes, affine, each kind; and its size."""
    slope = sources.curve.shape[0] + 1
    affine = 2 * slope
    dipole = affine + 12
    multipole = dipole + DIPOLE * sources.dipoles.shape[1]
    loop = multipole + MULTIPOLE * sources.multipoles.shape[1]
    cylinder = loop + LOOP * sources.loops.shape[1]
    size = cylinder + CYLINDER * sources.cylinders.shape[1]
    return slope, affine, dipole, multipole, loop, cylinder, size


def no_sources(inputs: int) -> Sources:
    """A table of ``inputs`` inputs that does nothing yet, in SI units."""
    none = np.zeros(0, dtype=np.int64)
    return Sources(
        length=1.0,
        flux=1.0,
        curve=np.zeros(inputs, dtype=np.int64),
        saturation=np.zeros((inputs, 2)),
        affine=np.zeros((inputs + 1, 12)),
        dipoles=np.zeros((DIPOLE, 0)),
        dipole_channel=none,
        multipoles=np.zeros((6, 0)),
        multipole_channel=none,
        outward=np.zeros((0, 0)),
        inward=np.zeros((0, 0)),
        loops=np.zeros((LOOP, 0)),
        loop_channel=none,
        cylinders=np.zeros((CYLINDER, 0)),
        cylinder_channel=none,
        maps=np.zeros((0, 3, 4, 4, 4)),
        map_channel=none,
        map_grid=np.zeros(18),
        posed=np.zeros((0, 3), dtype=np.int64),
        pose_frame=np.zeros((0, 12)),
    )


def new_strength(sources: Sources) -> Array:
    """Room for the state of ``sources``."""
    return np.zeros(int(offsets(sources)[-1]))

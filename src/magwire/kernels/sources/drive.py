"""From inputs to a state: all that does not depend on where one looks (P-24, P-26, P-27)."""

from __future__ import annotations

from math import atan, erf, exp, pi, sqrt, tanh

from magwire.kernels._jit import kernel
from magwire.kernels.sources.table import ATAN, DIPOLE, ERF, RATIONAL, TANH, offsets
from magwire.kernels.vectors import norm, scale


@kernel
def saturated(curve, a, b, u):
    """Effective input s(u) of an iron core, and ds/du; s = u where there is none."""
    if curve == ERF:
        return a * erf(b * u), a * b * 2.0 / sqrt(pi) * exp(-b * b * u * u)
    if curve == ATAN:
        return a * atan(b * u), a * b / (1.0 + b * b * u * u)
    if curve == TANH:
        t = tanh(b * u)
        return a * t, a * b * (1.0 - t * t)
    if curve == RATIONAL:
        c = 1.0 / (abs(u) + b)
        return a * u * c, a * b * c * c
    return u, 1.0


@kernel
def placed(frame, local):
    """A point given in a frame (rotation by rows, translation), in space."""
    x, y, z = turned(frame, local)
    return (x + frame[9], y + frame[10], z + frame[11])


@kernel
def turned(frame, local):
    """A direction given in a frame, in space."""
    x, y, z = local
    return (
        frame[0] * x + frame[1] * y + frame[2] * z,
        frame[3] * x + frame[4] * y + frame[5] * z,
        frame[6] * x + frame[7] * y + frame[8] * z,
    )


@kernel
def drive(sources, u, strength):
    """Set the state ``strength`` to that of the inputs ``u``; see table.py."""
    slope, affine, dipole, multipole, loop, cylinder, _ = offsets(sources)
    channels = slope
    for k in range(channels - 1):
        s, ds = saturated(
            sources.curve[k], sources.saturation[k, 0], sources.saturation[k, 1], u[k]
        )
        strength[k] = s
        strength[slope + k] = ds
    strength[channels - 1] = 1.0
    strength[slope + channels - 1] = 0.0
    for c in range(12):
        total = 0.0
        for k in range(channels):
            total += sources.affine[k, c] * strength[k]
        strength[affine + c] = total
    _scaled(sources.dipoles, sources.dipole_channel, 3, strength, dipole)
    _kept(sources.multipoles, sources.multipole_channel, strength, multipole)
    _kept(sources.loops, sources.loop_channel, strength, loop)
    _kept(sources.cylinders, sources.cylinder_channel, strength, cylinder)
    for p in range(sources.posed.shape[0]):
        _pose(sources, p, u, strength)


@kernel
def _scaled(rows, channel, first, strength, at):
    """Copy rows; those from ``first`` on times the strength of the channel."""
    n = rows.shape[1]
    for i in range(rows.shape[0]):
        for j in range(n):
            factor = strength[channel[j]] if i >= first else 1.0
            strength[at + i * n + j] = factor * rows[i, j]


@kernel
def _kept(rows, channel, strength, at):
    """Copy rows, and give the last quantity the strength of the channel.

    Multipoles have no such row of their own: theirs is the strength alone.
    """
    n = rows.shape[1]
    last = 6 if rows.shape[0] == 6 else rows.shape[0] - 1
    for i in range(last):
        for j in range(n):
            strength[at + i * n + j] = rows[i, j]
    for j in range(n):
        own = 1.0 if rows.shape[0] == 6 else rows[last, j]
        strength[at + last * n + j] = own * strength[channel[j]]


@kernel
def _pose(sources, p, u, strength):
    """Put a magnet where its six inputs say, three of position and three of direction."""
    kind, j, k = sources.posed[p, 0], sources.posed[p, 1], sources.posed[p, 2]
    frame = sources.pose_frame[p]
    where = placed(frame, (u[k], u[k + 1], u[k + 2]))
    axis = (u[k + 3], u[k + 4], u[k + 5])
    axis = turned(frame, scale(1.0 / norm(axis), axis))
    _, _, dipole, _, _, cylinder, _ = offsets(sources)
    if kind == DIPOLE:
        n, at = sources.dipoles.shape[1], dipole
        size = norm((strength[at + 3 * n + j], strength[at + 4 * n + j], strength[at + 5 * n + j]))
        axis = scale(size, axis)
    else:
        n, at = sources.cylinders.shape[1], cylinder
    for i in range(3):
        strength[at + i * n + j] = where[i]
        strength[at + (3 + i) * n + j] = axis[i]

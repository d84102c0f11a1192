"""Derivatives of the field by the inputs, at a point (P-24)."""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.sources.cylinder import cylinder
from magwire.kernels.sources.dipole import dipole
from magwire.kernels.sources.drive import turned
from magwire.kernels.sources.grid import on_grid
from magwire.kernels.sources.harmonic import first, second
from magwire.kernels.sources.loop import loop
from magwire.kernels.sources.multipole import multipole
from magwire.kernels.sources.table import DIPOLE, offsets
from magwire.kernels.vectors import cross, norm, scale


@kernel
def by_inputs(sources, u, strength, x, by_flux, by_gradient):
    """Derivatives of B and of its gradient by each input, in the units of ``sources``.

    Parameters
    ----------
    sources, u, strength
        The table, the inputs and the state that ``drive`` made of them.
    x
        Point [sources.length].
    by_flux, by_gradient
        Where they go, shapes (K, 3) and (K, 9).
    """
    r = (sources.length * x[0], sources.length * x[1], sources.length * x[2])
    count = sources.curve.shape[0]
    slope = count + 1
    for k in range(count):
        ds = strength[slope + k]
        row = sources.affine[k]
        for i in range(3):
            by_flux[k, i] = ds * (
                row[i] + row[3 + 3 * i] * r[0] + row[4 + 3 * i] * r[1] + row[5 + 3 * i] * r[2]
            )
        for i in range(9):
            by_gradient[k, i] = ds * row[3 + i]
    _linear(sources, strength, r, by_flux, by_gradient)
    _maps(sources, strength, r, by_flux, by_gradient)
    for p in range(sources.posed.shape[0]):
        _pose(sources, u, strength, p, r, by_flux, by_gradient)
    unit = 1.0 / sources.flux
    for k in range(count):
        for i in range(3):
            by_flux[k, i] *= unit
        for i in range(9):
            by_gradient[k, i] *= unit * sources.length


@kernel
def _linear(sources, strength, r, by_flux, by_gradient):
    """Sources that are proportional to the strength of one channel."""
    count = sources.curve.shape[0]
    slope = count + 1
    c = sources.dipoles
    for j in range(c.shape[1]):
        k = sources.dipole_channel[j]
        if k < count:
            away, m = _seen(c, j, r)
            _add(dipole(away, m), strength[slope + k], k, by_flux, by_gradient)
    c = sources.multipoles
    for j in range(c.shape[1]):
        k = sources.multipole_channel[j]
        if k < count:
            away, t = _seen(c, j, r)
            h = multipole(away, t, 1.0, sources.outward, sources.inward, j)
            _add(h, strength[slope + k], k, by_flux, by_gradient)
    c = sources.loops
    for j in range(c.shape[1]):
        k = sources.loop_channel[j]
        if k < count:
            away, t = _seen(c, j, r)
            _add(loop(away, t, c[6, j], c[7, j]), strength[slope + k], k, by_flux, by_gradient)
    c = sources.cylinders
    for j in range(c.shape[1]):
        k = sources.cylinder_channel[j]
        if k < count:
            away, t = _seen(c, j, r)
            h = cylinder(away, t, c[6, j], c[7, j], c[8, j])
            _add(h, strength[slope + k], k, by_flux, by_gradient)


@kernel
def _seen(rows, j, r):
    """Position of ``r`` from source ``j`` of a table, and the source's axis or moment."""
    away = (r[0] - rows[0, j], r[1] - rows[1, j], r[2] - rows[2, j])
    return away, (rows[3, j], rows[4, j], rows[5, j])


@kernel
def _add(h, factor, k, by_flux, by_gradient):
    """Add a field as in harmonic.py to the row of input ``k``."""
    g = first(h)
    for i in range(3):
        by_flux[k, i] += factor * h[i]
    for i in range(9):
        by_gradient[k, i] += factor * g[i]


@kernel
def _maps(sources, strength, r, by_flux, by_gradient):
    count = sources.curve.shape[0]
    for m in range(sources.maps.shape[0]):
        k = sources.map_channel[m]
        if k < count:
            b, g, _ = on_grid(sources.maps, sources.map_grid, m, r)
            ds = strength[count + 1 + k]
            for i in range(3):
                by_flux[k, i] += ds * b[i]
            for i in range(9):
                by_gradient[k, i] += ds * g[i]


@kernel
def _pose(sources, u, strength, p, r, by_flux, by_gradient):
    """The six inputs of a magnet: it moves, or turns about its centre, as a rigid body.

    Moving by d gives dB = -(d.grad) B. Turning by w gives dB = w x B - ((w x r).grad) B, and the
    gradient turns in the same way; the unit vector t of a direction d changes by
    (d' - t (t.d'))/|d|, which is the turn w = t x d'/|d|.
    """
    kind, j, k = sources.posed[p, 0], sources.posed[p, 1], sources.posed[p, 2]
    frame = sources.pose_frame[p]
    _, _, dipole_at, _, _, cylinder_at, _ = offsets(sources)
    if kind == DIPOLE:
        n, at = sources.dipoles.shape[1], dipole_at + j
    else:
        n, at = sources.cylinders.shape[1], cylinder_at + j
    away = (r[0] - strength[at], r[1] - strength[at + n], r[2] - strength[at + 2 * n])
    t = (strength[at + 3 * n], strength[at + 4 * n], strength[at + 5 * n])
    if kind == DIPOLE:
        h = dipole(away, t)
    else:
        h = cylinder(away, t, strength[at + 6 * n], strength[at + 7 * n], strength[at + 8 * n])
    g, d = first(h), second(h)
    t = scale(1.0 / norm(t), t)
    size = norm((u[k + 3], u[k + 4], u[k + 5]))
    for i in range(3):
        e = turned(frame, (1.0 if i == 0 else 0.0, 1.0 if i == 1 else 0.0, 1.0 if i == 2 else 0.0))
        _move(g, d, e, k + i, by_flux, by_gradient)
        w = scale(1.0 / size, cross(t, e))
        _move(g, d, cross(w, away), k + 3 + i, by_flux, by_gradient)
        _turn(h, g, w, k + 3 + i, by_flux, by_gradient)


@kernel
def _move(g, d, e, k, by_flux, by_gradient):
    """Take (e.grad) B and (e.grad) of its gradient from the row of input ``k``."""
    for i in range(3):
        by_flux[k, i] -= g[3 * i] * e[0] + g[3 * i + 1] * e[1] + g[3 * i + 2] * e[2]
        s = 6 * i
        by_gradient[k, 3 * i] -= d[s] * e[0] + d[s + 1] * e[1] + d[s + 2] * e[2]
        by_gradient[k, 3 * i + 1] -= d[s + 1] * e[0] + d[s + 3] * e[1] + d[s + 4] * e[2]
        by_gradient[k, 3 * i + 2] -= d[s + 2] * e[0] + d[s + 4] * e[1] + d[s + 5] * e[2]


@kernel
def _turn(h, g, w, k, by_flux, by_gradient):
    """Add w x B and [w] G - G [w], which is a symmetric matrix, to the row of input ``k``."""
    b = cross(w, (h[0], h[1], h[2]))
    x = cross(w, (g[0], g[3], g[6]))
    y = cross(w, (g[1], g[4], g[7]))
    z = cross(w, (g[2], g[5], g[8]))
    # columns of [w] G; G is symmetric, so -G [w] is the transpose of [w] G
    for i in range(3):
        by_flux[k, i] += b[i]
        by_gradient[k, 3 * i] += x[i]
        by_gradient[k, 3 * i + 1] += y[i]
        by_gradient[k, 3 * i + 2] += z[i]
        by_gradient[k, i] += x[i]
        by_gradient[k, 3 + i] += y[i]
        by_gradient[k, 6 + i] += z[i]

"""Flux density with its first and second derivatives in space, of all sources together."""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.sources.cylinder import cylinder
from magwire.kernels.sources.dipole import dipoles
from magwire.kernels.sources.grid import in_frame, inside, on_grid
from magwire.kernels.sources.harmonic import first, plus, second
from magwire.kernels.sources.loop import loop
from magwire.kernels.sources.multipole import multipole
from magwire.kernels.sources.table import offsets

NO_SECOND = (0.0,) * 18


@kernel
def jet(sources, strength, x, wanted):
    """Field at ``x``, in the units of length and flux of ``sources``.

    Parameters
    ----------
    sources, strength
        The table and its state, set by ``drive``.
    x
        Point [sources.length].
    wanted
        Whether the second derivatives are; they are zero otherwise.

    Returns
    -------
    tuple
        B (3), dB_i/dx_j by rows (9), d2B_i/dx_j dx_k, (18): for each i xx, xy, xz, yy, yz, zz. NaN
        outside of a map.
    """
    length, unit = sources.length, 1.0 / sources.flux
    r = (length * x[0], length * x[1], length * x[2])
    h = harmonic(sources, strength, r)
    _, at, _, _, _, _, _ = offsets(sources)
    affine = (
        strength[at] + _row(strength, at + 3, r),
        strength[at + 1] + _row(strength, at + 6, r),
        strength[at + 2] + _row(strength, at + 9, r),
    )
    b = _sum3(affine, (h[0], h[1], h[2]))
    g = _sum9(first(h), _affine_gradient(strength, at))
    d = second(h) if wanted else NO_SECOND
    for m in range(sources.maps.shape[0]):
        s = strength[sources.map_channel[m]]
        bm, gm, dm = on_grid(sources.maps, sources.map_grid, m, r)
        b = _sum3(b, _scale3(s, bm))
        g = _sum9(g, _scale9(s, gm))
        if wanted:
            d = _sum9(d[:9], _scale9(s, dm[:9])) + _sum9(d[9:], _scale9(s, dm[9:]))
    unit1 = unit * length
    unit2 = unit1 * length
    if wanted:
        d = _scale9(unit2, d[:9]) + _scale9(unit2, d[9:])
    return _scale3(unit, b), _scale9(unit1, g), d


@kernel
def covered(sources, x):
    """Whether the point ``x`` is inside of the map, if there is any."""
    length = sources.length
    if sources.maps.shape[0] == 0:
        return True
    r = in_frame(sources.map_grid, (length * x[0], length * x[1], length * x[2]))
    return inside(sources.map_grid, sources.maps.shape, r)


@kernel
def harmonic(sources, strength, r):
    """Sum of the sources whose field has neither divergence nor curl, as in harmonic.py, SI."""
    _, _, at_dipole, at_multipole, at_loop, at_cylinder, _ = offsets(sources)
    h = dipoles(strength, at_dipole, sources.dipoles.shape[1], r[0], r[1], r[2])
    n = sources.multipoles.shape[1]
    for j in range(n):
        away, t = _seen(strength, at_multipole + j, n, r)
        own = strength[at_multipole + j + 6 * n]
        h = plus(h, multipole(away, t, own, sources.outward, sources.inward, j))
    n = sources.loops.shape[1]
    for j in range(at_loop, at_loop + n):
        away, t = _seen(strength, j, n, r)
        h = plus(h, loop(away, t, strength[j + 6 * n], strength[j + 7 * n]))
    n = sources.cylinders.shape[1]
    for j in range(at_cylinder, at_cylinder + n):
        away, t = _seen(strength, j, n, r)
        h = plus(
            h,
            cylinder(away, t, strength[j + 6 * n], strength[j + 7 * n], strength[j + 8 * n]),
        )
    return h


@kernel
def _seen(strength, j, n, r):
    """Position of ``r`` from a source, and the source's axis."""
    away = (r[0] - strength[j], r[1] - strength[j + n], r[2] - strength[j + 2 * n])
    return away, (strength[j + 3 * n], strength[j + 4 * n], strength[j + 5 * n])


@kernel
def _row(strength, at, r):
    return strength[at] * r[0] + strength[at + 1] * r[1] + strength[at + 2] * r[2]


@kernel
def _affine_gradient(strength, at):
    return (
        strength[at + 3],
        strength[at + 4],
        strength[at + 5],
        strength[at + 6],
        strength[at + 7],
        strength[at + 8],
        strength[at + 9],
        strength[at + 10],
        strength[at + 11],
    )


@kernel
def _scale3(s, a):
    return (s * a[0], s * a[1], s * a[2])


@kernel
def _sum3(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@kernel
def _scale9(s, a):
    return _scale3(s, a[:3]) + _scale3(s, a[3:6]) + _scale3(s, a[6:])


@kernel
def _sum9(a, b):
    return _sum3(a[:3], b[:3]) + _sum3(a[3:6], b[3:6]) + _sum3(a[6:], b[6:])

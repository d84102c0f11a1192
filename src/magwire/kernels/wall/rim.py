"""The open ends of a lumen: a tube that flares out, and then no wall (P-8)."""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import kernel
from magwire.kernels.centreline import (
    BEGIN,
    END,
    END_COSINE,
    END_POINT,
    END_RADIUS,
    END_SLOPE,
    END_TANGENT,
    SHORTEST,
)
from magwire.kernels.vectors import combine, dot, norm, scale, sub


@kernel
def mouth(branches, branch, side, x, y, z):
    """Where a point past an end is: see the module's text.

    Returns
    -------
    past
        Arc length past the end's plane, over the end's radius.
    g
        Gap to the flared wall; goes on linearly where the flare ends at past = 1.
    lateral, m
        Distance from the end's axis and its direction.
    """
    at = BEGIN if side < 0 else END
    row = branches[branch]
    t = (row[at + END_TANGENT], row[at + END_TANGENT + 1], row[at + END_TANGENT + 2])
    radius, slope, cosine = row[at + END_RADIUS], row[at + END_SLOPE], row[at + END_COSINE]
    p = (x - row[at + END_POINT], y - row[at + END_POINT + 1], z - row[at + END_POINT + 2])
    axial = dot(p, t)
    p = sub(p, scale(axial, t))
    exact = norm(p)
    lateral = max(exact, SHORTEST * radius)
    past = (axial + slope * lateral / cosine) / radius
    flare = past * past * past if past < 1.0 else 3.0 * past - 2.0
    g = radius + slope * axial - cosine * exact + radius * flare
    return past, g, lateral, scale(1.0 / lateral, p)


@kernel
def safe_distance(branches, branch, side, past, g, lateral):
    """How far a point past an end may move without crossing the wall (a lower bound)."""
    at = BEGIN if side < 0 else END
    radius, slope = branches[branch, at + END_RADIUS], branches[branch, at + END_SLOPE]
    cosine = branches[branch, at + END_COSINE]
    narrowest = radius * min(1.0, 1.0 + slope)
    steepest = sqrt(1.0 + 9.0 / (cosine * cosine))  # Lipschitz constant of the flared gap
    return max(narrowest - lateral, g / steepest, (past - 1.0) * radius * cosine)


@kernel
def mouth_jet(lumen, branch, side, x, y, z):
    """Gradient and Hessian of the gap to the flared wall past an open end."""
    past, _, lateral, m = mouth(lumen.branches, branch, side, x, y, z)
    at = BEGIN if side < 0 else END
    row = lumen.branches[branch]
    t = (row[at + END_TANGENT], row[at + END_TANGENT + 1], row[at + END_TANGENT + 2])
    radius, slope, cosine = row[at + END_RADIUS], row[at + END_SLOPE], row[at + END_COSINE]
    w = combine(1.0, t, slope / cosine, m)
    steep = 3.0 * past * past
    n = combine(slope + steep, t, steep * slope / cosine - cosine, m)
    around = (steep * slope / cosine - cosine) / lateral
    bend = 6.0 * past / radius
    h = (
        around * (1.0 - t[0] * t[0] - m[0] * m[0]) + bend * w[0] * w[0],
        around * (-t[0] * t[1] - m[0] * m[1]) + bend * w[0] * w[1],
        around * (-t[0] * t[2] - m[0] * m[2]) + bend * w[0] * w[2],
        around * (1.0 - t[1] * t[1] - m[1] * m[1]) + bend * w[1] * w[1],
        around * (-t[1] * t[2] - m[1] * m[2]) + bend * w[1] * w[2],
        around * (1.0 - t[2] * t[2] - m[2] * m[2]) + bend * w[2] * w[2],
    )
    return n, h

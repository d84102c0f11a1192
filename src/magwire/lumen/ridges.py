"""Where a branch's balls leave a ridge in its wall, and the radius that leaves none.

The gap of a point is the largest of R(S) - |x - c(S)|. Where the radius rises to both sides, as
in a notch, or on the inside of a bend, two balls may be that, and between them the wall has a
ridge: a sharp edge into the lumen, of no finite curvature, on which a wire that lies on it has no
equilibrium that Newton's method could find.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from magwire.lumen.branch import Branch

Array = NDArray[np.float64]

PASSES = 100
WEIGHT = 0.5  # of the neighbours' mean in a pass
ROOM = 0.9  # of the radius of a bend, to which a branch is widened in it at most


def without_ridges(branch: Branch, begin: float) -> Branch:
    """The branch itself, or one whose radius is smoothed where it leaves ridges.

    Where it is narrow since it bends sharply it stays so, with its ridge.

    Parameters
    ----------
    branch
        A branch.
    begin
        Arc parameter up to which its wall is inside of others [m]. The last radius before its end
        stays as it is, too.
    """
    end = branch.length - float(branch.radius[-1])
    for _ in range(PASSES):
        arcs = ridges(branch)
        arcs = arcs[(arcs > begin) & (arcs < end)]
        if len(arcs) == 0:
            break
        radius = _averaged(branch, arcs)
        radius = np.minimum(radius, np.maximum(branch.radius, ROOM * _bends(branch)))
        if np.array_equal(radius, branch.radius):
            break
        branch = replace(branch, radius=radius)
    return branch


def ridges(branch: Branch) -> Array:
    """Arc parameters of pieces at which the radius leaves ridges, shape (n,) [m].

    At the wall |x - c| = R, and of R - |x - c| as a function of S the second derivative is
    R'' + kappa sqrt(1 - R'^2) cos(angle) - (1 - R'^2)/R, which must be negative all around. With
    R'' = 0 it is: a branch bends with a radius larger than its own.
    """
    s = branch.curve.knots()
    radius, slope, bend = (branch.curve.at(s, k)[:, 3] for k in range(3))
    first, second = (branch.curve.at(s, k)[:, :3] for k in (1, 2))
    curvature = np.linalg.norm(np.cross(first, second), axis=1)
    square = np.maximum(1.0 - slope**2, 0.0)
    sharp = bend + curvature * np.sqrt(square) > square / radius
    there: Array = s[sharp & (bend > 0.0)]
    return there


def _places(branch: Branch) -> Array:
    """Arc parameters of the points of a branch, or nearly, shape (n,) [m]."""
    steps = np.linalg.norm(np.diff(branch.points, axis=0), axis=1)
    places = np.concatenate([[0.0], np.cumsum(steps)])
    return np.asarray(places * (branch.length / places[-1]))


def _bends(branch: Branch) -> Array:
    """The smallest radius of the bends next to each point, shape (n,) [m]."""
    curvature, s = branch.curve.sharpest_bends()
    places = _places(branch)
    after = np.clip(np.searchsorted(places, s), 1, len(places) - 1)
    sharpest = np.full(len(places), 1e-300)
    for off in (-2, -1, 0, 1):
        np.maximum.at(sharpest, np.clip(after + off, 0, len(places) - 1), curvature)
    return np.asarray(1.0 / sharpest)


def _averaged(branch: Branch, arcs: Array) -> Array:
    """The radius with points around some places drawn towards the line between their neighbours."""
    places = _places(branch)
    after = np.searchsorted(places, arcs)
    near = np.zeros(len(places), dtype=np.bool_)
    for off in (-2, -1, 0, 1):
        near[np.clip(after + off, 0, len(places) - 1)] = True
    near[[0, -1]] = False
    inner = np.flatnonzero(near)
    radius = branch.radius.copy()
    low, high = places[inner] - places[inner - 1], places[inner + 1] - places[inner]
    line = (radius[inner - 1] * high + radius[inner + 1] * low) / (low + high)
    radius[inner] += WEIGHT * (line - radius[inner])
    return radius

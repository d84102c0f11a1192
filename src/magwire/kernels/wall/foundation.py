"""A wall that gives way: an elastic foundation in series with the barrier (P-39).

A point of the wire presses the wall in by w and keeps the clearance y = d + w from it, with the
clearance d from where the wall is at rest, which may be negative. Both carry the same force: given
d, that fixes y, and the point has the least energy that barrier and foundation can have together.
"""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import kernel
from magwire.kernels.wall.barrier import barrier

ITERATIONS = 60  # a safeguard: Newton's method takes about five
ROUND_OFF = 1e-15  # of a clearance


@kernel
def start_below(d, gap, ratio):
    """A clearance that is not above the one looked for, nor far below.

    The barrier's force is at least (gap - y)^2/y: with that in its place the equation is quadratic.
    """
    half = 2.0 * ratio * gap - d
    root = sqrt(d * d + 4.0 * ratio * gap * (gap - d))
    if half >= 0.0:
        return 2.0 * ratio * gap * gap / (half + root)
    return (root - half) / (2.0 * (1.0 - ratio))


@kernel
def on_foundation(d, gap, ratio):
    """Barrier and foundation in series at a clearance d < gap from the wall at rest.

    Newton's method for y - ratio f(y) = d, with the barrier's force f per stiffness. The left-hand
    side rises and is concave, so that it comes up to the root from below.

    Parameters
    ----------
    d, gap
        Clearance from the wall at rest, and the barrier's activation gap.
    ratio
        Stiffness of the barrier over that of the foundation.

    Returns
    -------
    y
        Clearance from the wall as it is; the wall is pressed in by y - d.
    value, first, second
        Energy and its derivatives by d, over the barrier's stiffness, as of ``barrier``.
    """
    y = start_below(d, gap, ratio)
    value, first, second = barrier(y, gap)
    for _ in range(ITERATIONS):
        step = (d - y - ratio * first) / (1.0 + ratio * second)
        if not step > ROUND_OFF * y:
            break
        y = min(y + step, (1.0 - ROUND_OFF) * gap)
        value, first, second = barrier(y, gap)
    return y, value + 0.5 * ratio * first * first, first, second / (1.0 + ratio * second)


# A rigid wall is one whose ratio is zero. It could be told by its type, as friction is; but then
# all that a step takes would be compiled twice.

RIGID = 0.0, 0.0


@kernel
def at_node(bed, i):
    """How the wall gives way at a node: the ratio of stiffnesses, and how far it may."""
    return bed.ratio[i], bed.deepest


@kernel
def at_edge(bed, j):
    """How the wall gives way at the points of an edge; see ``at_node``."""
    return 0.5 * (bed.ratio[j] + bed.ratio[j + 1]), bed.deepest


@kernel
def response(give, d, gap):
    """Clearance from the wall as it is, value, first and second derivative; see above."""
    if give[0] == 0.0:
        value, first, second = barrier(d, gap)
        return d, value, first, second
    return on_foundation(d, gap, give[0])


@kernel
def pressed_in(give, d, gap):
    """How far the wall is pressed in at a clearance d from where it is at rest."""
    if give[0] == 0.0 or not d < gap:
        return 0.0
    return -give[0] * on_foundation(d, gap, give[0])[2]

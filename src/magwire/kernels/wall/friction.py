"""Coulomb friction with elastic stick at one contact, by return mapping (P-29 to P-31).

n is the unit vector from the wall to the wire, the gradient of the gap. The elastic slip is a
vector in space, tangential to the wall: how far the wire's surface is from its anchor. Given the
normal force, what a step adds is a potential of the step's displacement: quadratic inside the cone,
linear outside, with a continuous gradient and a symmetric Hessian without negative eigenvalues.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.blocks import sym_add, sym_identity, sym_outer
from magwire.kernels.vectors import add, combine, cross, dot, norm, scale, sub

# Conditioning guard, not a material parameter: what slid last is on its cone, but for round-off,
# and slides on in the tangent. The energy is continuous there to the square of the difference.
ON_CONE = 1.0 - 1e-9


@kernel
def along_wall(n, v):
    """The part of v that is tangential to the wall."""
    return combine(1.0, v, -dot(n, v), n)


@kernel
def by_turning(n, t, radius):
    """Displacement of the wire's surface by a turn about its axis t, per angle (P-29)."""
    return along_wall(n, cross(t, scale(-radius, n)))


@kernel
def transported(slip, old, new):
    """An elastic slip, carried from where the wall's normal was ``old`` to where it is ``new``.

    It is turned as the normal is, by the smallest rotation; normals that are opposite, as on two
    sides of a lumen, have no such rotation: it is another contact then, and the slip is lost.
    """
    share = 1.0 + dot(old, new)
    if share < 1e-6:  # conditioning guard, not a material parameter
        return (0.0, 0.0, 0.0)
    return along_wall(new, combine(1.0, slip, -dot(new, slip) / share, add(old, new)))


@kernel
def under_load(slip, before, now):
    """The elastic slip when the stick stiffness goes from ``before`` to ``now``.

    The stiffness follows the normal force. While that grows the traction stays, while it shrinks
    the slip does: either way what is stored does not grow without work.
    """
    return scale(before / now, slip) if now > before else slip


@kernel
def potential(reach, n, cone, stiffness):
    """What a step of given end adds (P-30).

    Parameters
    ----------
    reach
        Elastic slip at the step's beginning and the surface's tangential displacement since.
    n
        Normal of the wall.
    cone
        Coefficient of friction times normal force.
    stiffness
        Of the stick, positive.

    Returns
    -------
    energy, gradient, hessian
        By the surface's displacement; the traction on the wire is minus the gradient.
    """
    far = norm(reach)
    if stiffness * far < ON_CONE * cone:
        plane = sym_add(sym_identity(stiffness), sym_outer(-stiffness, n))
        return 0.5 * stiffness * far * far, scale(stiffness, reach), plane
    rigid = cone / far
    plane = sym_add(sym_identity(rigid), sym_outer(-rigid, n))
    across = sym_add(plane, sym_outer(-rigid / (far * far), reach))
    return cone * (far - 0.5 * cone / stiffness), scale(rigid, reach), across


@kernel
def returned(reach, cone, stiffness):
    """Elastic slip at the step's end: ``reach``, or its return to the cone."""
    far = norm(reach)
    if stiffness * far <= cone:
        return reach
    return scale(cone / (stiffness * far), reach)


@kernel
def lost(reach, cone, stiffness):
    """What friction takes in a step: the traction times the slip that is not elastic."""
    kept = returned(reach, cone, stiffness)
    return stiffness * dot(kept, sub(reach, kept))


@kernel
def spread(gradient, hessian, turning):
    """The same by the wire's position and its angle about the axis; turning: ``by_turning``.

    Returns
    -------
    moment
        Derivative by the angle; that by the position is the gradient.
    mixed, twice
        Second derivatives by position and angle and by the angle twice; those by the position are
        the Hessian.
    """
    a = hessian
    mixed = (
        a[0] * turning[0] + a[1] * turning[1] + a[2] * turning[2],
        a[1] * turning[0] + a[3] * turning[1] + a[4] * turning[2],
        a[2] * turning[0] + a[4] * turning[1] + a[5] * turning[2],
    )
    return dot(gradient, turning), mixed, dot(turning, mixed)

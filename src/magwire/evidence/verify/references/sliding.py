"""Wires and sliders under Coulomb friction: what is known of them without a simulation."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]


def slider(course: Array, stiffness: float, cone: float) -> tuple[Array, float]:
    """Force of a spring behind a slider, and what the slider takes, over a course on a line.

    The force follows the play operator: it is the stiffness times the distance between the course
    and a slider that is dragged along when it is farther behind than cone / stiffness.

    Parameters
    ----------
    course
        Positions of the spring's end [m], from an unloaded spring.
    stiffness
        Stiffness of the spring [N/m].
    cone
        Force at which the slider moves [N].
    """
    slack = cone / stiffness
    place, taken = float(course[0]), 0.0
    forces = [0.0]
    for x in course[1:]:
        moved = min(max(place, x - slack), x + slack)
        taken += cone * abs(moved - place)
        place = moved
        forces.append(stiffness * (x - place))
    return np.array(forces), taken


def capstan(pull: float, angle: float, friction: float, radius: float, stiffness: float) -> float:
    """Pull at which a thin elastic rod over a drum begins to slide, for a pull at its other end.

    Long free ends carry the pulls in directions that make the given angle with each other. Along
    the drum the tension grows as in the classical problem. A free end is an elastica: it leaves the
    drum with the drum's curvature, where its direction is still ``acos(1 - EI/(2 F R^2))`` away
    from its pull, and presses there on the drum with a force of its own (H. Singh, Planar
    equilibria of an elastic rod wrapped around a circular capstan, J. Elasticity 151, 321, 2022;
    arXiv 2205.04348).

    Parameters
    ----------
    pull
        At the end that holds [N].
    angle
        Between the directions of the ends [rad].
    friction
        Coefficient of friction.
    radius
        Radius of the drum, to the rod's axis [m].
    stiffness
        EI [N m^2].

    Raises
    ------
    ValueError
        If the rod does not lie on the drum along an arc.
    """

    def lift(force: float) -> float:
        return math.acos(1.0 - stiffness / (2.0 * force * radius**2))

    if stiffness > 4.0 * pull * radius**2 or 2.0 * lift(pull) > angle:
        raise ValueError("the rod touches the drum at points only")
    first = lift(pull)
    begin = pull * (math.cos(first) + friction * math.sin(first))

    def missing(force: float) -> float:
        last = lift(force)
        end = force * (math.cos(last) - friction * math.sin(last))
        return end - begin * math.exp(friction * (angle - first - last))

    high = 2.0 * pull
    while missing(high) < 0.0:
        high *= 2.0
    return float(brentq(missing, pull, high, xtol=1e-13 * high))


def arc_growth(friction: float, thickness: float) -> float:
    """Growth of the logarithm of the tension, per angle, of a thick rod that slides on an arc.

    Friction acts on the rod's surface: it turns the rod, which therefore carries a shear force. By
    the angle, T' = Q + mu p, Q' = p - T and Q = -mu c p for the tension T, the shear force Q and
    the force p of the drum per angle; the steady solution has Q in proportion to T.

    Parameters
    ----------
    friction
        Coefficient of friction mu.
    thickness
        Distance c of the surface from the axis, towards the centre of the arc, in radii of the
        axis' arc; negative for a rod on the outer side of a bend.
    """
    if thickness == 0.0:
        return friction

    def steady(ratio: float) -> float:
        return ratio**2 * (1.0 - 1.0 / thickness) + ratio / (friction * thickness) + 1.0

    width = 2.0 * friction * abs(thickness)
    return float(brentq(steady, -width, width, xtol=1e-16)) * (1.0 - 1.0 / thickness)


def locked_up(force: float, distance: float, friction: float, clearance: float, ei: float) -> float:
    """Axial force at a distance behind a push on a helically buckled rod that slides in a tube.

    The helix presses with r F^2/(4 EI) per length (A. Lubinski, W. S. Althouse, J. L. Logan,
    Helical buckling of tubing sealed in packers, J. Petroleum Technology 14, 655, 1962), so
    dF/dx = -mu r F^2/(4 EI).

    Parameters
    ----------
    force
        Push at distance 0 [N].
    distance
        Along the tube [m].
    friction
        Coefficient of friction.
    clearance
        Distance r between the axes of tube and rod [m].
    ei
        Bending stiffness [N m^2].
    """
    return force / (1.0 + distance * friction * clearance * force / (4.0 * ei))


def torque_arrived(
    torque: float, turned: float, friction: float, radius: float, force: float
) -> float:
    """Torque that is left after a bend, of a rod that is turned in it under an axial force.

    The rod is pressed on the wall with F kappa per length and climbs it by atan(mu), until what
    presses and the friction balance: the normal force is F kappa/sqrt(1 + mu^2), its torque mu r
    times that.

    Parameters
    ----------
    torque
        At the beginning of the bend [N m].
    turned
        Angle of the bend, the integral of kappa ds [rad].
    friction
        Coefficient of friction.
    radius
        Radius of the rod [m].
    force
        Size of the axial force, the same all along [N].
    """
    return torque - friction * radius * force * turned / math.sqrt(1.0 + friction**2)

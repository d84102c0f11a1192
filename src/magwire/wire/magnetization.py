"""Magnetisation in words: along the axis, or across it (P-6)."""

from __future__ import annotations

import math

from magwire.errors import finite

Vector3 = tuple[float, float, float]


def axial(magnetization: float) -> Vector3:
    """A magnetisation along the wire, towards its tip.

    Parameters
    ----------
    magnetization
        Remanent magnetisation [A/m]; negative towards the proximal end. Of a ``remanence`` of
        ``Make``, flux density [T].

    Returns
    -------
    tuple
        Components in the material frame (m1, m2, tangent), shape (3,).

    Examples
    --------
    >>> import magwire as mw
    >>> mw.axial(128e3)
    (0.0, 0.0, 128000.0)
    """
    return (0.0, 0.0, finite("axial", "magnetization", magnetization, "A/m"))


def across(magnetization: float, angle: float = 0.0) -> Vector3:
    """A magnetisation at right angles to the wire: a tip that is magnetised diametrically.

    Parameters
    ----------
    magnetization
        Remanent magnetisation [A/m]. Of a ``remanence`` of ``Make``, flux density [T].
    angle
        From the material direction m1 towards m2 [rad], from which a rest curvature is measured,
        too. In an untwisted guide m1 is at right angles to the entrance's direction and to the
        coordinate axis that it is least along: for a lumen that is entered along x, m1 is z and m2
        is -y.

    Returns
    -------
    tuple
        Components in the material frame (m1, m2, tangent), shape (3,).

    Examples
    --------
    >>> import magwire as mw
    >>> mw.across(128e3)
    (128000.0, 0.0, 0.0)
    """
    size = finite("across", "magnetization", magnetization, "A/m")
    turn = finite("across", "angle", angle, "rad")
    return (size * math.cos(turn), size * math.sin(turn), 0.0)

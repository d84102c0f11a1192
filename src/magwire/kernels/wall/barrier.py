"""The wall's barrier per unit length and its derivatives by the clearance d (P-11)."""

from __future__ import annotations

from math import log

from magwire.kernels._jit import kernel


@kernel
def barrier(d, gap):
    """Value, first and second derivative of -(d - gap)^2 log(d / gap), for 0 < d < gap."""
    away = d - gap
    ratio = log(d / gap)
    value = -away * away * ratio
    first = -2.0 * away * ratio - away * away / d
    second = -2.0 * ratio - 4.0 * away / d + (away / d) ** 2
    return value, first, second

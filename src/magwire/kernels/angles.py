"""Sines, cosines and small angles, of four numbers at once or of one (P-2).

Series of Taylor's, of arguments so small that what is left out is below round-off.
"""

from __future__ import annotations

from math import floor, pi

from magwire.kernels._jit import kernel
from magwire.kernels.lanes import where

# pi/2 in three parts, the first two with few enough digits that whole multiples of them are exact
QUARTER = 1.5707963267341256
QUARTER_NEXT = 6.077100506303966e-11
QUARTER_LAST = 2.0222662487959506e-21
FARTHEST = 1e5  # angle from which on the parts above are no longer enough [rad]


@kernel
def sine_series(x, y):
    """Sine of x, with y = x^2, |x| <= pi/4."""
    s = 1.0 - y * (1.0 / 272.0)
    s = 1.0 - y * (1.0 / 210.0) * s
    s = 1.0 - y * (1.0 / 156.0) * s
    s = 1.0 - y * (1.0 / 110.0) * s
    s = 1.0 - y * (1.0 / 72.0) * s
    s = 1.0 - y * (1.0 / 42.0) * s
    s = 1.0 - y * (1.0 / 20.0) * s
    return x - x * y * (1.0 / 6.0) * s


@kernel
def cosine_series(y):
    """Cosine of x, with y = x^2, |x| <= pi/4."""
    c = 1.0 - y * (1.0 / 240.0)
    c = 1.0 - y * (1.0 / 182.0) * c
    c = 1.0 - y * (1.0 / 132.0) * c
    c = 1.0 - y * (1.0 / 90.0) * c
    c = 1.0 - y * (1.0 / 56.0) * c
    c = 1.0 - y * (1.0 / 30.0) * c
    c = 1.0 - y * (1.0 / 12.0) * c
    return 1.0 - 0.5 * y * c


@kernel
def sine_cosine(x):
    """Sine and cosine of four angles that are all smaller than ``FARTHEST``."""
    n = floor(x * (2.0 / pi) + 0.5)
    r = ((x - n * QUARTER) - n * QUARTER_NEXT) - n * QUARTER_LAST
    y = r * r
    s, c = sine_series(r, y), cosine_series(y)
    turn = n - 4.0 * floor(n * 0.25)  # 0, 1, 2, 3
    odd = turn - 2.0 * floor(turn * 0.5) - 0.5
    sine, cosine = where(odd, c, s), where(odd, s, c)
    sine = where(turn - 1.5, -sine, sine)
    flip = (turn - 0.5) * (2.5 - turn)
    return sine, where(flip, -cosine, cosine)


@kernel
def arctan_series(x):
    """Arctangent of |x| <= 0.2."""
    y = x * x
    s = 1.0 / 23.0 - y * (1.0 / 25.0)
    s = 1.0 / 21.0 - y * s
    s = 1.0 / 19.0 - y * s
    s = 1.0 / 17.0 - y * s
    s = 1.0 / 15.0 - y * s
    s = 1.0 / 13.0 - y * s
    s = 1.0 / 11.0 - y * s
    s = 1.0 / 9.0 - y * s
    s = 1.0 / 7.0 - y * s
    s = 1.0 / 5.0 - y * s
    s = 1.0 / 3.0 - y * s
    return x - x * y * s

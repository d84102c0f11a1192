"""Centrelines given by a formula: points and unit tangents at both ends.

All start at the origin, as the paper's do; all but the helix start along x.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Shape = tuple[Array, Array, Array]


def straight(length: float) -> Shape:
    """Straight line along x."""
    along = np.array([1.0, 0.0, 0.0])
    return np.array([[0.0, 0.0, 0.0], [length, 0.0, 0.0]]), along, along


def half_circle(centreline_radius: float, points: int) -> Shape:
    """Half a circle in the xy plane that turns towards +y.

    x = r cos(w - pi/2), y = r sin(w - pi/2) + r for w in [0, pi].
    """
    w = np.linspace(0.0, np.pi, points)
    x, y = centreline_radius * np.sin(w), centreline_radius * (1.0 - np.cos(w))
    return (
        np.column_stack([x, y, np.zeros(points)]),
        np.array([1.0, 0.0, 0.0]),
        np.array([-1.0, 0.0, 0.0]),
    )


def sinusoid(amplitude: float, period: float, extent: float, points: int) -> Shape:
    """Cosine in the xy plane: y = amplitude (cos(2 pi x / period) - 1) for x in [0, extent]."""
    x = np.linspace(0.0, extent, points)
    wave = 2.0 * np.pi / period
    y = amplitude * (np.cos(wave * x) - 1.0)
    slope = -amplitude * wave * np.sin(wave * extent)
    return (
        np.column_stack([x, y, np.zeros(points)]),
        np.array([1.0, 0.0, 0.0]),
        np.array([1.0, slope, 0.0]) / np.hypot(1.0, slope),
    )


def helix(helix_radius: float, pitch: float, length: float, points: int) -> Shape:
    """Helix around an axis parallel to z, of given arc length.

    x = r cos(w - pi/2), y = r sin(w - pi/2) + r, z = pitch w / (2 pi).
    """
    rise = pitch / (2.0 * np.pi)
    per_radian = np.hypot(helix_radius, rise)
    w = np.linspace(0.0, length / per_radian, points)
    x, y = helix_radius * np.sin(w), helix_radius * (1.0 - np.cos(w))
    tangents = np.column_stack(
        [helix_radius * np.cos(w), helix_radius * np.sin(w), np.full(points, rise)]
    )
    tangents /= per_radian
    return np.column_stack([x, y, rise * w]), tangents[0], tangents[-1]


def bends(table: Array, points: int) -> Shape:
    """Curve of given curvatures k1, k2, linear in arc length between the rows (s, k1, k2).

    c' = t, t' = k1 m1 + k2 m2, m1' = -k1 t, m2' = -k2 t from c = 0, t = x, m1 = y, m2 = z: the
    frame goes along without twist.
    """
    from scipy.integrate import solve_ivp

    def slope(s: float, state: Array) -> Array:
        t, m1, m2 = state[3:].reshape(3, 3)
        k1, k2 = np.interp(s, table[:, 0], table[:, 1]), np.interp(s, table[:, 0], table[:, 2])
        return np.concatenate([t, k1 * m1 + k2 * m2, -k1 * t, -k2 * t])

    length = float(table[-1, 0])
    s = np.linspace(0.0, length, points)
    state = np.concatenate([np.zeros(3), np.eye(3).ravel()])
    begin = state[3:6]
    places = [np.zeros((0, 3))]
    for low, high in zip(table[:-1, 0], table[1:, 0], strict=True):  # smooth between the rows
        stops = np.append(s[(s >= low) & (s < high)], high)
        scale = np.concatenate([np.full(3, length), np.ones(9)])
        course = solve_ivp(
            slope, (low, high), state, "DOP853", t_eval=stops, rtol=1e-11, atol=1e-12 * scale
        ).y.T
        places.append(course[:-1, :3])
        state = course[-1]
    return np.concatenate([*places, state[None, :3]]), begin, state[3:6]

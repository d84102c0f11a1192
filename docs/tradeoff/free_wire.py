"""Least field of a stable free wire in the paper's helix that just touches the wall (P-22).

The wire is an inextensible elastica that is clamped in the entrance's tangent. Its last 5 percent
are magnetised; the field is antiparallel to that tangent, which is the limit of stability against
swinging about it. Lengths in L, moments in EI/L, fields in EI/(M L^2). Prints for several offsets
of the tip what field it takes that the wire's body comes to where the wall begins to press.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.spatial import cKDTree

Array = NDArray[np.float64]

RADIUS, PITCH, LUMEN = 0.1, 0.1, 0.03
MAGNET = 0.05
TOUCH = 1.0 - 0.001 / LUMEN  # offset of the body, in the lumen's radius: the wall acts from 0.1 mm
OFFSETS = (0.8, 0.7, 0.6)
STEPS = 24  # of the magnet


def helix() -> Array:
    """Points of the centreline's first 0.45 L, shape (n, 3)."""
    rise = PITCH / (2.0 * np.pi)
    turn = np.linspace(0.0, 0.45, 20_001) / np.hypot(RADIUS, rise)
    return np.stack([RADIUS * np.sin(turn), RADIUS * (1.0 - np.cos(turn)), rise * turn], axis=1)


def bent(tip: float, field: float) -> tuple[Array, Array]:
    """Wire whose tip has turned by an angle: coordinates along and across the entrance's tangent.

    Along the magnet angle'' = -field sin(angle), integrated back from the tip, where no moment
    acts; the rest is the arc of a circle.
    """
    step, state = MAGNET / STEPS, np.array([tip, 0.0])

    def back(s: Array) -> Array:
        return np.array([-s[1], field * np.sin(s[0])])

    angles = [tip]
    for _ in range(STEPS):
        first = back(state)
        second = back(state + 0.5 * step * first)
        third = back(state + 0.5 * step * second)
        last = back(state + step * third)
        state = state + step / 6.0 * (first + 2.0 * second + 2.0 * third + last)
        angles.append(float(state[0]))
    root, curvature = state
    arc = np.linspace(0.0, root, 80)
    ends = np.array(angles[::-1])
    along, across = np.sin(arc) / curvature, (1.0 - np.cos(arc)) / curvature
    along = np.append(along, along[-1] + _integral(np.cos(ends), step))
    across = np.append(across, across[-1] + _integral(np.sin(ends), step))
    return along, across


def _integral(values: Array, step: float) -> Array:
    """Running integral by the trapezoidal rule, without its first value."""
    return np.cumsum(0.5 * step * (values[1:] + values[:-1]))


def main() -> None:
    """Print the table."""
    points = helix()
    tree = cKDTree(points)
    tangent = points[1] / np.linalg.norm(points[1])
    side = np.cross([0.0, 0.0, 1.0], tangent)
    side /= np.linalg.norm(side)
    up = np.cross(tangent, side)

    def offsets(unknowns: Array) -> Array:
        along, across = bent(unknowns[0], 100.0 * unknowns[1])
        plane = np.cos(unknowns[2]) * side + np.sin(unknowns[2]) * up
        found: Array = tree.query(along[:, None] * tangent + across[:, None] * plane)[0] / LUMEN
        return found

    start = np.array([2.5, 3.0, 0.32])  # angle of the tip, field / 100, angle of the wire's plane
    for part in OFFSETS:
        found = minimize(
            lambda unknowns: unknowns[1],
            start,
            constraints=(
                {"type": "ineq", "fun": lambda u, part=part: part - offsets(u)[-1]},
                {"type": "eq", "fun": lambda u: offsets(u).max() - TOUCH},
            ),
            bounds=((2.2, 3.1), (2.0, 30.0), (0.0, 0.7)),
            method="SLSQP",
            options={"eps": 1e-4, "ftol": 1e-4, "maxiter": 60},
        )
        start = found.x + np.array([0.08, 0.3, 0.0])
        reached = offsets(found.x)
        print(  # noqa: T201
            f"tip within {part} R (at {reached[-1]:.3f}, body at {reached.max():.3f}): |B*| = "
            f"{100.0 * found.x[1]:.0f}, tip turned by {np.degrees(found.x[0]):.0f} degrees"
        )


if __name__ == "__main__":
    main()

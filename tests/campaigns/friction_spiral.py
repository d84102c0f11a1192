"""A helix of two and a half turns, guided and not: `python -m campaigns.friction_spiral`.

In kind what Bruns, Riojas, Warren, Abbott and Webster did with a magnet-tipped array in a spiral
phantom: does ln(push) rise with the angle gone round at the coefficient of friction, and what does
steering take off.
"""

from __future__ import annotations

import sys

import numpy as np
from numpy.typing import NDArray

import magwire as mw
from magwire.evidence.verify.references.sliding import arc_growth

Array = NDArray[np.float64]

RADIUS, PITCH, TUBE, THICK = 10e-3, 8e-3, 2e-3, 0.3e-3
TURNS = 2.5
FED = TURNS * float(np.hypot(2.0 * np.pi * RADIUS, PITCH))
COEFFICIENTS = (0.3, 0.2, 0.1)
WINDOW = 1.5
"""Of the angle, over which a slope is taken [rad]."""
SIZES = (100.0, 400.0, 1600.0)
"""Of the push, over EI tau^2, at which it is given."""
GUIDES = ((0.0, 0.0), (4e-3, 20.0), (4e-3, 60.0), (8e-3, 40.0))
"""Flux densities that guide [T], and by how much they turn ahead of the way at the tip [deg]."""


def setup(friction: float) -> mw.Simulation:
    """The paper's material, thinner, with a magnet at its tip."""
    wire = mw.Wire.uniform(
        FED + 4e-3, THICK, 3e6, 1e6, 2000.0, 120, magnetized_tip=6e-3, magnetization=128e3
    )
    lumen = mw.Lumen.helix(RADIUS, PITCH, FED + 12e-3, TUBE)
    rubs = mw.Friction(friction) if friction > 0.0 else None
    return mw.Simulation(wire, lumen, contact=mw.Barrier(1e6, 5e-5), friction=rubs)


def gone_round(run: mw.Result) -> Array:
    """The integral of the curvature along the wire at each record [rad]."""
    edges = np.diff(run.position, axis=1)
    edges /= np.linalg.norm(edges, axis=2)[:, :, None]
    turns = np.clip((edges[:, 1:] * edges[:, :-1]).sum(axis=2), -1.0, 1.0)
    return np.asarray(np.arccos(turns).sum(axis=1))


def row(friction: float, run: mw.Result, strength: float, ahead: float) -> str:
    """A line of the table: slopes of ln(push) over the angle, and forces in EI/L^2.

    Over the last turn, as expected, and where the push has certain sizes; ``--`` where it has not.
    """
    angle, force, tip = gone_round(run), run.push_force, run.tip_force
    torsion = (PITCH / (2.0 * np.pi)) / (RADIUS**2 + (PITCH / (2.0 * np.pi)) ** 2)
    small = 3e6 * 0.25 * np.pi * THICK**4 * torsion**2  # EI tau^2
    expected = arc_growth(friction, -THICK / (RADIUS + TUBE - THICK)) if friction > 0.0 else 0.0
    unit = run.force_scale
    sizes, slopes = [], []
    for first in np.arange(3.0, angle[-1] - WINDOW, 0.5 * WINDOW):
        here = (angle > first) & (angle < first + WINDOW)
        if force[here].min() > 0.0:
            sizes.append(float(np.exp(np.log(force[here]).mean())) / small)
            slopes.append(slope(angle[here], force[here]))
    at = [
        f"{np.interp(size, sizes, slopes):.3f}" if min(sizes) < size < max(sizes) else "--"
        for size in SIZES
    ]
    late = angle > angle[-1] - 2.0 * np.pi
    return (
        f"| {friction:g} | {1e3 * strength:g} | {ahead:g} | "
        f"{slope(angle[late], force[late]):.3f} | {expected:.3f} | {' | '.join(at)} | "
        f"{run.max_push_force / unit:.0f} | {run.max_insertion_force / unit:.0f} | "
        f"{run.max_tip_force / unit:.0f} | "
        f"{run.tip_force.mean() / unit:.0f} | {force[-1] / tip[-1]:.3g} |"
    )


def slope(angle: Array, force: Array) -> float:
    """Of the logarithm of a force over the angle."""
    return float(np.polyfit(angle, np.log(force), 1)[0])


def push(sim: mw.Simulation, strength: float, ahead: float) -> mw.Result:
    """The wire pushed in, in a field [T] that turns ahead [deg] of the tip towards the inside.

    Of where the tip is, not of where a wire along the centreline would have it: on the outside of
    the bend the way is a sixth longer, so that the tip falls behind by half a turn in all.
    """
    speed, part, dt = 8e-3, 0.5e-3, 0.02
    along, inside = np.cos(np.radians(ahead)), np.sin(np.radians(ahead))
    with sim.session(time_step=dt, record_every=1e-3 / speed) as session:
        for _ in range(round(FED / part)):
            tangent, inward = frame(sim, session.observe().tip)
            field = strength * (along * tangent + inside * inward)
            session.step(feed_speed=speed, duration=part / speed, inputs=field)
    return session.result


def frame(sim: mw.Simulation, tip: Array) -> tuple[Array, Array]:
    """Tangent of the centreline next to the tip, and the direction to the helix' axis."""
    curve, step = sim.system.lumen.branches[0].curve, 0.2e-3
    places = np.arange(step, FED + 10e-3, step)
    points = curve.at(places)[:, :3]
    k = int(np.argmin(np.linalg.norm(points - tip, axis=1)).clip(1, len(places) - 2))
    tangent = points[k + 1] - points[k - 1]
    bend = points[k + 1] - 2.0 * points[k] + points[k - 1]
    return tangent / np.linalg.norm(tangent), bend / np.linalg.norm(bend)


def main(coefficients: tuple[float, ...] = COEFFICIENTS) -> None:
    """Print the table, line by line."""
    for friction in coefficients:
        for guide in GUIDES:
            print(row(friction, push(setup(friction), *guide), *guide), flush=True)


if __name__ == "__main__":
    main(tuple(float(one) for one in sys.argv[1:]) or COEFFICIENTS)

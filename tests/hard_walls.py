"""magwire's wires pushed through passages of which the forces of hard walls are known."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

import magwire as mw
from magwire.evidence.verify.references import pushed
from magwire.results import Result
from tables import hard_wall
from wires import paper_wire

Array = NDArray[np.float64]
L = 0.1
WITHIN = 0.03
"""Of the largest force on the tip."""


def lumen(case: str, wire_radius: float) -> mw.Lumen:
    """It leaves the wire's axis what the reference's axis has; wide enough for its surface."""
    passage = pushed.CASES[case]
    radius = passage.radius * L + wire_radius
    if case == "sinusoid":
        return mw.Lumen.sinusoid(0.15 * L, 0.8 * L, 0.8 * L, radius)
    if case == "helix":
        return mw.Lumen.helix(0.1 * L, 0.1 * L, 0.9 * L, radius)
    w = np.linspace(0.0, passage.end, 400)
    return mw.Lumen.through(L * passage.curve(w)[0], radius + L * passage.taper * w)


@lru_cache
def run(case: str, wall: mw.Barrier | None, nodes: int = 100) -> Result:
    """The paper's wire, recorded every 0.01 L."""
    wire = paper_wire(nodes)
    simulation = mw.Simulation(wire, lumen(case, wire.radius), contact=wall)
    reach = hard_wall(case)["X"][-1]
    return simulation.run(mw.Feed(1e-3, reach * L), time_step=0.01, record_every=0.01 * L)


def departures(case: str, result: Result) -> dict[str, Array]:
    """Pushes X at which a force is not that of a hard wall, for ``tip``, ``distal``, ``wire``.

    A point of contact that slides along the wire comes out of the distal 5 mm at once; nodes 1 mm
    apart know where it is to 1 mm. The sum over 5 mm may therefore be any between those over 4 and
    6 mm, and the tip is not compared within 1 mm of feed of where it leaves the wall.
    """
    forces = np.linalg.norm(result.dataset["contact_force"].values, axis=2)
    forces /= float(result.dataset.attrs["force_scale"])
    X, step = result.feed / L, 1.0 / (forces.shape[1] - 1)
    reference = hard_wall(case)
    hard = {name: np.interp(X, reference["X"], reference[name]) for name in reference}
    allowed = WITHIN * reference["tip"].max()
    tip = np.abs(forces[:, -1] - hard["tip"]) > allowed
    leaves = np.flatnonzero((hard["tip"][1:] < 0.01) & (hard["tip"][:-1] > 0.01))
    tip[np.append(leaves, leaves + 1)] = False
    distal = np.array([pushed.distal(sizes, step, 0.05) for sizes in forces])
    out = (distal < hard["distal_4mm"] - allowed) | (distal > hard["distal_6mm"] + allowed)
    wire = np.abs(forces.sum(axis=1) - hard["wire"]) > allowed
    return {"tip": X[tip], "distal": X[out], "wire": X[wire]}

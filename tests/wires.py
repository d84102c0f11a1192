"""Wires, lumens and runs that several folders of tests share."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.engine.record import Totals
from magwire.engine.system import System
from magwire.evidence.verify.wires import L, flux, free, magnet  # noqa: F401 - tests have them from here
from magwire.field import UniformField
from magwire.lumen import Lumen
from magwire.operate import March
from magwire.simulation import Simulation
from magwire.wire import Wire

Array = NDArray[np.float64]


def paper_wire(nodes: int = 100) -> Wire:
    """The paper's wire: 100 mm, of which the distal 5 mm are magnetised."""
    return Wire.uniform(
        L, 0.6e-3, 3e6, 1e6, 2000.0, nodes, magnetized_tip=5e-3, magnetization=128e3
    )


LUMENS = {
    "half-circle": lambda: Lumen.half_circle(0.25 * L, 0.03 * L),
    "half-circle-narrow": lambda: Lumen.half_circle(0.25 * L, 0.02 * L),
    "half-circle-wide": lambda: Lumen.half_circle(0.25 * L, 0.04 * L),
    "sinusoid": lambda: Lumen.sinusoid(0.15 * L, 0.8 * L, 0.8 * L, 0.03 * L),
    "helix": lambda: Lumen.helix(0.1 * L, 0.1 * L, 0.9 * L, 0.03 * L),
    "authors-half-circle": lambda: Lumen.half_circle(0.2 * L, 0.01 * L).with_entry(0.15 * L),
    "authors-narrow-bend": lambda: Lumen.half_circle(0.1 * L, 0.01 * L).with_entry(0.15 * L),
    "authors-sinusoid": lambda: Lumen.sinusoid(
        0.1 * L, 0.2 * np.pi * L, 0.8 * L, 0.01 * L
    ).with_entry(0.15 * L),
}
PAPER = ("half-circle", "half-circle-narrow", "half-circle-wide", "sinusoid", "helix")


@lru_cache
def lumen(name: str) -> Lumen:
    """One of the lumens of the paper or of its authors' earlier curves."""
    return LUMENS[name]()


def simulation(name: str, wire: Wire) -> Simulation:
    """A wire in one of these lumens, with the paper's wall convention."""
    return Simulation(wire, lumen(name), contact=Barrier(1e3, 1e-4, wall="centreline"))


@dataclass(frozen=True)
class Passive:
    """A passive run in numbers of the paper; arrays hold one entry for each record.

    X is the push, F the tip force in EI/L^2, ``peak`` its largest over all steps. The smallest
    clearance of the nodes, and of the middles between them [m], is NaN where all are on the guide.
    """

    system: System
    status: str
    X: Array
    F: Array
    positions: Array
    forces: Array
    clearance: Array
    between: Array
    stable: NDArray[np.bool_]
    peak: float
    totals: Totals


@lru_cache
def passive(
    name: str,
    *,
    time_step: float = 0.01,
    push: float = 0.72,
    nodes: int = 100,
    every: float = 0.002,
    release: str = "sliding",
    inertia: bool = True,
) -> Passive:
    """The paper's wire pushed through a lumen without a field, recorded ``every`` part of L."""
    system = System(
        paper_wire(nodes), lumen(name), Barrier(1e3, 1e-4, wall="centreline"), release=release
    )  # type: ignore[arg-type]
    course = Feed(0.01 * L, push * L)
    march = March(system, UniformField(), course, time_step=time_step, inertia=inertia)
    records = list(march.records(max(1, round(100 * every / time_step))))
    nearest = [record.clearance[np.isfinite(record.clearance)] for record in records]
    return Passive(
        system=system,
        status=march.plant.status.name if march.step == march.steps else "FAILED",
        X=np.array([record.feed for record in records]) / L,
        F=np.array([record.tip_force for record in records]) / system.scales.force,
        positions=np.array([record.position for record in records]),
        forces=np.array([record.contact_force for record in records]),
        clearance=np.array([gaps.min() if len(gaps) else np.nan for gaps in nearest]),
        between=np.array([record.clearance_midpoint for record in records]),
        stable=np.array([record.stable for record in records]),
        peak=march.plant.totals.max_tip_force / system.scales.force,
        totals=march.plant.totals,
    )

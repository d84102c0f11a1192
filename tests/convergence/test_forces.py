"""Forces along the wire are those of the wire and the lumen, not of mesh and barrier (P-37)."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.results import forces
from magwire.results.forces import Layout
from magwire.simulation import Simulation
from wires import L, lumen, paper_wire

Array = NDArray[np.float64]
PLACES = np.linspace(0.0, L, 241)


def pressed(name: str, nodes: int, stiffness: float) -> dict[str, float | Array]:
    """What the wall does to the paper's wire at rest."""
    wire = paper_wire(nodes)
    sim = Simulation(wire, lumen(name), contact=Barrier(stiffness, wall="centreline"))
    state = sim.equilibrium(0.06)
    layout = Layout(wire.length, nodes, wire.magnet, np.zeros((0, 4)))
    force = forces.sizes(state.wall_force[None])
    density = forces.per_length(layout, force)
    return {
        "sum": float(force.sum()),
        "patch": float(forces.largest_over(layout, force, layout.patch)[0]),
        "magnet": float(forces.magnet(layout, force)[0]),
        "push": state.push_force,
        "contact": float(forces.contact_length(layout, density)[0]),
        "density": np.interp(PLACES, layout.station, density[0]),
    }


@pytest.mark.parametrize("name", ["half-circle", "sinusoid"])
def test_mesh_and_wall_change_forces_by_less_than_5_percent(name: str) -> None:
    first, *others = (pressed(name, n, k) for n in (121, 481) for k in (1e3, 1e5))
    for other in others:
        for quantity in ("sum", "patch", "magnet", "push", "contact"):
            assert other[quantity] == pytest.approx(first[quantity], rel=0.05)
        apart = np.abs(np.asarray(other["density"]) - first["density"]).max()
        assert apart < 0.05 * np.max(first["density"])

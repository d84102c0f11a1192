"""Wires whose ends are held in ways that the guide does not know: pinned, clamped, closed.

The energies and their derivatives are those of the engine. What is held is taken out of the
unknowns: q = q_0 + T y with a constant matrix T. Lengths are in parts of the wire's, forces in
EI/L^2, moments in EI/L.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eig_banded
from scipy.sparse import coo_array, csc_array, diags_array, eye_array, hstack
from scipy.sparse.csgraph import reverse_cuthill_mckee
from scipy.sparse.linalg import spsolve

from magwire.contact import Barrier
from magwire.engine.sampling import sample
from magwire.engine.system import System
from magwire.evidence.verify.wires import magnet
from magwire.field import UniformField
from magwire.kernels.arrays import Motion, Mouth, State
from magwire.kernels.assembly import assemble
from magwire.kernels.frames import update_frames
from magwire.kernels.history import copy_configuration
from magwire.lumen import Lumen

Array = NDArray[np.float64]
End = Literal["pinned", "clamped"]

STRETCH = 4e6
"""EA L^2/EI of a round wire with L = 1000 r."""
RESIDUAL = 1e-9
ITERATIONS = 60
LARGEST_STEP = 0.05


class Rig:
    """A uniform straight wire of which every hinge is free to bend and twist.

    Parameters
    ----------
    nodes
        Nodes of the wire. A straight wire has a massless edge more at each end, which gives the
        direction of a clamp; a ring has as many hinges as nodes, and its first edge comes again
        after the last.
    twisting
        GJ/EI.
    ring
        Whether the wire is closed to a ring; it is straight if left out.

    Attributes
    ----------
    state
        Positions and angles; the frames follow them in ``move``.
    modes
        T, sparse, shape (4 * points, unknowns).
    """

    def __init__(self, nodes: int, *, twisting: float = 2.0 / 3.0, ring: bool = False) -> None:
        points = nodes + 2
        self.ring, self.nodes = ring, nodes
        self.edge = 1.0 / nodes if ring else 1.0 / (nodes - 1)
        self.system = System(magnet(points - 1, 0.0), Lumen.open_space(), Barrier())
        bend = np.full(points, 1.0 / self.edge)
        if not ring:
            bend[[1, -2]] *= 2.0  # half a cell at each end
        stretch = np.full(points - 1, STRETCH)
        self.rod = self.system.rod._replace(
            rest=np.full(points - 1, self.edge),
            stretch=stretch,
            bend=bend,
            twist=twisting * bend,
            weight=np.zeros((points, 3)),
        )
        self.state: State = self.system.new_state()
        self.modes = eye_array(4 * points, format="csc")
        self._work = self.system.new_work()
        self._field = sample(self.system, UniformField(), self.state)
        if ring:
            self._lay_ring()
        else:
            self._lay_straight()

    def _lay_straight(self) -> None:
        state = self.state
        state.q[:, 0] = self.edge * (np.arange(len(state.q)) - 1.0)
        state.length[:] = self.edge

    def _lay_ring(self) -> None:
        """A regular polygon in the xy plane; frames normal to it, so that no edge is twisted."""
        state = self.state
        angle = 2.0 * np.pi * np.arange(self.nodes + 2) / self.nodes
        radius = 0.5 * self.edge / np.sin(np.pi / self.nodes)
        state.q[:, 0], state.q[:, 1] = radius * np.cos(angle), radius * np.sin(angle)
        edges = np.diff(state.q[:, :3], axis=0)
        state.length[:] = self.edge
        state.tangent[:] = edges / self.edge
        state.director[:] = (0.0, 0.0, 1.0)
        size = 4 * (self.nodes + 2)
        own = np.arange(size) % (4 * self.nodes)  # the last two points are the first two
        self.modes = csc_array((np.ones(size), (np.arange(size), own)))

    def hold(self, near: End, far: End) -> None:
        """Hold the ends of a straight wire in the axis x; the far one may slide along it.

        A clamped end may not turn at all, a pinned one only may not turn about the axis.
        """
        last = self.nodes
        free = np.ones((last + 2, 4), dtype=bool)
        free[[0, -1]] = False
        free[[1, last], :3] = False
        free[last, 3] = free[0, 3] = False  # the edges beyond the ends give the clamps' twist
        for end, hinge, edge in ((near, 1, 1), (far, last, last - 1)):
            if end == "pinned":
                self.rod.bend[hinge] = self.rod.twist[hinge] = 0.0
                free[edge, 3] = False
        own = self.modes[:, free.ravel()]
        slide = np.zeros((last + 2, 4))
        slide[[last, last + 1], 0] = 1.0
        self.modes = csc_array(hstack([own, csc_array(slide.reshape(-1, 1))]))

    def fix(self, *where: tuple[int | slice, int]) -> None:
        """Take unknowns out: points, and which of x, y, z and the angle.

        For a motion that costs nothing, such as turning a buckled wire about its axis, to fix one
        number that changes with it leaves the equilibria as they are.
        """
        fixed = np.zeros_like(self.state.q, dtype=bool)
        for points, component in where:
            fixed[points, component] = True
        self.modes = self.modes[:, abs(self.modes[fixed.ravel()]).sum(axis=0) == 0.0]

    def pull(self, force: float) -> None:
        """Dead force along x on the far end; negative pushes."""
        self.rod.weight[self.nodes, 0] = force

    def move(self, q: Array) -> None:
        """Go to positions and angles of all points in one step, frames being carried along."""
        base = self.system.new_state()
        copy_configuration(self.state, base, 1)
        base.q[0], base.director[0] = self.state.q[0], self.state.director[0]
        base.tangent[0] = self.state.tangent[0]
        self.state.q[:] = q
        update_frames(base, self.state, 1)

    def energy(self) -> float:
        """Of the wire and its loads."""
        return float(self._assemble(self._work.no_band)[0])

    def gradient(self) -> Array:
        """Derivatives of the energy by all numbers, shape (points, 4)."""
        self._assemble(self._work.no_band)
        gradient: Array = self._work.gradient.copy()
        gradient[-1, 3] = 0.0
        return gradient

    def stiffness(self) -> csc_array:
        """Second derivatives of the energy by the unknowns."""
        self._assemble(self._work.band)
        size, width = self.state.q.size, self._work.band.shape[1]
        below = [self._work.band[: size - k, k] for k in range(width)]
        both = diags_array([*below[:0:-1], *below], offsets=list(range(1 - width, width)))
        return csc_array(self.modes.T @ both @ self.modes)

    def smallest(self, skip: int = 0) -> float:
        """Smallest eigenvalue of the stiffness, but for ``skip`` of them that are nearest to 0."""
        stiffness = self.stiffness()
        order = reverse_cuthill_mckee(stiffness, symmetric_mode=True)
        entries = coo_array(stiffness[order][:, order])
        row, column = entries.coords
        below = row >= column
        band = np.zeros((int((row - column).max()) + 1, stiffness.shape[0]))
        band[(row - column)[below], column[below]] = entries.data[below]
        values = eig_banded(band, lower=True, eigvals_only=True, select="i", select_range=(0, skip))
        return float(values[np.argsort(np.abs(values))[skip:]].min())

    def settle(self) -> None:
        """Newton's method to the equilibrium nearby, be it stable or not.

        Raises
        ------
        RuntimeError
            If it is not found.
        """
        for _ in range(ITERATIONS):
            gradient = self.modes.T @ self.gradient().ravel()
            step = self.modes @ spsolve(self.stiffness(), -gradient)
            size = np.abs(step).max()
            self.move(self.state.q + step.reshape(-1, 4) * min(1.0, LARGEST_STEP / size))
            if size < RESIDUAL:
                return
        raise RuntimeError(f"No equilibrium in {ITERATIONS} iterations; last step {size:.1e}.")

    def _assemble(self, band: Array) -> tuple[float, int]:
        model = self.system.new_terms(self._field, rod=self.rod)
        still = Motion(0.0, self._work.target)
        result: tuple[float, int] = assemble(
            model, self.state, Mouth(1, 1.0), still, self._work.gradient, band
        )
        return result

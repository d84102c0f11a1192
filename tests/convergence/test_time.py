"""First order in time, and the mass, damping and inertia that the steps move (P-14)."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh

from magwire.engine.sampling import sample
from magwire.engine.statics import Equilibrium
from magwire.evidence.verify.wires import order
from magwire.field import UniformField
from magwire.kernels.arrays import State
from magwire.kernels.frames import update_frames
from magwire.kernels.march import Drive, Tally, march
from tangent import copy, free_rows, mass, stiffness
from wires import L, flux, free, magnet

Array = NDArray[np.float64]
NODES = 31


def swing(
    start: State, rest: Equilibrium, field: Array, time: float, steps: int, damping: float
) -> Array:
    """Positions (scaled) and twist angles after the wire is let go, shape (nodes + 1, 4)."""
    system = rest.point.system
    state = system.new_state()
    for target, source in zip(state, start, strict=True):
        target[...] = source
    state.velocity[:] = 0.0
    feed = np.full(steps, rest.feed / system.wire.length)
    drive = Drive(feed, np.zeros(steps), np.zeros((steps, 3)), time / steps, damping, True)
    samples = sample(system, UniformField((field[0], field[1], field[2])), state)
    model = system.new_terms(samples)
    done, _ = march(
        model,
        system.guide,
        state,
        system.new_work(),
        system.step_limits()._replace(tolerance=1e-8, step=0.0),
        drive,
        Tally(np.zeros(4), np.zeros(3)),
    )
    assert done == steps
    return state.q.copy()


@pytest.mark.parametrize("damping", [0.0, 1.0, 20.0])
def test_small_swing_against_the_exact_motion(damping: float) -> None:
    """x'' + mu x' + omega^2 x = 0 in the first mode, over- and underdamped."""
    wire = magnet(NODES)
    field = flux(wire, 2.0, 0.0)
    rest = free(wire).equilibrium(L, field)
    squares, modes = eigh(stiffness(rest), np.diag(mass(rest)), subset_by_index=(0, 0))
    mode = np.zeros(4 * (NODES + 1))
    mode[free_rows(rest)] = modes[:, 0] / np.abs(modes[:, 0]).max()
    before, start = rest.point.state, copy(rest)
    start.q[:] += 1e-4 * mode.reshape(-1, 4)
    update_frames(before, start, rest.point.mouth.held)

    time = 2.0 / np.sqrt(squares[0])
    root = np.sqrt(complex(0.25 * damping**2 - squares[0]))
    rates = np.array([root, -root]) - 0.5 * damping
    decay = np.exp(rates[::-1] * time)
    exact = float(((rates[0] * decay[0] - rates[1] * decay[1]) / (2.0 * root)).real)

    node = int(np.abs(mode).argmax())
    steps = np.array([50, 100, 200, 400])
    ends = [swing(start, rest, field, time, n, damping).ravel()[node] for n in steps]
    found = (np.array(ends) - before.q.ravel()[node]) / (1e-4 * mode[node])
    assert found[-1] == pytest.approx(exact, abs=5e-3)
    assert order(1.0 / steps, np.abs(found - exact)) == pytest.approx(1.0, abs=0.1)


def test_large_swing() -> None:
    """A bent wire let go in another field, against finer steps, extrapolated."""
    wire = magnet(NODES)
    bent = free(wire).equilibrium(L, flux(wire, 3.0, 90.0))
    field = flux(wire, 1.0, -45.0)
    steps = np.array([100, 200, 400, 800])

    def end(n: int) -> Array:
        return swing(copy(bent), bent, field, 0.25, n, 1.0)[:, :3]

    coarse, fine = end(3200), end(6400)
    exact = 2.0 * fine - coarse
    assert np.linalg.norm(exact[-1] - bent.positions[-1] / L) > 0.2
    errors = [np.abs(end(n) - exact).max() for n in steps]
    assert order(1.0 / steps, errors) == pytest.approx(1.0, abs=0.2)

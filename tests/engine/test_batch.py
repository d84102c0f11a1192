"""Many wires stepped together give what each gives alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from magwire import Barrier, InputError, Lumen, Simulation
from magwire.batch import Batch
from magwire.engine.command import Command
from magwire.engine.plant import Plant
from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.evidence.verify.references.dipole import Dipole
from magwire.kernels.newton import Limits
from magwire.scenario import load
from magwire.wire import Wire

MATERIAL: dict[str, Any] = {"youngs_modulus": 3e6, "shear_modulus": 1e6, "density": 2000.0}
FEED = 0.03


def wire(nodes: int) -> Wire:
    return Wire.uniform(
        length=0.1,
        radius=0.6e-3,
        nodes=nodes,
        magnetized_tip=5e-3,
        magnetization=128e3,
        **MATERIAL,
    )


@pytest.fixture(scope="module")
def simulations() -> list[Simulation]:
    """Two of different lumens and numbers of nodes."""
    return [
        Simulation(wire(60), Lumen.half_circle(0.025, 3e-3), contact=Barrier(1e3, 1e-4)),
        Simulation(wire(45), Lumen.sinusoid(4e-3, 0.05, 0.09, 3e-3), contact=Barrier(1e3, 1e-4)),
    ]


LIMITS = System.step_limits


def hopeless(system: System) -> Limits:
    """Limits that no residual and no step can keep to."""
    return LIMITS(system)._replace(tolerance=-1.0, step=-1.0, iterations=3)


def commands(seed: int, count: int) -> list[Command]:
    chance = np.random.default_rng(seed)
    return [
        Command(
            chance.uniform(-0.01, 0.02),
            chance.uniform(-1.0, 1.0),
            chance.uniform(-5e-3, 5e-3, 3) if chance.random() < 0.8 else None,
            float(chance.choice([0.01, 0.025])),
        )
        for _ in range(count)
    ]


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_wires_of_a_batch_are_those_of_sessions(
    simulations: list[Simulation], threads: int
) -> None:
    who = np.random.default_rng(threads).permutation([0, 1, 0, 1, 0])
    courses = {int(i): commands(int(i), 12) for i in range(len(who))}
    batch = Batch([simulations[k] for k in who], feed=FEED, threads=threads)
    for k in range(12):
        ended = batch.advance([courses[i][k] for i in range(len(who))])
        assert np.array_equal(ended, np.zeros(len(who)))
    seen = batch.observe()
    for i, k in enumerate(who):
        session = simulations[k].session(feed=FEED)
        for command in courses[i]:
            session.advance([command])
        alone = session.observe()
        for name, value in zip(alone._fields, alone, strict=True):
            assert np.array_equal(getattr(seen, name)[i], value), name
        assert np.array_equal(batch.plant(i).state.q, session.plant.state.q)
        assert batch.plant(i).totals.newton_iterations == session.plant.totals.newton_iterations
    assert max(seen.patch_force) > 0.0  # they touch the wall


def test_tip_arc_is_that_of_the_way(simulations: list[Simulation]) -> None:
    batch = Batch(simulations, feed=FEED)
    for i, simulation in enumerate(simulations):
        nodes = batch.plant(i).record().position
        assert batch.observe().tip_arc[i] == pytest.approx(simulation.tip_arc(nodes), rel=1e-9)


def test_a_tip_in_another_branch_is_not_on_the_way() -> None:
    sim = load("left-branch", ["navigate.method=none", "wire.nodes=60"]).build().simulation
    batch = Batch([sim], feed=0.0)
    branches = []
    for _ in range(140):
        batch.step(0.01, duration=0.05)
        seen = batch.observe()
        branches.append((int(seen.branch[0]), bool(np.isnan(seen.tip_arc[0]))))
    assert branches[10] == (0, False)
    assert branches[-1][0] != 0
    assert branches[-1][1]


def test_a_failed_step_leaves_its_wire_and_no_other(
    simulations: list[Simulation], monkeypatch: pytest.MonkeyPatch
) -> None:
    good = Plant(simulations[0].system)
    with monkeypatch.context() as patch:
        patch.setattr(System, "step_limits", hopeless)
        bad = Plant(simulations[0].system)
    batch = Batch([good, bad], threads=1)
    ended = batch.step(0.01, inputs=[0.0, 5e-3, 0.0], duration=0.5)
    assert ended[0] == Status.CONVERGED
    assert ended[1] != Status.CONVERGED
    assert batch.message(0) == ""
    assert "wire 1 did not converge" in batch.message(1)
    seen = batch.observe()
    assert seen.feed[0] == pytest.approx(5e-3)
    assert seen.feed[1] < 5e-3
    assert seen.time[1] == pytest.approx(seen.feed[1] / 0.01)


def test_only_some_move_and_go_back(simulations: list[Simulation]) -> None:
    batch = Batch([simulations[0]] * 3, feed=FEED)
    start = batch.observe()
    kept = batch.snapshot(2)
    batch.step(0.01, duration=0.1, only=[False, True, True])
    moved = batch.observe()
    assert np.array_equal(moved.feed != start.feed, [False, True, True])
    assert np.array_equal(moved.time > 0.0, [False, True, True])
    batch.reset([1])
    batch.restore({2: kept})
    back = batch.observe()
    for name, value in zip(start._fields, start, strict=True):
        assert np.array_equal(getattr(back, name), value), name


def test_another_wire_takes_a_place(simulations: list[Simulation]) -> None:
    batch = Batch([simulations[0]] * 2, feed=FEED)
    batch.put(1, Plant(simulations[1].system))
    assert batch.observe().feed[1] == 0.0
    batch.step(0.01, duration=0.1)
    batch.reset()
    assert np.allclose(batch.observe().feed, [FEED, 0.0], rtol=1e-12)


def test_a_wire_takes_less_than_two_megabytes(simulations: list[Simulation]) -> None:
    batch = Batch([simulations[0]])
    nodes = simulations[0].system.wire.nodes
    assert nodes * 1000 < batch.bytes_per_wire < 2e6


def test_what_does_not_fit_is_refused(simulations: list[Simulation]) -> None:
    with pytest.raises(InputError, match="at least one wire"):
        Batch([])
    batch = Batch([simulations[0]] * 2)
    with pytest.raises(InputError, match="each of the 2 wires; received 1"):
        batch.advance([Command()])
    with pytest.raises(InputError, match="must be finite"):
        batch.step(np.nan)
    with pytest.raises(InputError, match=r"duration of Batch\.step must be positive"):
        batch.step(duration=0.0)
    magnet = Dipole((0.1, 0.0, 0.3), (0.0, 0.0, 10.0))
    near = Simulation(wire(60), Lumen.straight(0.1, 3e-3), field=magnet)
    with pytest.raises(InputError, match="affine in space; received wire 0 in a Dipole"):
        Batch([near])

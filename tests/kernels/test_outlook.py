"""What is observed ahead of a tip, against numpy written out plainly."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.kernels.outlook import ROW, ask, look_ahead, settle

RNG = np.random.default_rng(5)
WIRES, ROWS, INPUTS = 5, 40, 3
AHEAD = np.array([2e-3, 5e-3])


@pytest.mark.parametrize("limit", [0.02, -0.02])
def test_numbers_ahead(limit: float) -> None:
    paths = RNG.normal(size=(WIRES, ROWS, ROW))
    paths[:, :, 3] = RNG.uniform(1.0, 2.0, (WIRES, ROWS))
    spacing, goal = RNG.uniform(1e-3, 2e-3, WIRES), RNG.uniform(0.05, 0.1, WIRES)
    arc = RNG.uniform(0.0, 0.06, WIRES)
    arc[0] = 1.0  # beyond the end
    seen, asked = RNG.normal(size=(WIRES, 8)), RNG.normal(size=(WIRES, INPUTS))
    last = RNG.normal(size=(WIRES, 2 + INPUTS))
    frames, out = np.zeros((WIRES, 3, 3)), np.zeros((WIRES, 11 + 2 * INPUTS + 4 * len(AHEAD)))
    told = (arc, seen, asked, last, limit)
    look_ahead(paths, spacing, goal, AHEAD, *told, np.zeros(ROW), frames, out)
    for i in range(WIRES):
        places = np.arange(ROWS) * spacing[i]

        def row(place: float, i: int = i, places: np.ndarray = places) -> np.ndarray:
            return np.array([np.interp(place, places, column) for column in paths[i].T])

        here = row(arc[i])
        frame = here[4:].reshape(3, 3)
        ways = [row(arc[i] + by) for by in AHEAD]
        expected = [
            *(frame @ (seen[i, :3] - here[:3]))[1:] / here[3],
            *frame @ seen[i, 3:6],
            *(arc[i] / goal[i], seen[i, 6] / goal[i]),
            *(np.sin(seen[i, 7]), np.cos(seen[i, 7])),
            *(frame @ asked[i] if limit > 0.0 else asked[i]) / abs(limit),
            *last[i],
        ]
        for way, by in zip(ways, AHEAD, strict=True):
            expected += [*frame @ ((way[:3] - here[:3]) / by), way[3] / here[3]]
        np.testing.assert_allclose(out[i], expected, rtol=1e-4, atol=1e-4)
        np.testing.assert_allclose(frames[i], frame, rtol=1e-4, atol=1e-4)


@pytest.mark.parametrize("limit", [0.02, -0.02])
def test_inputs_go_as_fast_as_they_may(limit: float) -> None:
    share, frames = RNG.uniform(-1.0, 1.0, (WIRES, 3)), RNG.normal(size=(WIRES, 3, 3))
    before = RNG.normal(scale=0.01, size=(WIRES, 3))
    only = np.array([True, True, False, True, True])
    asked = before.copy()
    ask(share, frames, limit, 0.005, only, asked)
    for i in range(WIRES):
        size = max(np.linalg.norm(share[i]), 1.0)
        wanted = share[i] / size * limit @ frames[i] if limit > 0.0 else share[i] * abs(limit)
        now = before[i] + np.clip(wanted - before[i], -0.005, 0.005)
        np.testing.assert_allclose(asked[i], now if only[i] else before[i], rtol=1e-12)


def test_rewards_written_out() -> None:
    only = np.array([True, True, True, False])
    failed, taken = np.array([0, 3, 0, 0]), np.array([4, 5, 10, 2])
    before, arc = np.array([0.01, 0.02, 0.03, 0.0]), np.array([0.06, 0.01, 0.031, 0.01])
    goal, force = np.full(4, 0.05), np.array([0.5, 20.0, 0.0, 1.0])
    reward, done, cut = np.ones(4), np.zeros(4, dtype=bool), np.zeros(4, dtype=bool)
    weights = (10.0, 1.0, 0.2, 0.05, 10.0)
    settle(only, failed, taken, 10, before, arc, goal, force, weights, reward, (done, cut))
    expected = [8.0 + 1.0 - 0.02 - 0.025, -2.0 - 0.02 - 0.5, 0.2 - 0.02, 0.0]
    np.testing.assert_allclose(reward, expected, rtol=1e-12)
    assert done.tolist() == [True, False, False, False]
    assert cut.tolist() == [False, True, True, False]

"""Feeding: the guide, its mouth, releasing nodes and taking them back (P-15)."""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.hinge import reference_twist
from magwire.kernels.vectors import row

SMALLEST_PART = 1e-3  # conditioning guard: a hinge just released is stiff, not infinitely so


@kernel
def find_mouth(rod, guide, feed):
    """Last held node at a feed, and the part of its cell that is past the entrance."""
    tip = rod.station.shape[0] - 1
    entrance = rod.station[tip] - feed
    low, high = 1, tip
    ends = rod.cell_end if guide.sliding else rod.station
    while low < high:
        middle = (low + high) // 2
        if ends[middle] > entrance:
            high = middle
        else:
            low = middle + 1
    if not guide.sliding:
        held = low if ends[low] <= entrance else low - 1
        return max(held, 1), 1.0
    cell = rod.cell_end[low] - rod.cell_end[low - 1]
    return low, max(SMALLEST_PART, (rod.cell_end[low] - entrance) / cell)


@kernel
def place_held(rod, guide, state, first, last, feed, twist):
    """Put nodes first ... last and the edges between them on the guide line."""
    entrance = rod.station[rod.station.shape[0] - 1] - feed
    for i in range(first, last + 1):
        along = rod.station[i] - entrance
        for c in range(3):
            state.q[i, c] = guide.entrance[c] + along * guide.direction[c]
        if i < last:
            state.q[i, 3] = twist
            state.length[i] = rod.rest[i]
            state.twist[i] = 0.0
            for c in range(3):
                state.tangent[i, c] = guide.direction[c]
                state.director[i, c] = guide.director[c]


@kernel
def change_held(rod, guide, state, held, moves):
    """Release nodes or take them back, so that ``held`` is the last held one.

    moves = feed, twist, feed speed, twist speed of the guide.
    """
    feed, twist, speed, turning = moves
    before = state.held[0]
    state.held[0] = held
    if held < before:
        place_held(rod, guide, state, held - 1, before, feed, twist)
        for i in range(held, before + 1):
            for c in range(3):
                state.velocity[i, c] = speed * guide.direction[c]
            if i < before:
                state.velocity[i, 3] = turning
    elif held > before:
        tip = state.q.shape[0] - 1
        if held < tip:
            tau = state.q[held, 3] - state.q[held - 1, 3] + state.twist[held]
        place_held(rod, guide, state, before - 1, held, feed, twist)
        if held < tip:
            state.twist[held] = reference_twist(
                row(state.director, held - 1),
                row(state.tangent, held - 1),
                row(state.director, held),
                row(state.tangent, held),
                tau - (state.q[held, 3] - twist),
            )

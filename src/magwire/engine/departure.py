"""Whether a wire that is held by friction, too, would leave where it rests by itself (P-33).

What each contact does hangs on where the wire goes. So the tangent is a different one for each
choice of that, and a direction counts if its contacts do what its tangent takes them to do.
"""

from __future__ import annotations

from collections import deque
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magwire.engine.rubbing import Branches, Rubbing

Array = NDArray[np.float64]

CHOICES = 40  # of what the contacts do that are looked at
REAL = 1e-7  # imaginary part, of its size, up to which an eigenvalue is real
BESIDE = 1e-6  # relative distance from an eigenvalue at which its vector is looked for
ITERATIONS = 4  # for a vector; each takes out the others by that distance over theirs


def departs(rubbing: Rubbing) -> bool:
    """Whether there is a direction that a wire at rest takes by itself, guide and field held.

    A direction v with (theta M + K) v = 0, theta not negative, K the tangent of what the contacts
    do as the wire moves along v. It is looked for from the choice that all slide that are on
    their cones. If there are more choices to look at than ``CHOICES``, it counts as found.
    """
    contacts = rubbing.contacts
    waiting = deque([Branches(contacts.on.copy(), np.ones(len(contacts.node), dtype=bool))])
    seen: list[Branches] = []
    while waiting:
        branches = waiting.popleft()
        if any(branches.agree(other) for other in seen):
            continue
        if len(seen) == CHOICES:
            return True
        seen.append(branches)
        stiffness, way = rubbing.tangent(branches)
        for direction in _growing(rubbing, stiffness):
            for moved in (direction, -direction):
                found = rubbing.done(moved, way)
                if found.agree(branches):
                    return True
                waiting.append(found)
    return False


def _growing(rubbing: Rubbing, stiffness: Any) -> list[Array]:
    """Directions of all unknowns along which the wire would go with a given tangent."""
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import splu

    free, root = rubbing.free, 1.0 / np.sqrt(rubbing.inertia[rubbing.free])
    scaled = diags_array(root) @ stiffness[free, free] @ diags_array(root)
    values = np.linalg.eigvals(scaled.toarray())
    grows = (np.abs(values.imag) <= REAL * np.abs(values)) & (values.real <= 0.0)
    directions = []
    for value in np.sort(values.real[grows]):
        beside = diags_array(np.full(len(root), value * (1.0 + BESIDE)))
        inverse, vector = splu((scaled - beside).tocsc()), np.ones(len(root))
        for _ in range(ITERATIONS):
            vector = inverse.solve(vector)
            vector /= np.abs(vector).max()
        moved = np.zeros(stiffness.shape[0])
        moved[free] = root * vector
        directions.append(moved)
    return directions

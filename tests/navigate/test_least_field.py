"""Past a quarter turn the least field that holds a free wire is known in closed form (P-22)."""

from __future__ import annotations

import numpy as np

from magwire import Feed
from magwire.navigate.stable import StableNavigator
from wires import L, paper_wire, simulation

MAGNET = 0.05  # in L


def test_it_is_antiparallel_to_the_entrance_and_grows_with_the_turn() -> None:
    """|B| = EI kappa / (m sin alpha), all but the margins: the half-circle up to 150 degrees."""
    run = simulation("half-circle", paper_wire())
    course = Feed(1e-3, 0.07)
    result = run.run(course, StableNavigator(run.system), motion="quasi-static", record_every=5e-4)
    field = result.dataset["normalized_field"].values
    for push in (0.5, 0.55, 0.6, 0.65, 0.7):
        record = int(np.abs(result.normalized_push - push).argmin())
        edges = np.diff(result.position[record] / L, axis=0)
        angle = np.unwrap(np.arctan2(edges[:, 1], edges[:, 0]))
        middle = np.cumsum(np.linalg.norm(edges, axis=1)) - 1.0  # from the tip
        arc = (middle > 0.05 - push) & (middle < -0.02 - MAGNET)
        bend = float(np.polyfit(middle[arc], angle[arc], 1)[0])
        turned = float(np.sin(angle[middle > -MAGNET]).mean())
        least = bend / (MAGNET * turned)
        size = float(np.linalg.norm(field[record]))
        assert angle[-1] > 0.5 * np.pi
        assert -field[record, 0] > 0.9999 * size
        assert 1.0 <= size / least <= 1.03

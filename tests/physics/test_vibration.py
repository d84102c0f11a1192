"""Natural frequencies of a wire magnetised along its length, in an aligned field."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigh

from tables import closed_form
from tangent import mass, stiffness
from wires import L, flux, free, magnet

TABLE = closed_form("vibration_aligned_field")


@pytest.mark.parametrize("row", TABLE, ids=[f"b={row[0]:g}" for row in TABLE])
def test_first_three_frequencies(row: tuple[float, ...]) -> None:
    """omega L^2 sqrt(rho A/EI); each comes twice, once for either plane."""
    b, *expected = row
    wire = magnet(100)
    state = free(wire).equilibrium(L, flux(wire, b, 0.0))
    # Lumped masses are a diagonal: the standard problem of the scaled stiffness is cheaper.
    root = 1.0 / np.sqrt(mass(state))
    scaled = root[:, None] * stiffness(state) * root
    squares = eigh(scaled, eigvals_only=True, subset_by_index=(0, 5))
    assert state.stable
    body = wire.body
    scale = np.sqrt(body.density * body.area / body.bending_stiffness) * L**2
    found = scale * np.sqrt(squares)
    np.testing.assert_allclose(found[::2], found[1::2], rtol=1e-5)
    np.testing.assert_allclose(found[::2], expected, rtol=1e-3)


def test_first_twisting_and_stretching_frequencies() -> None:
    """Clamped-free: omega L = pi/2 times the speed of the wave."""
    wire = magnet(100, 0.0)
    state = free(wire).equilibrium(L)
    values, vectors = eigh(stiffness(state), np.diag(mass(state)))
    shapes = np.zeros((len(values) + 1, len(values)))
    shapes[1:] = vectors  # rows: theta of the mouth's edge, then x, y, z, theta of each node
    twisting = np.abs(shapes[1::4]).max(axis=0)
    stretching = np.abs(shapes[2::4]).max(axis=0)
    others = np.abs(shapes[3::4]).max(axis=0) + np.abs(shapes[4::4]).max(axis=0)
    body = wire.body
    for own, speed in (
        (twisting > 1e3 * (others + stretching), np.sqrt(body.shear_modulus / body.density)),
        (stretching > 1e3 * (others + twisting), np.sqrt(body.youngs_modulus / body.density)),
    ):
        assert own.any()
        lowest = np.sqrt(values[own].min())
        assert lowest * L / speed == pytest.approx(0.5 * np.pi, rel=0.01)

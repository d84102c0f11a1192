"""Banded root-free Cholesky against scipy, and what it says of an indefinite matrix."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import cho_solve_banded, cholesky_banded

from magwire.kernels.band import HALF_BANDWIDTH, WIDTH, factor, solve

from .rods import Array

FRONT = 7  # rows of the guide in front of the free ones
BACK = WIDTH  # rows that must be there behind them


def random_band(size: int, seed: int, shift: float = 1.0) -> Array:
    """Rows of a diagonally dominant band between rows of nonsense that must not be touched."""
    rng = np.random.default_rng(seed)
    band = rng.normal(size=(size, WIDTH))
    for k in range(1, WIDTH):
        band[max(size - k, 0) :, k] = 0.0
        within = (np.arange(FRONT, FRONT + size) % 4 + k) <= HALF_BANDWIDTH
        band[~within, k] = 0.0  # a wire has no such entries
    band[:, 0] = shift * 2.0 * WIDTH
    return np.concatenate([np.full((FRONT, WIDTH), 7.0), band, np.full((BACK, WIDTH), 9.0)])


def dense(band: Array) -> Array:
    size = len(band)
    full = np.zeros((size, size))
    for k in range(min(WIDTH, size)):
        column = np.arange(size - k)
        full[column + k, column] = full[column, column + k] = band[: size - k, k]
    return full


@pytest.mark.parametrize("size", [1, 2, 10, 11, 12, 60, 400])
def test_factor_and_solve(size: int) -> None:
    padded = random_band(size, size)
    free = slice(FRONT, FRONT + size)
    band = padded[free].copy()
    rows = min(WIDTH, size)
    expected = cholesky_banded(band.T[:rows], lower=True)
    assert factor(padded, FRONT, FRONT + size) == -1
    np.testing.assert_allclose(padded[free, 0], expected[0] ** -2.0)  # 1/D of A = L D L^T
    for k in range(1, rows):
        unit = expected[k, : size - k] / expected[0, : size - k]
        np.testing.assert_allclose(padded[FRONT : FRONT + size - k, k], unit)
    load = np.random.default_rng(1).normal(size=size)
    x = np.concatenate([np.full(FRONT, 3.0), load, np.full(BACK, 4.0)])
    solve(padded, x, FRONT, FRONT + size)
    np.testing.assert_allclose(x[free], cho_solve_banded((expected, True), load), rtol=1e-11)
    np.testing.assert_allclose(dense(band) @ x[free], load, atol=1e-12)


def test_what_is_in_front_stays_as_it_was() -> None:
    padded = random_band(30, 4)
    row, k = np.indices((FRONT, WIDTH))
    padded[:FRONT][row % 4 + k > HALF_BANDWIDTH] = 0.0  # such entries are zero in every band
    front = padded[:FRONT].copy()
    x = np.full(len(padded), 3.0)
    assert factor(padded, FRONT, FRONT + 30) == -1
    solve(padded, x, FRONT, FRONT + 30)
    assert np.array_equal(padded[:FRONT], front)
    assert np.all(padded[-BACK:] == 9.0)
    assert np.all(x[:FRONT] == 3.0)


@pytest.mark.parametrize("row", [0, 3, 37, 59])
def test_failure_names_the_row(row: int) -> None:
    padded = random_band(60, 2)
    padded[FRONT + row, 0] = -1.0
    assert factor(padded, FRONT, FRONT + 60) == FRONT + row


@pytest.mark.parametrize("bad", [0.0, np.nan])
def test_zero_and_nan_pivots_fail(bad: float) -> None:
    padded = random_band(5, 3)
    padded[FRONT, 0] = bad
    assert factor(padded, FRONT, FRONT + 5) == FRONT


@pytest.mark.parametrize("seed", range(10))
def test_fails_exactly_when_an_eigenvalue_is_negative(seed: int) -> None:
    padded = random_band(40, seed, shift=0.3 + 0.03 * seed)
    smallest = np.linalg.eigvalsh(dense(padded[FRONT:-BACK]))[0]
    assert (factor(padded, FRONT, FRONT + 40) == -1) == (smallest > 0.0)

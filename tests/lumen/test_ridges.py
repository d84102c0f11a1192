"""Radii that leave sharp edges in the wall of one branch, and what becomes of them in trees."""

from __future__ import annotations

import numpy as np
import pytest

import magwire as mw
from magwire.lumen import Branch
from magwire.lumen.ridges import ridges, without_ridges

ALONG = np.linspace(0.0, 0.03, 121)


def notched(depth: float, width: float = 0.6e-3) -> Branch:
    """A tube of 1 mm that is narrower at 20 mm, by a depth over a width [m]."""
    radius = 1e-3 - depth * np.exp(-(((ALONG - 0.02) / width) ** 2))
    points = np.stack([ALONG, 0.0 * ALONG, 0.0 * ALONG], axis=1)
    return Branch(points, radius)


def sharpest(branch: Branch) -> float:
    """Largest second difference of the gap along a line near the wall [1/m]."""
    lumen = mw.Lumen((branch,))
    x, step = np.linspace(0.018, 0.022, 4001, retstep=True)
    gap = lumen.gap(np.stack([x, np.full_like(x, 0.75e-3), 0.0 * x], axis=1))
    return float(np.diff(gap, 2).max()) / step**2


def test_a_ridge_is_where_the_gap_has_a_kink() -> None:
    """Of a notch with the radius r(S) the two balls of a point come apart where r'' r > 1."""
    gentle, deep = notched(0.08e-3), notched(0.3e-3)
    assert len(ridges(gentle)) == 0
    at = ridges(deep)
    assert at.min() > 0.0195
    assert at.max() < 0.0205
    assert sharpest(gentle) < 3e3
    assert sharpest(deep) > 1e5  # as sharp as the samples are near


def test_it_goes_and_the_rest_stays_to_the_bit() -> None:
    deep = notched(0.3e-3)
    smooth = without_ridges(deep, 0.0)
    assert len(ridges(smooth)) == 0
    assert sharpest(smooth) < 2e4
    away = np.abs(ALONG - 0.02) > 3e-3
    assert np.array_equal(smooth.radius[away], deep.radius[away])
    assert smooth.radius[80] > deep.radius[80]
    assert smooth.radius.max() <= deep.radius.max()


def test_what_has_none_is_left_alone() -> None:
    gentle = notched(0.08e-3)
    assert without_ridges(gentle, 0.0) is gentle
    deep = notched(0.3e-3)
    assert without_ridges(deep, 0.021) is deep  # it is inside of another branch there


def test_a_branch_of_a_tree_has_none() -> None:
    trunk = mw.Lumen.straight(0.04, 2e-3)
    side = notched(0.3e-3)
    turn = np.array([[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]])
    line = mw.Lumen.through(side.points @ turn.T + [0.01, 0.0, 0.0], side.radius)
    assert len(ridges(line.branches[0])) > 0
    tree = mw.Lumen.tree({"ahead": trunk, "side": line})
    own = tree.branches[1]
    found = ridges(own)
    assert not np.any((found > 0.015) & (found < 0.025))
    assert own.curve.at(np.array([0.01]))[0, 3] == pytest.approx(1e-3, rel=1e-6)

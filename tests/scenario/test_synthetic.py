"""Lumen tables of vessels with a formula: their keys are the formula's, and so are its defaults."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from magwire.errors import ScenarioError
from magwire.lumen import Lumen
from magwire.scenario import load
from magwire.vessel.synthetic import aortic_arch, carotid_bifurcation, coronary_tree, tortuous

FORMULAS: dict[str, tuple[Callable[..., Lumen], dict[str, tuple[Any, str]]]] = {
    "aortic-arch": (
        aortic_arch,
        {
            "target": ("left carotid", "left carotid"),
            "arch_radius": (40e-3, "40 mm"),
            "radius": (12e-3, "12 mm"),
            "ascending_radius": (13e-3, "13 mm"),
            "descending": (70e-3, "70 mm"),
            "ascending": (45e-3, "45 mm"),
        },
    ),
    "carotid": (
        carotid_bifurcation,
        {
            "target": ("external", "external"),
            "radius": (3e-3, "3 mm"),
            "common": (52e-3, "52 mm"),
            "length": (48e-3, "48 mm"),
            "angle": (np.radians(20.0), "20 deg"),
        },
    ),
    "coronary": (
        coronary_tree,
        {
            "target": ("anterior", "anterior"),
            "radius": (2.4e-3, "2.4 mm"),
            "diagonals": (1, "1"),
            "seed": (7, "7"),
        },
    ),
    "tortuous": (
        tortuous,
        {
            "length": (125e-3, "125 mm"),
            "radius": (3.2e-3, "3.2 mm"),
            "end_radius": (1.6e-3, "1.6 mm"),
            "amplitude": (5e-3, "5 mm"),
            "seed": (3, "3"),
        },
    ),
}


def assert_same(one: Lumen, other: Lumen) -> None:
    assert (one.outlets, one.target) == (other.outlets, other.target)
    for mine, theirs in zip(one.branches, other.branches, strict=True):
        np.testing.assert_allclose(mine.points, theirs.points, rtol=0.0, atol=1e-12)
        np.testing.assert_allclose(mine.radius, theirs.radius, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("name", FORMULAS)
def test_what_is_left_out_is_as_in_the_formula(name: str) -> None:
    formula, _ = FORMULAS[name]
    scenario = load(name)
    target = {"target": scenario.lumen.target} if hasattr(scenario.lumen, "target") else {}
    assert_same(scenario.lumen.build(), formula(**target))


@pytest.mark.parametrize("name", FORMULAS)
def test_every_key_gets_to_the_formula(name: str) -> None:
    formula, values = FORMULAS[name]
    keys = [f"lumen.{key}={text}" for key, (_, text) in values.items()]
    built = load(name, [*keys, "feed.distance=10 mm"]).lumen.build()
    assert_same(built, formula(**{key: value for key, (value, _) in values.items()}))


@pytest.mark.parametrize("name", FORMULAS)
def test_the_wire_has_to_fit_the_way_to_the_target(name: str) -> None:
    narrowest = load(name).lumen.build().path().narrowest
    with pytest.raises(ScenarioError, match="smaller than the lumen's smallest radius"):
        load(name, [f"wire.radius={1.01e3 * narrowest} mm", "contact.activation_gap=0.01 mm"])
    scenario = load(name, [f"wire.radius={0.98e3 * narrowest} mm", "contact.activation_gap=1 um"])
    assert scenario.lumen.narrowest == narrowest

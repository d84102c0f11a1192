"""Wrong things in every place of the public interface: one plain sentence, no AttributeError."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np
import pytest

import magwire as mw
from magwire.actuate import Uniform

SECTION = mw.Section(0.05, 3e6, 1e6, 0.6e-3, 2000.0)
MAKE = mw.Make(
    diameter=1.2e-3, youngs_modulus=3e6, poisson_ratio=0.5, density=2e3, magnetization=1e5
)
WIRE = mw.Wire.of(MAKE, 0.05, 20, magnetized_tip=5e-3)
LUMEN = mw.Lumen.straight(0.1, 3e-3)
TREE = mw.Lumen.tree(
    {
        "ahead": LUMEN,
        "aside": mw.Lumen.through([[0.02, 0, 0], [0.04, 0.02, 0], [0.05, 0.05, 0]], 2e-3),
    }
)
SIMULATION = mw.Simulation(WIRE, LUMEN)
SCHEDULE = mw.Schedule(np.array([0.0, 0.1]), np.zeros((2, 3)))


class NoAffine:
    """A field that lacks a part."""

    def at(self, points: object) -> object:
        return points


WRONG: tuple[Any, ...] = (
    None,
    "word",
    3,
    0.5,
    True,
    [0.0, 0.01, 0.0],
    [[1.0], [1.0, 2.0]],
    {"radius": 1.0},
    object(),
    len,
    mw.Wire,
    mw.UniformField,
    mw.TipNavigator,
    SECTION,
    WIRE,
    LUMEN,
    mw.Barrier(),
    mw.UniformField(),
    mw.Feed(1e-3, 0.01),
    SCHEDULE,
    NoAffine(),
)

TUBES = {"radius": 3e-3, "points": 20}
PLACES: tuple[tuple[Callable[..., object], Mapping[str, Any]], ...] = (
    (mw.Barrier, {"stiffness": 1e3, "activation_gap": 1e-4, "wall": "surface"}),
    (mw.Friction, {"static": 0.1, "kinetic": 0.1, "drag": 0.0, "along": ()}),
    (mw.Command, {"feed_speed": 0.0, "twist_rate": 0.0, "inputs": None, "duration": 0.1}),
    (
        mw.Demands,
        {
            "tip_clearance": 0.4,
            "stability_margin": 1.0,
            "field_tolerance": 0.05,
            "gain_tolerance": 0.0,
            "max_field": 0.1,
            "max_field_rate": 1.0,
        },
    ),
    (mw.Feed, {"speed": 1e-3, "distance": 0.01, "twist": 0.0}),
    (mw.Feed.table, {"times": [0.0, 1.0], "speeds": [1e-3, 1e-3], "twists": None}),
    (mw.ForceLimit, {"tip": 1e-3, "wall": 1e-3, "push": 1e-3}),
    (mw.UniformField, {"flux_density": (0.0, 0.0, 0.0)}),
    (
        mw.GradientField,
        {"flux_density": (0.0, 0.0, 0.0), "gradient": np.zeros((3, 3)), "origin": (0.0, 0.0, 0.0)},
    ),
    (mw.Hold, {"position": (0.0, 0.0, 0.0), "direction": (1.0, 0.0, 0.0), "turn": 0.0}),
    (mw.Lumen, {"branches": LUMEN.branches, "paths": {}, "target": None}),
    (mw.Lumen.straight, {"length": 0.1, "radius": 3e-3}),
    (mw.Lumen.half_circle, {"centreline_radius": 0.03, **TUBES}),
    (mw.Lumen.sinusoid, {"amplitude": 0.005, "period": 0.05, "length": 0.1, **TUBES}),
    (mw.Lumen.helix, {"helix_radius": 0.02, "pitch": 0.02, "length": 0.1, **TUBES}),
    (mw.Lumen.through, {"points": [[0.0, 0, 0], [0.1, 0, 0]], "radius": 3e-3}),
    (mw.Lumen.bends, {"table": [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0]], **TUBES}),
    (mw.Lumen.tree, {"branches": {"ahead": LUMEN}, "target": None, "blend": None}),
    (
        mw.Lumen.ways,
        {"balls": {"a": [[0, 0, 0, 3e-3], [0.1, 0, 0, 3e-3]]}, "target": None, "blend": None},
    ),
    (mw.Lumen.read, {"path": "none.vtp", "units": None, "target": None}),
    (LUMEN.with_entry, {"length": 0.01}),
    (LUMEN.path, {"target": None}),
    (LUMEN.gap, {"points": [[0.0, 0.0, 0.0]]}),
    (LUMEN.locate, {"points": [[0.0, 0.0, 0.0]]}),
    (LUMEN.offset, {"points": [[0.0, 0.0, 0.0]]}),
    (
        mw.Make,
        {
            "diameter": 1e-3,
            "inner_diameter": None,
            "taper_to": None,
            "youngs_modulus": 1e6,
            "poisson_ratio": 0.5,
            "density": 1e3,
            "magnetization": None,
            "remanence": None,
            "rest_curvature": (0.0, 0.0),
            "rest_twist": 0.0,
        },
    ),
    (MAKE.section, {"length": 0.01}),
    (
        mw.Section,
        {
            "length": 0.05,
            "youngs_modulus": 3e6,
            "shear_modulus": 1e6,
            "radius": 0.6e-3,
            "density": 2000.0,
            "inner_radius": 0.0,
            "magnetization": (0.0, 0.0, 0.0),
            "rest_curvature": (0.0, 0.0),
            "rest_twist": 0.0,
            "end_radius": None,
            "stiffness": None,
        },
    ),
    (mw.Wire, {"sections": (SECTION,), "nodes": 20}),
    (
        mw.Wire.uniform,
        {
            "length": 0.05,
            "radius": 0.6e-3,
            "youngs_modulus": 3e6,
            "shear_modulus": 1e6,
            "density": 2000.0,
            "nodes": 20,
            "magnetized_tip": 5e-3,
            "magnetization": 128e3,
            "inner_radius": 0.0,
            "rest_curvature": (0.0, 0.0),
        },
    ),
    (mw.Wire.of, {"make": MAKE, "length": 0.05, "nodes": 20, "magnetized_tip": 5e-3}),
    (mw.Schedule, {"feed": [0.0, 0.1], "flux_density": np.zeros((2, 3))}),
    (SCHEDULE.at, {"feed": 0.0}),
    (SCHEDULE.scaled, {"factor": 1.0}),
    (mw.TipNavigator, {"demands": mw.Demands(), "update_every": 1e-3, "plan_every": None}),
    (
        mw.StableNavigator,
        {"system": SIMULATION.system, "path": None, "demands": None, "plan_every": None},
    ),
    (
        mw.Simulation,
        {
            "wire": WIRE,
            "lumen": LUMEN,
            "field": None,
            "contact": None,
            "friction": None,
            "actuator": Uniform(),
            "damping": 0.01,
            "gravity": (0.0, 0.0, 0.0),
            "fluid_density": 0.0,
            "tip_load": (0.0, 0.0, 0.0),
            "release": "sliding",
        },
    ),
    (mw.Result, {"dataset": None}),
    (mw.Result.load, {"path": "none.nc"}),
    (mw.Vessel.read, {"path": "none.vtp", "units": None, "radius": None, "scale": 1.0}),
    (mw.load_device, {"name": "guidewire-035"}),
    (mw.load_device("guidewire-035").wire, {"length": None, "nodes": None}),
    (
        partial(mw.plan, outlets=("nowhere",)),
        {"lumen": TREE, "wire": WIRE, "demands": None, "contact": None},
    ),
    (mw.run_many, {"scenarios": (), "workers": 1, "cluster": None}),
)


def title(make: Callable[..., object]) -> str:
    inner = make.func if isinstance(make, partial) else make
    return f"{inner.__qualname__}"


CASES = {f"{title(make)}-{name}": (make, good, name) for make, good in PLACES for name in good}


@pytest.mark.parametrize("case", CASES)
def test_a_wrong_thing_ends_in_a_sentence(case: str) -> None:
    make, good, name = CASES[case]
    for wrong in WRONG:
        try:
            make(**{**good, name: wrong})
        except mw.MagwireError as error:
            message = str(error)
            assert message.endswith((".", "?"))
            assert len(message) < 900


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: mw.Simulation(LUMEN, WIRE),
            "Input wire of Simulation must be a Wire; received a Lumen.",
        ),
        (
            lambda: mw.Simulation(WIRE, LUMEN, contact=mw.Barrier),
            "Input contact of Simulation must be a Barrier; received the class Barrier itself.",
        ),
        (
            lambda: mw.Simulation(WIRE, LUMEN, field=mw.UniformField),
            "Input field of Simulation must be three components [T] or a field with at(points) and "
            "affine, such as UniformField(); received the class UniformField itself.",
        ),
        (
            lambda: mw.Simulation(WIRE, LUMEN, field=NoAffine()),
            "Input field of Simulation must be three components [T] or a field with at(points) and "
            "affine, such as UniformField(); received a NoAffine.",
        ),
        (
            lambda: mw.Simulation(WIRE, LUMEN, actuator=mw.UniformField()),
            "Input actuator of Simulation must be an Actuator; received a UniformField.",
        ),
        (
            lambda: mw.plan(WIRE, LUMEN),
            "Input lumen of plan must be a Lumen; received a Wire.",
        ),
        (
            lambda: mw.Wire(SECTION, 20),
            "Input sections of Wire must be a list of Section; received a Section.",
        ),
        (
            lambda: mw.Wire.of(SECTION, 0.05, 20),
            "Input make of Wire must be a Make; received a Section.",
        ),
        (
            lambda: mw.TipNavigator(1e-3),
            "Input demands of TipNavigator must be a Demands; received 0.001.",
        ),
        (
            lambda: mw.StableNavigator(SIMULATION),
            "Input system of StableNavigator must be a System; received a Simulation.",
        ),
        (
            lambda: mw.run_many("half-circle"),
            "Input scenarios of run_many must be a list of scenarios; received 'half-circle'.",
        ),
        (
            lambda: mw.Result("result.nc"),
            "Input dataset of Result must be an xarray Dataset; received 'result.nc'.",
        ),
    ],
)
def test_sentences(make: Callable[[], object], message: str) -> None:
    with pytest.raises(mw.InputError) as caught:
        make()
    assert str(caught.value) == message


def test_three_components_are_a_field() -> None:
    assert mw.Simulation(WIRE, LUMEN, field=[0.0, 0.01, 0.0]).field == mw.UniformField((0, 0.01, 0))


def test_what_runs_a_simulation_is_looked_at() -> None:
    wire = mw.Wire.uniform(0.05, 5e-4, 3e6, 1e6, 2e3, 21)
    simulation = mw.Simulation(wire, mw.Lumen.straight(0.1, 3e-3))
    feed = mw.Feed(1e-3, 0.01)
    for call, said in (
        (lambda: simulation.run(0.02), "feed of Simulation.run must be a Feed; received 0.02"),
        (lambda: simulation.run(feed, "stable"), "navigator of Simulation.run must be a navigator"),
        (lambda: simulation.run(feed, mw.TipNavigator), "received the class TipNavigator itself"),
        (lambda: simulation.session(navigator=3), "navigator of Simulation.session must be"),
        (lambda: simulation.equilibrium(0.01, mw.UniformField), "received the class UniformField"),
        (lambda: simulation.equilibrium(0.01, start=3), "start of Simulation.equilibrium must be"),
    ):
        with pytest.raises(mw.InputError, match=said):
            call()
    assert repr(simulation).startswith("Simulation of\n  Wire of 50 mm")
    assert repr(simulation.equilibrium(0.01)).startswith("<Equilibrium: stable, 10 mm inserted")

"""Every faulty input is refused with one sentence (P-17: SI units)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.errors import InputError
from magwire.field import GradientField, UniformField
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from magwire.wire import Section, Wire
from wires import lumen, paper_wire

NAN = float("nan")
ZERO = (0.0, 0.0, 0.0)


def section(**changes: Any) -> Section:
    stuff = {
        "length": 0.1,
        "youngs_modulus": 3e6,
        "shear_modulus": 1e6,
        "radius": 6e-4,
        "density": 2e3,
    }
    return Section(**{**stuff, **changes})


def wire(**changes: Any) -> Wire:
    stuff = {
        "length": 0.1,
        "radius": 6e-4,
        "youngs_modulus": 3e6,
        "shear_modulus": 1e6,
        "density": 2e3,
        "nodes": 100,
    }
    return Wire.uniform(**{**stuff, **changes})


def simulation(**options: Any) -> Simulation:
    return Simulation(paper_wire(), lumen("half-circle"), **options)


Case = tuple[Callable[[], object], str]
CASES: list[Case] = [
    (lambda: section(length=0.0), "Input length of Section must be positive; received 0 m."),
    (
        lambda: section(youngs_modulus=-1.0),
        "Input youngs_modulus of Section must be positive; received -1 Pa.",
    ),
    (
        lambda: section(shear_modulus=NAN),
        "Input shear_modulus of Section must be a finite number; received nan Pa.",
    ),
    (
        lambda: section(density="heavy"),
        "Input density of Section must be a number; received 'heavy'.",
    ),
    (
        lambda: section(inner_radius=6e-4),
        "Input inner_radius of Section must be at least 0 and below the radius 0.0006 m; "
        "received 0.0006 m.",
    ),
    (
        lambda: section(magnetization=(1.0, 2.0)),
        "Input magnetization of Section must have shape (3,); received shape (2,).",
    ),
    (
        lambda: section(rest_curvature=(1.0, NAN)),
        "Input rest_curvature of Section must be finite; received [ 1., nan] 1/m.",
    ),
    (lambda: Wire((), 100), "Input sections of Wire must be at least one Section; received ()."),
    (
        lambda: Wire((section(),), 4),
        "Input nodes of Wire must be at least 5; received 4.",
    ),
    (
        lambda: Wire((section(),), 10.5),  # type: ignore[arg-type]
        "Input nodes of Wire must be a whole number; received 10.5.",
    ),
    (
        lambda: wire(magnetized_tip=5e-3, nodes=20),
        "Input nodes of Wire must be at least 21, so that the section of 0.005 m spans an edge; "
        "received 20.",
    ),
    (
        lambda: wire(magnetized_tip=0.2),
        "Input magnetized_tip of Wire must be at most the length 0.1 m; received 0.2 m.",
    ),
    (
        lambda: wire(magnetized_tip=-0.01),
        "Input magnetized_tip of Wire must be zero or positive; received -0.01 m.",
    ),
    (lambda: wire(radius=-6e-4), "Input radius of Section must be positive; received -0.0006 m."),
    (lambda: Feed(0.0, 0.1), "Input speed of Feed must be positive; received 0 m/s."),
    (lambda: Feed(1e-3, -0.1), "Input distance of Feed must be positive; received -0.1 m."),
    (
        lambda: Feed(1e-3, 0.1, twist=NAN),
        "Input twist of Feed must be a finite number; received nan rad.",
    ),
    (
        lambda: Feed.table([0.0, 1.0], [1.0]),
        "Input speeds of Feed must have shape (2,); received shape (1,).",
    ),
    (
        lambda: Feed.table([1.0, 2.0], [1.0, 1.0]),
        "Input times of Feed must start at 0 s and rise; received [1.0, 2.0] s.",
    ),
    (
        lambda: Feed.table([0.0, 2.0, 2.0], [1.0, 1.0, 1.0]),
        "Input times of Feed must start at 0 s and rise; received [0.0, 2.0, 2.0] s.",
    ),
    (
        lambda: Feed.table([0.0, 10.0, 30.0], [1e-3, 1e-3, -3e-3]),
        "Input speeds of Feed must not pull the wire out of the guide; "
        "received a course down to a feed of -0.01 m.",
    ),
    (lambda: Barrier(stiffness=0.0), "Input stiffness of Barrier must be positive; received 0 Pa."),
    (
        lambda: Barrier(activation_gap=-1e-4),
        "Input activation_gap of Barrier must be positive; received -0.0001 m.",
    ),
    (
        lambda: Barrier(wall="inside"),  # type: ignore[arg-type]
        "Input wall of Barrier must be 'surface' or 'centreline'; received 'inside'.",
    ),
    (
        lambda: UniformField((0.0, NAN, 0.0)),
        "Input flux_density of UniformField must be finite; received [ 0., nan,  0.] T.",
    ),
    (
        lambda: UniformField(1.0),  # type: ignore[arg-type]
        "Input flux_density of UniformField must have shape (3,); received shape ().",
    ),
    (
        lambda: GradientField(ZERO, ((1.0, 0.0, 0.0), ZERO, ZERO)),
        "Input gradient of GradientField must have zero trace (div B = 0); received trace 1 T/m.",
    ),
    (
        lambda: GradientField(ZERO, ((0.0, 1.0, 0.0), ZERO, ZERO)),
        "Input gradient of GradientField must be symmetric (curl B = 0); "
        "received [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]] T/m.",
    ),
    (
        lambda: simulation(damping=-0.1),
        "Input damping of Simulation must be zero or positive; received -0.1 1/s.",
    ),
    (
        lambda: simulation(gravity=(0.0, 1.0)),
        "Input gravity of Simulation must have shape (3,); received shape (2,).",
    ),
    (
        lambda: simulation(release="sudden"),
        "Input release of Simulation must be 'sliding' or 'node'; received 'sudden'.",
    ),
    (
        lambda: Simulation(wire(radius=5e-3), Lumen.straight(0.1, 3e-3)),
        "Input wire of Simulation must be thinner than the lumen, whose smallest radius is "
        "0.003 m; received a wire radius of 0.005 m.",
    ),
    (
        lambda: simulation().run(Feed(1e-3, 0.05), time_step=0.0),
        "Input time_step of Simulation must be positive; received 0 s.",
    ),
    (
        lambda: simulation().run(Feed(1e-3, 0.2)),
        "Input distance of Feed must be at most the wire's length 0.1 m; received 0.2 m.",
    ),
    (
        lambda: simulation().run(Feed(1e-3, 0.05), record_every=-1.0),
        "Input record_every of Simulation must be positive; received -1 m.",
    ),
]


@pytest.mark.parametrize(("build", "message"), CASES, ids=range(len(CASES)))
def test_one_sentence(build: Callable[[], object], message: str) -> None:
    with pytest.raises(InputError) as error:
        build()
    assert str(error.value) == message


def test_what_is_at_the_edge_is_accepted() -> None:
    assert wire(magnetized_tip=5e-3, nodes=21).nodes == 21
    assert wire(magnetized_tip=0.1).sections[0].length == 0.1
    assert Feed.table([0.0, 10.0, 20.0], [1e-3, 0.0, -1e-3]).largest == pytest.approx(5e-3)
    thick = Simulation(
        wire(radius=5e-3), Lumen.straight(0.1, 3e-3), contact=Barrier(1e3, 1e-4, wall="centreline")
    )
    assert thick.system.wire.radius == 5e-3

"""Wires as people describe them, and tapers and rest twist on any mesh (P-4)."""

from __future__ import annotations

import itertools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

import magwire as mw
from magwire.errors import InputError
from magwire.evidence.verify.wires import order
from magwire.wire import Make, Section, Stiffness, Wire, lay_out

NITINOL: dict[str, Any] = {
    "diameter": 0.36e-3,
    "youngs_modulus": 60e9,
    "poisson_ratio": 0.33,
    "density": 6450.0,
}


def make(**changes: Any) -> Make:
    return Make(**{k: v for k, v in {**NITINOL, **changes}.items() if v is not None})


def test_moduli_by_poisson_ratio() -> None:
    section = make(inner_diameter=0.1e-3).section(0.1)
    plain = Section(0.1, 60e9, 60e9 / (2 * 1.33), 0.18e-3, 6450.0, inner_radius=0.05e-3)
    assert section == plain


def test_stiffness_as_it_is_given() -> None:
    ei, gj = 2e-5, 1.4e-5
    stated = make(
        youngs_modulus=None, poisson_ratio=None, bending_stiffness=ei, twisting_stiffness=gj
    )
    section = stated.section(0.1)
    assert (section.bending_stiffness, section.twisting_stiffness) == (ei, gj)
    area, second = np.pi * 0.18e-3**2, np.pi * 0.18e-3**4 / 4.0
    assert section.stretching_stiffness == pytest.approx(ei * area / second, rel=1e-12)
    coil = replace(stated, stretching_stiffness=30.0).section(0.1)
    assert coil.stretching_stiffness == 30.0
    rubber = replace(stated, twisting_stiffness=None, poisson_ratio=0.5).section(0.1)
    assert rubber.twisting_stiffness == pytest.approx(ei / 1.5, rel=1e-12)


def test_the_same_wire_in_other_words() -> None:
    """Stiffness and mass given directly or by moduli and density: one mesh, and one shape."""
    plain = Wire.of(make(magnetization=100e3), 0.05, 41, magnetized_tip=4e-3)
    body = plain.sections[0]
    other = make(
        youngs_modulus=None,
        poisson_ratio=None,
        density=None,
        bending_stiffness=body.bending_stiffness,
        twisting_stiffness=body.twisting_stiffness,
        mass_per_length=body.density * body.area,
        remanence=100e3 * 4e-7 * np.pi,
    )
    again = Wire.of(other, 0.05, 41, magnetized_tip=4e-3)
    for name, value in vars(lay_out(plain)).items():
        np.testing.assert_allclose(getattr(lay_out(again), name), value, rtol=1e-9, err_msg=name)
    tips = [
        mw.Simulation(wire, mw.Lumen.open_space()).equilibrium(0.05, [0.0, 1.0, 0.0]).tip
        for wire in (plain, again)
    ]
    np.testing.assert_allclose(tips[1], tips[0], atol=1e-9)
    assert tips[0][1] > 1e-4


def test_remanence_is_a_flux_density_of_the_magnetisation() -> None:
    """1.2 T, as of a neodymium magnet, are 955 kA/m."""
    section = make(remanence=1.2).section(0.01)
    assert section.magnetization == pytest.approx((0.0, 0.0, 1.2 / (4e-7 * np.pi)), rel=1e-9)
    assert section.magnetization[2] == pytest.approx(954.93e3, rel=1e-5)
    assert section.describe().endswith("magnetised 954.93 kA/m (remanence 1.2 T)")
    across = make(remanence=(0.6, 0.0, 0.6)).section(0.01)
    assert across.magnetization[0] == across.magnetization[2] > 0.0


@pytest.mark.parametrize(
    ("changes", "sentences"),
    [
        (
            {"radius": 0.18e-3},
            ["Input radius of Make cannot stand next to diameter of Make; remove one of them."],
        ),
        (
            {"shear_modulus": 20e9},
            ["Input shear_modulus of Make cannot stand next to poisson_ratio of Make; remove one "
             "of them."],
        ),
        (
            {"bending_stiffness": 1e-5, "mass_per_length": 1e-3, "diameter": None},
            [
                "Input youngs_modulus of Make cannot stand next to bending_stiffness of Make; "
                "remove one of them.",
                "Input density of Make cannot stand next to mass_per_length of Make; remove one "
                "of them.",
                "Input radius of Make is missing; give it, or diameter of Make.",
            ],
        ),
        (
            {"poisson_ratio": None, "twisting_stiffness": 1e-5},
            ["Input twisting_stiffness of Make cannot stand next to youngs_modulus of Make; remove "
             "one of them."],
        ),
        (
            {"poisson_ratio": 0.6, "diameter": -1e-3},
            [
                "Input diameter of Make must be positive; received -0.001 m.",
                "Input poisson_ratio of Make must be between 0 and 0.5; received 0.6.",
            ],
        ),
    ],
)  # fmt: skip
def test_all_that_is_wrong_at_once(changes: dict[str, Any], sentences: list[str]) -> None:
    with pytest.raises(InputError) as error:
        make(**changes)
    assert str(error.value) == " ".join(sentences)


def test_moduli_or_stiffness() -> None:
    with pytest.raises(InputError, match="Input stiffness of Section must stand in place of"):
        Section(0.1, 1e9, None, 1e-3, 1e3)
    with pytest.raises(InputError, match="Input stiffness of Section must stand in place of"):
        Section(0.1, 1e9, 1e9, 1e-3, 1e3, stiffness=Stiffness(1.0, 1.0, 1.0))
    with pytest.raises(InputError, match="end_radius of Section cannot stand next to a stiffness"):
        Section(0.1, None, None, 1e-3, 1e3, end_radius=1e-4, stiffness=Stiffness(1.0, 1.0, 1.0))
    with pytest.raises(InputError, match="bending of Stiffness must be positive"):
        Stiffness(0.0, 1.0, 1.0)


@settings(max_examples=30, deadline=None)
@given(
    end=st.floats(0.05, 3.0), bore=st.floats(0.0, 0.9), at=st.floats(0.3, 0.7),
    nodes=st.integers(7, 120),
)  # fmt: skip
def test_every_cell_of_a_taper(end: float, bore: float, at: float, nodes: int) -> None:
    """Against quadrature, cell by cell and edge by edge; the taper ends somewhere in a cell."""
    shaft = Section(at * 0.1, 1e9, 4e8, 0.3e-3, 3000.0)
    taper = Section((1.0 - at) * 0.1, 2e9, 7e8, 0.3e-3, 5000.0, inner_radius=bore * 0.3e-3,
                    magnetization=(0.0, 0.0, 1e5), end_radius=end * 0.3e-3)  # fmt: skip
    mesh = lay_out(Wire((shaft, taper), nodes))

    def section(s: float) -> Section:
        if s < at * 0.1:
            return shaft
        outer = 0.3e-3 * (1.0 + (end - 1.0) * (s - at * 0.1) / taper.length)
        return replace(taper, radius=outer, inner_radius=bore * outer, end_radius=None)

    def over(bounds: np.ndarray, density: Any) -> float:
        inside = [end for end in (at * 0.1,) if bounds[0] < end < bounds[1]]
        ends = [bounds[0], *inside, bounds[1]]
        whole = [
            quad(lambda s: density(section(s)), a, b, epsabs=0.0, epsrel=1e-10)[0]
            for a, b in itertools.pairwise(ends)
        ]
        return float(sum(whole))

    few = slice(max(0, nodes // 3 - 2), None, max(1, nodes // 12))
    cells = np.concatenate(([0.0], mesh.cell_end))
    pick = np.arange(nodes)[few]
    for k in pick:
        here = cells[k : k + 2]
        bend = 1.0 / over(here, lambda s: 1.0 / s.bending_stiffness)
        assert mesh.bending_stiffness[k] == pytest.approx(bend, rel=1e-7)
        twist = 1.0 / over(here, lambda s: 1.0 / s.twisting_stiffness)
        assert mesh.twisting_stiffness[k] == pytest.approx(twist, rel=1e-7)
        assert mesh.mass[k] == pytest.approx(over(here, lambda s: s.density * s.area), rel=1e-7)
        assert mesh.radius[k] == pytest.approx(section(mesh.station[k]).radius, rel=1e-7)
    for k in pick[pick < nodes - 1]:
        here = mesh.station[k : k + 2]
        soft = over(here, lambda s: 1.0 / s.stretching_stiffness)
        stretch = mesh.edge_length[k] / soft
        assert mesh.stretching_stiffness[k] == pytest.approx(stretch, rel=1e-7)
        moment = over(here, lambda s: s.moment_per_length[2])
        assert mesh.moment[k, 2] == pytest.approx(moment, rel=1e-7, abs=1e-18)
        ring = over(here, lambda s: 0.5 * s.density * s.area * (s.radius**2 + s.inner_radius**2))
        assert mesh.axial_inertia[k] == pytest.approx(ring, rel=1e-7)


def test_cantilever_with_a_taper_over_four_decades_of_stiffness() -> None:
    """Diameter falling to a tenth: tip by unit loads, y = P int (L - s)^2/EI ds."""
    length, ei = 0.1, 60e9 * np.pi * 0.5e-3**4 / 4.0
    wire = Wire.of(make(diameter=1e-3, taper_to=0.1e-3), length, 201)
    exact = quad(lambda s: (1.0 - s) ** 2 / (1.0 - 0.9 * s) ** 4, 0.0, 1.0)[0] * length**3 / ei
    force = 1e-5 * length / exact
    sim = mw.Simulation(wire, mw.Lumen.open_space(), tip_load=(0.0, force, 0.0))
    assert sim.equilibrium(length).tip[1] == pytest.approx(force * exact, rel=1e-3)


def test_a_wire_of_one_taper_keeps_it_through_its_magnet() -> None:
    wire = Wire.of(make(taper_to=0.18e-3, magnetization=1e5), 0.1, 101, magnetized_tip=0.01)
    body, tip = wire.sections
    assert body.end_radius == pytest.approx(tip.radius) == pytest.approx(0.18e-3 - 0.9 * 0.09e-3)
    assert tip.end_radius == pytest.approx(0.09e-3)
    assert wire.radius == 0.18e-3
    assert body.magnetization == (0.0, 0.0, 0.0)
    assert wire.length == pytest.approx(0.1, rel=1e-15)


def test_rest_curvature_and_twist_make_a_helix() -> None:
    """Curvature k and torsion t, with T, N, B at the clamp along x, z (which is m1) and -y."""
    k, t, s = 60.0, 80.0, 0.1
    w = np.hypot(k, t)
    exact = np.array(
        [
            (k**2 * np.sin(w * s) / w + t**2 * s) / w**2,
            -k * t * (s - np.sin(w * s) / w) / w**2,
            k * (1.0 - np.cos(w * s)) / w**2,
        ]
    )
    errors = []
    for nodes in (41, 81, 161):
        wire = Wire.of(make(rest_curvature=(k, 0.0), rest_twist=t), s, nodes)
        state = mw.Simulation(wire, mw.Lumen.open_space()).equilibrium(s)
        errors.append(np.linalg.norm(state.tip - exact) / s)
    assert order([1 / 40, 1 / 80, 1 / 160], errors) == pytest.approx(2.0, abs=0.1)
    assert errors[-1] < 1e-3


def test_rest_twist_turns_what_lies_across_and_totals_stay() -> None:
    """Against quadrature: moment of every edge, over three sections, of which two are twisted."""
    stuff = {"youngs_modulus": 1e9, "shear_modulus": 4e8, "radius": 0.3e-3, "density": 3e3}
    parts = [
        Section(0.02, rest_twist=40.0, magnetization=(1e5, 0.0, 2e4), **stuff),  # type: ignore[arg-type]
        Section(0.03, magnetization=(1e5, 5e4, 0.0), **stuff),  # type: ignore[arg-type]
        Section(0.05, rest_twist=-90.0, magnetization=(0.0, 3e4, 1e4), **stuff),  # type: ignore[arg-type]
    ]
    mesh = lay_out(Wire(tuple(parts), 24))
    area = parts[0].area

    def density(s: float) -> tuple[complex, float]:
        angle = 40.0 * min(s, 0.02) - 90.0 * max(s - 0.05, 0.0)
        m1, m2, m3 = parts[0 if s < 0.02 else 1 if s < 0.05 else 2].magnetization
        return (m1 + 1j * m2) * np.exp(1j * angle) * area, m3 * area

    points, weight = np.polynomial.legendre.leggauss(2000)
    for k, (a, b) in enumerate(zip(mesh.station[:-1], mesh.station[1:], strict=True)):
        found = [density(0.5 * (a + b) + 0.5 * (b - a) * x) for x in points]
        across = 0.5 * (b - a) * sum(w * f[0] for w, f in zip(weight, found, strict=True))
        along = 0.5 * (b - a) * sum(w * f[1] for w, f in zip(weight, found, strict=True))
        expected = [across.real, across.imag, along]
        np.testing.assert_allclose(mesh.moment[k], expected, atol=1e-3 * area * 1e5 * (b - a))

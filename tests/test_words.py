"""What is shown of an object is short, and has units."""

from __future__ import annotations

import numpy as np

import magwire as mw

AHEAD = mw.Lumen.straight(0.1, 3e-3)
ASIDE = mw.Lumen.through([[0.02, 0, 0], [0.04, 0.02, 0], [0.05, 0.05, 0]], 2e-3)
WIRE = mw.Wire.uniform(
    0.05, 0.6e-3, 3e6, 1e6, 2000.0, 50, magnetized_tip=5e-3, magnetization=mw.across(128e3)
)


def test_a_wire_lists_its_sections() -> None:
    lines = repr(WIRE).splitlines()
    assert lines[0] == "Wire of 50 mm, 2 sections, 50 nodes, proximal first:"
    assert lines[1].startswith("  45 mm: diameter 1.2 mm, EI 3.054e-07 N m^2")
    assert lines[2].endswith("magnetised 128 kA/m across the axis (remanence 0.1608 T)")


def test_a_slanted_magnetisation_is_told_from_an_axial_one() -> None:
    section = mw.Section(0.05, 3e6, 1e6, 1e-3, 2e3, magnetization=(1e5, 0.0, 1e5))
    assert "141.421 kA/m at 45 deg to the axis" in section.describe()


def test_a_wire_of_many_sections_stays_short() -> None:
    section = mw.Section(0.01, 3e6, 1e6, 1e-3, 2e3)
    lines = repr(mw.Wire((section,) * 60, 100)).splitlines()
    assert len(lines) == 6
    assert lines[4] == "  56 more"


def test_lumens() -> None:
    assert repr(AHEAD) == "<Lumen: tube of 100 mm, radius 3 mm>"
    assert repr(mw.Lumen.open_space()) == "<Lumen: open space, no wall>"
    tree = mw.Lumen.tree({"ahead": AHEAD, "aside": ASIDE}, target="aside")
    assert repr(tree) == (
        "<Lumen: tree of 2 branches, radius 2 mm to 3 mm; outlets 'ahead', 'aside'; target 'aside'>"
    )


def test_feeds() -> None:
    assert repr(mw.Feed(1e-3, 0.075)) == "<Feed: 75 mm in 75 s, at up to 1 mm/s>"
    there_and_back = mw.Feed.table([0, 1, 2], [1e-3, 0, -1e-3], [0, 0, np.pi])
    assert repr(there_and_back) == (
        "<Feed: 0.5 mm, back to 0 mm, in 2 s, at up to 1 mm/s, twisted 0 deg to 180 deg>"
    )


def test_what_is_simulated() -> None:
    simulation = mw.Simulation(WIRE, AHEAD, gravity=(0.0, 0.0, -9.81), tip_load=(1e-3, 0.0, 0.0))
    lines = repr(simulation).splitlines()
    assert lines[0] == "Simulation of"
    assert "  <Lumen: tube of 100 mm, radius 3 mm>" in lines
    assert "  inputs Bx [T], By [T], Bz [T]" in lines
    assert lines[-1] == "  damping 0.01 1/s, gravity 9.81 m/s^2, tip load 1 mN"
    assert repr(simulation.system).startswith("System of\n")


def test_an_equilibrium() -> None:
    words = repr(mw.Simulation(WIRE, AHEAD).equilibrium(0.02))
    assert words == (
        "<Equilibrium: stable, 20 mm inserted, tip at (20, 0, 0) mm, smallest clearance 2.4 mm, "
        "force of the wall 0 mN on the wire and 0 mN on the tip>"
    )

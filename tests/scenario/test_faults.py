"""Faulty scenarios: each has its plain sentence, exit status 1, and leaves nothing behind."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import pytest

from magwire.cli import main
from magwire.errors import ScenarioError
from magwire.scenario import load, parse


class Fault(NamedTuple):
    name: str
    keys: tuple[str, ...]
    sentence: str
    scenario: str = "half-circle"


STABLE = ("navigate.method=stable",)
SCHEDULE = "navigate.method=schedule"
KNOT = "['1 mm', '0 mT', '1 mT', '0 mT']"

FAULTS = (
    Fault(
        "negative radius",
        ("wire.radius=-0.6 mm",),
        "Input wire.radius must be positive; received -0.6 mm.",
    ),
    Fault(
        "zero radius of the lumen",
        ("lumen.radius=0 mm",),
        "Input lumen.radius must be positive; received 0 mm.",
    ),
    Fault(
        "wire wider than the lumen",
        ("wire.radius=4 mm",),
        "Input wire.radius must be smaller than the lumen's smallest radius, 3 mm; received 4 mm.",
    ),
    Fault(
        "bore wider than the wire",
        ("wire.inner_radius=0.6 mm",),
        "Input wire.inner_radius must be smaller than wire.radius, 0.6 mm; received 0.6 mm.",
    ),
    Fault(
        "negative bore",
        ("wire.inner_radius=-0.1 mm",),
        "Input wire.inner_radius must be zero or positive; received -0.1 mm.",
    ),
    Fault(
        "negative stiffness",
        ("wire.youngs_modulus=-3 MPa",),
        "Input wire.youngs_modulus must be positive; received -3 MPa.",
    ),
    Fault(
        "negative density",
        ("wire.density=-2000 kg/m^3",),
        "Input wire.density must be positive; received -2000 kg/m^3.",
    ),
    Fault(
        "misspelt key",
        ("wire.raduis=0.5 mm",),
        "Input wire.raduis is not a key of [wire]; did you mean 'radius'?",
    ),
    Fault(
        "unknown key",
        ("contact.slipperiness=0.1",),
        "Input contact.slipperiness is not a key of [contact]; expected one of 'stiffness', "
        "'activation_gap', 'wall', 'foundation', 'friction', 'breathing', 'pulsation'.",
    ),
    Fault(
        "key of another shape",
        ("lumen.pitch=10 mm",),
        "Input lumen.pitch is not a key of [lumen] with shape 'half-circle'; expected one of "
        "'entry', 'radius', 'shape', 'centreline_radius', 'points'.",
    ),
    Fault(
        "misspelt table",
        ("contcat.wall=surface",),
        "Input contcat is not a key of the scenario; did you mean 'contact'?",
    ),
    Fault(
        "unit of another kind",
        ("wire.length=100 ms",),
        "Input wire.length needs a unit of length such as '5 mm'; received '100 ms', which is a "
        "time.",
    ),
    Fault(
        "unit that does not exist",
        ("wire.length=4 inches",),
        "Input wire.length needs a unit of length such as '5 mm'; received '4 inches'.",
    ),
    Fault(
        "missing unit",
        ("solver.time_step=10",),
        "Input solver.time_step needs a unit of time such as '10 ms'; received 10.",
    ),
    Fault(
        "unit without a number",
        ("feed.speed=mm/s",),
        "Input feed.speed must be a number with a unit of speed such as '1 mm/s'; received 'mm/s'.",
    ),
    Fault(
        "not a number",
        ("wire.youngs_modulus=nan MPa",),
        "Input wire.youngs_modulus must be a finite number; received nan MPa.",
    ),
    Fault(
        "TOML's not a number",
        ("wire.length=nan",),
        "Input wire.length must be a finite number; received nan.",
    ),
    Fault(
        "infinite length",
        ("feed.distance=inf mm",),
        "Input feed.distance must be a finite number; received inf mm.",
    ),
    Fault(
        "too large for a number",
        ("wire.density=1e400 kg/m^3",),
        "Input wire.density must be a finite number; received 1e400 kg/m^3.",
    ),
    Fault(
        "list in place of a quantity",
        ("wire.radius=[1, 2]",),
        "Input wire.radius must be text such as '5 mm'; received [1, 2].",
    ),
    Fault(
        "half-circle sharper than its radius",
        ("lumen.centreline_radius=2.5 mm", "feed.distance=7 mm"),
        "Input lumen must bend with a radius larger than lumen.radius, 3 mm; received a bend "
        "radius of 2.5 mm.",
    ),
    Fault(
        "sinusoid sharper than its radius",
        ("lumen.period=40 mm",),
        "Input lumen must bend with a radius larger than lumen.radius, 3 mm; received a bend "
        "radius of 2.7019 mm.",
        "sinusoid",
    ),
    Fault(
        "helix sharper than its radius",
        ("lumen.helix_radius=2 mm", "lumen.pitch=5 mm"),
        "Input lumen must bend with a radius larger than lumen.radius, 3 mm; received a bend "
        "radius of 2.31663 mm.",
        "helix",
    ),
    Fault(
        "too few nodes for the magnetised tip",
        ("wire.nodes=15",),
        "Input wire.nodes must be at least 21 for a magnetised tip of 5 mm to span one edge; "
        "received 15.",
    ),
    Fault(
        "too few nodes for a wire",
        ("wire.nodes=2",),
        "Input wire.nodes must be at least 4; received 2.",
    ),
    Fault(
        "points that take gigabytes",
        ("lumen.points=1000000",),
        "Input lumen.points must be at most 200000; received 1000000.",
    ),
    Fault(
        "too many nodes for any machine",
        ("wire.nodes=1000000000",),
        "Input wire.nodes must be at most 100000; received 1000000000.",
    ),
    Fault(
        "half a node",
        ("wire.nodes=20.5",),
        "Input wire.nodes must be a whole number without a unit; received 20.5.",
    ),
    Fault(
        "nodes in words",
        ("wire.nodes=many",),
        "Input wire.nodes must be a whole number without a unit; received 'many'.",
    ),
    Fault(
        "magnetised tip longer than the wire",
        ("wire.magnetized_tip=200 mm",),
        "Input wire.magnetized_tip must be at most wire.length, 100 mm; received 200 mm.",
    ),
    Fault(
        "magnetisation without a magnetised tip",
        ("wire.magnetized_tip=0 mm",),
        "Input wire.magnetized_tip must be positive for a wire with wire.magnetization; "
        "received 0 mm.",
    ),
    Fault(
        "magnetisation with two components",
        ("wire.magnetization=['1 kA/m', '2 kA/m']",),
        "Input wire.magnetization must have 3 entries; received 2.",
    ),
    Fault(
        "feed longer than the wire",
        ("lumen.centreline_radius=50 mm", "feed.distance=120 mm"),
        "Input feed.distance must be at most the length of the wire, 100 mm; received 120 mm.",
    ),
    Fault(
        "feed longer than the lumen",
        ("feed.distance=80 mm",),
        "Input feed.distance must be at most the length of the lumen, 78.5398 mm; received 80 mm.",
    ),
    Fault(
        "feeding backwards",
        ("feed.speed=-1 mm/s",),
        "Input feed.speed must be positive; received -1 mm/s.",
    ),
    Fault(
        "zero time step",
        ("solver.time_step=0 ms",),
        "Input solver.time_step must be positive; received 0 ms.",
    ),
    Fault(
        "time step longer than the run",
        ("solver.time_step=2 min",),
        "Input solver.time_step must be at most the duration of the feed, 72 s; received 120 s.",
    ),
    Fault(
        "negative damping",
        ("solver.damping=-1 1/s",),
        "Input solver.damping must be zero or positive; received -1 1/s.",
    ),
    Fault(
        "unknown release",
        ("solver.release=drop",),
        "Input solver.release must be 'sliding' or 'node'; received 'drop'.",
    ),
    Fault(
        "unknown shape",
        ("lumen.shape=half_circle",),
        "Input lumen.shape must be one of 'straight', 'half-circle', 'sinusoid', 'helix', "
        "'tree', 'aortic-arch', 'carotid-bifurcation', 'coronary-tree', 'tortuous', 'points', "
        "'vessel'; received 'half_circle', did you mean 'half-circle'?",
    ),
    Fault(
        "shape that is no text",
        ("lumen.shape=3",),
        "Input lumen.shape must be one of 'straight', 'half-circle', 'sinusoid', 'helix', "
        "'tree', 'aortic-arch', 'carotid-bifurcation', 'coronary-tree', 'tortuous', 'points', "
        "'vessel'; received 3.",
    ),
    Fault(
        "branch that a vessel with a formula lacks",
        ("lumen.target=diagonal 3",),
        "Input lumen.target must be one of the outlets 'anterior', 'circumflex', 'diagonal 1', "
        "'diagonal 2'; received 'diagonal 3'.",
        "coronary",
    ),
    Fault(
        "arch that is wider than its bend",
        ("lumen.arch_radius=10 mm", "wire.radius=20 mm"),
        "Input lumen.arch_radius must be larger than the lumen's radius 0.014 m; received 0.01 m.",
        "aortic-arch",
    ),
    Fault(
        "carotid arteries that part at no angle",
        ("lumen.angle=0 deg",),
        "Input lumen.angle must be positive; received 0 deg.",
        "carotid",
    ),
    Fault(
        "carotid arteries that turn back",
        ("lumen.angle=2.5 rad",),
        "Input lumen must bend with a radius larger than the lumen's; received a bend of radius "
        "0.00149714 m in a lumen of radius 0.00319908 m at arc length 0.0568533 m, near "
        "(0.00178729, 0, 0.0562029) m.",
        "carotid",
    ),
    Fault(
        "unknown wall",
        ("contact.wall=middle",),
        "Input contact.wall must be 'surface' or 'centreline'; received 'middle'.",
    ),
    Fault(
        "activation gap larger than the lumen",
        ("contact.activation_gap=3.5 mm",),
        "Input contact.activation_gap must be smaller than the free gap of the lumen, 3 mm; "
        "received 3.5 mm.",
    ),
    Fault(
        "activation gap larger than the free gap of the surface",
        ("contact.activation_gap=2.5 mm", "contact.wall=surface"),
        "Input contact.activation_gap must be smaller than the free gap of the lumen, 2.4 mm; "
        "received 2.5 mm.",
    ),
    Fault(
        "field of two components",
        ("field.flux_density=['0 mT', '1 mT']",),
        "Input field.flux_density must have 3 entries; received 2.",
    ),
    Fault(
        "field that is no list",
        ("field.flux_density=10 mT",),
        "Input field.flux_density must be a list such as ['10 mT', '10 mT', '10 mT']; "
        "received '10 mT'.",
    ),
    Fault(
        "magnetic monopole",
        (
            "field={kind='gradient', gradient=[['1 T/m','0 T/m','0 T/m'],"
            "['0 T/m','0 T/m','0 T/m'],['0 T/m','0 T/m','0 T/m']]}",
        ),
        "Input field.gradient must have a trace of zero (no sources of flux); received 1 T/m.",
    ),
    Fault(
        "gradient that is not symmetric",
        (
            "field={kind='gradient', gradient=[['0 T/m','1 T/m','0 T/m'],"
            "['0 T/m','0 T/m','0 T/m'],['0 T/m','0 T/m','0 T/m']]}",
        ),
        "Input field.gradient must be symmetric (no currents in the lumen); received a difference "
        "of 1 T/m across the diagonal.",
    ),
    Fault(
        "table that is no table",
        ("contact=hard",),
        "Input contact must be a table; received 'hard'.",
    ),
    Fault(
        "title that is no text",
        ("title=3",),
        "Input title must be text; received 3.",
    ),
    Fault(
        "unknown navigator",
        ("navigate.method=magic",),
        "Input navigate.method must be one of 'none', 'stable', 'newton', 'paper', 'schedule', "
        "'inputs', 'timed'; received 'magic'.",
    ),
    Fault(
        "key of another way to steer",
        (*STABLE, "navigate.file=x.csv"),
        "Input navigate.file is not a key of [navigate] with method 'stable'; expected one of "
        "'method', 'update_every', 'friction', 'objective', 'plan_every', 'tip_clearance', "
        "'stability_margin', 'field_tolerance', 'gain_tolerance', 'max_field', 'max_field_rate', "
        "'attempts'.",
    ),
    Fault(
        "clearance for nobody who steers",
        ("navigate.tip_clearance=0.5",),
        "Input navigate.tip_clearance is not a key of [navigate] with method 'none'; expected one "
        "of 'method'.",
    ),
    Fault(
        "tip farther from the wall than the centreline",
        (*STABLE, "navigate.tip_clearance=1.2"),
        "Input navigate.tip_clearance must be from 0 to 1; received 1.2.",
    ),
    Fault(
        "tip in the wall",
        (*STABLE, "navigate.tip_clearance=-0.1"),
        "Input navigate.tip_clearance must be from 0 to 1; received -0.1.",
    ),
    Fault(
        "clearance as a length",
        (*STABLE, "navigate.tip_clearance=1.5 mm"),
        "Input navigate.tip_clearance must be a plain number from 0 to 1; received '1.5 mm'.",
    ),
    Fault(
        "clearance that is no number",
        (*STABLE, "navigate.tip_clearance=nan"),
        "Input navigate.tip_clearance must be from 0 to 1; received nan.",
    ),
    Fault(
        "no margin of stability",
        (*STABLE, "navigate.stability_margin=0 1/s^2"),
        "Input navigate.stability_margin must be positive; received 0 1/s^2.",
    ),
    Fault(
        "margin of stability as a rate",
        (*STABLE, "navigate.stability_margin=1 1/s"),
        "Input navigate.stability_margin needs a unit of squared rate such as '1 1/s^2'; received "
        "'1 1/s', which is a rate.",
    ),
    Fault(
        "field that may be off by all of it",
        (*STABLE, "navigate.field_tolerance=1"),
        "Input navigate.field_tolerance must be from 0 to 0.5; received 1.",
    ),
    Fault(
        "no field allowed",
        (*STABLE, "navigate.max_field=0 mT"),
        "Input navigate.max_field must be positive; received 0 mT.",
    ),
    Fault(
        "field rate per time",
        (*STABLE, "navigate.max_field_rate=5 mT"),
        "Input navigate.max_field_rate needs a unit of flux gradient such as '0.5 T/m'; received "
        "'5 mT', which is a flux density.",
    ),
    Fault(
        "never an update",
        (*STABLE, "navigate.update_every=0 mm"),
        "Input navigate.update_every must be positive; received 0 mm.",
    ),
    Fault(
        "nothing to steer by",
        (*STABLE, "wire.magnetization=0 kA/m"),
        "Input wire.magnetization must have a magnetisation for navigate.method 'stable'; "
        "received none.",
    ),
    Fault(
        "schedule without a file",
        (SCHEDULE,),
        "Input navigate.file is missing; expected a schedule as CSV file or a result file.",
    ),
    Fault(
        "schedule file that is not there",
        (SCHEDULE, "navigate.file=none.csv"),
        "Input navigate.file 'none.csv' cannot be read: no such file or directory.",
    ),
    Fault(
        "schedule from a result that is not there",
        (SCHEDULE, "navigate.file=none.nc"),
        "Input navigate.file 'none.nc' does not exist.",
    ),
    Fault(
        "schedule file that is no name",
        (SCHEDULE, "navigate.file=3"),
        "Input navigate.file must be the name of a file; received 3.",
    ),
    Fault(
        "schedule and file",
        (SCHEDULE, "navigate.file=x.csv", "navigate.table=[]"),
        "Input navigate.table cannot stand next to navigate.file; remove one of them.",
    ),
    Fault(
        "schedule that goes back",
        (SCHEDULE, f"navigate.table=[{KNOT}, {KNOT}]"),
        "Input navigate.table must have feeds that increase; received 1 mm after 1 mm.",
    ),
    Fault(
        "schedule of two components",
        (SCHEDULE, "navigate.table=[['1 mm', '0 mT', '1 mT']]"),
        "Input navigate.table (row 1) must have 4 entries; received 3.",
    ),
    Fault(
        "recording interval of zero",
        ("output.record_every=0 mm",),
        "Input output.record_every must be positive; received 0 mm.",
    ),
    Fault(
        "unknown outlet",
        ("lumen.target=lfet",),
        "Input lumen.target must be one of the outlets 'left', 'middle', 'right'; received 'lfet'.",
        "left-branch",
    ),
    Fault(
        "arc lengths that go back",
        (
            "lumen.branches.left=[['0 mm','0 1/m','0 1/m'],['9 mm','0 1/m','0 1/m'],"
            "['8 mm','0 1/m','0 1/m']]",
        ),
        "Input lumen.branches.left must have arc lengths that start at 0 mm and increase; "
        "received 0 mm, 9 mm, 8 mm.",
        "left-branch",
    ),
    Fault(
        "unit of a bend",
        ("lumen.branches.left=[['0 mm','0 1/m','0 1/m'],['80 mm','5 mm','0 1/m']]",),
        "Input lumen.branches.left (row 2) needs a unit of curvature such as '10 1/m'; "
        "received '5 mm', which is a length.",
        "left-branch",
    ),
    Fault(
        "branch that is no table",
        ("lumen.branches.left=ahead",),
        "Input lumen.branches.left must be a list of rows, each a list such as ['5 mm', '10 1/m', "
        "'10 1/m']; received 'ahead'.",
        "left-branch",
    ),
    Fault(
        "branches that are no table",
        ("lumen.branches=3",),
        "Input lumen.branches must be a table; received 3.",
        "left-branch",
    ),
    Fault(
        "tree without a branch",
        ("lumen.branches={}",),
        "Input lumen.branches must have at least one branch; received none.",
        "left-branch",
    ),
    Fault(
        "branch that never leaves",
        (
            "lumen.branches.left=[['0 mm','0 1/m','0 1/m'],['76 mm','0 1/m','0 1/m']]",
            "lumen.branches.right=[['0 mm','0 1/m','0 1/m'],['75 mm','0 1/m','0 1/m']]",
        ),
        "Input lumen.branches must leave those before them, no wider than them, and end clear of "
        "all others; 'right' runs along 'left' to its end.",
        "left-branch",
    ),
    Fault(
        "branch sharper than its radius",
        ("lumen.radius=16 mm",),
        "Input lumen must bend with a radius larger than lumen.radius, 16 mm; received a bend "
        "radius of 14.2393 mm.",
        "left-branch",
    ),
    Fault(
        "feed longer than the way to the target",
        ("feed.distance=77 mm",),
        "Input feed.distance must be at most the length of the lumen, 76 mm; received 77 mm.",
        "left-branch",
    ),
    Fault(
        "override without a value",
        ("wire.radius",),
        "Override 'wire.radius' must read key=value, as in 'wire.radius=0.5 mm'.",
    ),
    Fault(
        "override inside of a value",
        ("wire.radius.inner=1 mm",),
        "Override 'wire.radius.inner=1 mm' sets a key inside something that is no table.",
    ),
    Fault(
        "misspelt name",
        (),
        "There is no scenario 'half-circel'; did you mean 'half-circle', 'half-circle-wide' or "
        "'half-circle-narrow'?",
        "half-circel",
    ),
    Fault(
        "unknown name",
        (),
        "There is no scenario 'xyz'; expected one of 'aortic-arch', 'carotid', 'coronary', "
        "'half-circle', 'half-circle-helmholtz', 'half-circle-magnet', 'half-circle-narrow', "
        "'half-circle-wide', 'helix', 'left-branch', 'middle-branch', 'right-branch', "
        "'sinusoid', 'straight', 'tortuous'.",
        "xyz",
    ),
)

WIRE = """
[wire]
length = "100 mm"
nodes = 100
radius = "0.6 mm"
youngs_modulus = "3 MPa"
shear_modulus = "1 MPa"
density = "2000 kg/m^3"
"""
SECTIONS = """
[[wire.sections]]
length = "95 mm"
radius = "0.6 mm"
youngs_modulus = "3 MPa"
shear_modulus = "1 MPa"
density = "2000 kg/m^3"
[[wire.sections]]
length = "5 mm"
radius = "0.6 mm"
youngs_modulus = "3 MPa"
shear_modulus = "1 MPa"
density = "2000 kg/m^3"
magnetization = "128 kA/m"
"""
TUBE = """
[lumen]
shape = "straight"
length = "100 mm"
radius = "3 mm"
"""
FEED = """
[feed]
speed = "1 mm/s"
distance = "50 mm"
"""
POINTS = """
[lumen]
shape = "points"
points = [["0 mm", "0 mm", "0 mm"], ["10 mm", "0 mm", "0 mm"], {third}, ["90 mm", "0 mm", "0 mm"]]
radius = {radius}
"""
FROM_FILE = """
[lumen]
shape = "points"
file = "line.csv"
units = "mm"
"""

FILES = {
    "empty file": ("", "Scenario 'faulty.toml' is empty."),
    "blank file": (" \n\n", "Scenario 'faulty.toml' is empty."),
    "TOML without a value": (
        "[wire]\nlength =\n",
        "Scenario 'faulty.toml' is not valid TOML: invalid value (at line 2, column 9).",
    ),
    "a key twice": (
        WIRE + 'length = "1 m"\n' + TUBE + FEED,
        "Scenario 'faulty.toml' is not valid TOML: cannot overwrite a value (at line 9, column "
        "15).",
    ),
    "no wire": (TUBE + FEED, "Input wire is missing; expected a table."),
    "no shape": (
        WIRE + '[lumen]\nlength = "1 m"\n' + FEED,
        "Input lumen.shape is missing; expected one of 'straight', 'half-circle', 'sinusoid', "
        "'helix', 'tree', 'aortic-arch', 'carotid-bifurcation', 'coronary-tree', 'tortuous', "
        "'points', 'vessel'.",
    ),
    "no radius": (
        WIRE.replace('radius = "0.6 mm"\n', "") + TUBE + FEED,
        "Input wire.radius is missing; give it, or wire.diameter.",
    ),
    "radius and diameter": (
        WIRE + 'diameter = "1.2 mm"\n' + TUBE + FEED,
        "Input wire.radius cannot stand next to wire.diameter; remove one of them.",
    ),
    "shear modulus and Poisson ratio": (
        WIRE + "poisson_ratio = 0.5\n" + TUBE + FEED,
        "Input wire.shear_modulus cannot stand next to wire.poisson_ratio; remove one of them.",
    ),
    "a radius in French": (
        WIRE.replace("0.6 mm", "3 Fr") + TUBE + FEED,
        "Input wire.radius needs a unit of length such as '5 mm'; received '3 Fr', which is a "
        "diameter.",
    ),
    "a diameter wider than the lumen": (
        WIRE.replace('radius = "0.6 mm"', 'diameter = "21 Fr"') + TUBE + FEED,
        "Input wire.diameter must be smaller than the lumen's smallest diameter, 6 mm; received "
        "7 mm.",
    ),
    "bore by its diameter": (
        WIRE.replace('radius = "0.6 mm"', 'diameter = "3 Fr"\ninner_diameter = "0.04 in"')
        + TUBE
        + FEED,
        "Input wire.inner_diameter must be smaller than wire.diameter, 1 mm; received 1.016 mm.",
    ),
    "remanence without a length": (
        WIRE + 'remanence = "1.2 T"\n' + TUBE + FEED,
        "Input wire.magnetized_tip must be positive for a wire with wire.remanence; received 0 mm.",
    ),
    "a section that says things twice": (
        "[wire]\nnodes = 100\n" + SECTIONS + 'remanence = "1 T"\n' + TUBE + FEED,
        "Input wire.sections[1].magnetization cannot stand next to wire.sections[1].remanence; "
        "remove one of them.",
    ),
    "uniform keys and sections": (
        '[wire]\nnodes = 100\nradius = "0.6 mm"\n' + SECTIONS + TUBE + FEED,
        "Input wire.radius cannot stand next to wire.sections; remove one of them.",
    ),
    "fault in a section": (
        "[wire]\nnodes = 100\n" + SECTIONS.replace('"0.6 mm"', '"-6 mm"', 1) + TUBE + FEED,
        "Input wire.sections[0].radius must be positive; received -6 mm.",
    ),
    "bore of a section": (
        "[wire]\nnodes = 100\n" + SECTIONS + 'inner_radius = "0.7 mm"\n' + TUBE + FEED,
        "Input wire.sections[1].inner_radius must be smaller than wire.sections[1].radius, 0.6 mm; "
        "received 0.7 mm.",
    ),
    "magnetised section finer than the mesh": (
        "[wire]\nnodes = 20\n" + SECTIONS + TUBE + FEED,
        "Input wire.nodes must be at least 21 for the magnetised wire.sections[1] of 5 mm to span "
        "one edge; received 20.",
    ),
    "no sections": (
        "[wire]\nnodes = 20\nsections = []\n" + TUBE + FEED,
        "Input wire.sections must have at least one section; received none.",
    ),
    "sections that are no tables": (
        "[wire]\nnodes = 20\nsections = 3\n" + TUBE + FEED,
        "Input wire.sections must be a list of tables; received 3.",
    ),
    "speed and table": (
        WIRE + TUBE + '[feed]\nspeed = "1 mm/s"\ntable = [["0 s", "1 mm/s"], ["9 s", "1 mm/s"]]',
        "Input feed.speed cannot stand next to feed.table; remove one of them.",
    ),
    "times that go back": (
        WIRE + TUBE + '[feed]\ntable = [["0 s", "1 mm/s"], ["9 s", "1 mm/s"], ["8 s", "1 mm/s"]]',
        "Input feed.table must have times that start at 0 s and increase; received 0 s, 9 s, 8 s.",
    ),
    "wire drawn out of the guide": (
        WIRE + TUBE + '[feed]\ntable = [["0 s", "1 mm/s"], ["10 s", "-3 mm/s"]]',
        "Input feed.table must not retract more wire than it has fed; received a feed of -10 mm.",
    ),
    "table that feeds too much": (
        WIRE
        + TUBE.replace("100 mm", "300 mm")
        + '[feed]\ntable = [["0 s", "20 mm/s"], ["10 s", "20 mm/s"]]',
        "Input feed.table must be at most the length of the wire, 100 mm; received 200 mm.",
    ),
    "fault in a row": (
        WIRE + TUBE + '[feed]\ntable = [["0 s", "1 mm/s"], ["10 mm", "1 mm/s"]]',
        "Input feed.table (row 2) needs a unit of time such as '10 ms'; received '10 mm', which is "
        "a length.",
    ),
    "polyline sharper than its radius": (
        WIRE + POINTS.format(third='["11 mm", "30 mm", "0 mm"]', radius='"9 mm"') + FEED,
        "Input lumen.points must bend with a radius larger than the lumen's; received ",
    ),
    "the same point twice": (
        WIRE + POINTS.format(third='["10 mm", "0 mm", "0 mm"]', radius='"3 mm"') + FEED,
        "Input lumen.points must be distinct; points 1 and 2 are both (0.01, 0, 0) m.",
    ),
    "radius for some points": (
        WIRE + POINTS.format(third='["50 mm", "0 mm", "0 mm"]', radius='["3 mm", "3 mm"]') + FEED,
        "Input lumen.radius must be one value or one for each of the 4 points; received 2.",
    ),
    "points file that is not there": (
        WIRE + FROM_FILE.replace("line", "none") + FEED,
        "Input lumen.file 'none.csv' cannot be read: no such file or directory.",
    ),
    "points file without a column": (
        WIRE + FROM_FILE + FEED,
        "Input lumen.file must have the columns x, y, z, radius; 'line.csv' lacks z and radius.",
    ),
    "points file without units": (
        WIRE + FROM_FILE.replace('units = "mm"', "").replace("line", "good") + FEED,
        "Input lumen.units is missing; expected the unit of lumen.file such as 'mm'.",
    ),
    "points file with a word in it": (
        WIRE + FROM_FILE.replace("line", "word") + FEED,
        "Input lumen.file must hold finite numbers; received 'thin' for radius in row 2 of "
        "'word.csv'.",
    ),
    "points and file": (
        WIRE
        + FROM_FILE.replace("line", "good")
        + 'points = [["0 mm", "0 mm", "0 mm"], ["9 mm", "0 mm", "0 mm"]]\n'
        + FEED,
        "Input lumen.points cannot stand next to lumen.file; remove one of them.",
    ),
}


def lines_of(text: str) -> list[str]:
    return text.strip().splitlines()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("fault", FAULTS, ids=[fault.name for fault in FAULTS])
def test_fault_has_its_sentence(
    fault: Fault, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["run", fault.scenario, "--set", "navigate.method=none", *fault.keys]
    assert main(words) == 1
    seen = capsys.readouterr()
    assert lines_of(seen.err) == [fault.sentence]
    assert seen.out == ""
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize("name", FILES)
def test_faulty_file_has_its_sentence(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text, sentence = FILES[name]
    (folder / "faulty.toml").write_text(text)
    (folder / "line.csv").write_text("x,y\n0,0\n1,1\n")
    (folder / "good.csv").write_text("x,y,z,radius\n0,0,0,3\n90,0,0,3\n")
    (folder / "word.csv").write_text("x,y,z,radius\n0,0,0,3\n90,0,0,thin\n")
    before = sorted(folder.iterdir())
    assert main(["run", "faulty.toml", "--out", "out"]) == 1
    seen = capsys.readouterr()
    assert len(lines_of(seen.err)) == 1
    assert seen.err.startswith(sentence)
    assert seen.out == ""
    assert sorted(folder.iterdir()) == before


def test_missing_file(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "nowhere/none.toml"]) == 1
    said = "Scenario 'nowhere/none.toml' cannot be read: no such file or directory."
    assert lines_of(capsys.readouterr().err) == [said]
    assert list(folder.iterdir()) == []


def test_folder_as_file(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "some.toml").mkdir()
    assert main(["run", "some.toml"]) == 1
    said = "Scenario 'some.toml' is a folder; expected a TOML file."
    assert lines_of(capsys.readouterr().err) == [said]


def test_file_that_is_no_text(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "some.toml").write_bytes(b"\xff\xfe\x00\x80")
    assert main(["run", "some.toml"]) == 1
    assert lines_of(capsys.readouterr().err) == ["Scenario 'some.toml' is not a text file."]


def test_all_faults_at_once() -> None:
    with pytest.raises(ScenarioError) as caught:
        load(
            "half-circle",
            [
                "wire.youngs_modulus=-1 MPa",
                "wire.raduis=1 mm",
                "wire.nodes=10",
                "lumen.radius=0.5 mm",
                "feed.distance=200 mm",
                "solver.time_step=3 mm",
                "field.kind=uniforn",
                "nonsense",
            ],
        )
    assert sorted(caught.value.faults) == [
        "Input feed.distance must be at most the length of the lumen, 78.5398 mm; received 200 mm.",
        "Input feed.distance must be at most the length of the wire, 100 mm; received 200 mm.",
        "Input field.kind must be one of 'uniform', 'gradient'; received 'uniforn', "
        "did you mean 'uniform'?",
        "Input solver.time_step needs a unit of time such as '10 ms'; received '3 mm', "
        "which is a length.",
        "Input wire.nodes must be at least 21 for a magnetised tip of 5 mm to span one edge; "
        "received 10.",
        "Input wire.radius must be smaller than the lumen's smallest radius, 0.5 mm; "
        "received 0.6 mm.",
        "Input wire.raduis is not a key of [wire]; did you mean 'radius'?",
        "Input wire.youngs_modulus must be positive; received -1 MPa.",
        "Override 'nonsense' must read key=value, as in 'wire.radius=0.5 mm'.",
    ]


def test_all_faults_of_a_makes_words_at_once() -> None:
    """What is said twice and what is missing, next to a value that is out of range."""
    text = WIRE.replace('density = "2000 kg/m^3"', 'poisson_ratio = 0.7\ndiameter = "3 Fr"')
    with pytest.raises(ScenarioError) as caught:
        parse(text + 'stretching_stiffness = "3 N"\n' + TUBE + FEED)
    assert set(caught.value.faults) == {
        "Input wire.poisson_ratio must be from 0 to 0.5; received 0.7.",
        "Input wire.radius cannot stand next to wire.diameter; remove one of them.",
        "Input wire.shear_modulus cannot stand next to wire.poisson_ratio; remove one of them.",
        "Input wire.stretching_stiffness cannot stand next to wire.youngs_modulus; remove one of "
        "them.",
        "Input wire.density is missing; give it, or wire.mass_per_length.",
    }


def test_faults_of_everything_missing() -> None:
    with pytest.raises(ScenarioError) as caught:
        parse("title = 'Nothing'")
    assert caught.value.faults == (
        "Input wire is missing; expected a table.",
        "Input lumen is missing; expected a table.",
        "Input feed is missing; expected a table.",
    )

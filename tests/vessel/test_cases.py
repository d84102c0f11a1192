"""Files as other programs write them: what is right for each kind."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest

import magwire as mw
from magwire.cli import main
from magwire.errors import InputError
from magwire.vessel import Vessel
from magwire.vessel.files import load
from magwire.vessel.survey import courses

FOLDER = Path(__file__).parents[1] / "data" / "vessels"
SURFACES = Path(os.environ.get("MAGWIRE_CASES", ""))
LENGTH, RADII = 66.04, (1.2, 2.0)  # of the bent line that most of the files hold [mm]


def reads(name: str, unit: str | None = "mm", **options: object) -> Vessel:
    return Vessel.read(FOLDER / name, unit, **options)  # type: ignore[arg-type]


def is_the_line(vessel: Vessel, outlet: str) -> None:
    tube = vessel.tubes[outlet]
    assert 1e3 * tube.length == pytest.approx(LENGTH, rel=0.01)
    assert 1e3 * tube.radius.min() == pytest.approx(RADII[0], rel=0.02)
    assert 1e3 * tube.radius.max() == pytest.approx(RADII[1], rel=0.02)


def refusal(name: str, **options: object) -> str:
    with pytest.raises(InputError) as caught:
        reads(name, **options)
    return str(caught.value)


BRANCHES = ("c02_slicer_branch_main.mrk.json", "c02_slicer_branch_side.mrk.json")


def test_several_files_are_one_tree(tmp_path: Path) -> None:
    for name in BRANCHES:
        shutil.copy(FOLDER / name, tmp_path)
    (tmp_path / "notes.md").write_text("no vessel")
    (tmp_path / ".hidden.csv").write_text("no vessel")
    for source in ([FOLDER / name for name in BRANCHES], tmp_path):
        vessel = Vessel.read(source)
        assert vessel.lumen().outlets == ("main", "side")
        is_the_line(vessel, "main")
    with pytest.raises(InputError, match="is a folder without files that end in"):
        Vessel.read(Path(__file__).parent)


def test_lines_without_a_name_are_called_what_their_file_is(tmp_path: Path) -> None:
    for name in BRANCHES:
        text = (FOLDER / name).read_text().replace('"name": "main"', '"name": ""')
        (tmp_path / name.replace("slicer_branch_", "")).write_text(text.replace("side", ""))
    assert set(Vessel.read(tmp_path).balls) == {"c02_main", "c02_side"}


def test_files_of_one_vessel_have_one_unit(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("x [mm],y,z,r\n0,0,0,1\n9,0,0,1\n")
    (tmp_path / "b.csv").write_text("x [cm],y,z,r\n0,0,0,1\n9,9,0,1\n")
    with pytest.raises(InputError, match=r"b.csv' is in cm, but .*a.csv' in mm"):
        Vessel.read(tmp_path)


@pytest.mark.parametrize(
    ("name", "outlet"),
    [
        ("c03_slicer_stale_radius.mrk.json", "a"),
        ("c06_paraview_underscore.csv", "end-2"),
        ("c10_xyz_capitals.csv", "end-2"),
        ("c14_swc_parent_after_child_float_ids.swc", "end-2"),
        ("c11_swc_branch.swc", "end-2"),
        ("c16_tre_spacing_on_radius.tre", "end-2"),
        ("c17_legacy51_metadata.vtk", "end-2"),
        ("c18_legacy51_celldata_blanking.vtk", "end-2"),
    ],
)
def test_they_hold_the_same_line(name: str, outlet: str) -> None:
    is_the_line(reads(name), outlet)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("c04_slicer_more_radii_than_points.mrk.json", "has 61 radii for 31 control points"),
        ("c08_diameter_column.csv", "has no radius at its points among its arrays 'diameter'"),
        ("c12_swc_gap_second_root.swc", "pieces; the closest ones are 4.24 mm apart"),
        ("c19_unstructured_grid_lines.vtk", "expected 'DATASET POLYDATA'"),
        ("r8_line.obj", "has no radius at its points; name the array that holds it, or give one"),
    ],
)
def test_others_are_refused_plainly(name: str, words: str) -> None:
    assert words in refusal(name)


def test_a_line_of_an_obj_takes_one_radius() -> None:
    vessel = reads("r8_line.obj", radius=2e-3)
    assert vessel.lumen().length == pytest.approx(63.1e-3, rel=0.01)


def test_vertebral_arteries_make_a_loop() -> None:
    vessel = reads("c28_vertebrals_join_loop.csv", None)
    (note,) = [note for note in vessel.notes if "A loop of 347 mm is opened near" in note]
    assert "at a fork, since the way on turns back there" in note
    assert vessel.lumen().outlets == ("aorta", "basilar", "cut-1")
    cut = [(30e-3, 20e-3, 60e-3)]
    with pytest.raises(InputError, match="cannot be cut near"):
        reads("c28_vertebrals_join_loop.csv", None, cut=cut)


@pytest.mark.parametrize(
    ("unit", "turn", "backwards", "power"),
    [("cm", 1.1, False, 1), ("m", -0.4, True, 1), ("cm", 1.1, True, 2), ("m", -0.4, False, 2)],
)
def test_other_loops_are_opened_where_ways_go_on(
    unit: str, turn: float, backwards: bool, power: int, tmp_path: Path
) -> None:
    """Two arteries of other lengths and radii that meet at 40 or at 74 degrees; both stay.

    Their lines end in the trunk, beside the points of its line.
    """
    s = np.linspace(0.0, 1.0, 101)[:, None]
    trunk = np.hstack([90 * s - 40, 0 * s, 0 * s]), 6.0
    left = np.hstack([-20 + 20 * s**power, 6 * np.sin(np.pi * s), 60 * s]), 1.2
    right = np.hstack([25 - 25 * s**power, -8 * np.sin(np.pi * s), 60 * s]), 1.4
    onward = np.hstack([0 * s, 0 * s, 60 + 30 * s]), 1.5
    about = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    names = {"trunk": trunk, "left": left, "right": right, "onward": onward}
    factor = {"cm": 0.1, "m": 1e-3}[unit]
    rows = [f"line,x [{unit}],y [{unit}],z [{unit}],radius [{unit}]"]
    for name, (points, radius) in reversed(names.items()) if backwards else names.items():
        for x, y, z in factor * points[:: -1 if backwards else 1] @ about.T:
            rows.append(f"{name},{x},{y},{z},{factor * radius}")
    (tmp_path / "a.csv").write_text("\n".join(rows))
    entrance = (1e-3 * trunk[0][0] @ about.T).tolist()
    vessel = Vessel.read(tmp_path / "a.csv", entrance=entrance)
    (note,) = [note for note in vessel.notes if "A loop of" in note]
    assert ("at a fork, since" in note) == (power == 1)
    assert not any("left out" in note for note in vessel.notes)
    lumen = vessel.lumen()
    assert len(lumen.outlets) == len(vessel.ends) - 1
    for points, radius in names.values():
        inside = 1e-3 * points[5:-5] @ about.T
        gap = lumen.gap(inside)
        # all but the rest of a cut of a few radii
        assert np.mean(gap < 0.6e-3 * radius) < 0.12


def test_a_side_branch_at_a_wide_end_leaves_the_trunk() -> None:
    vessel = reads("c30_small_side_branch_at_wide_end.csv", None)
    lumen = vessel.lumen()
    # the wall of the trunk is the aorta's, whatever the way to the side branch has lost
    s = np.linspace(0.0, 0.1, 60)
    points = np.column_stack([s, 0 * s, -0.97 * 15e-3 + 0.0083 * s])
    assert lumen.gap(points).min() > 0.0
    shares_the_trunk(vessel, "side", 15e-3, 1e-3)


def shares_the_trunk(vessel: Vessel, side: str, wide: float, narrow: float) -> None:
    """The path to a side branch is as wide as the trunk in it, and loses next to nothing."""
    assert vessel.ways[side].narrowed < 0.1 * narrow
    assert not any("narrower" in note for note in vessel.notes)
    (course,) = [c for c in courses(vessel) if c.name == side]
    assert course.radii[0] == pytest.approx(narrow, rel=0.05)
    assert course.radii[1] == pytest.approx(wide, rel=0.05)


@pytest.mark.parametrize(("at", "mouth"), [(1.0, 0.2), (0.4, 0.3), (3.0, 0.15)])
def test_other_side_branches_at_wide_ends_do_too(at: float, mouth: float, tmp_path: Path) -> None:
    """Trunks of 8 mm, with a branch at some radii from the entrance that tapers to 1.2 mm."""
    s = np.linspace(0.0, 1.0, 90)[:, None]
    trunk = np.hstack([7 * s, 90 * s, 5 * s]), np.full(90, 8.0)
    start = trunk[0][0] + at * 8.0 * np.array([7, 90, 5]) / 90.4
    side = start + s * np.array([30.0, 4.0, 10.0]), 8 * mouth + s[:, 0] * (1.2 - 8 * mouth)
    rows = ["line,x [mm],y [mm],z [mm],radius [mm]"]
    for name, (points, radius) in {"small": side, "big": trunk}.items():
        rows += [f"{name},{x},{y},{z},{r}" for (x, y, z), r in zip(points, radius, strict=True)]
    (tmp_path / "a.csv").write_text("\n".join(rows))
    vessel = Vessel.read(tmp_path / "a.csv", entrance=(0.0, 0.0, 0.0))
    shares_the_trunk(vessel, "small", 8e-3, 1.2e-3)


def test_marks_of_a_converted_file_stay_in_every_encoding() -> None:
    vessel = reads("r1_marked_resaved_ascii.vtp", None)
    assert (vessel.entrance, list(vessel.balls)) == ("end-1", ["end-2"])
    assert vessel.smoothing == 0.0
    assert np.array_equal(
        1e3 * vessel.balls["end-2"][:, :3],
        1e3 * (1e-3 * load(FOLDER / "r1_marked_resaved_ascii.vtp").lines[0].points),
    )


@pytest.mark.parametrize("name", ["r1_resaved_lz4.vtp", "r1_resaved_legacy_binary.vtk"])
def test_vtk_9_7_saves_it_again(name: str) -> None:
    vessel = reads(name, None)
    assert (vessel.entrance, list(vessel.balls)) == ("end-1", ["main", "side"])
    assert vessel.smoothing == 0.0


def test_tubes_are_turned_and_moved_as_itk_does() -> None:
    """Written by ITK 5.4.7, with a quarter turn about z and an offset of (10, 20, 30)."""
    (line,) = load(FOLDER / "itk_binary_transform.tre").lines
    assert np.allclose(line.points[:3], [[10, 20, 30], [9.5, 21, 30.25], [9, 22, 30.5]])
    assert line.radius == pytest.approx([1.0, 1.1, 1.2, 1.3, 1.4])


def test_tubes_lie_in_the_frames_of_what_they_are_a_part_of() -> None:
    """Written by ITK 5.4.7; the ends are what it told before it wrote."""
    lines = load(FOLDER / "itk_parents.tre").lines
    ends = [line.points[[0, -1]].tolist() for line in lines]
    assert np.allclose(ends[0], [[90, 0, 0], [90, 8, 0]])  # twice the scale, in a group
    assert np.allclose(ends[1], [[90, 30, 0], [84, 30, 0]])  # in the first
    assert np.allclose(ends[2], [[80, 30, 0], [76, 30, 0]])  # in the second
    assert np.concatenate([line.radius for line in lines]) == pytest.approx(3.0)


def test_a_tube_that_is_a_part_of_itself(tmp_path: Path) -> None:
    text = (FOLDER / "itk_parents.tre").read_text().replace("ParentID = 1", "ParentID = 9")
    (tmp_path / "a.tre").write_text(text)
    with pytest.raises(InputError, match="part of itself, ParentID 9"):
        Vessel.read(tmp_path / "a.tre", "mm")


@pytest.mark.parametrize(("kind", "stated"), [("<f8", True), ("<f8", False), ("<f4", True)])
def test_binary_tubes_of_every_width(kind: str, stated: bool, tmp_path: Path) -> None:
    rows = np.column_stack([np.arange(9.0), 0.5 * np.arange(9.0), np.zeros(9), np.full(9, 2.0)])
    name = "MET_DOUBLE" if kind == "<f8" else "MET_FLOAT"
    tube = (
        b"ObjectType = Tube\nNDims = 3\nBinaryData = True\nPointDim = x y z r\n"
        + (f"ElementType = {name}\n" if stated else "").encode()
        + b"NPoints = 9\nPoints = \n"
        + rows.astype(kind).tobytes()
        + b"\n"
    )
    (tmp_path / "a.tre").write_bytes(b"ObjectType = Scene\nNDims = 3\n" + tube + tube)
    for line in load(tmp_path / "a.tre").lines:
        assert np.array_equal(np.column_stack([line.points, line.radius]), rows)
    assert len(load(tmp_path / "a.tre").lines) == 2


def test_a_curve_that_begins_elsewhere_in_the_list(tmp_path: Path) -> None:
    curve = json.loads((FOLDER / BRANCHES[0]).read_text())
    points = curve["markups"][0]["controlPoints"]
    curve["markups"][0]["controlPoints"] = points[1:] + points[:1]
    radii = curve["markups"][0]["measurements"][0]["controlPointValues"]
    curve["markups"][0]["measurements"][0]["controlPointValues"] = radii[1:] + radii[:1]
    (tmp_path / "a.mrk.json").write_text(json.dumps(curve))
    vessel = Vessel.read(tmp_path / "a.mrk.json")
    is_the_line(vessel, "main")
    assert any("begins at its control point" in note for note in vessel.notes)


def test_a_unit_may_be_a_coded_entry(tmp_path: Path) -> None:
    text = (FOLDER / BRANCHES[0]).read_text()
    coded = text.replace(
        '"coordinateUnits": "mm"', '"coordinateUnits": ["mm", "UCUM", "millimeter"]'
    )
    assert coded != text
    (tmp_path / "a.mrk.json").write_text(coded)
    assert load(tmp_path / "a.mrk.json").unit == "mm"


def test_the_sides_of_a_soma_are_no_vessel(tmp_path: Path) -> None:
    rows = ["1 1 0 0 0 5 -1", "2 1 0 5 0 5 1", "3 1 0 -5 0 5 1"]
    rows += [f"{k} 3 {2 * k} 0 0 2 {1 if k == 4 else k - 1}" for k in range(4, 30)]
    (tmp_path / "a.swc").write_text("\n".join(rows))
    drawing = load(tmp_path / "a.swc")
    assert len(drawing.lines) == 1
    assert any("soma" in note for note in drawing.notes)


def test_outlets_by_their_clinical_names() -> None:
    lumen = mw.load_scenario("aortic-arch").lumen.build()
    assert lumen.path("LCCA") is lumen.path("left carotid")
    assert lumen.path("lsa") is lumen.path("left subclavian")
    assert lumen.path("BCA") is lumen.path("Brachiocephalic artery")
    with pytest.raises(InputError, match="one of the outlets"):
        lumen.path("LAD")


def test_models_in_ras_lie_where_their_curve_does() -> None:
    model, curve = load(FOLDER / "r2_space_ras.vtp"), load(FOLDER / "r2_space_ras.mrk.json")
    assert np.allclose(model.lines[0].points, curve.lines[0].points, rtol=0, atol=1e-12)
    assert not load(FOLDER / "r2_space_lps.vtp").notes
    binary = load(FOLDER / "r2_space_ras_binary.vtk")
    for found in (model, curve, binary):
        assert any("x and y are turned round, to LPS" in note for note in found.notes)


@pytest.mark.parametrize("name", ["Max Inscribed Radius [mm]", "Max Inscribed Radius", None])
def test_names_with_blanks_are_found(name: str | None) -> None:
    found = load(FOLDER / "r4_name_with_blanks.vtk", name)
    assert found.radius_unit == "mm"
    assert np.isfinite(found.lines[0].radius).all()


def test_each_column_has_its_unit(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(
        "x [cm],y [cm],z [cm],radius [mm]\n" + "".join(f"{x},0,0,2\n" for x in range(9))
    )
    tube = Vessel.read(path).tubes["end-2"]
    assert tube.length == pytest.approx(80e-3)
    assert tube.radius == pytest.approx(2e-3)
    head = "x [mm],y [mm],z [mm],radius [mm]\n"
    path.write_text(head + "".join(f"{x},0,0,2\n" for x in range(9)))
    overruled = Vessel.read(path, "cm").tubes["end-2"]
    assert overruled.length == pytest.approx(80e-3)
    assert overruled.radius == pytest.approx(20e-3)
    path.write_text("x [cm],y [mm],z [cm],radius\n0,0,0,1\n9,0,0,1\n")
    with pytest.raises(InputError, match="has points in cm and mm; expected one unit"):
        Vessel.read(path)


@pytest.mark.parametrize("name", ["c22", "c26", "c20", "c23"])
@pytest.mark.skipif("MAGWIRE_CASES" not in os.environ, reason="MAGWIRE_CASES names no folder")
def test_surfaces(name: str) -> None:
    (path,) = SURFACES.glob(f"{name}_*")
    vessel = Vessel.read(path, "m" if name == "c20" else "mm")
    assert len(vessel.ends) == (4 if name == "c26" else 2)
    assert vessel.deviation is not None
    assert vessel.deviation.outside.radii[2] < 0.1
    assert len(vessel.lumen().outlets) == len(vessel.ends) - 1


@pytest.mark.parametrize("name", ["c12_swc_gap_second_root.swc", "c08_diameter_column.csv"])
def test_inspect_ends_as_a_run_does(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["lumen", "inspect", str(FOLDER / name), "--units", "mm"]) == 1
    inspected = capsys.readouterr().err
    scenario = tmp_path / "a.toml"
    scenario.write_text(
        '[wire]\nlength = "80 mm"\nnodes = 81\nradius = "0.6 mm"\nyoungs_modulus = "3 MPa"\n'
        'shear_modulus = "1 MPa"\ndensity = "2000 kg/m^3"\n[feed]\nspeed = "1 mm/s"\n'
        f'[lumen]\nfile = "{FOLDER / name}"\nunits = "mm"\n'
    )
    assert main(["run", str(scenario)]) == 1
    assert inspected.strip() in capsys.readouterr().err


def test_each_plausible_unit_is_named_with_its_vessel(capsys: pytest.CaptureFixture[str]) -> None:
    text = refusal("c11_swc_branch.swc", unit=None)
    assert "'mm', a vessel 65.4 mm long with radius 0.961 to 1.94 mm" in text
    assert "or 'cm', a vessel 654 mm long with radius 9.61 to 19.4 mm" in text
    assert main(["lumen", "inspect", str(FOLDER / "c11_swc_branch.swc")]) == 1
    assert text in capsys.readouterr().err

"""Files of vessels: every format gives the same vessel, and broken ones a sentence."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

import corrupted_files
import vessel_files
from magwire.errors import InputError
from magwire.lumen import Lumen
from magwire.vessel import Vessel
from magwire.vessel.files import load
from vessel_files import CENTRELINES, EVERY, SINGLE, SURFACES, fork, vtp

LENGTHS = [float(np.linalg.norm(np.diff(p, axis=0), axis=1).sum()) for p, _ in fork()]


def write(folder: Path, name: str, data: bytes | None = None) -> Path:
    path = folder / name
    path.write_bytes(EVERY[name]() if data is None else data)
    return path


def refusal(path: Path, **options: object) -> str:
    with pytest.raises(InputError) as caught:
        Vessel.read(path, "mm", **options).lumen()  # type: ignore[arg-type]
    text = str(caught.value)
    assert text.endswith(".")
    assert "\n" not in text
    return text


def off_fork(points: np.ndarray) -> float:
    """Largest distance of points [m] from the fork."""
    given = np.concatenate([p for p, _ in fork()]) * 1e-3
    fine = np.concatenate([given[:-1] + t * np.diff(given, axis=0) for t in np.linspace(0, 1, 9)])
    return float(np.linalg.norm(points[:, None] - fine, axis=2).min(axis=1).max())


@pytest.mark.parametrize("name", sorted(CENTRELINES))
def test_every_format_gives_the_same_vessel(name: str, tmp_path: Path) -> None:
    vessel = Vessel.read(write(tmp_path, name), "mm")
    lengths = [1e3 * tube.length for tube in vessel.tubes.values()]
    assert lengths == pytest.approx(LENGTHS, rel=1e-3)
    for tube in vessel.tubes.values():
        assert tube.radius[0] == pytest.approx(3e-3, rel=1e-4)
        assert tube.radius[-1] == pytest.approx(1.8e-3, rel=1e-4)
        assert off_fork(tube.points) < 0.12e-3  # where the second line parts from the first
    assert np.allclose(vessel.ends[vessel.entrance], 0.0)
    assert vessel.lumen().length == pytest.approx(1e-3 * LENGTHS[0], rel=1e-3)


@pytest.mark.parametrize("name", sorted(SINGLE))
def test_formats_of_one_line(name: str, tmp_path: Path) -> None:
    radius = 2e-3 if name == "path.pth" else None
    vessel = Vessel.read(write(tmp_path, name), radius=radius)  # these state their unit
    (tube,) = vessel.tubes.values()
    assert tube.length == pytest.approx(1e-3 * LENGTHS[0], rel=1e-3)
    assert tube.radius[-1] == pytest.approx(radius or 1.8e-3, rel=1e-4)
    assert off_fork(tube.points) < 0.05e-3  # points are 0.06 mm apart


@pytest.mark.parametrize("name", sorted(SURFACES))
def test_surfaces_are_extracted(name: str, tmp_path: Path) -> None:
    pytest.importorskip("trimesh")
    vessel = Vessel.read(write(tmp_path, name), "mm")
    (tube,) = vessel.tubes.values()
    assert off_fork(tube.points) < 0.15e-3
    assert tube.length == pytest.approx(1e-3 * LENGTHS[0], rel=0.02)
    # a prism of 24 sides has an inscribed radius of 0.991 of its corners'
    assert tube.radius.min() == pytest.approx(1.8e-3, rel=0.03)
    assert tube.radius.max() == pytest.approx(3.0e-3, rel=0.03)
    assert any("inscribed balls" in note for note in vessel.notes)


def test_surface_without_trimesh(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "trimesh", None)
    from magwire.errors import MagwireError

    with pytest.raises(MagwireError, match=r"needs trimesh; install it with pip install"):
        Lumen.read(write(tmp_path, "open.stl"), "mm")


def test_units_are_asked_for_and_guessed(tmp_path: Path) -> None:
    path = write(tmp_path, "ascii.vtp")
    with pytest.raises(InputError, match=r"does not state them; its numbers look like 'mm'"):
        Lumen.read(path)
    small = [(0.1 * p, 0.1 * r) for p, r in fork()]
    path = write(tmp_path, "cm.vtp", vtp(lines=small))
    with pytest.raises(InputError, match=r"look like 'cm'"):
        Lumen.read(path)
    assert Lumen.read(path, "cm").length == pytest.approx(1e-3 * LENGTHS[0], rel=1e-3)
    assert not any("People's" in note for note in Vessel.read(path, "cm").notes)
    said = r"^It is a vessel [\d.]+ m long with radius .* mm\. People's are 8 mm to 1\.5 m long"
    assert any(re.search(said, note) for note in Vessel.read(path, "m").notes)
    with pytest.raises(InputError, match="must be 'm' or 'dm'"):
        Lumen.read(path, "cmm")


def test_a_radius_by_its_name(tmp_path: Path) -> None:
    path = write(tmp_path, "own.vtp", vtp(name="Width"))
    assert "has no radius at its points among its arrays 'Width'" in refusal(path)
    assert "has no array 'Widht' at its points, but 'Width'" in refusal(path, radius="Widht")
    assert Lumen.read(path, "mm", radius="Width").radius_range[1] == pytest.approx(3e-3, rel=2e-3)
    assert Lumen.read(path, "mm", radius=1e-3).radius_range[1] == pytest.approx(1e-3, rel=1e-3)


def test_right_and_left_handed_markups_are_the_same(tmp_path: Path) -> None:
    ras, lps = (load(write(tmp_path, f"{name}.mrk.json")).lines[0] for name in ("ras", "lps"))
    assert np.array_equal(ras.points, lps.points)
    assert ras.name == "aorta"


@pytest.mark.parametrize(
    ("name", "data", "words"),
    [
        ("none.vtp", None, "cannot be read: no such file or directory"),
        ("a.xyz", b"1", "must have one of the endings .vtp, .vtk"),
        ("a.vtp", b"", "is not valid XML"),
        ("a.vtp", b"<VTKFile type='ImageData'/>", "is a VTK file of type 'ImageData'"),
        ("a.vtk", b"# vtk DataFile\nx\nASCII\nDATASET STRUCTURED_GRID\n", "expected 'DATASET POLY"),
        ("a.csv", b"x,y,z,r\n1,2,3\n", "has 3 columns in row 1; expected 4"),
        ("a.csv", b"x,y,r\n1,2,3\n", "lacks the column z among x, y, r"),
        ("a.csv", b"x,y,z,r\n1,2,u,1\n", "has 'u' for z in row 1; expected a number"),
        ("a.csv", b"0,0,0,1\n9,0,0,nan\n", "has no positive radius at 1 of 2 points of line 1"),
        ("a.csv", b"0,0,0,1\n0,0,0,1\n", "line 1 without two distinct points"),
        ("a.csv", b"0,0,0,1\n1e30,0,0,1\n", "not finite, or farther than 1e9 from the origin"),
        ("a.csv", b"0,0,0,1e-9\n100,0,0,1e-9\n", "expected at most 200000 points"),
        ("a.swc", b"1 0 0 0 0 1 -1\n2 0 9 0 0 1 7\n", "a point whose parent 7 is not there"),
        ("a.tre", b"NDims = 3\n", "holds no tube"),
        ("a.json", b"{}", "is not a markups file"),
        ("a.pth", b"<path/>", "is not a SimVascular path"),
        ("a.toml", b"[lumen]\n", "has no lumen.branches"),
    ],
)
def test_broken_files_get_a_sentence(
    name: str, data: bytes | None, words: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    if data is not None:
        path.write_bytes(data)
    assert words in refusal(path)


def test_closed_curves_are_refused(tmp_path: Path) -> None:
    data = json.loads(EVERY["lps.mrk.json"]())
    data["markups"][0]["type"] = "ClosedCurve"
    path = write(tmp_path, "a.json", json.dumps(data).encode())
    assert "holds a closed curve; expected open ones" in refusal(path)


def test_corrupted_files_are_read_or_refused() -> None:
    seeds = {name: make() for name, make in CENTRELINES.items()}
    seeds |= {name: make() for name, make in SINGLE.items()}
    found = corrupted_files.campaign(250, 7, seeds)
    assert sum(n for what, n in found.items() if "refused" in what) > 25
    assert sum(n for what, n in found.items() if "read" in what) > 25


def test_holes_are_closed_and_listed_and_short_ends_are_not(tmp_path: Path) -> None:
    from magwire.vessel.extract import _without_holes
    from magwire.vessel.files import Surface
    from magwire.vessel.mesh import shell

    corners, triangles = vessel_files.tube()
    middle = 0.25 * (corners[triangles[1400, 0]] + 3.0 * corners[triangles[1400, 1]])
    away = np.linalg.norm(corners[triangles].mean(axis=1) - middle, axis=1)
    ends, notes, _ = _without_holes(shell(Surface(1e-3 * corners, triangles[away > 1.2])))
    assert len(ends) == 2
    (note,) = notes
    assert note.startswith("Holes in the wall: 1, closed, at (")
    assert "with radius 1" in note


def test_a_chamber_is_no_tube() -> None:
    trimesh = pytest.importorskip("trimesh")
    from magwire.vessel.extract import extract
    from magwire.vessel.files import Surface
    from magwire.vessel.files.drawing import FileFaultError

    ball = trimesh.creation.icosphere(3, radius=0.02)
    open_ends = np.abs(ball.vertices[ball.faces].mean(axis=1)[:, 2]) < 0.017
    with pytest.raises(FileFaultError, match="is no tube: from end to end it is"):
        extract(Surface(np.array(ball.vertices), np.array(ball.faces)[open_ends]))

"""A wall of triangles in a scenario: from a file, and in the scenario that a run leaves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import magwire as mw
import surfaces
from magwire.errors import ScenarioError
from magwire.scenario.triangles import Triangles, TrianglesText

RADIUS = 3e-3
SCENARIO = """
[wire]
length = "60 mm"
radius = "0.6 mm"
nodes = 61
youngs_modulus = "3 MPa"
shear_modulus = "1 MPa"
density = "2000 kg/m^3"

[feed]
speed = "1 mm/s"
distance = "20 mm"

[lumen]
file = "bend.obj"
units = "mm"
"""


def bend(folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """A bent tube's surface, written as bend.obj in millimetres."""
    points, triangles = surfaces.tube(
        surfaces.arc(25e-3, 1.5, 40), lambda _, angle: np.full(angle.shape, RADIUS), 20
    )
    rows = [f"v {x!r} {y!r} {z!r}" for x, y, z in (1e3 * points).tolist()]
    rows += [f"f {a} {b} {c}" for a, b, c in (triangles + 1).tolist()]
    (folder / "bend.obj").write_text("\n".join(rows))
    return points, triangles


def test_texts_read_back_to_the_same_numbers() -> None:
    points = np.random.default_rng(1).normal(size=(5, 3))
    given = Triangles(points, np.array([[0, 1, 2], [2, 3, 4]]))
    text = TrianglesText()
    assert text.read(text.write(given)) == given


def test_the_scenario_of_a_run_needs_the_file_no_more(tmp_path: Path) -> None:
    pytest.importorskip("trimesh")
    bend(tmp_path)
    (tmp_path / "a.toml").write_text(SCENARIO + 'wall = "surface"\n')
    scenario = mw.load_scenario(tmp_path / "a.toml")
    (tmp_path / "b.toml").write_text(scenario.to_toml())
    assert any("nowhere outside" in note for note in scenario.notes)
    (tmp_path / "bend.obj").unlink()
    one, other = scenario.lumen.build(), mw.load_scenario(tmp_path / "b.toml").lumen.build()
    assert np.array_equal(one.sheet.points, other.sheet.points)
    assert np.array_equal(one.sheet.triangles, other.sheet.triangles)
    spot = one.centreline()[0][[5]] + [0.0, 0.0, 0.5 * RADIUS]
    assert one.gap(spot) == other.gap(spot) == pytest.approx(0.5 * RADIUS, abs=0.05 * RADIUS)


def test_a_surface_is_asked_for_where_there_is_none(tmp_path: Path) -> None:
    rows = "\n".join(f"{x},0,0,2" for x in range(30))
    (tmp_path / "line.csv").write_text("x,y,z,radius\n" + rows)
    (tmp_path / "a.toml").write_text(
        SCENARIO.replace("bend.obj", "line.csv") + 'wall = "surface"\n'
    )
    with pytest.raises(ScenarioError, match=r"Input lumen.wall must be 'balls' for a file without"):
        mw.load_scenario(tmp_path / "a.toml")


def test_a_run_stays_inside_of_the_triangles(tmp_path: Path) -> None:
    """By the distance from all triangles, which the wall's spline has no part in."""
    pytest.importorskip("trimesh")
    points, triangles = bend(tmp_path)
    (tmp_path / "a.toml").write_text(SCENARIO + 'wall = "surface"\n')
    result = mw.load_scenario(tmp_path / "a.toml").run()
    assert result.status == "complete"
    wire = result.dataset.position.values
    fed = wire[-1][wire[-1][:, 0] > 0.5e-3]  # past the plane of the entrance
    assert len(fed) > 15
    starts, ends = fed[:-1], fed[1:]
    assert not surfaces.crossings(starts, ends, points, triangles).any()
    assert surfaces.apart(starts, ends, points, triangles) > 0.6e-3
    assert float(np.nanmin(result.dataset.clearance_along)) > 0.0

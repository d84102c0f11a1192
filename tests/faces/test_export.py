"""Results in the formats of other programs, read back by their readers."""

from __future__ import annotations

import csv
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from magwire.cli import main
from magwire.contact.motion import gone, recorded
from magwire.export import write_tables
from magwire.export.mcap import TOPICS, orientations
from magwire.export.pvd import _walls
from magwire.export.wall import wall
from magwire.results import Result, Writer
from magwire.view import content
from records import BREATHING, half_circle, info, records

RAS = np.array([-1.0, -1.0, 1.0])


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A result file of 25 records with forces on the wall."""
    run = info(title="Bend", scenario='[wire]\nradius = "0.5 mm"\nmagnetized_tip = "5 mm"')
    writer = Writer(run)
    for record in records(run, 25):
        writer.append(record)
    writer.close("complete")
    return writer.result().save(tmp_path_factory.mktemp("made") / "bend.nc")


@pytest.fixture
def data(result: Path) -> Any:
    return Result.load(result).dataset


def export(result: Path, kind: str, out: Path, frame: str) -> Path:
    arguments = ["export", str(result), "--to", kind, "--out", str(out), "--frame", frame]
    assert main(arguments) == 0
    return out


def read(path: Path) -> dict[str, np.ndarray]:
    with path.open(newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return dict(zip(names, np.array(rows, dtype=float).T, strict=True))


@pytest.mark.parametrize(("frame", "signs"), [("lps", np.ones(3)), ("ras", RAS)])
def test_tables(result: Path, data: Any, tmp_path: Path, frame: str, signs: np.ndarray) -> None:
    out = export(result, "csv", tmp_path / "out", frame)
    run, nodes = read(out / "run.csv"), read(out / "nodes.csv")
    np.testing.assert_array_equal(run["time [s]"], data["time"])
    np.testing.assert_array_equal(run["push_force [N]"], data["push_force"])
    for i, axis in enumerate("xyz"):
        field = signs[i] * data["field"].values[:, i]
        np.testing.assert_array_equal(run[f"field_{axis} [T]"], field)
        tip = signs[i] * data["position"].values[:, -1, i]
        np.testing.assert_array_equal(run[f"tip_{axis} [m]"], tip)
        force = signs[i] * data["contact_force"].values[..., i].ravel()
        np.testing.assert_array_equal(nodes[f"contact_force_{axis} [N]"], force)
    np.testing.assert_array_equal(nodes["clearance [m]"], data["clearance"].values.ravel())
    assert set(nodes["node"]) == set(range(20))


def test_a_wall_that_moves_is_where_it_is(data: Any, tmp_path: Path) -> None:
    """Every corner where its tissue is, and the pressure on it still the force."""
    writer = Writer(info(wall_motion=BREATHING))
    for record in records(writer.info, 25):
        writer.append(record)
    writer.close("complete")
    file = writer.result().save(tmp_path / "moving.nc")
    moving = Result.load(file).dataset
    assert recorded(moving)[0].period == BREATHING[0].period
    assert recorded(data) == ()
    rest = wall(content.branches(moving))
    entrance = moving["way"].values[0]
    for record, ((points, _), time) in enumerate(
        zip(_walls(moving, content.branches(moving), "lps"), moving["time"].values, strict=True)
    ):
        there = gone(BREATHING, rest.points, entrance, time)
        np.testing.assert_allclose(points, there, atol=1e-8)
        assert (np.abs(there - rest.points).max() > 0.0) == (record > 0)


def series(path: Path) -> list[tuple[float, Path]]:
    """Times and files of a collection."""
    entries = ET.parse(path).getroot().iter("DataSet")
    return [(float(e.attrib["timestep"]), path.parent / e.attrib["file"]) for e in entries]


@pytest.mark.parametrize(("frame", "signs"), [("lps", np.ones(3)), ("ras", RAS)])
def test_paraview_series(
    result: Path, data: Any, tmp_path: Path, frame: str, signs: np.ndarray
) -> None:
    vtk = pytest.importorskip("vtk", reason="vtk is not installed")
    from vtk.util.numpy_support import vtk_to_numpy

    out = export(result, "pvd", tmp_path / "out", frame)

    def load(path: Path) -> tuple[Any, dict[str, np.ndarray]]:
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        poly = reader.GetOutput()
        held = poly.GetPointData()
        names = [held.GetArrayName(k) for k in range(held.GetNumberOfArrays())]
        arrays = {name: vtk_to_numpy(held.GetArray(name)) for name in names}
        return poly, arrays | {"points": vtk_to_numpy(poly.GetPoints().GetData())}

    wires, fields, walls = (series(out / f"{name}.pvd") for name in ("wire", "field", "wall"))
    assert [time for time, _ in wires] == data["time"].values.tolist()
    for record in (0, 13, 24):
        poly, wire = load(wires[record][1])
        assert poly.GetNumberOfLines() == 1
        position, force = (data[n].values[record] * signs for n in ("position", "contact_force"))
        np.testing.assert_allclose(wire["points"], position, rtol=1e-6, atol=1e-12)
        np.testing.assert_allclose(wire["contact_force"], force, rtol=1e-6, atol=1e-15)
        np.testing.assert_array_equal(wire["clearance"], data["clearance"].values[record])
        assert wire["magnetised"].tolist() == [0] * 19 + [1]
        poly, field = load(fields[record][1])
        assert poly.GetNumberOfVerts() == 1
        np.testing.assert_allclose(field["field"][0], data["field"].values[record] * signs)
        poly, lumen = load(walls[record][1])
        properties = vtk.vtkMassProperties()
        properties.SetInputData(poly)
        assert properties.GetSurfaceArea() == pytest.approx(
            2 * np.pi * 3e-3 * np.pi * 0.025, rel=0.01
        )
        carried = vtk.vtkIntegrateAttributes()  # the pressure carries the force
        carried.SetInputData(poly)
        carried.Update()
        held = carried.GetOutput().GetPointData().GetArray("pressure").GetTuple1(0)
        assert held == pytest.approx(data["wall_force"].values[record], rel=1e-5, abs=1e-12)
        assert lumen["pressure"].min() >= 0.0


def test_pressure_is_where_the_wire_presses() -> None:
    line = half_circle(200)
    mesh = wall([np.column_stack([line, np.full(len(line), 3e-3)])])
    at = line[100] + [2.5e-3, 0.0, 0.0]  # outwards, at the middle of the half-circle
    force = np.array([[-1e-3, 0.0, 0.0]])
    pressure = mesh.pressure(at[None], force, 0.5e-3)
    touched = line[100] + [3e-3, 0.0, 0.0]
    away = np.linalg.norm(mesh.points - touched, axis=1)
    assert pressure[away > 0.85 * 3e-3].max() == 0.0
    assert away[np.argmax(pressure)] < 1e-3
    # A force that is spread by (1 - d^2/h^2)^2 has its peak at 3 F / (pi h^2) on a flat wall.
    assert pressure.max() == pytest.approx(3e-3 / (np.pi * (0.8 * 3e-3) ** 2), rel=0.15)


def test_branches_are_open_where_they_join() -> None:
    along = np.linspace(0.0, 0.05, 80)[:, None]
    trunk = np.hstack([along, 0 * along, 0 * along, 0 * along + 3e-3])
    side = np.hstack([0.02 + 0.2 * along, along, 0 * along, 0 * along + 2e-3])
    both = wall([trunk, side])
    corners = both.points[both.triangles].mean(axis=1)
    inside = (np.linalg.norm(corners[:, 1:], axis=1) < 2.2e-3) & (
        np.abs(corners[:, 0] - 0.02) < 0.01
    )
    assert not inside.any()
    assert len(wall([trunk]).triangles) + len(wall([side]).triangles) > len(both.triangles)


@pytest.mark.parametrize(("frame", "signs"), [("lps", np.ones(3)), ("ras", RAS)])
def test_log(result: Path, data: Any, tmp_path: Path, frame: str, signs: np.ndarray) -> None:
    pytest.importorskip("mcap_ros2", reason="mcap-ros2-support is not installed")
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory

    out = export(result, "mcap", tmp_path / "out", frame)
    found: dict[str, list[Any]] = {}
    with (out / "result.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        for schema, channel, message, content in reader.iter_decoded_messages():
            assert schema.name == TOPICS[channel.topic]
            found.setdefault(channel.topic, []).append((message.log_time, content))

    def vector(value: Any) -> list[float]:
        return [value.x, value.y, value.z]

    wires = found["/magwire/wire"]
    assert len(wires) == 25
    assert wires[0][1].header.frame_id == f"magwire_{frame}"
    for record in (0, 13, 24):
        held = {topic: messages[record][1] for topic, messages in found.items()}
        assert wires[record][0] == round(1e9 * data["time"].values[record])
        points = [vector(pose.position) for pose in held["/magwire/wire"].poses]
        position = signs * data["position"].values[record]
        np.testing.assert_allclose(points, position, rtol=1e-6, atol=1e-12)
        tip = vector(held["/magwire/tip/wall_wrench"].wrench.force)
        force = signs * data["contact_force"].values[record, -1]
        np.testing.assert_allclose(tip, force, rtol=1e-6, atol=1e-15)
        push = vector(held["/magwire/guide/wrench"].wrench.force)
        along = (position[1] - position[0]) / np.linalg.norm(position[1] - position[0])
        wanted = data["push_force"].values[record] * along
        np.testing.assert_allclose(push, wanted, rtol=1e-6, atol=1e-15)
        field = vector(held["/magwire/field"].magnetic_field)
        np.testing.assert_allclose(field, signs * data["field"].values[record], rtol=1e-6)


def test_orientations_turn_x_along_the_wire() -> None:
    nodes = np.cumsum([[0, 0, 0], [1, 0, 0], [0, 2, 0], [-1, 0, 0], [0.3, -0.2, 0.7]], axis=0)
    for (x, y, z, w), edge in zip(orientations(nodes), np.diff(nodes, axis=0), strict=False):
        turned = [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)]
        np.testing.assert_allclose(turned, edge / np.linalg.norm(edge), atol=1e-12)


def test_a_log_without_its_packages(
    result: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    monkeypatch.setitem(sys.modules, "mcap_ros2.writer", None)
    assert main(["export", str(result), "--to", "mcap", "--out", str(tmp_path / "out")]) == 1
    assert "pip install magwire[export]" in capsys.readouterr().err


def test_a_folder_is_not_overwritten(result: Path, data: Any, tmp_path: Path, capsys: Any) -> None:
    write_tables(data, tmp_path)
    arguments = ["export", str(result), "--to", "csv", "--out", str(tmp_path)]
    assert main(arguments) == 1
    assert "exists already" in capsys.readouterr().err
    assert main([*arguments, "--force"]) == 0

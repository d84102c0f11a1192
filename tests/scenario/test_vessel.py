"""Scenarios with a vessel's file: numbers in its place, and all faults at once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import vessel_files
from magwire.errors import ScenarioError
from magwire.lumen import Lumen
from magwire.scenario import Scenario, load, parse

WIRE = """
[wire]
length = "80 mm"
nodes = 81
radius = "0.6 mm"
youngs_modulus = "3 MPa"
shear_modulus = "1 MPa"
density = "2000 kg/m^3"
magnetized_tip = "5 mm"
magnetization = "128 kA/m"

[feed]
speed = "1 mm/s"
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a vessel's file."""
    (tmp_path / "vessel.vtp").write_bytes(vessel_files.vtp("raw-zlib"))
    return tmp_path


def scenario(folder: Path, *lines: str, feed: str = "") -> Scenario:
    lumen = "\n".join(['[lumen]\nfile = "vessel.vtp"', *lines])
    return parse(WIRE + feed + lumen, folder=folder)


def faults(folder: Path, *lines: str) -> tuple[str, ...]:
    with pytest.raises(ScenarioError) as caught:
        scenario(folder, *lines)
    return caught.value.faults


def test_a_file_is_enough(folder: Path) -> None:
    found = scenario(folder, 'units = "mm"', 'target = "end-3"')
    lumen = found.build().simulation.system.lumen
    assert lumen.target == "end-3"
    assert lumen.outlets == ("end-2", "end-3")
    same = Lumen.read(folder / "vessel.vtp", "mm", target="end-3")
    assert lumen.length == pytest.approx(same.length, rel=1e-12)
    # the feed goes as far as the target
    assert found.feed.distance == pytest.approx(same.length, rel=1e-12)  # type: ignore[union-attr]


def test_it_is_complete_as_toml_and_needs_the_file_no_more(folder: Path, tmp_path: Path) -> None:
    found = scenario(folder, 'units = "mm"', "target = 3")
    (folder / "vessel.vtp").unlink()
    again = parse(found.to_toml(), folder=tmp_path)
    assert again == found


def test_placement_and_scale(folder: Path) -> None:
    lines = ('units = "mm"', "scale = 1.2", 'rotation = ["0 deg", "0 deg", "90 deg"]')
    found = scenario(folder, *lines, 'translation = ["1 mm", "0 mm", "0 mm"]', "target = 2")
    lumen = found.lumen.build()
    end = 1e-3 * vessel_files.fork()[0][0][-1]
    x, y, z = 1.2 * end
    assert np.allclose(lumen.path().centreline()[0][-1], [1e-3 - y, x, z], atol=1e-6)


def test_points_name_entrance_and_target(folder: Path) -> None:
    spots = ('entrance = ["20 mm", "0 mm", "2 mm"]', 'target = ["58 mm", "-5 mm", "6 mm"]')
    found = scenario(folder, 'units = "mm"', *spots)
    assert found.lumen.target == "end-3"  # type: ignore[union-attr]
    assert found.lumen.build().entrance == pytest.approx([20e-3, 0, 2e-3], abs=0.2e-3)


def test_the_entry_is_part_of_the_way(folder: Path) -> None:
    plain, longer = (
        scenario(folder, 'units = "mm"'),
        scenario(folder, 'units = "mm"', 'entry = "5 mm"'),
    )
    more = longer.feed.distance - plain.feed.distance  # type: ignore[union-attr]
    assert more == pytest.approx(5e-3, rel=1e-9)
    assert longer.lumen.build().length == pytest.approx(plain.lumen.build().length + 5e-3)


def test_all_faults_at_once(folder: Path) -> None:
    found = faults(
        folder, 'units = "mn"', 'scale = "2 mm"', "entrance = true", 'rotation = ["1 deg"]'
    )
    text = "\n".join(found)
    assert "Input lumen.units must be one of 'm', 'dm'" in text
    assert "Input lumen.scale takes no unit; received '2 mm'." in text
    assert "Input lumen.entrance must be the name or the number of an end, or a point" in text
    assert "Input lumen.rotation must be a list of three" in text


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ((), "Input lumen.units must be given for '"),
        (('units = "mm"', 'target = "left"'), "Input lumen.target must be 'end-2' or 'end-3'"),
        (('units = "mm"', "target = 1"), "Input lumen.target must be the number of an end, one of"),
        (('units = "mm"', 'radius = "Width"'), "has no array 'Width' at its points"),
        (('units = "mm"', "wrong = 1"), "Input lumen.wrong is not a key of [lumen]"),
        (('units = "mm"', "scale = -1"), "Input lumen.scale must be positive; received -1"),
        (('units = "mm"', "scale = 0.3"), "Input wire.radius must be smaller than the lumen's"),
        (('units = "mm"', "scale = 2"), "Input feed.distance must be at most the length of the w"),
    ],
)
def test_faults(folder: Path, lines: tuple[str, ...], words: str) -> None:
    (sentence,) = faults(folder, *lines)
    assert words in sentence


def test_without_a_file_there_is_nothing_to_scale(folder: Path) -> None:
    text = scenario(folder, 'units = "mm"').to_toml()
    with pytest.raises(ScenarioError, match=r"Input lumen.scale needs lumen.file next to it"):
        parse(text, ["lumen.scale=2"])


def test_only_the_way_to_the_target_has_to_fit_the_wire(tmp_path: Path) -> None:
    lines = vessel_files.fork()
    lines[1] = (lines[1][0], lines[1][1] * np.where(lines[1][0][:, 0] > 45.0, 0.25, 1.0))
    (tmp_path / "vessel.vtp").write_bytes(vessel_files.vtp(lines=lines))
    assert scenario(tmp_path, 'units = "mm"', "target = 2").build().simulation is not None
    (sentence,) = faults(tmp_path, 'units = "mm"', "target = 3")
    assert "must be smaller than the lumen's smallest radius" in sentence


def test_a_run_in_a_vessel(folder: Path) -> None:
    text = WIRE.replace('"1 mm/s"', '"5 mm/s"\ndistance = "30 mm"')
    (folder / "a.toml").write_text(
        text + '[lumen]\nfile = "vessel.vtp"\nunits = "mm"\n[solver]\ntime_step = "100 ms"\n',
        encoding="utf-8",
    )
    result = load(folder / "a.toml").run()
    assert result.status == "complete"
    assert result.smallest_clearance > 0.0

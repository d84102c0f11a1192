"""The examples of docs/extending.md: each is one file, and magwire itself is not changed for it."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
import tomli_w

from magwire.evidence.verify.references.dipole import Dipole
from magwire.lumen import Lumen
from magwire.results import Result
from magwire.scenario import load

PAGE = Path(__file__).parents[1] / "docs" / "extending.md"
NAMES = ("dipole", "arc", "ahead", "tip_height")
PLACE, DIAMETER, MAGNETIZATION = (0.02, 0.12, 0.0), 0.06, (0.0, 900e3, 0.0)
MOMENT = np.pi * DIAMETER**3 / 6.0 * np.array(MAGNETIZATION)


def tables() -> dict[str, object]:
    """The parts of scenarios on the page."""
    blocks = re.findall(r"```toml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    return {name: table for block in blocks for name, table in tomllib.loads(block).items()}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the files of the page, and a scenario that needs all of them."""
    found = tmp_path_factory.mktemp("own")
    text = PAGE.read_text(encoding="utf-8")
    for name in NAMES:
        block = re.search(rf"`{name}\.py`:\n\n```python\n(.*?)```", text, re.DOTALL)
        assert block is not None
        (found / f"{name}.py").write_text(block[1], encoding="utf-8")
    raw = tomllib.loads(load("half-circle", ["navigate.method=none"]).to_toml()) | tables()
    raw["wire"]["nodes"] = 40
    raw["feed"] = {"speed": "10 mm/s", "distance": "20 mm"}
    raw["solver"]["time_step"], raw["output"]["record_every"] = "50 ms", "5 mm"
    (found / "own.toml").write_text(tomli_w.dumps(raw), encoding="utf-8")
    return found


def magwire(folder: Path, *words: str, own: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "magwire", *words],
        cwd=folder,
        env=os.environ | {"MAGWIRE_KINDS": own},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture(scope="module")
def result(folder: Path) -> Result:
    """What the command line makes of the scenario."""
    own = os.pathsep.join(f"{name}.py" for name in NAMES)
    seen = magwire(folder, "run", "own.toml", "--out", "out", own=own)
    assert seen.returncode == 0, seen.stderr
    return Result.load(folder / "out")


def test_the_files_are_all_that_a_run_needs(result: Result) -> None:
    assert result.status == "complete"
    scenario = tomllib.loads(result.scenario)
    assert scenario["field"]["kind"] == "dipole"
    assert scenario["lumen"]["shape"] == "arc"
    assert scenario["navigate"] == {"method": "ahead", "strength": "20 mT"}


def test_the_wire_feels_the_dipole_and_the_navigator(result: Result) -> None:
    """Next to an independent dipole, and the tangent of the arc at the fed length."""
    angle = result.feed / 0.025
    ahead = np.column_stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)])
    outside = Dipole(PLACE, MOMENT).at(result.position[:, -1])[0]
    # The centreline is drawn in pieces of 0.26 mm, half a degree each.
    steered = (result.field - outside)[1:]  # the first record is of before
    np.testing.assert_allclose(steered, 20e-3 * ahead[1:], atol=20e-3 * 0.02)
    assert np.linalg.norm(outside, axis=1).min() > 2e-3


def test_the_lumen_is_an_arc(result: Result) -> None:
    line = result.dataset["centreline"].values
    np.testing.assert_allclose(np.linalg.norm(line - [0.0, 0.025, 0.0], axis=1), 0.025, rtol=1e-4)
    length = np.linalg.norm(np.diff(line, axis=0), axis=1).sum()
    assert length == pytest.approx(0.025 * 2.0 * np.pi / 3.0, rel=1e-3)
    half = Lumen.half_circle(0.025, 3e-3).centreline()[0]
    assert np.linalg.norm(half - line[len(line) // 2], axis=1).min() < 0.2e-3


def test_the_result_has_the_new_variable(result: Result) -> None:
    np.testing.assert_array_equal(result.dataset["tip_height"], result.position[:, -1, 2])
    assert result.dataset["tip_height"].attrs["units"] == "m"


SCRIPT = """
import json, sys
import dipole, arc
from magwire.errors import ScenarioError
from magwire.scenario import json_schema, load
faults = {}
for name, words in json.loads(sys.argv[1]).items():
    try:
        load("half-circle", words)
    except ScenarioError as error:
        faults[name] = error.faults
properties = json_schema()["properties"]
shapes = [list(properties[name]["discriminator"]["mapping"]) for name in ("field", "lumen")]
print(json.dumps([faults, shapes]))
"""
DIPOLE = "{kind='dipole', place=['0 mm','1 m','0 mm'], diameter='1 mm', magnetization='1 kA/m'}"


def test_messages_and_schema_know_the_new_kinds(folder: Path) -> None:
    """Made known by an import, after the scenario's model is there."""
    words = {
        "steered": [f"field={DIPOLE}"],
        "misspelt": ["field.kind=dipol", "navigate.method=none"],
        "key": [f"field={DIPOLE}", "field.flux=1 mT", "navigate.method=none"],
        "bend": ["navigate.method=none", "lumen={shape='arc',radius='3 mm',bend_radius='2 mm',"
                 "angle='9 rad'}", "feed.distance=9 mm"],
    }  # fmt: skip
    seen = subprocess.run(
        [sys.executable, "-c", SCRIPT, json.dumps(words)],
        cwd=folder, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert seen.returncode == 0, seen.stderr
    faults, (fields, shapes) = json.loads(seen.stdout)
    assert faults == {
        "steered": [
            "Input field.kind must be linear in space, such as 'uniform' or 'gradient', for "
            "navigate.method 'stable'; received 'dipole'."
        ],
        "misspelt": [
            "Input field.kind must be one of 'uniform', 'gradient', 'dipole'; received 'dipol', "
            "did you mean 'dipole'?"
        ],
        "key": [
            "Input field.flux is not a key of [field] with kind 'dipole'; expected one of 'kind', "
            "'place', 'diameter', 'magnetization'."
        ],
        "bend": [
            "Input lumen must bend with a radius larger than lumen.radius, 3 mm; received a bend "
            "radius of 2 mm."
        ],
    }
    assert "dipole" in fields
    assert "arc" in shapes


def test_own_kinds_that_are_not_there_are_told(folder: Path) -> None:
    for own, said in (
        ("nowhere.py", "File 'nowhere.py' of MAGWIRE_KINDS does not exist.\n"),
        ("nowhere", "Module 'nowhere' of MAGWIRE_KINDS is not installed.\n"),
    ):
        seen = magwire(folder, "list", own=own)
        assert (seen.returncode, seen.stdout, seen.stderr) == (1, "", said)

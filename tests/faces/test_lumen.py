"""magwire lumen: what is in a file, and the same written anew."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import vessel_files
from magwire.cli import main
from magwire.lumen import Lumen
from magwire.vessel import Vessel


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A vessel's file."""
    path = tmp_path / "vessel.vtp"
    path.write_bytes(vessel_files.vtp("zlib"))
    return path


def test_inspect_says_what_is_there(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lumen", "inspect", str(file)]) == 1  # a run would not take what is likely
    out, err = capsys.readouterr()
    assert "which does not state them; its numbers look like 'mm'" in err
    assert "2 centrelines with 242 points" in out
    assert "not stated; the numbers look like mm, which is taken here" in out
    assert "1  end-1" in out
    assert "entrance" in out
    rows = {words[0]: words for words in map(str.split, out.splitlines()) if words}
    assert float(rows["end-2"][1]) == pytest.approx(60.9, abs=0.1)
    assert [float(rows["end-2"][i]) for i in (3, 5)] == pytest.approx([1.8, 3.0], abs=0.01)


@pytest.mark.parametrize(
    ("words", "verdict"),
    [
        (("--wire", "1 mm"), "  yes"),
        (("--wire", "4 mm"), "  no, 3.6 mm wide at the narrowest"),
        (("--wire", "1 mm", "--youngs-modulus", "3 MPa"), "  yes, about 0."),
        (("--wire", "1 mm", "--youngs-modulus", "3 GPa", "--max-force", "1 mN"), "  no, about "),
    ],
)
def test_inspect_says_whether_a_wire_gets_there(
    words: tuple[str, ...], verdict: str, file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["lumen", "inspect", str(file), "--units", "mm", *words]) == 0
    rows = [line for line in capsys.readouterr().out.splitlines() if line.startswith("end-")]
    assert len(rows) == 2
    assert all(verdict in row for row in rows)


def test_inspect_draws(file: Path, tmp_path: Path) -> None:
    import matplotlib.image

    picture = tmp_path / "vessel.png"
    words = ["--units", "mm", "--picture", str(picture), "--wire", "1 mm"]
    assert main(["lumen", "inspect", str(file), *words]) == 0
    image = matplotlib.image.imread(picture)
    assert image.shape[1] == pytest.approx(2126, abs=2)
    assert np.ptp(image[..., :3], axis=(0, 1)).min() > 0.5


def test_inspect_finds_flipped_axes(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "other.vtp"
    lines = [((p + [40, 9, 0]) * [-1, -1, 1], r) for p, r in vessel_files.fork()]
    other.write_bytes(vessel_files.vtp(lines=lines))
    file.write_bytes(vessel_files.vtp(lines=[(p + [40, 9, 0], r) for p, r in vessel_files.fork()]))
    inspect = ["lumen", "inspect", str(file), "--units", "mm"]
    assert main([*inspect, "--compare", str(other)]) == 0
    assert "The axes x and y of" in capsys.readouterr().out
    assert main([*inspect, "--compare", str(file)]) == 0
    assert "are the same" in capsys.readouterr().out


@pytest.mark.parametrize("ending", ["vtp", "nc", "toml"])
def test_what_is_converted_reads_back_the_same(ending: str, file: Path, tmp_path: Path) -> None:
    out = tmp_path / f"clean.{ending}"
    assert main(["lumen", "convert", str(file), str(out), "--units", "mm"]) == 0
    before, after = Vessel.read(file, "mm"), Vessel.read(out)
    assert list(before.tubes) == list(after.tubes)
    for name, tube in before.tubes.items():
        assert np.abs(after.tubes[name].points - tube.points).max() < 1e-15
        assert np.abs(after.tubes[name].radius - tube.radius).max() < 1e-15
    where = np.random.default_rng(0).uniform([0, -5e-3, 0], [60e-3, 5e-3, 6e-3], (500, 3))
    gaps = before.lumen().gap(where), Lumen.read(out).gap(where)
    assert np.allclose(*gaps, rtol=0.0, atol=1e-12)


def test_a_converted_table_is_part_of_a_scenario(file: Path, tmp_path: Path) -> None:
    from magwire.scenario import parse

    out = tmp_path / "clean.toml"
    words = ["--units", "mm", "--target", "3", "--entrance", "0 mm, 0 mm, 0 mm"]
    assert main(["lumen", "convert", str(file), str(out), *words]) == 0
    wire = (
        '[wire]\nlength = "80 mm"\nnodes = 81\nradius = "0.6 mm"\nyoungs_modulus = "3 MPa"\n'
        'shear_modulus = "1 MPa"\ndensity = "2000 kg/m^3"\n'
        '[feed]\nspeed = "1 mm/s"\ndistance = "50 mm"\n'
    )
    found = parse(wire + out.read_text(encoding="utf-8"))
    assert found.lumen.target == "end-3"  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["inspect", "none.vtp"], "cannot be read: no such file"),
        (["convert", "{file}", "{folder}/a.stl", "--units", "mm"], "must end in one of .vtp, .nc"),
        (["convert", "{file}", "{file}", "--units", "mm"], "exists already; use --force"),
        (["convert", "{file}", "{folder}/a.nc"], "does not state them; its numbers look like"),
        (["inspect", "{file}", "--wire", "1 s"], "--wire needs a unit of diameter"),
        (["inspect", "{file}", "--wire", "-1 mm"], "is written --wire='-1 mm'."),
        (
            ["inspect", "{file}", "--units", "mm", "--wire=-1 mm"],
            "--wire of magwire lumen inspect must be positive",
        ),
        (["inspect", "{file}", "--units", "mm", "--extend", "1e6"], "must be between 0 and 100"),
        (["inspect", "{file}", "--picture", "{folder}/a.xyz"], "cannot be written: "),
        (["inspect", "{file}", "--picture", "{folder}/no/a.png"], "/a.png' cannot be written: no"),
        (["convert", "{file}", "{folder}/no/a.nc", "--units", "mm"], "cannot be written: no such"),
    ],
)
def test_faults_are_one_sentence(
    words: list[str], sentence: str, file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    given = [word.format(file=file, folder=file.parent) for word in words]
    assert main(["lumen", *given]) == 1
    err = capsys.readouterr().err
    assert sentence in err
    assert err.count("\n") == 1

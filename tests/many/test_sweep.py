"""Sweeps: samples, faults, tables, and taking up what was interrupted."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from magwire.cli import main
from magwire.errors import ScenarioError
from magwire.many.outcome import QUANTITIES
from magwire.many.sampling import Choice, Span, column, samples
from magwire.many.sweep import KEYS, read
from magwire.many.table import load

RANGES = (Span("lumen.radius", 2.0, 4.0, "mm", False, 3), Choice("navigate.method", ("a", "b")))
SWEEP = """
[sweep]
scenario = "half-circle"
{method}

[sweep.ranges]
lumen.radius = {{ from = "2.5 mm", to = "3.5 mm", {count} }}
navigate.method = ["none"]
feed.distance = ["{feed}"]
wire.nodes = [40]
solver.time_step = ["100 ms"]
"""


def written(
    folder: Path, *, method: str = "", count: str = "count = 3", feed: str = "22 mm"
) -> Path:
    file = folder / "tubes.toml"
    file.write_text(SWEEP.format(method=method, count=count, feed=feed))
    return file


def faults(folder: Path, text: str) -> tuple[str, ...]:
    file = folder / "faulty.toml"
    file.write_text(text)
    with pytest.raises(ScenarioError) as caught:
        assert read(file).scenarios
    return caught.value.faults


def test_grid_has_all_combinations() -> None:
    found = samples(RANGES, "grid", 0, 0)
    assert found == [(f"{r} mm", word) for r in (2.0, 3.0, 4.0) for word in "ab"]


@pytest.mark.parametrize("method", ["random", "sobol"])
def test_samples_follow_from_their_seed(method: str) -> None:
    first = samples(RANGES, method, 64, 7)
    assert first == samples(RANGES, method, 64, 7) != samples(RANGES, method, 64, 8)
    radii, units = column([row[0] for row in first])
    assert units == "m"
    assert radii.min() >= 2e-3
    assert radii.max() <= 4e-3
    assert {row[1] for row in first} == {"a", "b"}


def test_sobol_fills_every_cell_once() -> None:
    spans = (Span("a", 0.0, 8.0, "", False, 1), Span("b", 0.0, 8.0, "", False, 1))
    cells = [tuple(int(float(x)) for x in row) for row in samples(spans, "sobol", 64, 3)]
    assert len(set(cells)) == 64


def test_whole_numbers_stay_whole() -> None:
    assert samples((Span("wire.nodes", 40.0, 100.0, "", True, 3),), "grid", 0, 0) == [
        (40,),
        (70,),
        (100,),
    ]


def test_columns_are_in_si_units() -> None:
    assert column(["1 MPa", "20 kPa"])[1] == "Pa"
    np.testing.assert_array_equal(column(["1 MPa", "20 kPa"])[0], [1e6, 2e4])
    assert column([0.25, 0.5])[1] == "1"
    assert column(["stable", "none"])[1] == ""
    assert list(column(["stable", 1])[0]) == ["stable", "1"]


def test_all_faults_of_the_table_at_once(tmp_path: Path) -> None:
    found = faults(
        tmp_path,
        """
        [sweep]
        methd = "x"
        method = "sobol"
        samples = 12
        seed = -1
        scenario = "half-circl"
        [sweep.ranges]
        lumen.radius = { from = "1 mm", to = 2 }
        wire.radius = 3
        """,
    )
    assert [fault.split()[1] for fault in found] == [
        "sweep.methd",
        "is",
        'sweep.ranges."lumen.radius"',
        'sweep.ranges."wire.radius"',
        "sweep.seed",
    ]


def test_all_faults_of_the_runs_at_once(tmp_path: Path) -> None:
    found = faults(
        tmp_path,
        """
        [sweep]
        scenario = "half-circle"
        [sweep.ranges]
        lumen.radius = { from = "0 mm", to = "0.4 mm", count = 3 }
        wire.radus = ["3 mm"]
        """,
    )
    assert found[0] == "Input wire.radus is not a key of [wire]; did you mean 'radius'?"
    assert found[1] == "Run 0: Input lumen.radius must be positive; received 0.0 mm."
    assert [fault[:6] for fault in found[2:]] == ["Run 1:", "Run 2:"]


def test_sobol_rounds_up_to_a_power_of_two(tmp_path: Path) -> None:
    file = tmp_path / "sobol.toml"
    table = '[sweep]\nscenario = "half-circle"\nmethod = "sobol"\nsamples = {}\n[sweep.ranges]\n'
    table += '"lumen.radius" = {{ from = "2 mm", to = "3 mm" }}\n'
    file.write_text(table.format(50))
    assert len(read(file).values) == 64
    assert read(file).note == "Method 'sobol' needs a power of two: 64 runs in place of 50."
    file.write_text(table.format(8))
    assert read(file).note == ""


def test_ranges_may_say_how_a_file_is_read(tmp_path: Path) -> None:
    from magwire.scenario import load as load_scenario

    (tmp_path / "vessel").mkdir()
    rows = ["x,y,z,radius", *(f"{x},0,0,3" for x in range(0, 101, 5))]
    (tmp_path / "vessel" / "tube.csv").write_text("\n".join(rows))
    wire = load_scenario("straight").to_toml().split("[lumen]")[0]
    lumen = '[lumen]\nfile = "tube.csv"\nunits = "mm"\n[feed]\nspeed = "1 mm/s"\n'
    (tmp_path / "vessel" / "tube.toml").write_text(wire + lumen)
    file = tmp_path / "scales.toml"
    table = '[sweep]\nscenario = "vessel/tube.toml"\n[sweep.ranges]\n"lumen.scale" = [1.0, 0.5]\n'
    file.write_text(table)
    scenarios = read(file).scenarios
    assert [s.lumen.narrowest for s in scenarios] == pytest.approx([3e-3, 1.5e-3])
    written_out = tmp_path / "elsewhere.toml"
    written_out.write_text(read(file).base + '[sweep.ranges]\n"lumen.scale" = [0.5]\n')
    assert read(written_out).scenarios[0].lumen.narrowest == pytest.approx(1.5e-3)


def test_only_complete_runs_count_as_clear(tmp_path: Path) -> None:
    from magwire.many.table import blank
    from magwire.report.sweep import lines

    table = blank(read(written(tmp_path)))
    table["tip_contact_free"].values[:] = [1.0, 1.0, 0.0]
    table["wire_contact_free"].values[:] = [0.0, 1.0, 0.0]
    table["status"].values[:] = ["complete", "not converged", "complete"]
    tip, wire = lines(table)[2:4]
    assert tip.split("  ")[0] == "tip clear throughout"
    assert tip.endswith("in 1 of 2 complete runs")
    assert wire.endswith("in 0 of 2 complete runs")


def test_scenario_may_be_in_the_file(tmp_path: Path) -> None:
    from magwire.scenario import load as load_scenario

    file = tmp_path / "whole.toml"
    table = '[sweep.ranges]\n"lumen.radius" = ["2 mm", "3 mm"]\n'
    file.write_text(load_scenario("half-circle").to_toml() + table)
    assert [s.lumen.narrowest for s in read(file).scenarios] == [2e-3, 3e-3]
    file.write_text('[sweep]\nscenario = "helix"\n' + file.read_text())
    with pytest.raises(ScenarioError, match="cannot stand next to"):
        read(file)


def test_sweep_ends_in_a_table_and_a_figure(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    words = ["sweep", str(written(tmp_path)), "--workers", "1", "--keep", "--out", str(out)]
    assert main(words) == 0
    assert "3: 3 complete" in capsys.readouterr().out
    names = sorted(path.relative_to(out).as_posix() for path in out.rglob("*.*"))
    assert names == [
        *(f"runs/{n:04d}.nc" for n in range(3)),
        *("sweep.nc", "sweep.png", "sweep.svg", "sweep.toml"),
    ]
    with xr.open_dataset(out / "sweep.nc", engine="h5netcdf") as table:
        assert dict(table.sizes) == {"run": 3}
        np.testing.assert_allclose(table["lumen.radius"], [2.5e-3, 3e-3, 3.5e-3])
        assert table["lumen.radius"].attrs["units"] == "m"
        assert table["max_tip_force"].attrs["units"] == "N"
        assert (np.diff(table["max_tip_force"]) < 0.0).all()  # wider is easier
        assert not table["contact_free"].any()
    assert main(words) == 1  # nothing is overwritten
    assert "use --force" in capsys.readouterr().err


def test_interrupted_sweep_is_taken_up_again(tmp_path: Path) -> None:
    file = written(tmp_path, count="count = 60")
    out, table = tmp_path / "out", tmp_path / "out" / "sweep.nc"
    command = [sys.executable, "-m", "magwire", "sweep", file, "--workers", "1", "--out", out]
    running = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    until = time.monotonic() + 120.0
    while time.monotonic() < until and not (
        table.exists() and (load(table)["status"] == "complete").any()
    ):
        time.sleep(0.02)
    running.send_signal(signal.SIGINT)
    assert "takes up the sweep" in running.communicate()[1]
    assert running.returncode == 130
    before = load(table)
    assert 0 < int((before["status"] == "complete").sum()) < 60
    assert set(before["status"].values) == {"complete", "pending"}
    assert main(["sweep", str(file), "--workers", "1", "--out", str(out)]) == 0
    after = load(table)
    assert set(after["status"].values) == {"complete"}
    ended = (before["status"] == "complete").values
    np.testing.assert_array_equal(after["wall_time"][ended], before["wall_time"][ended])


def test_page_on_sweeps_says_what_is_there(tmp_path: Path) -> None:
    page = (Path(__file__).parents[2] / "docs" / "many.md").read_text(encoding="utf-8")
    assert {name for name in (*QUANTITIES, *KEYS) if f"`{name}`" not in page} == set()
    file = tmp_path / "example.toml"
    file.write_text(page.split("```toml\n")[1].split("```")[0])
    assert len(read(file).scenarios) == 64


def test_runs_that_end_early_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "weak.toml"
    file.write_text(
        """
        [sweep]
        scenario = "half-circle"
        [sweep.ranges]
        navigate.max_field = ["1 mT"]
        solver.motion = ["quasi-static"]
        wire.nodes = [40]
        feed.distance = ["20 mm"]
        """
    )
    assert main(["sweep", str(file), "--workers", "1", "--out", str(tmp_path / "out")]) == 1
    seen = capsys.readouterr()
    assert seen.err.startswith("1 of 1 runs did not reach their end")
    assert "1: 1 no field" in seen.out

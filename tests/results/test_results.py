from __future__ import annotations

import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray as xr

from magwire.errors import InputError, ResultError
from magwire.report.run import lines
from magwire.results import Result, Writer
from magwire.results.contract import CONSTANTS, DERIVED, VARIABLES
from records import info, records

TESTS = Path(__file__).parents[1]


def written(path: Path | None, count: int = 73, status: str = "complete") -> Result:
    run = info(title="Half-circle")
    writer = Writer(run, path)
    for record in records(run, count):
        writer.append(record)
    writer.close(status)
    return writer.result()


def test_file_has_the_contract(tmp_path: Path) -> None:
    written(tmp_path / "result.nc")
    with xr.open_dataset(tmp_path / "result.nc", engine="h5netcdf") as data:
        known = VARIABLES | DERIVED | CONSTANTS
        walls = ("surface_", "wall_amplitude", "wall_period", "wall_ramp")
        others = {name for name in known if name.startswith(walls)}
        assert set(data.variables) == set(known) - others
        for name, variable in known.items():
            if name in others:
                continue
            assert data[name].dims == variable.dims
            assert data[name].attrs["units"] == variable.units
            assert data[name].attrs["long_name"] == variable.long_name
        lengths = {"time": 73, "node": 20, "xyz": 3, "input": 3, "arc": 38, "centreline_point": 60}
        assert data.sizes == lengths
        assert data.attrs["status"] == "complete"
        assert data.attrs["title"] == "Half-circle"
        assert data.attrs["steps"] == 7200
        assert data["normalized_push"][-1] == pytest.approx(0.72)


def test_file_is_plain_hdf5_with_unlimited_time(tmp_path: Path) -> None:
    written(tmp_path / "result.nc")
    with h5py.File(tmp_path / "result.nc") as file:
        assert file["position"].shape == (73, 20, 3)
        assert file["position"].maxshape == (None, 20, 3)
        assert file["position"].dims[0][0].name == "/time"
        assert "_NCProperties" in file.attrs


def test_memory_and_file_agree(tmp_path: Path) -> None:
    there, here = written(tmp_path / "result.nc"), written(None)
    xr.testing.assert_equal(there.dataset, here.dataset)
    assert there.dataset.attrs.keys() == here.dataset.attrs.keys()


def test_save_and_load(tmp_path: Path) -> None:
    result = written(None)
    again = Result.load(result.save(tmp_path / "result.nc"))
    xr.testing.assert_equal(result.dataset, again.dataset)
    xr.testing.assert_equal(result.dataset, Result.load(tmp_path).dataset)
    assert again.status == "complete"
    assert again.max_tip_force == result.max_tip_force


def test_forces_of_a_result() -> None:
    result = written(None)
    force = np.linalg.norm(result.contact_force, axis=2)
    assert result.force_patch == pytest.approx(2.0 * 0.1 / 19)  # long edges
    assert result.max_wall_force == pytest.approx(force.sum(axis=1).max())
    assert result.max_patch_force == pytest.approx(result.max_tip_force)
    assert result.max_magnet_force == pytest.approx(result.max_tip_force)
    assert result.max_push_force == pytest.approx(1.5 * result.max_tip_force)
    assert result.max_guide_torque == pytest.approx(1e-3 * result.max_tip_force)
    assert result.force_per_length.shape == (73, 20)
    assert 0.0 < result.longest_contact < result.force_patch
    assert result.largest_force_over(1.0) == pytest.approx(result.wall_force)
    assert not result.tip_contact_free
    assert not result.wire_contact_free
    with pytest.raises(InputError, match=r"length of Result\.largest_force_over must be positive"):
        result.largest_force_over(0.0)


def test_contact_of_the_body_alone() -> None:
    data = written(None).dataset
    data.attrs["max_tip_force"] = 0.0
    result = Result(data)
    assert result.tip_contact_free
    assert result.contact_free
    assert not result.wire_contact_free


def older(result: Result) -> xr.Dataset:
    """A result as it was written before there were forces along the wire."""
    data = result.dataset.drop_vars(["arc", "way", *DERIVED, "push_force", "guide_torque"])
    for name in ("force_patch", "magnet_begin", "magnet_end"):
        del data.attrs[name]
    return data


def test_an_older_file_gets_what_follows_from_it(tmp_path: Path) -> None:
    now = written(None)
    older(now).to_netcdf(tmp_path / "result.nc", engine="h5netcdf")
    result = Result.load(tmp_path)
    for name in ("wall_force", "patch_force", "force_per_length", "contact_length", "lumen_force"):
        xr.testing.assert_allclose(result.dataset[name], now.dataset[name])
    assert np.isnan(result.max_push_force)
    assert np.isnan(result.max_magnet_force)
    result.plot(tmp_path / "a.png")
    assert "not known" not in "".join(lines(result, passive=now))


def test_an_older_file_of_a_tree_has_no_forces_along_its_way() -> None:
    data = older(written(None))
    data["lumen_branch"][30:] = 1
    result = Result(data)
    assert "lumen_force" not in result.dataset
    assert result.max_wall_force > 0.0
    result.plot()


def test_figures_of_a_result() -> None:
    result = written(None)
    assert result.converged
    assert result.max_tip_force == result.tip_force.max()
    assert result.first_contact == pytest.approx(0.013)
    assert not result.contact_free
    assert result.smallest_clearance == pytest.approx(1e-5)
    assert result.peak_field == pytest.approx(np.linalg.norm(result.field, axis=1).max())
    assert result.newton_iterations_per_step == pytest.approx(2.3)
    assert result.wall_time == pytest.approx(0.72)
    assert result.position.shape == (73, 20, 3)
    assert np.isnan(result.clearance[0, 0])
    shown = repr(result)
    assert "complete, 73 records, " in shown
    assert "mm inserted in" in shown
    assert shown.endswith("mN>")


def test_run_without_contact() -> None:
    result = written(None, count=5)
    assert result.contact_free
    assert result.first_contact is None


def test_title_comes_from_the_scenario() -> None:
    writer = Writer(info(scenario='title = "Some bend"\n'))
    writer.close("complete")
    assert writer.result().dataset.attrs["title"] == "Some bend"


@pytest.mark.parametrize("path", [None, "result.nc"])
def test_open_space_has_no_centreline(tmp_path: Path, path: str | None) -> None:
    run = info(np.zeros((0, 3)))
    writer = Writer(run, None if path is None else tmp_path / path)
    for record in records(run, 3):
        writer.append(record)
    writer.close("complete")
    assert "centreline" not in writer.result().dataset


def test_an_empty_run_is_readable(tmp_path: Path) -> None:
    Writer(info(), tmp_path / "result.nc").close("not converged", "The first step failed.")
    result = Result.load(tmp_path / "result.nc")
    assert result.time.shape == (0,)
    assert result.position.shape == (0, 20, 3)
    assert result.message == "The first step failed."
    assert np.isnan(result.smallest_clearance)
    assert result.peak_field == 0.0


def test_interruption_is_recorded(tmp_path: Path) -> None:
    run = info()

    def interrupted() -> None:
        with Writer(run, tmp_path / "a.nc") as writer:
            for record in records(run, 3):
                writer.append(record)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    result = Result.load(tmp_path / "a.nc")
    assert result.status == "interrupted"
    assert not result.converged
    assert result.time.size == 3


def test_failure_is_recorded() -> None:
    writer = Writer(info())
    with pytest.raises(ZeroDivisionError), writer:
        raise ZeroDivisionError("by zero")
    assert writer.result().status == "failed"
    assert writer.result().message == "by zero"


def test_result_of_an_open_writer_is_refused() -> None:
    with pytest.raises(ResultError, match="only after the run has ended"):
        Writer(info()).result()


def test_file_can_be_read_while_it_is_written(tmp_path: Path) -> None:
    run = info()
    writer = Writer(run, tmp_path / "result.nc")
    for record in records(run, 10):
        writer.append(record)
    writer.flush()
    command = (
        "import magwire, sys; r = magwire.Result.load(sys.argv[1]); print(r.status, r.time.size)"
    )
    seen = subprocess.run(
        [sys.executable, "-c", command, str(tmp_path / "result.nc")],
        capture_output=True,
        text=True,
        check=True,
    )
    assert seen.stdout.split() == ["running", "10"]
    writer.close("complete")


def test_killed_process_leaves_a_readable_file(tmp_path: Path) -> None:
    program = f"""
        import sys, time
        sys.path.insert(0, {str(TESTS)!r})
        from records import info, records
        from magwire.results import Writer
        run = info(nodes=100)
        writer = Writer(run, {str(tmp_path / "result.nc")!r})
        for k, record in enumerate(records(run, 100_000, step=1e-6)):
            writer.append(record)
            if k % 20 == 0:
                writer.flush()
                print(writer._written, flush=True)
    """
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(program)], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    flushed = 0
    while flushed < 400:
        flushed = int(process.stdout.readline())
    time.sleep(0.02)
    process.kill()
    process.wait()
    process.stdout.close()
    if sys.platform != "win32":
        assert process.returncode == -signal.SIGKILL
    result = Result.load(tmp_path / "result.nc")
    assert result.status == "running"
    assert result.time.size >= flushed > 0
    assert np.all(np.diff(result.feed) > 0.0)
    assert np.all(np.isfinite(result.position[:flushed]))
    with h5py.File(tmp_path / "result.nc") as file:
        assert file["position"].shape[0] >= flushed


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda p: None, "Result file '{p}' does not exist."),
        (lambda p: p.mkdir(), "Folder '{p}' holds no result.nc."),
        (
            lambda p: p.write_text("no"),
            "Result file '{p}' is not a readable NetCDF-4 file.",
        ),
        (
            lambda p: xr.Dataset({"a": 1}).to_netcdf(p, engine="h5netcdf"),
            "File '{p}' is not a result of magwire.",
        ),
    ],
)
def test_what_is_no_result_is_refused(tmp_path: Path, make, message: str) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "thing"
    make(path)
    with pytest.raises(ResultError) as caught:
        Result.load(path)
    assert str(caught.value) == message.format(p=path)


def test_unwritable_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "result.nc").mkdir()
    with pytest.raises(ResultError, match=r"cannot be written"):
        Writer(info(), tmp_path / "result.nc")


@pytest.mark.parametrize(("strength", "said"), [(11.9, False), (12.1, True)])
def test_a_field_that_no_magnet_makes_is_told(strength: float, said: bool) -> None:
    run = info()
    with Writer(run) as writer:
        for record in records(run, 5):
            record.flux_density[:] = (0.0, strength, 0.0)
            writer.append(record)
    text = "\n".join(lines(writer.result(), steered=True))
    assert ("set navigate.max_field" in text) == said

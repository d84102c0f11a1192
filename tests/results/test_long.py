"""Results that are larger than what is held of them in memory."""

from __future__ import annotations

import errno
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
import xarray as xr

from magwire import pieces
from magwire.errors import ResultError
from magwire.plot.few import MOST, few
from magwire.report.run import gains, lines
from magwire.results import Result, Writer, disk, loading, writer
from magwire.results.plain import Stored
from records import info, records


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sizes from which a result is large, a small part of what they are."""
    monkeypatch.setattr(loading, "WHOLE", loading.WHOLE // 1000)
    monkeypatch.setattr(pieces, "BYTES", pieces.BYTES // 1000)
    monkeypatch.setattr(writer, "MOST_WAITING", writer.MOST_WAITING // 300)


def written(path: Path | None, count: int = 40) -> Result:
    run = info(title="Half-circle")
    made = Writer(run, path)
    for record in records(run, count):
        made.append(record)
    made.close("complete")
    return made.result()


def read_whole(stored: Stored) -> None:
    pytest.fail(f"all of a variable of the dimensions {stored.dims} is read at once")


def in_memory(result: Result) -> list[str]:
    return [name for name, held in result.held.variables.items() if not isinstance(held, Stored)]


@pytest.mark.usefixtures("small")
def test_a_large_result_is_summed_up_without_being_in_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    there, here = written(tmp_path / "result.nc"), written(None)
    monkeypatch.setattr(Stored, "values", property(read_whole))
    names = [name for name, kind in vars(Result).items() if isinstance(kind, property)]
    names.remove("dataset")
    scalars = [name for name in names if np.ndim(getattr(here, name)) == 0]
    assert len(scalars) > 20
    for name in scalars:
        np.testing.assert_equal(getattr(there, name), getattr(here, name))
    assert repr(there) == repr(here)
    assert lines(there, steered=True) == lines(here, steered=True)
    assert gains(there, there) == gains(here, here)
    np.testing.assert_equal(there.largest_force_over(0.01), here.largest_force_over(0.01))
    assert in_memory(there) == []
    monkeypatch.undo()
    assert in_memory(here) == list(here.held.variables)
    xr.testing.assert_equal(there.dataset, here.dataset)


@pytest.mark.usefixtures("small")
def test_a_large_result_outlives_its_file(tmp_path: Path) -> None:
    path = tmp_path / "result.nc"
    first = written(path)
    written(path, 30)
    assert first.position.shape[0] == 40
    assert Result.load(path).position.shape[0] == 30


def put_aside(path: Path, monkeypatch: pytest.MonkeyPatch) -> Writer:
    """A writer with ten records in the file and some more in its draft."""
    run = info()
    made = Writer(run, path)
    for k, record in enumerate(records(run, 60)):
        made.append(record)
        if k == 9:
            made.flush()
            monkeypatch.setattr(made, "_due", float("inf"))
    return made


@pytest.mark.usefixtures("small")
def test_records_wait_in_a_draft_when_they_are_many(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "result.nc"
    made = put_aside(path, monkeypatch)
    assert 0 < len(made._waiting) < 10
    assert Result.load(path).time.size == 10
    assert len(list(tmp_path.glob(".*.draft.nc"))) == 1
    made.close("complete")
    np.testing.assert_equal(Result.load(path).position, written(None, 60).position)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.usefixtures("small")
def test_a_disk_that_fills_up_loses_nothing_that_was_flushed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "result.nc"
    made = put_aside(path, monkeypatch)
    add = disk.Draft.add

    def full(draft: disk.Draft, *rows: Any) -> None:
        add(draft, *rows)
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(disk.Draft, "add", full)
    with pytest.raises(ResultError, match="cannot be written: no space left on device"):
        made.flush()
    monkeypatch.setattr(disk.Draft, "add", add)  # without the draft there is room
    made.close("failed", "no room")
    result = Result.load(path)
    np.testing.assert_equal(result.position, written(None, 10).position)
    assert (result.status, result.steps) == ("failed", written(None, 10).steps)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.usefixtures("small")
def test_a_large_file_that_lacks_numbers_is_refused_unread(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "result.nc"
    written(path)
    with h5py.File(path, "r+") as file:
        assert loading._gap(file, path.stat().st_size) == ""
        assert "is not all in it" in loading._gap(file, path.stat().st_size // 2)
        file["wall_force"].resize(20_000, axis=0)
    monkeypatch.setattr(loading, "_damage", lambda file: "")  # which counts what is stored
    with pytest.raises(ResultError, match="is damaged: it lacks numbers of wall_force"):
        Result.load(path)


def test_a_figure_of_a_long_run_shows_its_extremes() -> None:
    short = written(None, MOST).dataset
    assert few(short) is short
    long = written(None, 3 * MOST).dataset
    long["tip_force"][1234] = long["normalized_tip_force"][1234] = 1e3
    long["clearance"][2345, 7] = 1e-9
    drawn = few(long)
    assert drawn.sizes["time"] < MOST
    assert drawn.attrs == long.attrs
    assert float(drawn["normalized_tip_force"].values.max()) == 1e3
    assert float(np.nanmin(drawn["clearance"].values)) == 1e-9
    for name in ("normalized_push", "wall_force", "lumen_force", "field"):
        assert float(drawn[name].values.max()) == float(long[name].max()), name
    assert float(drawn["time"].values[-1]) == float(long["time"][-1])


def test_small_files_are_read_without_xarray_to_the_same(tmp_path: Path) -> None:
    path = tmp_path / "result.nc"
    result = written(path)
    assert result.held.source is None
    as_xarray = xr.load_dataset(path, engine="h5netcdf")
    xr.testing.assert_identical(result.dataset, as_xarray)
    with h5py.File(path, "r+") as file:
        file["tip_force"].attrs["scale_factor"] = 1e-3  # somebody else's packing
    assert float(Result.load(path).tip_force.max()) == 1e-3 * float(as_xarray["tip_force"].max())

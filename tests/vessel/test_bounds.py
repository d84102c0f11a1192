"""Files of vessels that would cost time or memory without end, or divide by nothing."""

from __future__ import annotations

import os
import sys
import tracemalloc
import zlib
from pathlib import Path

import numpy as np
import pytest

import vessel_files
from magwire.errors import InputError
from magwire.lumen import Lumen
from magwire.vessel import Vessel, files

CASES = Path(__file__).parents[1] / "data" / "robustness"


def refusal(path: Path) -> str:
    with pytest.raises(InputError) as caught:
        Vessel.read(path, "mm").lumen()
    return str(caught.value)


def test_a_fork_of_a_thousand_branches_is_refused() -> None:
    assert "has too many lines that run along each other" in refusal(CASES / "fork1000.swc")


def test_many_lines_along_each_other_are_refused(tmp_path: Path) -> None:
    s = np.arange(0.0, 60.0, 0.5)
    rows = ["x,y,z,radius,line"]
    for line in range(250):
        rows += [f"{x},{max(x - 50.0, 0.0) * 0.01 * line},0,3,{line}" for x in s]
    (tmp_path / "bundle.csv").write_text("\n".join(rows))
    assert "has too many lines that run along each other" in refusal(tmp_path / "bundle.csv")


def test_a_radius_of_nearly_nothing_is_refused() -> None:
    with pytest.raises(InputError, match="radius of Branch must be at least"):
        Vessel.read(CASES / "vessel-traceback-zerodivision.toml").lumen()


def test_places_beyond_all_vessels_are_refused() -> None:
    with pytest.raises(InputError, match="must be within 1e"):
        Lumen.through(np.array([[0.0, 0, 0], [1e200, 0, 0]]), 1e199)


@pytest.mark.skipif(sys.platform == "win32", reason="no pipes in folders")
@pytest.mark.parametrize("end", [".vtp", ".csv", ".stl", ".nc", ".toml"])
def test_what_is_no_regular_file_is_refused(tmp_path: Path, end: str) -> None:
    os.mkfifo(tmp_path / f"pipe{end}")
    (tmp_path / f"device{end}").symlink_to("/dev/zero")
    for name in ("pipe", "device"):
        assert refusal(tmp_path / f"{name}{end}").endswith("cannot be read: it is no regular file.")


def test_files_are_read_up_to_a_size(tmp_path: Path) -> None:
    for name in ("big.csv", "big.vtp"):
        with (tmp_path / name).open("wb") as file:
            file.truncate(101_000_000)
        assert "cannot be read: it is larger than" in refusal(tmp_path / name)


def test_arrays_that_are_not_needed_stay_packed(tmp_path: Path) -> None:
    text = vessel_files.vtp("zlib")
    blank = zlib.compress(bytes(50_000_000))
    size = np.array([1, 50_000_000, 0, len(blank)], dtype="<u4").tobytes()
    packed = vessel_files.base64.b64encode(size) + vessel_files.base64.b64encode(blank)
    array = b'<DataArray type="Float64" Name="Pressure" format="binary">' + packed
    path = tmp_path / "pressure.vtp"
    path.write_bytes(text.replace(b"<PointData>", b"<PointData>" + array + b"</DataArray>", 1))
    assert b"Pressure" in path.read_bytes()
    tracemalloc.start()
    drawing = files.load(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 20e6
    assert "Pressure" in drawing.arrays
    with pytest.raises(InputError, match="no array 'Pressure'"):  # fifty million are not points
        files.load(path, "Pressure")

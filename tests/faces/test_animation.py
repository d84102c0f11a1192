"""Moving pictures of results."""

from __future__ import annotations

import itertools
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from magwire.cli import main
from magwire.engine.record import RunInfo
from magwire.errors import InputError
from magwire.plot import style
from magwire.plot.animation import MovieError, Scene, animate, magnetised
from magwire.results import Result, Writer
from magwire.scenario import load
from records import helix, info, records

SMALL = {"width": 320, "seconds": 0.5, "rate": 10}


def made(run: RunInfo, count: int = 73) -> xr.Dataset:
    writer = Writer(run)
    for record in records(run, count):
        writer.append(record)
    writer.close("complete")
    return writer.result().dataset


@pytest.mark.parametrize("line", [None, helix(), np.zeros((0, 3))], ids=["plane", "space", "open"])
def test_gif(tmp_path: Path, line: np.ndarray | None) -> None:
    seen: list[tuple[int, int]] = []
    data = made(info(line, title="Bend"))
    path = animate(data, tmp_path / "a.gif", **SMALL, watch=lambda *now: seen.append(now))
    assert seen == [(k, 5) for k in range(1, 6)]
    with Image.open(path) as picture:
        assert (picture.n_frames, picture.size) == (5, (320, 176))
        frames = []
        for k in range(5):
            picture.seek(k)
            frames.append(np.asarray(picture.convert("RGB"), dtype=float))
    for before, after in itertools.pairwise(frames):
        assert np.abs(after - before).max() > 50.0


def test_mp4(tmp_path: Path) -> None:
    import imageio_ffmpeg

    path = animate(made(info()), tmp_path / "a.mp4", **SMALL)
    frames, seconds = imageio_ffmpeg.count_frames_and_secs(str(path))
    assert frames == 5
    assert seconds == pytest.approx(0.5, abs=0.01)


def test_mp4_without_the_encoder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(MovieError, match=r"pip install magwire\[movie\]"):
        animate(made(info()), tmp_path / "a.mp4", **SMALL)
    assert not (tmp_path / "a.mp4").exists()


def test_nothing_is_left_of_a_movie_that_fails(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(done: int, frames: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        animate(made(info()), tmp_path / "a.mp4", **SMALL, watch=fail)
    assert not (tmp_path / "a.mp4").exists()


def pixels(frame: np.ndarray, colour: str) -> np.ndarray:
    """Which pixels have a colour, shape (n, 2), rows and columns."""
    wanted = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)])
    return np.argwhere(np.abs(frame.astype(int) - wanted).max(axis=2) < 12)


def test_arrow_points_along_the_field() -> None:
    data = made(info())
    data["field"][:] = np.array([-0.01, 0.0, 0.0])
    scene = Scene(data, (640, 352))
    left = pixels(scene.frame(20), style.CLEARANCE)
    data["field"][:] = np.array([0.01, 0.0, 0.0])
    right = pixels(Scene(data, (640, 352)).frame(20), style.CLEARANCE)
    assert len(left) > 20
    assert left[:, 1].mean() < right[:, 1].mean() - 20
    assert left[:, 0].mean() == pytest.approx(right[:, 0].mean(), abs=2)


def test_no_field_no_arrow() -> None:
    data = made(info())
    data["field"][:] = 0.0
    assert len(pixels(Scene(data, (640, 352)).frame(20), style.CLEARANCE)) == 0


def test_force_that_nobody_steered_is_shown_too() -> None:
    data = made(info())
    alone, both = (Scene(data, (640, 352), other).frame(40) for other in (None, data))
    assert len(pixels(alone, style.PASSIVE)) == 0
    assert len(pixels(both, style.PASSIVE)) > 10


def test_magnetised_part() -> None:
    text = load("half-circle").to_toml()
    marked = magnetised(made(info(nodes=101, scenario=text), 2))
    assert np.flatnonzero(marked).tolist() == list(range(95, 101))
    assert not magnetised(made(info(), 2)).any()


def test_magnetised_sections() -> None:
    made_of = "youngs_modulus=3 MPa", "shear_modulus=1 MPa", "density=2000 kg/m^3", "radius=0.6 mm"
    common = ", ".join(f'{key} = "{value}"' for key, value in (m.split("=") for m in made_of))
    plain, magnet = 'length = "60 mm"', 'length = "40 mm", magnetization = "1 kA/m"'
    text = f"[wire]\nsections = [{{{plain}, {common}}}, {{{magnet}, {common}}}]\n"
    marked = magnetised(made(info(nodes=101, scenario=text), 2))
    assert np.flatnonzero(marked).tolist() == list(range(60, 101))


@pytest.mark.parametrize(
    ("name", "options", "said"),
    [
        ("a.avi", {}, r"must end in \.gif or \.mp4; received 'a\.avi'"),
        ("a.gif", {"width": 10}, "width"),
        ("a.gif", {"seconds": 0.0}, "seconds"),
        ("a.gif", {"rate": 0}, "rate"),
    ],
)
def test_what_cannot_be(tmp_path: Path, name: str, options: dict[str, float], said: str) -> None:
    with pytest.raises(InputError, match=said):
        animate(made(info(), 3), tmp_path / name, **options)  # type: ignore[arg-type]
    assert list(tmp_path.iterdir()) == []


def test_no_records(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="at least one record; received 0"):
        animate(made(info(), 0), tmp_path / "a.gif")


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Result(made(info(), 10)).save(tmp_path / "result.nc")
    words = ["animate", str(tmp_path), "--seconds", "0.3", "--width", "200"]
    assert main(words) == 0
    file = tmp_path / "animation.gif"
    assert capsys.readouterr().out == f"{file}\n"
    before = file.read_bytes()
    assert main(words) == 1
    assert "use --force to overwrite" in capsys.readouterr().err
    assert file.read_bytes() == before
    assert main([*words, "--force"]) == 0

"""Pages that replay results, in a real browser without a screen."""

from __future__ import annotations

import io
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from browsers import DRAWN, FLAT, started
from magwire.cli import main
from magwire.contact.motion import gone
from magwire.errors import InputError
from magwire.results import Result, Writer
from magwire.scenario import load
from magwire.view import Page, packing, page
from records import BREATHING, info, records
from surfaces import tube

NASTY = "</script><script>window.caught = 1</script><img src=x onerror='caught=1'> & \u2028"


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """What starts a browser, by its arguments; each is started once."""
    yield from started()


@pytest.fixture(scope="module")
def helix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run through the helix, with a page."""
    folder = tmp_path_factory.mktemp("helix")
    load("helix", ["navigate.method=none"]).run().save(folder / "result.nc")
    assert main(["view", str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def shown(chromium: Any, helix: Path) -> Iterator[Any]:
    """That page in a browser without a network."""
    opened = Opened(chromium(), (helix / "view.html").as_uri())
    yield opened
    opened.page.close()


class Opened:
    """A page in a browser whose network is cut, what it sent for, and what went wrong in it."""

    def __init__(self, browser: Any, address: str, size: tuple[int, int] = (1000, 700)) -> None:
        self.requests: list[str] = []
        self.faults: list[str] = []
        context = browser.new_context(viewport={"width": size[0], "height": size[1]}, offline=True)
        self.page = context.new_page()
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("console", self._listen)
        self.page.goto(address)
        self.wait()

    def _listen(self, message: Any) -> None:
        if message.type == "error":
            self.faults.append(message.text)

    def wait(self) -> None:
        until = time.monotonic() + 30.0
        while not self.ask("!!window.magwire") and time.monotonic() < until:
            self.page.wait_for_timeout(20)
        assert self.ask("!!window.magwire"), self.faults

    def ask(self, expression: str) -> Any:
        return self.page.evaluate(expression)

    def picture(self, element: str = ".view canvas") -> np.ndarray:
        shot = self.page.locator(element).first.screenshot()
        return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB"), dtype=float)


def made(*, title: str = "", count: int = 73, nodes: int = 20, **given: Any) -> Result:
    run = info(nodes=nodes, title=title, **given)
    writer = Writer(run)
    for record in records(run, count):
        writer.append(record)
    writer.close("complete")
    return writer.result()


def opened(browser: Any, shown_page: Page, folder: Path, **options: Any) -> Opened:
    return Opened(browser, shown_page.save(folder / "page.html").as_uri(), **options)


def test_packed_numbers_are_near_enough() -> None:
    values = np.cumsum(np.random.default_rng(1).normal(size=(50, 7, 3)), axis=0)
    packed = packing.in_steps(values, 1e-3)
    assert packed["step"] == 1e-3
    assert packed["shape"] == [50, 7, 3]
    # Where 28 bits do not reach, steps are larger, and nothing overflows.
    assert packing.in_steps(values, 1e-30)["step"] == pytest.approx(np.abs(values).max() / 2**28)
    assert packing.in_steps(np.zeros((2, 3)), 0.0)["step"] == 1.0


def test_the_page_is_one_small_file(helix: Path, shown: Any) -> None:
    assert (helix / "view.html").stat().st_size < 1_000_000
    assert shown.requests == [(helix / "view.html").as_uri()]
    assert not shown.faults
    assert shown.ask("magwire.mode") == "webgl2"


def test_points_and_forces_are_those_of_the_file(helix: Path, shown: Any) -> None:
    with xr.open_dataset(helix / "result.nc", engine="h5netcdf") as data:
        times, force = data["time"].values, data["contact_force"].values
        for share in (0.0, 0.21, 0.5, 0.77, 1.0):
            record = round(share * (len(times) - 1))
            shown.ask(f"magwire.seek({times[record]})")
            assert shown.ask("magwire.record()") == record
            points = np.reshape(shown.ask("magwire.points()"), (-1, 3))
            away = np.abs(points - data["position"].values[record]).max()
            assert away < 1e-3 * data["lumen_radius"].values.min()
            forces = np.reshape(shown.ask("magwire.forces()"), (-1, 3))
            peak = np.linalg.norm(force, axis=2).max()
            assert np.linalg.norm(forces - force[record], axis=1).max() < 1e-3 * peak
            values = shown.ask("magwire.values()")
            for name in ("time", "feed", "tip_force", "wall_force", "push_force"):
                assert values[name] == data[name].values[record]  # every digit
            np.testing.assert_equal(values["clearance"], data["clearance_along"].values[record])
            for i, axis in enumerate("xyz"):
                assert values[f"field_{axis}"] == data["field"].values[record, i]
            # The wall's pressure carries the force.
            assert shown.ask("magwire.pressed()") == pytest.approx(
                data["wall_force"].values[record], abs=1e-3 * data["wall_force"].values.max()
            )


def test_the_picture_varies_and_moves(shown: Any) -> None:
    shown.ask("magwire.seek(20)")
    before = shown.picture()
    assert len(np.unique(before.reshape(-1, 3), axis=0)) > 500
    shown.ask("magwire.seek(60)")
    assert np.abs(shown.picture() - before).max() > 100.0
    shown.ask("magwire.preset('x')")
    aside = shown.picture()
    shown.ask("magwire.preset('overview')")
    assert np.abs(shown.picture() - aside).max() > 100.0


def test_curves_and_cursor_agree(shown: Any) -> None:
    shown.ask("magwire.seek(31.7)")
    values = shown.ask("magwire.values()")
    marks = shown.ask("magwire.marks()")
    assert [mark["key"] for mark in marks[:3]] == ["tip_force", "wall_force", "push_force"]
    for mark in marks:
        assert mark["drawn"] == pytest.approx(1e3 * values[mark["key"]], rel=1e-9, abs=1e-12)
        assert float(mark["written"]) == pytest.approx(1e3 * values[mark["key"]], rel=1e-3)
    push = marks[2]
    height, width = shown.picture(".panel:nth-child(2) canvas").shape[:2]
    assert 0 < push["x"] < width
    assert 0 < push["y"] < height
    dot = shown.picture(".panel:nth-child(2) canvas")[round(push["y"]), round(push["x"])]
    np.testing.assert_allclose(dot, [0x00, 0x72, 0xB2], atol=8)


def test_it_plays_by_keys_and_mouse(shown: Any) -> None:
    shown.ask("magwire.seek(0)")
    shown.page.keyboard.press("ArrowRight")
    assert shown.ask("magwire.record()") == 1
    shown.page.keyboard.press(" ")
    shown.page.wait_for_timeout(400)
    shown.page.keyboard.press(" ")
    there = shown.ask("magwire.record()")
    assert there > 1
    shown.page.wait_for_timeout(100)
    assert shown.ask("magwire.record()") == there
    box = shown.page.locator(".panel canvas").first.bounding_box()
    shown.page.mouse.click(box["x"] + box["width"] - 12, box["y"] + 20)
    assert shown.ask("magwire.values().time") == pytest.approx(72.0, abs=1.0)
    before = shown.picture()
    shown.page.mouse.move(300, 300)
    shown.page.mouse.down()
    shown.page.mouse.move(360, 340)
    shown.page.mouse.up()
    assert np.abs(shown.picture() - before).max() > 100.0
    assert not shown.faults


def test_two_results_side_by_side(chromium: Any, tmp_path: Path) -> None:
    first, second = made(title="One"), made(title="Two", count=40)
    shown = opened(chromium(), first.view(second), tmp_path)
    assert shown.ask("magwire.runs") == 2
    shown.ask("magwire.seek(60)")
    assert [shown.ask(f"magwire.record({run})") for run in (0, 1)] == [60, 39]  # it ended earlier
    for run, result in enumerate((first, second)):
        record = shown.ask(f"magwire.record({run})")
        assert shown.ask(f"magwire.values({run}).tip_force") == result.tip_force[record]
    assert shown.page.locator(".words strong").all_inner_texts() == ["1: One", "2: Two"]
    assert not shown.faults


def test_without_webgl_it_is_drawn_flat(chromium: Any, helix: Path) -> None:
    shown = Opened(chromium(FLAT), (helix / "view.html").as_uri())
    assert shown.ask("magwire.mode") == "canvas"
    shown.ask("magwire.seek(20)")
    before = shown.picture()
    assert len(np.unique(before.reshape(-1, 3), axis=0)) > 50
    shown.ask("magwire.seek(60)")
    assert np.abs(shown.picture() - before).max() > 100.0
    shown.ask("magwire.toggle()")
    done = shown.ask("magwire.pictures()")
    shown.page.wait_for_timeout(300)
    assert shown.ask("magwire.pictures()") > done
    assert not shown.faults


def test_a_graphics_processor_that_goes_away(chromium: Any, tmp_path: Path) -> None:
    shown = opened(chromium(), made().view(), tmp_path)
    shown.ask("magwire.seek(40)")
    lose = "document.querySelector('.view canvas').getContext('webgl2')"
    shown.ask(f"{lose}.getExtension('WEBGL_lose_context').loseContext()")
    shown.page.wait_for_timeout(200)
    assert shown.ask("magwire.mode") == "canvas"
    assert len(np.unique(shown.picture().reshape(-1, 3), axis=0)) > 50
    assert not shown.faults


@pytest.mark.parametrize("painter", [DRAWN, FLAT])
def test_a_wall_that_moves_is_where_it_is(
    chromium: Any, tmp_path: Path, painter: tuple[str, ...]
) -> None:
    result = made(wall_motion=BREATHING)
    shown = opened(chromium(painter), result.view(), tmp_path)

    def corners(time_: float) -> np.ndarray:
        shown.ask(f"magwire.seek({time_})")
        return np.reshape(shown.ask("magwire.wall()"), (-1, 3))

    rest, before = corners(0.0), shown.picture()
    for time_ in (3.0, 44.0, 17.0):
        moved = gone(BREATHING, rest, np.zeros(3), time_) - rest
        assert np.abs(moved).max() > 1e-4
        np.testing.assert_allclose(corners(time_) - rest, moved, atol=1e-7)
    assert np.abs(shown.picture() - before).max() > 20.0
    np.testing.assert_array_equal(corners(0.0), rest)
    assert not shown.faults
    assert "wall_period" not in made().dataset


@pytest.mark.parametrize("painter", [DRAWN, FLAT])
def test_triangles_are_drawn_as_they_are(
    chromium: Any, tmp_path: Path, painter: tuple[str, ...]
) -> None:
    """A tube three times as broad as its balls is three times as high in the picture."""
    line = np.linspace(0.0, 0.08, 60)[:, None] * [1.0, 0.0, 0.0]
    run = info(line)
    points, triangles = tube(line, lambda u, _: np.full(u.shape, 9e-3), 24)
    heights = []
    for known in (run, replace(run, surface=(points, triangles))):
        writer = Writer(known)
        for record in records(known, 30):
            writer.append(record)
        writer.close("complete")
        shown = opened(chromium(painter), writer.result().view(), tmp_path)
        shown.ask("magwire.preset('z')")
        middle = shown.picture()[60:-60].mean(axis=2)
        column = middle[:, round(0.45 * middle.shape[1])]
        steps = np.flatnonzero(np.abs(np.diff(column)) > 3.0)
        heights.append(steps.max() - steps.min())
        assert not shown.faults
    assert heights[1] / heights[0] == pytest.approx(3.0, rel=0.25)


def test_titles_are_texts(chromium: Any, tmp_path: Path) -> None:
    result = made(title=NASTY)
    shown = opened(chromium(), result.view(), tmp_path)
    assert shown.ask("window.caught === undefined")
    assert shown.page.locator(".words strong").inner_text().startswith("</script><script>window.")
    assert len(shown.requests) == 1
    assert not shown.faults


def test_notebooks_show_it(chromium: Any, tmp_path: Path) -> None:
    cell = tmp_path / "cell.html"
    cell.write_text(f"<!doctype html>{made().view()._repr_html_()}", encoding="utf-8")
    tab = chromium().new_page()
    tab.goto(cell.as_uri())
    inner = tab.locator("iframe").element_handle().content_frame()
    until = time.monotonic() + 30.0
    while not inner.evaluate("!!window.magwire") and time.monotonic() < until:
        tab.wait_for_timeout(20)
    assert inner.evaluate("magwire.times().length") == 73
    tab.close()


def test_open_space_is_framed_by_the_wire(chromium: Any, tmp_path: Path) -> None:
    shown = opened(chromium(), made(centreline=np.zeros((0, 3))).view(), tmp_path)
    shown.ask("magwire.seek(40)")
    assert len(np.unique(shown.picture().reshape(-1, 3), axis=0)) > 100
    assert not shown.faults


def test_what_cannot_be_shown() -> None:
    with pytest.raises(InputError, match="at least one record; received 0"):
        made(count=0).view()
    broken = made().dataset
    broken["position"][3, 4] = np.nan
    with pytest.raises(InputError, match="finite numbers; position has others"):
        page([("broken", broken)])
    with pytest.raises(InputError, match="one or two; received 0"):
        page([])


def test_a_page_is_not_overwritten(
    helix: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = str(tmp_path / "a" / "page.html")
    assert main(["view", str(helix), "--out", out]) == 0
    assert main(["view", str(helix), "--out", out]) == 1
    assert "exists already; use --force" in capsys.readouterr().err
    assert main(["view", str(helix), str(helix / "result.nc"), "--out", out, "--force"]) == 0
    assert main(["view", str(helix), "--out", str(tmp_path)]) == 1
    assert "is a folder" in capsys.readouterr().err

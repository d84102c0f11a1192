"""Pictures of results: what is on them, not how they look."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
import xarray as xr
from matplotlib.image import imread

from magwire import plot
from magwire.engine.record import RunInfo
from magwire.plot import loads, shapes
from magwire.results import Result, Writer
from records import helix, info, records


def made(run: RunInfo, count: int = 73, *, status: str = "complete") -> xr.Dataset:
    writer = Writer(run)
    for record in records(run, count):
        writer.append(record)
    writer.close(status)
    return writer.result().dataset


def test_png_and_svg_at_paper_size(tmp_path: Path) -> None:
    paths = plot.save(made(info()), tmp_path)
    assert [path.name for path in paths] == ["figure.png", "figure.svg"]
    height, width = imread(paths[0]).shape[:2]
    assert width == pytest.approx(180.0 / 25.4 * 300, abs=1)
    assert height > 0.4 * width


def test_same_result_same_picture(tmp_path: Path) -> None:
    data = made(info(), 5)
    first = [path.read_bytes() for path in plot.save(data, tmp_path, "a")]
    assert first == [path.read_bytes() for path in plot.save(data, tmp_path, "b")]


def test_settings_of_others_are_left_alone() -> None:
    before = dict(mpl.rcParams)
    plot.draw(made(info(), 5))
    assert dict(mpl.rcParams) == before


def test_planar_case_has_flat_panels() -> None:
    figure = plot.draw(made(info(title="Half-circle")))
    axes = figure.get_axes()
    assert not any(ax.name == "3d" for ax in axes)
    labels = {ax.get_ylabel() for ax in axes}
    assert {"y [mm]", "field [mT]", "clearance [mm]", r"tip force  $\mathcal{F}$"} <= labels
    assert {"along the lumen [mm]", "forces [mN]", "wall force [N/m]"} <= labels
    assert any("Half-circle" in ax.get_title(loc="left") for ax in axes)


def test_helix_is_drawn_in_space() -> None:
    figure = plot.draw(made(info(helix())))
    assert sum(ax.name == "3d" for ax in figure.get_axes()) == 1


def tree() -> RunInfo:
    """A run in two branches that start as one."""
    one, other = info(helix()), helix() * [1.0, 1.0, -1.0]
    return replace(
        one,
        centreline=np.concatenate([one.centreline, other]),
        lumen_radius=np.full(2 * len(other), 3e-3),
        lumen_branch=np.repeat([0, 1], len(other)),
    )


def test_all_branches_are_drawn_each_without_what_is_inside_of_another() -> None:
    data = made(tree(), 5)
    parts = shapes.branches(data)
    assert len(parts) == 2
    wall = np.stack(shapes._outside(shapes.tube(parts[1]), parts[:1]), axis=-1)
    hidden = np.isnan(wall).any(axis=(1, 2))
    assert hidden[:5].all()
    assert not hidden[len(wall) // 2 :].any()
    (ax,) = (ax for ax in plot.draw(data).get_axes() if ax.name == "3d")
    assert (ax.elev, ax.azim) != shapes.VIEW


def test_title_tells_of_an_early_end() -> None:
    figure = plot.draw(made(info(title="Bend"), 30, status="interrupted"))
    titles = [ax.get_title(loc="left") for ax in figure.get_axes()]
    assert any("Bend (interrupted at push 0.290)" in title for title in titles)


def test_title_tells_of_quasi_static_motion() -> None:
    for run, title in (("Bend", "Bend, quasi-static"), ("", "quasi-static")):
        figure = plot.draw(made(replace(info(title=run), motion="quasi-static"), 30))
        assert any(ax.get_title(loc="left").endswith(title) for ax in figure.get_axes())
    figure = plot.draw(made(info(title="Bend"), 30))
    assert not any("dynamic" in ax.get_title(loc="left") for ax in figure.get_axes())


def test_result_draws_itself(tmp_path: Path) -> None:
    result = Result(made(info(), 20))
    result.plot(tmp_path / "mine.pdf")
    assert (tmp_path / "mine.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize("count", [0, 1, 2], ids=["nothing", "one", "two"])
@pytest.mark.parametrize("line", [None, helix(), np.zeros((0, 3))], ids=["plane", "space", "open"])
def test_short_runs_can_be_drawn(count: int, line: np.ndarray | None) -> None:
    plot.draw(made(info(line), count))


def test_run_without_field_contact_and_magnet_can_be_drawn(tmp_path: Path) -> None:
    data = made(info(), 8)
    data["field"] = 0.0 * data["field"]
    data["normalized_tip_force"] = 0.0 * data["normalized_tip_force"]
    data["clearance"] = np.nan * data["clearance"]
    data["clearance_midpoint"] = np.nan * data["clearance_midpoint"]
    data.attrs["field_scale"] = np.nan
    plot.save(data, tmp_path)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_plane_is_found(axis: int) -> None:
    line = np.roll(info().centreline, axis + 1, axis=1)
    assert shapes.plane(made(info(line), 1)) == ((1, 2), (0, 2), (0, 1))[axis]


def test_tilted_lumen_is_spatial() -> None:
    line = info().centreline.copy()
    line[:, 2] = 0.01 * line[:, 0]
    assert shapes.plane(made(info(line), 1)) is None


def test_snapshots_are_at_round_feeds() -> None:
    data = made(info())
    push = data["normalized_push"].values[shapes.snapshots(data)]
    assert push == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7])


def test_wide_lumen_shares_its_column() -> None:
    line = np.column_stack([np.linspace(0.0, 0.1, 20), np.zeros(20), np.zeros(20)])
    data = made(info(line, title="Tube"))
    assert shapes.aspect(data) > 5.0
    panels = [ax for ax in plot.draw(data).get_axes() if ax.get_title(loc="left")]
    assert len(panels) == 8


def test_map_shows_where_along_the_lumen_the_wall_is_pressed() -> None:
    data = made(info())
    (ax,) = (a for a in plot.draw(data).get_axes() if a.get_ylabel() == "along the lumen [mm]")
    (image,) = ax.get_images()
    shown = np.asarray(image.get_array())
    assert shown.shape == (data.sizes["arc"], 72)
    pressed = 1e3 * data["arc"].values[shown.argmax(axis=0)]
    fed = (np.arange(72) + 1.0)[14:]  # the tip slides along the centreline and carries all
    assert pressed[14:] == pytest.approx(fed, abs=2.2)
    assert not shown[:, :12].any()


@pytest.mark.parametrize(("branches", "where"), [(1, "off the path"), (2, "in other branches")])
def test_map_tells_of_what_presses_off_the_path(branches: int, where: str) -> None:
    def words(data: xr.Dataset) -> str:
        axes = plot.draw(data).get_axes()
        (ax,) = (a for a in axes if a.get_ylabel() == "along the lumen [mm]")
        return " ".join(text.get_text() for text in ax.texts)

    data = made(info())
    data["lumen_branch"] = (
        "centreline_point",
        np.arange(data.sizes["centreline_point"]) % branches,
    )
    assert words(data) == "dashed: insertion"
    data["lumen_force"] = 0.9 * data["lumen_force"]
    assert f"not shown: what presses\n{where}" in words(data)
    data["lumen_force"] = 0.0 * data["lumen_force"]
    assert words(data) == f"all {where}"
    data["wall_force"] = 0.0 * data["wall_force"]
    assert words(data) == "nothing touches the wall"


def test_map_of_a_retraction_keeps_the_largest_force() -> None:
    push = np.array([0.0, 0.1, 0.2, 0.1, 0.0])
    values = np.array([[0.0], [1.0], [2.0], [3.0], [0.5]])
    last, found = loads.columns_of(push, values)
    assert last == 0.2
    assert found[:, 0].tolist() == [0.5, 0.5, 3.0, 2.0]


def test_both_runs_have_a_map_on_one_scale() -> None:
    data, passive = made(info()), made(info())
    data["lumen_force"] = 0.5 * data["lumen_force"]
    axes = plot.draw(data, passive).get_axes()
    maps = [ax.get_images()[0] for ax in axes if ax.get_images()]
    assert len(maps) == 2
    assert maps[0].get_clim() == maps[1].get_clim()
    assert maps[0].get_clim()[1] == passive["lumen_force"].values.max()


def test_a_row_on_friction_where_there_is_any() -> None:
    """With the twists of a wire that is turned on its way, or else how far it slid."""
    rubbed = made(info())
    still = rubbed.assign(guide_twist=0.0 * rubbed["guide_twist"])
    smooth = rubbed.assign(friction_work=0.0 * rubbed["friction_work"])
    labels = [
        {ax.get_ylabel() for ax in plot.draw(data).get_axes()} for data in (rubbed, still, smooth)
    ]
    assert {"friction [mN]", "work of friction [µJ]", "twist [deg]"} <= labels[0]
    assert "slid on the wall [mm]" in labels[1]
    assert labels[1] - labels[2] == {
        "friction [mN]",
        "work of friction [µJ]",
        "slid on the wall [mm]",
    }

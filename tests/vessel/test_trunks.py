"""Wide trunks entered from narrow side branches: the wall is the trunk's, from any entrance."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import magwire as mw
from magwire.cli import main
from magwire.kernels.wall.gap import gap_many
from magwire.vessel import Vessel
from magwire.vessel.balls import Balls

DATA = Path(__file__).parents[1] / "data" / "vessels"
Array = NDArray[np.float64]


def written(path: Path, lines: dict[str, tuple[Array, Array]]) -> Path:
    """A table of lines and radii [mm]."""
    rows = ["line,x [mm],y [mm],z [mm],radius [mm]"]
    for name, (points, radius) in lines.items():
        rows += [f"{name},{x},{y},{z},{r}" for (x, y, z), r in zip(points, radius, strict=True)]
    path.write_text("\n".join(rows))
    return path


def tee(bend: float, lean: float, wide: float, narrow: float) -> dict[str, tuple[Array, Array]]:
    """A bent trunk along x that tapers a little, and a side branch from its middle [mm]."""
    s = np.linspace(-70.0, 70.0, 141)
    trunk = np.column_stack([s, bend * (s / 70.0) ** 2, 3.0 * np.sin(s / 40.0)])
    t = np.linspace(0.0, 60.0, 70)[:, None]
    side = trunk[70] + t * np.array([np.sin(lean), 0.0, np.cos(lean)])
    return {
        "trunk": (trunk, wide * (1.0 - 0.001 * (s + 70.0))),
        "side": (side, narrow * (1.0 - 0.003 * t[:, 0])),
    }


def around(line: tuple[Array, Array], share: float, count: int = 24) -> Array:
    """Points at a part of the radius from a line that is not near its ends, shape (n, 3) [m]."""
    points, radius = line
    tangent = np.gradient(points, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    first = np.cross(tangent, [0.0, 1.0, 0.1])
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(tangent, first)
    angle = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)[:, None, None]
    ring = points + share * radius[:, None] * (np.cos(angle) * first + np.sin(angle) * second)
    return 1e-3 * ring[:, 15:-15].reshape(-1, 3)


@pytest.mark.parametrize(
    ("bend", "lean", "wide", "narrow", "backwards"),
    [(0.0, 0.0, 10.0, 2.0, False), (12.0, 0.5, 8.0, 2.5, True), (-10.0, -0.4, 6.0, 1.0, False)],
)
@pytest.mark.parametrize("entrance", ["side", "trunk"])
def test_the_trunk_is_as_wide_from_a_side_branch_as_from_its_end(
    bend: float,
    lean: float,
    wide: float,
    narrow: float,
    backwards: bool,
    entrance: str,
    tmp_path: Path,
) -> None:
    lines = tee(bend, lean, wide, narrow)
    if backwards:
        lines = {name: (p[::-1], r[::-1]) for name, (p, r) in reversed(lines.items())}
    point = 1e-3 * (lines["side"][0][0 if backwards else -1])
    if entrance == "trunk":
        point = 1e-3 * lines["trunk"][0][0]
    vessel = Vessel.read(written(tmp_path / "a.csv", lines), entrance=point.tolist())
    lumen = vessel.lumen()
    assert lumen.gap(around(lines["trunk"], 0.95)).min() > 0.0
    assert len(vessel.trunks) >= (1 if entrance == "side" else 0)
    assert any("no path runs straight through it" in n for n in vessel.notes) == bool(vessel.trunks)
    assert len(lumen.outlets) == 2  # a trunk leads nowhere
    assert vessel.deviation is not None
    assert vessel.deviation.outside.radii[2] < 0.1
    assert vessel.deviation.inside.radii[1] < 0.05
    # outside of the trunk, away from the side branch, there is nothing
    out = around(lines["trunk"], 1.08)
    clear = np.linalg.norm(out[:, None] - 1e-3 * lines["side"][0], axis=2).min(axis=1)
    assert lumen.gap(out[clear > 4e-3 * narrow]).max() < 0.0


def test_the_gap_has_no_jumps_where_a_trunk_begins(tmp_path: Path) -> None:
    lines = tee(12.0, 0.5, 8.0, 2.5)
    vessel = Vessel.read(written(tmp_path / "a.csv", lines), entrance="side")
    lumen = vessel.lumen()
    arrays = lumen.arrays()
    rng = np.random.default_rng(0)
    near = around(lines["trunk"], 0.97)
    near = near[rng.integers(0, len(near), 4000)]
    way = rng.normal(size=near.shape)
    way /= np.linalg.norm(way, axis=1)[:, None]
    step = 2e-6
    found = []
    for k in range(4):
        gap, arc = np.empty((2, len(near)))
        gap_many(arrays, near + k * step * way, gap, arc, np.empty(len(near), dtype=np.int32))
        found.append(gap)
    slopes = np.diff(found, axis=0) / step
    assert np.abs(slopes).max() < 1.0 + 1e-6  # Lipschitz
    assert np.abs(np.diff(slopes, axis=0)).max() < 0.02  # and its gradient turns slowly


@pytest.fixture(scope="module")
def from_the_basilar() -> tuple[Vessel, mw.Lumen]:
    """The handed vertebral arteries, and their lumen."""
    vessel = Vessel.read(DATA / "c28_vertebrals_join_loop.csv", entrance="basilar")
    return vessel, vessel.lumen()


def test_the_handed_vertebral_arteries_from_the_basilar_one(
    from_the_basilar: tuple[Vessel, mw.Lumen],
) -> None:
    vessel, lumen = from_the_basilar
    angle = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    x = np.concatenate([np.linspace(-50.0, -16.0, 40), np.linspace(16.0, 50.0, 40)])
    x, angle = (each.ravel() for each in np.meshgrid(x, angle))
    points = 1e-3 * np.column_stack([x, 9.7 * np.cos(angle), -20.0 + 9.7 * np.sin(angle)])
    assert lumen.gap(points).min() > 0.0
    assert vessel.deviation is not None
    assert vessel.deviation.inside.radii[2] < 0.05
    for way in vessel.ways.values():
        assert way.narrowed < 0.5e-3


@pytest.mark.parametrize("entrance", ["aorta", "side"])
def test_the_handed_side_branch_at_a_wide_end_from_the_other_ends(entrance: str) -> None:
    vessel = Vessel.read(DATA / "c30_small_side_branch_at_wide_end.csv", entrance=entrance)
    lumen = vessel.lumen()
    s = np.linspace(0.0, 0.1, 60)
    points = np.column_stack([s, 0 * s, -0.97 * 15e-3 + 0.0083 * s])
    assert lumen.gap(points).min() > 0.0
    assert vessel.deviation is not None
    assert vessel.deviation.inside.radii[2] < 0.05


@pytest.mark.parametrize("ending", [".vtp", ".nc", ".toml"])
def test_trunks_go_with_the_files_that_are_written(
    ending: str, from_the_basilar: tuple[Vessel, mw.Lumen], tmp_path: Path
) -> None:
    source = DATA / "c28_vertebrals_join_loop.csv"
    out = tmp_path / f"a{ending}"
    assert main(["lumen", "convert", str(source), str(out), "--entrance", "basilar"]) == 0
    (vessel, lumen), again = from_the_basilar, Vessel.read(out)
    assert len(again.trunks) == len(vessel.trunks) == 2
    assert list(again.balls) == list(vessel.balls)
    for one, other in zip(vessel.trunks, again.trunks, strict=True):
        assert np.allclose(one, other, rtol=1e-14, atol=1e-17)
    assert again.lumen().outlets == lumen.outlets
    if ending == ".toml":
        text = out.read_text() + (
            '[wire]\nlength = "80 mm"\nnodes = 81\nradius = "0.6 mm"\nyoungs_modulus = "3 MPa"\n'
            'shear_modulus = "1 MPa"\ndensity = "2000 kg/m^3"\n[feed]\nspeed = "1 mm/s"\n'
            'distance = "20 mm"\n'
        )
        (tmp_path / "run.toml").write_text(text)
        made = mw.load_scenario(tmp_path / "run.toml").lumen.build()
        points = np.random.default_rng(0).uniform(-0.03, 0.03, (500, 3))
        assert np.array_equal(made.gap(points), lumen.gap(points), equal_nan=True)


def fork(path: Path, ways: list[tuple[float, float, float]], length: float, narrow: float) -> Path:
    """An SWC file of a trunk of 2 mm along x that ends in two teeth [mm]."""
    rows, last = [f"{k + 1} 3 {k} 0 0 2 {k or -1}" for k in range(21)], 21
    for way in ways:
        before, step = 21, np.array(way) / np.linalg.norm(way) / 2.0
        for k in range(1, int(2 * length) + 1):
            x, y, z = np.array([20.0, 0.0, 0.0]) + k * step
            last += 1
            rows.append(f"{last} 3 {x:.6f} {y:.6f} {z:.6f} {narrow} {before}")
            before = last
    path.write_text("\n".join(rows))
    return path


@pytest.mark.parametrize("length", [3.0, 4.0, 5.0, 9.0])
@pytest.mark.parametrize("lean", [0.1, 0.15])
def test_outlets_of_a_fork_cut_short_may_overlap(
    lean: float, length: float, tmp_path: Path
) -> None:
    path = fork(tmp_path / "a.swc", [(1.0, lean, 0.0), (1.0, -lean, 0.0)], length, 1.0)
    vessel = Vessel.read(path, "mm")
    lumen = vessel.lumen()
    assert lumen.outlets == ("end-2", "end-3")
    end = np.array([20.0, 0.0, 0.0]) + (length - 0.8) * np.array([1.0, lean, 0.0])
    assert lumen.gap(1e-3 * end[None])[0] > 0.8e-3
    assert lumen.gap(1e-3 * (end[None] + [0.0, 1.3, 0.0]))[0] < 0.0


def test_teeth_side_by_side_that_bend_sharply_are_a_tree(tmp_path: Path) -> None:
    """The first is narrow in its bend, where the second leaves it."""
    path = fork(tmp_path / "a.swc", [(0.0, 1.0, 0.0), (0.2, 1.0, 0.0)], 8.0, 1.0)
    vessel = Vessel.read(path, "mm")
    assert vessel.lumen().outlets == ("end-2", "end-3")
    assert vessel.deviation is not None
    assert vessel.deviation.outside.radii[2] < 0.05


def test_an_end_inside_of_another_tube_is_left_out_and_said(tmp_path: Path) -> None:
    path = fork(tmp_path / "a.swc", [(1.0, 0.1, 0.0), (1.0, -0.05, 0.0)], 5.0, 1.0)
    text = path.read_text().splitlines()
    x, y, z = (float(value) for value in text[-1].split()[2:5])
    for k in range(1, 12):
        text.append(f"{len(text) + 1} 3 {x + 0.5 * k} {y} {z} 1.0 {len(text)}")
    path.write_text("\n".join(text))
    vessel = Vessel.read(path, "mm")
    assert vessel.lumen().outlets == ("end-3",)
    assert "The path to 'end-2' is left out: it ends inside of another one's tube." in vessel.notes


def test_how_deep_a_point_is_where_narrow_tubes_run_beside_wide_ones() -> None:
    rng = np.random.default_rng(0)
    s = np.linspace(0.0, 1.0, 400)[:, None]
    wide = np.hstack([20 * s, 0 * s, 0 * s]), np.full(400, 2.0)
    thin = np.hstack([20 * s, 1.5 + 0 * s, 0.3 * s]), np.linspace(1.1, 1.6, 400)
    points, radius = (np.concatenate([a, b]) for a, b in zip(wide, thin, strict=True))
    asked = rng.uniform([0.0, -3.0, -3.0], [20.0, 4.0, 3.0], (500, 3))
    apart = np.linalg.norm(asked[:, None] - points, axis=2)
    assert np.array_equal(Balls(points, radius).depth(asked), (radius - apart).max(axis=1))

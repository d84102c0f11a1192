"""``magwire actuator plot``: what is drawn, what is said, what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import magwire as mw
from magwire.cli import main

PLOT = ("actuator", "plot")


def test_coils_are_drawn_with_the_fields_that_they_make(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "coils.png"
    thin = [f"actuator.pairs.{k}.width=0 mm" for k in range(3)]
    words = [word for text in thin for word in ("--set", text)]
    assert main([*PLOT, "half-circle-helmholtz", *words, "--out", str(picture)]) == 0
    said = capsys.readouterr().out
    assert said.startswith("In the middle, at 12.5, 25, 0 mm: ")
    assert "mT in its worst" in said
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert main([*PLOT, "half-circle-helmholtz", "--out", str(picture)]) == 1
    assert "exists already; use --force" in capsys.readouterr().err


def test_a_table_alone_is_drawn_too(tmp_path: Path) -> None:
    (tmp_path / "field.toml").write_text(
        '[actuator]\nkind = "uniform"\nmax_component = "20 mT"\n', encoding="utf-8"
    )
    assert main([*PLOT, str(tmp_path / "field.toml"), "--out", str(tmp_path / "field.svg")]) == 0
    assert "<svg" in (tmp_path / "field.svg").read_text(encoding="utf-8")


def test_a_magnet_is_drawn_with_its_reach(tmp_path: Path) -> None:
    from magwire.actuate import Magnet
    from magwire.plot.actuators import Scene, draw
    from magwire.scenario import load_actuator

    magnet = load_actuator("half-circle-magnet")
    assert isinstance(magnet, Magnet)
    low, high = magnet.pose.shift - 0.05, magnet.pose.shift + 0.05
    figure = draw(magnet, Scene(low, high, magnet.idle), None)
    assert {ax.get_ylabel() for ax in figure.axes} >= {"flux density [mT]", "y [mm]"}


def test_where_a_magnet_is_drawn_to_be_is_in_the_axes_of_the_picture() -> None:
    """Not in those of its arm, which stands turned here."""
    from magwire.actuate import Magnet, Pose
    from magwire.plot.actuators import Scene, draw

    pose = Pose.turned((0.0, 1.0, 0.0), np.pi / 2.0, (0.0, 0.01, 0.0))
    parked = (0.1, 0.02, 0.03, 0.0, 0.0, -2.0)
    magnet = Magnet(radius=0.02, remanence=1.4, parked=parked, pose=pose)
    figure = draw(magnet, Scene(np.full(3, -0.05), np.full(3, 0.05), magnet.idle), None)
    assert figure.axes[0].get_title(loc="left") == "magnet at 30, 30, -100 mm, along -1, 0, 0"


def test_a_result_from_python_says_that_its_actuator_is_not_known(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wire = mw.Wire.uniform(
        length=0.02, radius=5e-4, youngs_modulus=3e6, shear_modulus=1e6, density=2e3, nodes=9
    )
    bare = mw.Simulation(wire, mw.Lumen.straight(0.03, 3e-3))
    bare.run(mw.Feed(1e-2, 1e-3), out=tmp_path / "bare.nc")
    assert main([*PLOT, str(tmp_path / "bare.nc")]) == 1
    assert "set up in Python: its actuator is not known here" in capsys.readouterr().err


def test_a_scenario_without_an_actuator_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*PLOT, "half-circle"]) == 1
    assert "must have a table [actuator]" in capsys.readouterr().err

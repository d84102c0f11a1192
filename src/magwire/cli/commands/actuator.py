"""The command ``magwire actuator plot``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from cyclopts import App

from magwire.cli.folders import writing_to
from magwire.cli.options import Flag, Overrides
from magwire.cli.words import CommandError, say

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from magwire.actuate import Actuator, Extremes
    from magwire.plot.actuators import Scene

    Array = NDArray[np.float64]

actuator = App(name="actuator", help="Look at coils and magnets.")

MARGIN = 0.25
"""Of the working volume, around what is in it."""
ALONE = 0.05
"""Half of the volume's side around an actuator that says nothing of it [m]."""


@actuator.command(name="plot")
def plot_actuator(
    file: Path,
    /,
    *,
    overrides: Overrides = None,
    out: Path | None = None,
    force: Flag = False,
) -> None:
    """Draw an actuator's field with the wire in it, and the set of fields that it can make.

    Of a result the field is drawn where it is strongest, with the wire as it was then.

    Parameters
    ----------
    file
        A TOML file with a table [actuator], a scenario of the library, or a result of a run.
    overrides
        Keys to set, such as actuator.max_power="1 kW".
    out
        Image to write, PNG, SVG or PDF by its suffix; NAME-actuator.png if left out.
    force
        Overwrite an image.
    """
    from magwire.files import successor
    from magwire.plot import actuators as pictures

    device, scene = _scene(file, overrides or ())
    middle = 0.5 * (scene.low + scene.high)
    found = _set(device, middle)
    path = out or Path(f"{file.resolve().stem}-actuator.png")
    if path.exists() and not force:
        raise CommandError(f"Image '{path}' exists already; use --force to overwrite it.")
    if found is not None:
        say(
            f"In the middle, at {', '.join(f'{1e3 * x:.4g}' for x in middle)} mm: "
            f"{1e3 * found.worst:.3g} mT in its worst, {1e3 * found.median:.3g} mT in the median, "
            f"{1e3 * found.best:.3g} mT in its best direction."
        )
    figure = pictures.draw(device, scene, found)
    with writing_to(path.parent), successor(path) as draft:
        figure.savefig(draft)
    say(str(path))


def _set(device: Actuator, middle: Array) -> Extremes | None:
    """The set of fields; None of a magnet that moves."""
    from magwire.actuate import extremes

    if any(one.unit in ("m", "") for one in device.inputs):
        return None
    return extremes(device, middle)


def _scene(file: Path, overrides: Sequence[str]) -> tuple[Actuator, Scene]:
    """The actuator of a file, and what is to be drawn with it."""
    from magwire.files import parse_toml
    from magwire.plot.actuators import Scene
    from magwire.results import Result
    from magwire.scenario import load, load_actuator, parse
    from magwire.scenario.reader import text_of

    if file.suffix == ".nc" or file.is_dir():
        result = Result.load(file)
        if not result.scenario:
            raise CommandError(
                "The result is of a run that was set up in Python: its actuator is not known here."
            )
        described = parse(result.scenario, overrides, source="of the result")
        if described.actuator is None:
            raise CommandError("The scenario of the result has no table [actuator].")
        at = int(np.argmax(np.linalg.norm(result.field, axis=1)))
        lumen = described.lumen.build()
        tubes = _tubes(lumen)
        low, high = _around(tubes)
        wire = result.position[at]
        fed = result.dataset["clearance"].values[at]
        return described.actuator.build(), Scene(
            low, high, result.inputs[at], tubes, wire[np.isfinite(fed)]
        )
    name = str(file)
    device = load_actuator(name, overrides)
    if "lumen" in parse_toml(text_of(name)[0]):
        tubes = _tubes(load(name, overrides).lumen.build())
        low, high = _around(tubes)
    else:
        tubes, middle = (), device.pose.shift
        low, high = middle - ALONE, middle + ALONE
        if device.workspace is not None:
            own = np.array([device.workspace.low, device.workspace.high])
            corners = np.array(np.meshgrid(*own.T)).reshape(3, -1).T @ device.pose.matrix.T
            low, high = corners.min(axis=0) + middle, corners.max(axis=0) + middle
    found = _set(device, 0.5 * (low + high))
    inputs = device.idle if found is None else found.inputs[int(np.argmax(found.flux_density))]
    return device, Scene(low, high, np.nan_to_num(inputs), tubes)


def _tubes(lumen: object) -> tuple[Array, ...]:
    """Points and radius of each branch [m]."""
    from magwire.lumen import Lumen

    assert isinstance(lumen, Lumen)
    lines = (lumen.centreline(i) for i in range(len(lumen.branches)))
    return tuple(np.column_stack([points, radius]) for points, radius in lines)


def _around(tubes: tuple[Array, ...]) -> tuple[Array, Array]:
    """Opposite corners of a volume around branches [m]."""
    points = np.concatenate(tubes)
    low = (points[:, :3] - points[:, 3:]).min(axis=0)
    high = (points[:, :3] + points[:, 3:]).max(axis=0)
    room = MARGIN * float((high - low).max())
    return low - room, high + room

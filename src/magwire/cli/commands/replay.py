"""The command ``magwire replay``."""

from __future__ import annotations

from pathlib import Path

from magwire.cli.commands.run import carry_out
from magwire.cli.folders import RESULT
from magwire.cli.laboratory import EXACT, Departures
from magwire.cli.options import Flag, Overrides


def replay(
    result: Path,
    /,
    *,
    scale: float = 1.0,
    resample: str | None = None,
    departures: Departures = EXACT,
    overrides: Overrides = None,
    out: Path | None = None,
    force: Flag = False,
) -> int:
    """Run a result's scenario again in the field that was recorded, whatever the wire does.

    With an actuator its inputs are played, through hardware that departs from its model where an
    option says so: the wire is then in the field that the hardware makes.

    Parameters
    ----------
    result
        Result file, or the folder that holds it.
    scale
        Factor on the recorded field, such as 1.03 for a field that is 3 percent too strong.
    resample
        Feed between two values of the field that are kept, such as "2 mm"; it is linear between.
    departures
        How the hardware departs from its model.
    overrides
        Keys to set in the scenario, such as wire.youngs_modulus="3.1 MPa".
    out
        Folder for the output; NAME-replay in the working folder if left out.
    force
        Overwrite what a former run left in the folder.
    """
    from magwire.results import Result
    from magwire.scenario.replays import replayed
    from magwire.units import parse

    step = None if resample is None else parse(resample, "length", "--resample")
    described = replayed(Result.load(result), overrides or (), scale=scale, resample=step)
    name = result.resolve() if result.is_dir() or result.name != RESULT else result.resolve().parent
    folder = out or Path(f"{name.stem}-replay")
    actuator = None if described.actuator is None else described.actuator.build()
    return carry_out(described, folder, hardware=departures.hardware(actuator), force=force)

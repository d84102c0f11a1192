"""The command ``magwire export``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from magwire.cli.folders import occupied, writing_to
from magwire.cli.laboratory import ALONE, Playing, played
from magwire.cli.options import Flag
from magwire.cli.words import CommandError, say


def export(
    result: Path,
    /,
    *,
    kind: Annotated[Literal["pvd", "csv", "mcap", "inputs"], Parameter(name="--to")],
    out: Path | None = None,
    frame: Literal["lps", "ras"] = "lps",
    playing: Playing = ALONE,
    force: Flag = False,
) -> None:
    """Write a result for other programs, or for a laboratory that plays it.

    Parameters
    ----------
    result
        Result file, or the folder that holds it.
    kind
        pvd for ParaView, csv for tables, mcap for a log of ROS 2 messages, or inputs for currents
        (or poses) and feed against time, as the hardware can follow them.
    out
        Folder for the files; NAME-pvd and so on in the working folder if left out.
    frame
        Axes of positions, forces and fields: lps as in result files and DICOM, or ras as in 3D
        Slicer, with x and y turned round.
    playing
        How a schedule of inputs is made.
    force
        Overwrite what is in the folder.
    """
    from magwire import export as formats
    from magwire.results import Result

    writers = {"pvd": formats.write_pvd, "csv": formats.write_tables, "mcap": formats.write_mcap}
    loaded = Result.load(result)
    if kind != "inputs":
        playing.refuse_any()
    elif frame != "lps":
        raise CommandError("Option --frame must be lps for inputs, whose poses are in that frame.")
    table = played(loaded, playing) if kind == "inputs" else None  # faults before any file
    name = result.resolve()
    folder = out or Path(f"{(name.parent if name.name == 'result.nc' else name).stem}-{kind}")
    with occupied(folder, force=force), writing_to(folder):
        if table is None:
            written = writers[kind](loaded.dataset, folder, frame)
        else:
            written = formats.write_timetable(table, folder)
        for path in written:
            say(str(path))
    if table is None:
        say(f"axes {frame.upper()}, all in SI units")
        return
    from magwire.report import schedule

    for line in schedule.lines(table, float(loaded.time[-1] - loaded.time[0])):
        say(line)

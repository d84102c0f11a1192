"""The command ``magwire export``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from magwire.cli.folders import occupied, writing_to
from magwire.cli.options import Flag
from magwire.cli.words import say


def export(
    result: Path,
    /,
    *,
    kind: Annotated[Literal["pvd", "csv", "mcap"], Parameter(name="--to")],
    out: Path | None = None,
    frame: Literal["lps", "ras"] = "lps",
    force: Flag = False,
) -> None:
    """Write a result for other programs: ParaView, tables, or a log of ROS 2 messages.

    Parameters
    ----------
    result
        Result file, or the folder that holds it.
    kind
        pvd for ParaView, csv for tables, or mcap for a log.
    out
        Folder for the files; NAME-pvd and so on in the working folder if left out.
    frame
        Axes of positions, forces and fields: lps as in result files and DICOM, or ras as in 3D
        Slicer, with x and y turned round.
    force
        Overwrite what is in the folder.
    """
    from magwire import export as formats
    from magwire.results import Result

    writers = {"pvd": formats.write_pvd, "csv": formats.write_tables, "mcap": formats.write_mcap}
    data = Result.load(result).dataset
    name = result.resolve()
    folder = out or Path(f"{(name.parent if name.name == 'result.nc' else name).stem}-{kind}")
    with occupied(folder, force=force), writing_to(folder):
        for path in writers[kind](data, folder, frame):
            say(str(path))
    say(f"axes {frame.upper()}, all in SI units")

"""The commands ``magwire lumen inspect`` and ``magwire lumen convert``."""

from __future__ import annotations

from pathlib import Path

from cyclopts import App

from magwire.cli.options import Flag
from magwire.cli.reading import USUAL, Point, Reading, source_of, spot
from magwire.cli.words import complain, say

lumen = App(name="lumen", help="Look into a vessel's file, or write it anew.")


@lumen.command(name="inspect")
def inspect_lumen(
    *files: Path,
    reading: Reading = USUAL,
    wire: str | None = None,
    youngs_modulus: str | None = None,
    max_force: str | None = None,
    compare: Path | None = None,
    picture: Path | None = None,
) -> int:
    """Say what is in a file of centrelines or of a surface, and what is wrong with it.

    Ends with status 1 and the same sentence where a run would refuse the vessel.

    Parameters
    ----------
    files
        The file; or a folder of files, or several files, of one branch each.
    reading
        How a vessel's file is read.
    wire
        Diameter of a wire, such as "0.4 mm", to say which outlets it gets to.
    youngs_modulus
        Those of a solid wire, such as "3 MPa": what it takes to bend it.
    max_force
        Force on the wall that is allowed, such as "1 mN".
    compare
        Another file of the same vessel, to see whether its axes point the same way.
    picture
        Image to draw.
    """
    from magwire.cli.vessel_files import draw
    from magwire.report import vessel as report

    found = report.inspect(
        source_of(files),
        units=reading.units,
        wire={"diameter": wire, "modulus": youngs_modulus, "force": max_force},
        other=compare,
        wall=reading.wall,
        **reading.options(),
    )
    for line in found.lines:
        say(line)
    if picture is not None:
        draw(found.vessel, picture, wire)
        say(str(picture))
    if found.refusal:
        complain(found.refusal)
    return 1 if found.refusal else 0


@lumen.command(name="convert")
def convert_lumen(
    *files: Path,
    reading: Reading = USUAL,
    target: Point = None,
    force: Flag = False,
) -> None:
    """Write the smooth tubes of a file to another one.

    Parameters
    ----------
    files
        Centrelines or a surface; and last the file to write: .vtp as VMTK does, in millimetres; .nc
        (NetCDF), in metres; or .toml, the lumen's table of a scenario.
    reading
        How a vessel's file is read.
    target
        Name or number of an end, or a point, of the scenario's table; the first outlet if left out.
    force
        Overwrite what is there.
    """
    from magwire.cli.vessel_files import write
    from magwire.vessel import Vessel

    source, out = source_of(files[:-1]), files[-1]
    vessel = Vessel.read(source, reading.units, **reading.options())
    write(vessel, spot(target, "--target"), out, wall=reading.wall, force=force)
    say(str(out))

"""The commands ``magwire lumen inspect`` and ``magwire lumen convert``."""

from __future__ import annotations

from pathlib import Path

from cyclopts import App

from magwire.cli.options import Flag
from magwire.cli.words import say

lumen = App(name="lumen", help="Look into a vessel's file, or write it anew.")


@lumen.command(name="inspect")
def inspect_lumen(
    file: Path,
    /,
    *,
    units: str | None = None,
    entrance: str | None = None,
    radius: str | None = None,
    scale: float = 1.0,
    smoothing: float = 0.5,
    wire: str | None = None,
    youngs_modulus: str | None = None,
    max_force: str | None = None,
    compare: Path | None = None,
    picture: Path | None = None,
) -> None:
    """Say what is in a file of centrelines or of a surface, and what is wrong with it.

    Parameters
    ----------
    file
        The file.
    units
        Unit of its numbers, such as mm; guessed if left out.
    entrance
        Name or number of an end, or a point such as "1 mm, 2 mm, 3 mm"; the widest end if left out.
    radius
        Name of the array that holds the radius, or one radius for all, such as "2 mm".
    scale
        Factor on all lengths.
    smoothing
        Length in radii; shorter waves of the centrelines are taken out.
    wire
        Diameter of a wire, such as "0.4 mm", to say which outlets it gets to.
    youngs_modulus
        Of a solid wire, such as "3 MPa": what it takes to bend it.
    max_force
        Force on the wall that is allowed, such as "1 mN".
    compare
        Another file of the same vessel, to see whether its axes point the same way.
    picture
        Image to draw.
    """
    from magwire import lumen_commands as commands

    lines, vessel = commands.inspect(
        file,
        units=units,
        wire={"diameter": wire, "modulus": youngs_modulus, "force": max_force},
        other=compare,
        entrance=commands.spot(entrance, "--entrance"),
        radius=commands.radius_of(radius),
        scale=scale,
        smoothing=smoothing,
    )
    for line in lines:
        say(line)
    if picture is not None:
        commands.picture(vessel, picture, wire)
        say(str(picture))


@lumen.command(name="convert")
def convert_lumen(
    file: Path,
    out: Path,
    /,
    *,
    units: str | None = None,
    entrance: str | None = None,
    target: str | None = None,
    radius: str | None = None,
    scale: float = 1.0,
    smoothing: float = 0.5,
    force: Flag = False,
) -> None:
    """Write the smooth tubes of a file to another one.

    Parameters
    ----------
    file
        Centrelines or a surface.
    out
        File to write: .vtp as VMTK does, in millimetres; .nc (NetCDF), in metres; or .toml, the
        lumen's table of a scenario.
    units
        Unit of the numbers in the file, such as mm; needed unless it states one.
    entrance
        Name or number of an end, or a point such as "1 mm, 2 mm, 3 mm"; the widest end if left out.
    target
        The same, of the scenario's table; the first outlet if left out.
    radius
        Name of the array that holds the radius, or one radius for all, such as "2 mm".
    scale
        Factor on all lengths.
    smoothing
        Length in radii; shorter waves of the centrelines are taken out.
    force
        Overwrite what is there.
    """
    from magwire import lumen_commands as commands
    from magwire.vessel import Vessel

    vessel = Vessel.read(
        file,
        units,
        entrance=commands.spot(entrance, "--entrance"),
        radius=commands.radius_of(radius),
        scale=scale,
        smoothing=smoothing,
    )
    commands.convert(vessel, commands.spot(target, "--target"), out, force=force)
    say(str(out))

"""The command ``magwire plan``."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path

from magwire.cli.folders import occupied, writing_to
from magwire.cli.options import Flag
from magwire.cli.words import CommandError, say, say_if_compiling


def plan_outlets(
    source: str,
    /,
    *,
    wire: str | None = None,
    max_field: str | None = None,
    units: str | None = None,
    entrance: str | None = None,
    scale: float | None = None,
    youngs_modulus: str | None = None,
    magnetization: str | None = None,
    magnetized_tip: str | None = None,
    out: Path | None = None,
    force: Flag = False,
) -> int:
    """Steer a wire to every outlet, by equilibria: table, and with --out files and a map.

    Parameters
    ----------
    source
        Centrelines or a surface of a vessel; or a scenario, by its name or its TOML file.
    wire
        Diameter of the wire, such as "0.6 mm"; of a scenario, its own if left out.
    max_field
        Largest flux density, such as "50 mT".
    units
        Of a vessel's file, such as mm; needed unless it states one.
    entrance
        Of a vessel's file: name or number of an end, or a point such as "1 mm, 2 mm, 3 mm".
    scale
        Of a vessel's file: factor on all lengths.
    youngs_modulus
        With a vessel's file: of the wire, "3 MPa" if left out.
    magnetization
        With a vessel's file: of the magnet along its axis, "128 kA/m" if left out.
    magnetized_tip
        With a vessel's file: length of the magnet; ten radii of the wire if left out.
    out
        Folder for plan.csv, plan.json and the map plan.png; nothing is written if left out.
    force
        Overwrite what is there.
    """
    from rich.console import Console

    from magwire import plan_commands as commands
    from magwire.progress import pieces
    from magwire.scenario import load, names

    words = {
        "diameter": wire,
        "field": max_field,
        "modulus": youngs_modulus,
        "magnetization": magnetization,
        "magnet": magnetized_tip,
    }
    claim = nullcontext() if out is None else occupied(out, force=force)  # better before the work
    say_if_compiling()
    with claim:
        with pieces(1) as begin:
            if source in names() or Path(source).suffix == ".toml":
                given = {
                    "--units": units,
                    "--entrance": entrance,
                    "--scale": scale,
                    "--youngs-modulus": youngs_modulus,
                    "--magnetization": magnetization,
                    "--magnetized-tip": magnetized_tip,
                }
                for option, value in given.items():
                    if value is not None:
                        raise CommandError(
                            f"Option {option} is for a vessel's file; received {value!r}."
                        )
                lumen, prospects = commands.of_scenario(load(source), words, watch=begin)
            else:
                lumen, prospects = commands.of_file(
                    Path(source),
                    words,
                    units=units,
                    entrance=entrance,
                    scale=1.0 if scale is None else scale,
                    watch=begin,
                )
        console = Console()
        if not console.is_terminal:
            console = Console(width=commands.FILE_WIDTH)
        console.print(commands.table(prospects))
        for line in commands.reasons(prospects):
            say(line)
        if out is not None:
            with writing_to(out):
                for path in commands.save(lumen, prospects, out):
                    say(str(path))
        return 0

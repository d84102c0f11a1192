"""The command ``magwire plan``."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from magwire.cli.folders import check_free, occupied, writing_to
from magwire.cli.options import Flag
from magwire.cli.reading import USUAL, Points, Reading, refuse, source_of
from magwire.cli.words import say, say_if_compiling

if TYPE_CHECKING:
    from magwire.cli.errand import Work


def plan_outlets(
    *sources: str,
    wire: str | None = None,
    target: Points = (),
    max_field: str | None = None,
    reading: Reading = USUAL,
    youngs_modulus: str | None = None,
    magnetization: str | None = None,
    magnetized_tip: str | None = None,
    out: Path | None = None,
    force: Flag = False,
) -> int:
    """Steer a wire to outlets, by equilibria: a row for each, and with --out files and a map.

    Parameters
    ----------
    sources
        Centrelines or a surface of a vessel, a folder or several files of one branch each; or a
        scenario, by its name or its TOML file.
    wire
        Diameter of the wire, such as "0.6 mm"; of a scenario, its own if left out.
    target
        Outlets to try, by their names or numbers, or points; all of them if left out.
    max_field
        Largest flux density, such as "50 mT".
    reading
        How a vessel's file is read.
    youngs_modulus
        With a vessel's file: of the wire, "3 MPa" if left out.
    magnetization
        With a vessel's file: of the magnet along its axis, "128 kA/m" if left out.
    magnetized_tip
        With a vessel's file: length of the magnet; ten radii of the wire if left out.
    out
        Folder for plan.csv, plan.json and the map plan.png, renewed as each outlet is done; nothing
        is written if left out.
    force
        Overwrite what is there.
    """
    from magwire.cli import errand
    from magwire.scenario import load, names

    words = {
        "diameter": wire,
        "field": max_field,
        "modulus": youngs_modulus,
        "magnetization": magnetization,
        "magnet": magnetized_tip,
    }
    if out is not None:  # better said before the work than after it
        check_free(out, force=force)
    say_if_compiling()
    if len(sources) == 1 and (sources[0] in names() or Path(sources[0]).suffix == ".toml"):
        reading.refuse_any()
        refuse(
            {
                "youngs-modulus": youngs_modulus,
                "magnetization": magnetization,
                "magnetized-tip": magnetized_tip,
            }
        )
        work = errand.of_scenario(load(sources[0]), words)
    else:
        source = source_of(tuple(map(Path, sources)))
        work = errand.of_file(source, reading.units, words, reading.options(), reading.wall)
    with nullcontext() if out is None else occupied(out, force=force):
        _carry_out(work, errand.outlets(work, target), out)
    return 0


def _carry_out(work: Work, names: tuple[str, ...], out: Path | None) -> None:
    """Plan for one outlet after the other; say and write each as it is done."""
    from magwire.cli import errand
    from magwire.report import outlets
    from magwire.report.progress import pieces

    for note in work.notes:
        say(note)
    say(outlets.head(names))
    done, files = [], []
    with pieces(len(names)) as begin:
        begin(names[0])
        for prospect in errand.carried_out(work, names):
            done.append(prospect)
            say(outlets.row(prospect, names))
            if out is not None:
                with writing_to(out):
                    files = outlets.save(work.lumen, done, out)
            if len(done) < len(names):
                begin(names[len(done)])
    for line in [*outlets.reasons(done), *map(str, files)]:
        say(line)

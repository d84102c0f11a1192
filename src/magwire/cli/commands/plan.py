"""The command ``magwire plan``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from magwire.cli.folders import check_free, occupied, writing_to
from magwire.cli.options import Flag
from magwire.cli.reading import USUAL, Points, Reading, refuse, source_of
from magwire.cli.words import INTERRUPTED, complain, say, say_if_compiling

if TYPE_CHECKING:
    from magwire.cli.errand import Work
    from magwire.many.planners import Crew
    from magwire.planning import Prospect, Trial

EARLY = 4  # planners, at most, that are started before it is known how many outlets there are


def plan_outlets(
    *sources: str,
    wire: str | None = None,
    target: Points = (),
    max_field: str | None = None,
    reading: Reading = USUAL,
    youngs_modulus: str | None = None,
    magnetization: str | None = None,
    magnetized_tip: str | None = None,
    robust: Flag = False,
    workers: int | None = None,
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
    robust
        Try what is reached once more with edges 0.75 and 1.25 times as long, moduli 5 percent and
        the field 3 percent off, and the vessel 0.2 mm beside: a second table.
    workers
        Processes, each of which plans for one outlet at a time; one for each core if left out.
    out
        Folder for plan.csv, plan.json and the map plan.png, renewed as each outlet is done; nothing
        is written if left out. A plan that was interrupted there is taken up again.
    force
        Overwrite what is there.
    """
    from magwire.errors import whole
    from magwire.many.children import cores
    from magwire.many.planners import Crew

    words = {
        "diameter": wire,
        "field": max_field,
        "modulus": youngs_modulus,
        "magnetization": magnetization,
        "magnet": magnetized_tip,
    }
    count = whole("plan", "workers", cores() if workers is None else workers, minimum=1)
    early = min(count, EARLY) if count > 1 and len(target) != 1 else 0
    with Crew(early) as crew:
        from magwire.cli import errand
        from magwire.report import outlets
        from magwire.scenario import load, names

        if out is not None and not outlets.begun(out):  # better said before the work than after it
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
        wanted = errand.outlets(work, target)
        if out is None:
            _carry_out(work, wanted, None, count, crew, robust=robust)
            return 0
        again = not force and outlets.begun(out, errand.fingerprint(work))
        with occupied(out, force=force or again):
            if again:
                complain(f"Taking up the plan in '{out}'.")
            try:
                known = outlets.taken_up(out) if again else []
                _carry_out(work, wanted, out, count, crew, robust=robust, known=known)
            except KeyboardInterrupt:
                complain(f"Interrupted; the same command takes up the plan in '{out}' again.")
                return INTERRUPTED
        for file in outlets.files(out):
            say(str(file))
        return 0


def _carry_out(
    work: Work,
    names: tuple[str, ...],
    out: Path | None,
    workers: int,
    crew: Crew,
    *,
    robust: bool,
    known: Sequence[Prospect] = (),
) -> None:
    """Plan for the outlets, and try what is reached if that is asked for."""
    for note in work.notes:
        say(note)
    done = {prospect.outlet: prospect for prospect in known}
    _plan(work, names, out, workers, crew, done)
    if robust:
        _check(work, names, out, workers, done)


def _plan(
    work: Work,
    names: tuple[str, ...],
    out: Path | None,
    workers: int,
    crew: Crew,
    done: dict[str, Prospect],
) -> None:
    """Plan for the outlets; say and write each as it is done, first those of an earlier time."""
    from magwire.cli import errand
    from magwire.report import outlets
    from magwire.report.progress import pieces

    say(outlets.head(names))
    for prospect in done.values():
        if prospect.outlet in names:
            say(outlets.row(prospect, names))
    left = [name for name in names if name not in done]
    with pieces(len(left)) as begin:
        begin(", ".join(left[:workers]))
        for prospect in errand.carried_out(work, left, workers, crew):
            done[prospect.outlet] = prospect
            say(outlets.row(prospect, names))
            _save(work, done, out)
            begin(", ".join(n for n in left if n not in done))
    for line in outlets.reasons([done[name] for name in names]):
        say(line)


def _check(
    work: Work, names: tuple[str, ...], out: Path | None, workers: int, done: dict[str, Prospect]
) -> None:
    """Try the ways to outlets; say and write each when all is tried of it."""
    from magwire.cli import errand
    from magwire.planning.perturbations import CHANGES
    from magwire.report import outlets
    from magwire.report.progress import pieces

    reached = [done[name] for name in names if done[name].reached]
    left = [prospect for prospect in reached if not prospect.trials]
    say("")
    say(outlets.robust_head(names))
    for prospect in reached:
        if prospect.trials:
            say(outlets.robust_row(prospect, names))
    trials: dict[str, list[Trial]] = {prospect.outlet: [] for prospect in left}
    with pieces(len(left) * len(CHANGES)) as begin:
        begin("")
        for name, trial in errand.checked(work, left, workers):
            trials[name].append(trial)
            if len(trials[name]) == len(CHANGES):
                done[name] = replace(done[name], trials=errand.in_order(trials[name]))
                say(outlets.robust_row(done[name], names))
                _save(work, done, out)
            begin(f"{name}, {trial.change}")
    for line in outlets.failures([done[name] for name in names]):
        say(line)


def _save(work: Work, done: dict[str, Prospect], out: Path | None) -> None:
    """Write what is done, if it is to be written."""
    from magwire.cli import errand
    from magwire.report import outlets

    if out is not None:
        with writing_to(out):
            outlets.save(work.lumen, list(done.values()), out, errand.fingerprint(work))

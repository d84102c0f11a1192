"""The command ``magwire run``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from magwire.cli.folders import (
    FIGURES,
    PASSIVE,
    RESULT,
    SCENARIO,
    SCHEDULE,
    check_free,
    occupied,
    writing_to,
)
from magwire.cli.options import Flag, Overrides
from magwire.cli.words import INTERRUPTED, CommandError, complain, say, say_if_compiling
from magwire.files import write_whole
from magwire.status import RunStatus

if TYPE_CHECKING:
    from magwire.actuate import Hardware
    from magwire.results import Result
    from magwire.scenario import Scenario
    from magwire.scenario.job import Job
    from magwire.wire import Wire


def run(
    scenario: str,
    /,
    *,
    overrides: Overrides = None,
    out: Path | None = None,
    compare: Literal["none"] | None = None,
    no_figure: Flag = False,
    force: Flag = False,
) -> int:
    """Run a scenario: result, summary and figure.

    Parameters
    ----------
    scenario
        Name of a scenario of the library, or a TOML file.
    overrides
        Keys to set in the scenario, such as wire.radius="0.5 mm".
    out
        Folder for the output; NAME-result in the working folder if left out.
    compare
        Run the scenario without steering, too, and show both.
    no_figure
        Draw none: it takes longer than a short run. 'magwire plot' draws it any time.
    force
        Overwrite what a former run left in the folder.
    """
    from magwire.scenario import load

    described = load(scenario, overrides or ())
    if compare is not None and described.navigate.method == "none":
        raise CommandError(
            "Option --compare none needs a scenario that is steered; navigate.method is 'none'."
        )
    folder = out or Path(f"{Path(scenario).stem}-result")
    return carry_out(
        described, folder, compare=compare is not None, draw=not no_figure, force=force
    )


def carry_out(
    described: Scenario,
    folder: Path,
    *,
    compare: bool = False,
    draw: bool = True,
    force: bool = False,
    hardware: Hardware | None = None,
) -> int:
    """Run a scenario and leave all that comes of it in a folder; the exit status.

    With ``hardware`` the wire is in the field that it makes; see ``Simulation.run``.
    """
    check_free(folder, force=force)
    job = described.build()  # all faults before anything is written
    for note in described.notes:
        say(note)
    with occupied(folder, force=force):
        with writing_to(folder):
            for name in (RESULT, PASSIVE, SCHEDULE, *FIGURES):
                (folder / name).unlink(missing_ok=True)
            write_whole(folder / SCENARIO, described.to_toml())
        results = [simulate(job, folder / RESULT, hardware=hardware)]
        if compare and results[0] is not None and results[0].status != RunStatus.INTERRUPTED:
            results.append(simulate(described.unsteered().build(), folder / PASSIVE))
        return _report(described, job.simulation.system.wire, folder, results, draw=draw)


def _report(
    described: Scenario, wire: Wire, folder: Path, results: list[Result | None], *, draw: bool
) -> int:
    """Say how the runs ended and draw them; the exit status."""
    result, *others = results
    if result is None:
        complain("The run was interrupted before its first record.")
        return INTERRUPTED
    passive = others[0] if others else None
    steered = described.navigate.method != "none"
    from magwire.report import run as summary

    for line in summary.lines(result, steered=steered, passive=passive):
        say(line)
    for line in summary.wire_lines(wire):
        say(line)
    if passive is not None:
        for line in summary.gains(result, passive):
            say(line)
    if steered and result.held.sizes["time"]:
        with writing_to(folder):
            _write_course(described, result, folder / SCHEDULE)
    status = max(outcome(run) for run in results)
    if status == INTERRUPTED:  # whoever interrupts does not want to wait
        complain(f"No figure is drawn; 'magwire plot {folder}' draws what there is.")
    elif draw:
        from magwire import plot as pictures

        with writing_to(folder):
            pictures.save(result.held, folder, passive=passive.held if passive else None)
    say(f"{'written to':{summary.COLUMN}}{folder}")
    return status


def _write_course(described: Scenario, result: Result, path: Path) -> None:
    """Write what steered: the inputs of the actuator, or the field where there is none."""
    from magwire.scenario import inputs_of, schedule_of, write_inputs, write_schedule

    if described.actuator is None:
        write_schedule(schedule_of(result), path)
    else:
        write_inputs(inputs_of(result), path)


def outcome(result: Result | None) -> int:
    """The exit status of a run, with a word on standard error if it did not reach its end."""
    if result is None:
        complain("The run without steering was interrupted before its first record.")
        return INTERRUPTED
    if result.status == RunStatus.COMPLETE:
        return 0
    complain(result.message or f"The run ended early: {result.status}.")
    return INTERRUPTED if result.status == RunStatus.INTERRUPTED else 1


def simulate(job: Job, file: Path, *, hardware: Hardware | None = None) -> Result | None:
    """Run a job with a progress bar; None if it was interrupted before its first record."""
    from magwire.report.progress import running
    from magwire.results import Result

    say_if_compiling()
    with running(job.feed.duration) as show:
        try:
            return job.run(file, watch=show, hardware=hardware)
        except KeyboardInterrupt:  # the file says "interrupted" by now
            return Result.load(file) if file.exists() else None

"""The command line."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import App, CycloptsError, Parameter

import magwire
from magwire.errors import MagwireError
from magwire.lumen_app import lumen

if TYPE_CHECKING:
    import xarray as xr

    from magwire.engine.record import Record
    from magwire.results import Result
    from magwire.scenario import Scenario
    from magwire.scenario.job import Job

INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells have it."""
RESULT, SCENARIO, FIGURES = "result.nc", "scenario.toml", ("figure.png", "figure.svg")
PASSIVE, SCHEDULE = "result-none.nc", "schedule.csv"

Folder = Annotated[Path | None, Parameter(help="Folder for the output.")]
Force = Annotated[bool, Parameter(negative="", help="Overwrite what is there.")]
Names = Annotated[list[str] | None, Parameter(consume_multiple=True)]
Overrides = Annotated[list[str] | None, Parameter(name="--set", consume_multiple=True)]

app = App(
    name="magwire",
    help="Simulate magnetic soft continuum robots in lumens.",
    version=lambda: magwire.__version__,
    version_flags=["--version"],
    result_action="return_value",
)
app.command(lumen)


class CommandError(MagwireError):
    """A command that cannot be carried out."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command.

    Parameters
    ----------
    arguments
        The words after ``magwire``; those of the process if left out.

    Returns
    -------
    int
        Exit status: 0 only if the job did what it says.
    """
    words = sys.argv[1:] if arguments is None else list(arguments)
    try:
        status = app(words, exit_on_error=False, print_error=False)
    except KeyboardInterrupt:
        complain("Interrupted.")
        return INTERRUPTED
    except (MagwireError, CycloptsError) as error:
        complain(str(error))
        return 1
    except BrokenPipeError:  # a reader such as head has seen enough
        sys.stderr.close()
        return 1
    return status if isinstance(status, int) else 0


def say(text: str = "") -> None:
    """A line on standard output."""
    sys.stdout.write(text + "\n")


def complain(text: str) -> None:
    """A line on standard error."""
    sys.stderr.write(text.strip() + "\n")


@app.command(name="list")
def list_scenarios() -> None:
    """List the scenarios that come with magwire."""
    from magwire.scenario import load, names

    width = max(map(len, names()))
    for name in names():
        say(f"{name:{width}}  {load(name).description}")


@app.command
def schema() -> None:
    """Print the JSON schema of scenario files."""
    from magwire.scenario import json_schema

    say(json.dumps(json_schema(), indent=2))


@app.command
def plot(result: Path, /, *, out: Folder = None, force: Force = False) -> None:
    """Draw a result as figure.png and figure.svg.

    Parameters
    ----------
    result
        Result file, or the folder that holds it.
    out
        Folder for the figures; next to the result, where they replace the ones of the run, if left
        out.
    force
        Overwrite figures in another folder.
    """
    from magwire import plot as pictures
    from magwire.results import Result

    data = Result.load(result)
    beside = result if result.is_dir() else result.parent
    passive = passive_beside(result)
    folder = out or beside
    if folder.exists() and not folder.is_dir():
        raise CommandError(f"Output folder '{folder}' is a file.")
    there = [name for name in FIGURES if (folder / name).exists()]
    if there and not force and folder.resolve() != beside.resolve():
        raise CommandError(
            f"Folder '{folder}' holds {' and '.join(there)} already; use --force to overwrite."
        )
    with writing_to(folder):
        for path in pictures.save(data.dataset, folder, passive=passive):
            say(str(path))


@app.command
def run(
    scenario: str,
    /,
    *,
    overrides: Overrides = None,
    out: Folder = None,
    compare: Literal["none"] | None = None,
    force: Force = False,
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
    return carry_out(described, folder, compare=compare is not None, force=force)


@app.command
def replay(
    result: Path,
    /,
    *,
    scale: float = 1.0,
    resample: str | None = None,
    overrides: Overrides = None,
    out: Folder = None,
    force: Force = False,
) -> int:
    """Run a result's scenario again in the field that was recorded, whatever the wire does.

    Parameters
    ----------
    result
        Result file, or the folder that holds it.
    scale
        Factor on the recorded field, such as 1.03 for a field that is 3 percent too strong.
    resample
        Feed between two values of the field that are kept, such as "2 mm"; it is linear between.
    overrides
        Keys to set in the scenario, such as wire.youngs_modulus="3.1 MPa".
    out
        Folder for the output; NAME-replay in the working folder if left out.
    force
        Overwrite what a former run left in the folder.
    """
    from magwire.results import Result
    from magwire.scenario.schedules import replayed
    from magwire.units import parse

    step = None if resample is None else parse(resample, "length", "--resample")
    described = replayed(Result.load(result), overrides or (), scale=scale, resample=step)
    name = result.resolve() if result.is_dir() or result.name != RESULT else result.resolve().parent
    folder = out or Path(f"{name.stem}-replay")
    return carry_out(described, folder, force=force)


@app.command
def sweep(
    file: Path,
    /,
    *,
    workers: int | None = None,
    out: Folder = None,
    keep: Annotated[bool, Parameter(negative="")] = False,
    cluster: str | None = None,
    force: Force = False,
) -> int:
    """Run a scenario for many values of its keys: one table, and a figure.

    Parameters
    ----------
    file
        TOML file with a table [sweep], which says what varies.
    workers
        Processes, one on each core; one for each core if left out.
    out
        Folder for the output; NAME-sweep in the working folder if left out. A sweep that was
        interrupted there is taken up again.
    keep
        Keep the result file of each run.
    cluster
        Address of a Dask scheduler, such as tcp://10.0.0.1:8786, or local.
    force
        Overwrite what is there.
    """
    from magwire.errors import whole
    from magwire.many import sweep as sweeps
    from magwire.many import sweeping
    from magwire.many.runs import cores

    count = whole("sweep", "workers", cores() if workers is None else workers, minimum=1)
    described = sweeps.read(file)
    runs = len(described.scenarios)  # all faults of the file before anything is written
    folder = out or Path(f"{file.stem}-sweep")
    again = sweeping.begun(folder, described)
    if force:
        (folder / sweeping.TABLE).unlink(missing_ok=True)
    elif again:
        complain(f"Taking up the sweep in '{folder}'.")
    else:
        check_free(folder, force=False)
    with writing_to(folder):
        try:
            table = sweeping.carry_out(described, folder, workers=count, keep=keep, cluster=cluster)
        except KeyboardInterrupt:
            complain(f"Interrupted; the same command takes up the sweep in '{folder}' again.")
            return INTERRUPTED
        from magwire.plot import save_sweep

        save_sweep(table, folder)
    for line in sweeping.lines(table):
        say(line)
    say(f"{'written to':22}{folder}")
    early = [str(word) for word in table["status"].values if word != "complete"]
    if early:
        complain(
            f"{len(early)} of {runs} runs did not reach their end; the table's messages say why."
        )
    return 1 if early else 0


@app.command
def bench(
    *,
    repeats: int = 5,
    quick: Annotated[bool, Parameter(negative="")] = False,
    as_json: Annotated[bool, Parameter(name="--json", negative="")] = False,
    read: Annotated[Path | None, Parameter(name="--read")] = None,
) -> int:
    """Measure times, counts and ratios on this machine: one page, in one thread.

    Parameters
    ----------
    repeats
        How often each thing is measured.
    quick
        One repeat of a short feed, which shows that it works.
    as_json
        Print all samples as JSON in place of the page.
    read
        File of such samples to make the page of, without measuring.
    """
    import os
    import subprocess

    from magwire.errors import whole
    from magwire.many.processes import ONE_THREAD

    whole("bench", "--repeats", repeats, minimum=1)
    if read is None and any(os.environ.get(name) != one for name, one in ONE_THREAD.items()):
        # Libraries look at these when they are loaded, which they are by now.
        words = ["bench", "--repeats", str(repeats), *["--quick"] * quick, *["--json"] * as_json]
        command = [sys.executable, "-m", "magwire", *words]
        return subprocess.run(command, env=os.environ | ONE_THREAD, check=False).returncode
    from magwire.bench import page

    if read is None:
        from rich.console import Console

        from magwire.bench.run import measure

        with Console(stderr=True).status("measuring ...") as status:
            results = measure(repeats=repeats, quick=quick, tell=status.update)
    else:
        results = page.load(read)
    if as_json:
        say(json.dumps(results, indent=1))
    else:
        page.show(results)
    return 0


@app.command
def reproduce(*, only: Names = None, out: Folder = None, force: Force = False) -> int:
    """Run the paper's cases: figures, and what it says next to what magwire finds.

    Parameters
    ----------
    only
        Parts of the page: setup, passive, half-circle, sinusoid, helix, branches, authors, speed.
    out
        Folder for reproduce.html, reproduce.md and images; reproduce in the working folder if left
        out.
    force
        Overwrite what a former run left in the folder.
    """
    from magwire.progress import pieces
    from magwire.reproduce import report

    names = report.chosen(only)
    folder = out or Path("reproduce")
    check_free(folder, force=force)
    say_if_compiling()
    with writing_to(folder), pieces(len(report.asks(names)) + len(names)) as begin:
        chapters = report.reproduce(folder, names, watch=begin)
    for chapter in chapters:
        for text in chapter.broken:
            complain(text)
    say(str(folder / report.PAGE))
    return 1 if any(chapter.broken for chapter in chapters) else 0


@app.command
def animate(
    result: Path,
    /,
    *,
    out: Path | None = None,
    width: int = 960,
    seconds: float = 12.0,
    force: Force = False,
) -> None:
    """Make a moving picture of a result: the wire in its lumen, the field and the tip force.

    Parameters
    ----------
    result
        Result file, or the folder that holds it.
    out
        File to write, .gif or .mp4 by its suffix; animation.gif next to the result if left out.
    width
        Of the picture, in pixels.
    seconds
        How long it takes.
    force
        Overwrite the file.
    """
    from magwire.plot import animation
    from magwire.progress import pieces
    from magwire.results import Result

    data = Result.load(result).dataset
    beside = result if result.is_dir() else result.parent
    passive = passive_beside(result)
    file = out or beside / "animation.gif"
    if file.exists() and not force:
        raise CommandError(f"File '{file}' exists already; use --force to overwrite it.")
    rate = 25 if file.suffix.lower() == ".mp4" else 12
    with writing_to(file.parent), pieces(round(seconds * rate)) as begin:
        animation.animate(
            data,
            file,
            passive=passive,
            width=width,
            seconds=seconds,
            rate=rate,
            watch=lambda *_: begin("frames"),
        )
    say(str(file))


def passive_beside(result: Path) -> xr.Dataset | None:
    """The run without steering that was made with a result, if there is one."""
    from magwire.results import Result

    beside = result if result.is_dir() else result.parent
    compared = (result.is_dir() or result.name == RESULT) and (beside / PASSIVE).exists()
    return Result.load(beside / PASSIVE).dataset if compared else None


@app.command
def verify(
    *,
    full: Annotated[bool, Parameter(negative="")] = False,
    only: Annotated[list[str] | None, Parameter(consume_multiple=True)] = None,
    out: Folder = None,
    force: Force = False,
) -> int:
    """Compare with closed forms and other methods: the evidence that the physics is right.

    Parameters
    ----------
    full
        Run all cases, which takes minutes, and not only the fast ones.
    only
        Groups to run: elastica, magnetic, twist, dynamics, contact, authors, consistency, engines.
    out
        Folder for the report as verify.html and verify.json; nothing is written if left out.
    force
        Overwrite what is there.
    """
    from magwire.verify import report

    if out is not None:  # better said before the work than after it
        check_free(out, force=force)
        with writing_to(out):
            pass
    say_if_compiling()
    result = report.show(only or tuple(report.GROUPS), full=full)
    if out is not None:
        with writing_to(out):
            for path in report.save(result, out):
                say(str(path))
    return 0 if result.passed else 1


@app.command(name="plan")
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
    out: Folder = None,
    force: Force = False,
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
    if out is not None:  # better said before the work than after it
        check_free(out, force=force)
    say_if_compiling()
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


def carry_out(
    described: Scenario, folder: Path, *, compare: bool = False, force: bool = False
) -> int:
    """Run a scenario and leave all that comes of it in a folder; the exit status."""
    check_free(folder, force=force)
    job = described.build()
    with writing_to(folder):
        for name in (RESULT, PASSIVE, SCHEDULE, *FIGURES):
            (folder / name).unlink(missing_ok=True)
        (folder / SCENARIO).write_text(described.to_toml(), encoding="utf-8")
    results = [simulate(job, folder / RESULT)]
    if compare and results[0] is not None and results[0].status != "interrupted":
        results.append(simulate(described.unsteered().build(), folder / PASSIVE))
    result, *others = results
    if result is None:
        complain("The run was interrupted before its first record.")
        return INTERRUPTED
    passive = others[0] if others else None
    steered = described.navigate.method != "none"
    from magwire import summary

    for line in summary.lines(result, steered=steered, passive=passive):
        say(line)
    with writing_to(folder):
        from magwire import plot as pictures
        from magwire.scenario import schedule_of, write_schedule

        pictures.save(result.dataset, folder, passive=passive.dataset if passive else None)
        if steered and result.time.size:
            write_schedule(schedule_of(result), folder / SCHEDULE)
    if passive is not None:
        say(f"{'gained':{summary.COLUMN}}{summary.gain(result, passive)}")
    say(f"{'written to':{summary.COLUMN}}{folder}")
    return max(outcome(run) for run in results)


def outcome(result: Result | None) -> int:
    """The exit status of a run, with a word on standard error if it did not reach its end."""
    if result is None:
        complain("The run without steering was interrupted before its first record.")
        return INTERRUPTED
    if result.status == "complete":
        return 0
    complain(result.message or f"The run ended early: {result.status}.")
    return INTERRUPTED if result.status == "interrupted" else 1


def simulate(job: Job, file: Path) -> Result | None:
    """Run a job with a progress bar; None if it was interrupted before its first record."""
    from magwire.results import Result

    say_if_compiling()
    with progress(job.feed.duration) as show:
        try:
            return job.run(file, watch=show)
        except KeyboardInterrupt:  # the file says "interrupted" by now
            return Result.load(file) if file.exists() else None


def say_if_compiling() -> None:
    """Say why nothing happens, the first time."""
    from magwire.kernels._jit import compiled_before

    if not compiled_before():
        complain("Compiling for this machine; this happens once and takes about half a minute.")


@contextmanager
def progress(duration: float) -> Iterator[Callable[[Record], None]]:
    """A progress bar on standard error: feed, tip force and real-time factor.

    Parameters
    ----------
    duration
        Simulated time at the end of the run [s].

    Yields
    ------
    callable
        To be called with every record.
    """
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn

    console = Console(stderr=True)
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(bar_width=28),
        TaskProgressColumn(),
        TextColumn("feed {task.fields[feed]:5.1f} mm"),
        TextColumn("tip force {task.fields[force]:6.3f} mN"),
        TextColumn("{task.fields[factor]:.1f} x real time"),
        console=console,
        disable=not console.is_terminal,
        transient=True,
    )
    begin = time.perf_counter()
    with bar:
        task = bar.add_task("running", total=duration, feed=0.0, force=0.0, factor=0.0)

        def watch(record: Record) -> None:
            bar.update(
                task,
                completed=record.time,
                feed=1e3 * record.feed,
                force=1e3 * record.tip_force,
                factor=record.time / max(time.perf_counter() - begin, 1e-9),
            )

        yield watch


def check_free(folder: Path, *, force: bool) -> None:
    """Refuse a folder that holds something, unless it may be overwritten."""
    if folder.exists() and not folder.is_dir():
        raise CommandError(f"Output folder '{folder}' is a file; expected a folder or a new name.")
    if folder.is_dir() and any(folder.iterdir()) and not force:
        raise CommandError(
            f"Output folder '{folder}' exists already; use --force to overwrite it, "
            "or --out for another."
        )


@contextmanager
def writing_to(folder: Path) -> Iterator[None]:
    """Make a folder and say it plainly if it cannot be written to."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        yield
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise CommandError(f"Output folder '{folder}' cannot be written: {reason}.") from error

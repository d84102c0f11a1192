"""The command ``magwire drive``."""

from __future__ import annotations

from itertools import count
from pathlib import Path

from magwire.cli.folders import RESULT, SCENARIO, occupied, writing_to
from magwire.cli.options import Flag, Overrides
from magwire.cli.words import say, say_if_compiling
from magwire.files import write_whole

USUAL = "half-circle"


def drive(
    scenario: str = USUAL,
    /,
    *,
    overrides: Overrides = None,
    out: Path | None = None,
    limit: str | None = None,
    host: str = "127.0.0.1",
    port: int | None = None,
    browser: Flag = False,
    force: Flag = False,
) -> None:
    """Drive the wire yourself, live in a browser.

    Parameters
    ----------
    scenario
        Name of a scenario of the library, or a TOML file.
    overrides
        Keys to set in the scenario, such as wire.radius="0.5 mm".
    out
        Folder for the recording; NAME-drive in the working folder, or NAME-drive-2 and so on, if
        left out.
    limit
        Force of the wall at which the advance stops, such as "2 mN".
    host
        Address to listen at; one that others can reach gets a token.
    port
        Port; 8140, or any if that is taken, if left out.
    browser
        Open the page in the browser.
    force
        Overwrite what a former run left in the folder.
    """
    from magwire.drive import check_package, serve
    from magwire.errors import positive
    from magwire.scenario import load
    from magwire.units import parse

    check_package()
    most = None if limit is None else positive("drive", "--limit", parse(limit, "force", "--limit"))
    described = load(scenario, overrides or ())
    job = described.build()
    folder = out or _free(f"{Path(scenario).stem}-drive")
    for note in described.notes:
        say(note)
    say_if_compiling()

    def ready(address: str) -> None:
        say(f"open {address}")
        say("Ctrl-C, or 'End' on the page, ends it.")
        if browser:
            import webbrowser

            webbrowser.open(address)

    with occupied(folder, force=force):
        with writing_to(folder):
            write_whole(folder / SCENARIO, described.to_toml())
        outcome = serve(
            job.simulation,
            title=described.title or Path(scenario).stem,
            steering=described.navigate.build,
            out=folder / RESULT,
            scenario=described.to_toml(),
            time_step=job.time_step,
            motion=described.solver.motion,
            limit=most,
            host=host,
            port=port,
            ready=ready,
        )
    rows = outcome.rows()
    wide = 2 + max(map(len, rows))
    for name, text in rows.items():
        say(f"{name:{wide}}{text}")


def _free(name: str) -> Path:
    """A folder of this name that is not there yet, or of this name with a number."""
    tried = (Path(name if k == 1 else f"{name}-{k}") for k in count(1))
    return next(path for path in tried if not path.exists())

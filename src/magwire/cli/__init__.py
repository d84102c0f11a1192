"""The command line."""

from __future__ import annotations

import gc
import itertools
import re
import sys
from collections.abc import Sequence

from cyclopts import App, CycloptsError

import magwire
from magwire.cli.commands.actuator import actuator
from magwire.cli.commands.animate import animate
from magwire.cli.commands.bench import bench
from magwire.cli.commands.check import check
from magwire.cli.commands.devices import devices
from magwire.cli.commands.doctor import doctor
from magwire.cli.commands.drive import drive
from magwire.cli.commands.export import export
from magwire.cli.commands.list import list_scenarios
from magwire.cli.commands.lumen import lumen
from magwire.cli.commands.plan import plan_outlets
from magwire.cli.commands.plot import plot
from magwire.cli.commands.replay import replay
from magwire.cli.commands.reproduce import reproduce
from magwire.cli.commands.run import run
from magwire.cli.commands.schema import schema
from magwire.cli.commands.sweep import sweep
from magwire.cli.commands.verify import verify
from magwire.cli.commands.view import view
from magwire.cli.words import INTERRUPTED, complain
from magwire.errors import MagwireError
from magwire.interrupt import Terminated, end_in_order, nothing_dropped

__all__ = ["app", "main"]

RESTING = 100_000
"""New objects before the garbage collector looks: what a start imports stays, and looking through
it again and again takes an eighth of the time to the first step."""

MINUS = re.compile(r"-\.?\d")

app = App(
    name="magwire",
    help="Simulate magnetic soft continuum robots in lumens.\n\n"
    "To report a fault: send the output of 'magwire doctor', the command and all that it printed, "
    "and scenario.toml, to where you got magwire from.",
    version=lambda: magwire.__version__,
    version_flags=["--version"],
    result_action="return_value",
    suppress_keyboard_interrupt=False,  # what is said then is said below
)
for command in (
    actuator,
    animate,
    bench,
    check,
    devices,
    doctor,
    drive,
    export,
    lumen,
    plot,
    replay,
    reproduce,
    run,
    schema,
    sweep,
    verify,
    view,
):
    app.command(command)
app.command(list_scenarios, name="list")
app.command(plan_outlets, name="plan")


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
    gc.set_threshold(RESTING)
    end_in_order()
    try:
        with nothing_dropped():
            status = app(words, exit_on_error=False, print_error=False)
    except KeyboardInterrupt:
        complain("Interrupted.")
        return INTERRUPTED
    except Terminated as told:
        complain(str(told))
        return told.status
    except MagwireError as error:
        complain(str(error))
        return 1
    except CycloptsError as error:
        complain(f"{error}{_about_minus(words)}")
        return 1
    except BrokenPipeError:  # a reader such as head has seen enough
        sys.stderr.close()
        return 1
    except OSError as error:  # a disk that is full, or gone, wherever it is noticed
        where = f" '{error.filename}'" if error.filename else ""
        complain(f"A file{where} cannot be used: {(error.strerror or str(error)).lower()}.")
        return 1
    return status if isinstance(status, int) else 0


def _about_minus(words: Sequence[str]) -> str:
    """How a value that looks like an option, by its minus sign, is written; "" if there is none."""
    for option, value in itertools.pairwise(words):
        if option.startswith("--") and MINUS.match(value):
            return f" What begins with a minus sign is written {option}='{value}'."
    return ""

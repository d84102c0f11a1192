"""What every command says, and what it ends with."""

from __future__ import annotations

import sys

from magwire.errors import MagwireError

INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells have it."""


class CommandError(MagwireError):
    """A command that cannot be carried out."""


def say(text: str = "") -> None:
    """A line on standard output."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()  # it is read as it comes, also where that is no terminal


def complain(text: str) -> None:
    """A line on standard error."""
    sys.stderr.write(text.strip() + "\n")


def say_if_compiling() -> None:
    """Say why nothing happens, the first time."""
    from magwire.kernels._jit import compiled_before

    if not compiled_before():
        complain("Compiling for this machine; this happens once and takes about half a minute.")

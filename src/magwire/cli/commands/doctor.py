"""The command ``magwire doctor``."""

from __future__ import annotations

from magwire.cli.words import complain, say, say_if_compiling


def doctor() -> int:
    """Say what magwire runs on, and check it by three numbers: what to put into a bug report."""
    from magwire.report import health

    for name, text in health.facts().items():
        say(f"{name:{health.COLUMN}}{text}")
    say_if_compiling()
    wrong = 0
    for check in health.checks():
        say(f"{check.name:{health.COLUMN}}{check.sentence}")
        wrong += not check.right
    if wrong:
        complain(f"{wrong} of 3 numbers are wrong: magwire must not be relied on here.")
    return 1 if wrong else 0

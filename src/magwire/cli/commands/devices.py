"""The command ``magwire devices``."""

from __future__ import annotations

from magwire.cli.words import say


def devices(name: str = "", /) -> None:
    """List the devices that can be a scenario's wire, or show where the numbers of one are from.

    Parameters
    ----------
    name
        Show this one: every number, between what it may lie, and its source.
    """
    from magwire.devices import load, names

    if name:
        from magwire.report import device

        for line in device.lines(load(name)):
            say(line)
        return
    width = max(map(len, names()))
    for each in names():
        say(f"{each:{width}}  {load(each).description}")

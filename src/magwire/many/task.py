"""One run of many, wherever it takes place: text in, plain values out."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from magwire.status import RunStatus


def run(scenario: str, file: str | None) -> dict[str, Any]:
    """Run a scenario and say how it ended, whatever happens.

    Parameters
    ----------
    scenario
        The scenario as TOML, complete.
    file
        Result file to write; none if None.

    Returns
    -------
    dict
        ``status``, ``message`` and ``numbers``, as in ``Outcome``.
    """
    from magwire.many.outcome import numbers_of
    from magwire.scenario import parse

    try:
        result = parse(scenario).run(None if file is None else Path(file))
        return {
            "status": result.status,
            "message": result.message,
            "numbers": numbers_of(result),
        }
    except Exception as error:  # one run must not sink the others
        return {
            "status": RunStatus.FAILED,
            "message": str(error) or type(error).__name__,
            "numbers": {},
        }

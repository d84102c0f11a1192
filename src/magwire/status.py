"""How runs end, in one word each."""

from __future__ import annotations

from enum import StrEnum


class RunStatus(StrEnum):
    """How a run ended; a text, such as ``"complete"``, as it stands in its file.

    A watcher may end a run with a word of its own, which is none of these.
    """

    RUNNING = "running"
    """It goes on, or its process was killed."""
    COMPLETE = "complete"
    """It went to its end, and every step converged."""
    NOT_CONVERGED = "not converged"
    """A step had no solution, or a point of the wire was outside the wall."""
    UNSTABLE = "unstable"
    """Quasi-static motion came to an equilibrium that a wire leaves."""
    NO_FIELD = "no field"
    """The navigator found no field, or no inputs, that meet its demands."""
    FORCE_LIMIT = "force limit"
    """The wall pressed harder than a ``ForceLimit`` allows."""
    INTERRUPTED = "interrupted"
    """By Ctrl-C."""
    TERMINATED = "terminated"
    """The process was told to end, as batch systems do."""
    FAILED = "failed"
    """By an exception."""

    @classmethod
    def of(cls, word: object) -> str:
        """The status that a word of a file is; the word itself if it is a watcher's own."""
        text = str(word)
        return cls(text) if text in set(cls) else text

"""A chapter of the page, and what the parts of the page have in common."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from magwire.evidence.reproduce.claim import Claim
from magwire.evidence.reproduce.page import Block
from magwire.evidence.reproduce.runs import Ask, Run, Runs


@dataclass
class Chapter:
    """What a part of the page says.

    Attributes
    ----------
    title
        Its heading.
    blocks
        Text, pictures and tables.
    claims
        Lines for the table of claims.
    reductions, replays
        Rows for the tables of wall forces and of replays.
    broken
        What was promised and did not come out, a sentence each.
    """

    title: str
    blocks: list[Block] = field(default_factory=list)
    claims: list[Claim] = field(default_factory=list)
    reductions: list[tuple[str, ...]] = field(default_factory=list)
    replays: list[tuple[str, ...]] = field(default_factory=list)
    broken: list[str] = field(default_factory=list)

    def expect_complete(self, asks: tuple[Ask, ...], runs: Runs) -> None:
        """Note runs that did not reach their end and should have."""
        for ask in asks:
            run = runs[ask]
            if not run.result.converged:
                self.broken.append(f"{ask.name}: {why(run)}")


@dataclass(frozen=True)
class Part:
    """A part of the page that can be asked for by name.

    Attributes
    ----------
    asks
        The runs that it needs.
    write
        Makes the chapter, its pictures in a folder.
    """

    asks: tuple[Ask, ...]
    write: Callable[[Runs, Path], Chapter]


def why(run: Run) -> str:
    """Why a run ended, as a sentence."""
    return run.result.message or f"The run ended early: {run.result.status}."

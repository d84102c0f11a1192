"""One line of the table: what the paper says, what magwire finds, and whether they agree."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Verdict = Literal["yes", "partly", "no", "not checked"]


@dataclass(frozen=True)
class Claim:
    """A claim of the paper and what became of it.

    Attributes
    ----------
    where
        Figure or paragraph of the paper.
    says
        What the paper says.
    finds
        What magwire finds, with numbers.
    agrees
        The verdict.
    because
        Why, in a few words.
    """

    where: str
    says: str
    finds: str
    agrees: Verdict
    because: str


def judged(good: bool, fair: bool = False) -> Verdict:
    """The verdict on a measured claim: "partly" where it is not good but fair."""
    return "yes" if good else "partly" if fair else "no"


def percent(part: float) -> str:
    """A part of one as percent, with two digits that count; below 0.001 % none do."""
    if abs(part) < 1e-5:
        return "less than 0.001 %"
    return f"{100.0 * part:.2g} %"

"""How a solve ended, and what to try when it failed."""

from __future__ import annotations

from enum import IntEnum

from magwire.kernels import newton


class Status(IntEnum):
    """How Newton's method ended; ``remedy`` says what to try."""

    CONVERGED = newton.CONVERGED
    STALLED = newton.STALLED
    TOO_MANY_ITERATIONS = newton.TOO_MANY_ITERATIONS
    PENETRATING = newton.PENETRATING

    @property
    def remedy(self) -> str:
        """What happened and what to try, as a sentence without its full stop."""
        return _REMEDIES[self]


_REMEDIES = {
    Status.CONVERGED: "Newton's method converged",
    Status.STALLED: (
        "the line search found no lower energy; try smaller steps or a nearer start, or, if "
        "a wall force is large, a stiffer contact or a larger activation gap"
    ),
    Status.TOO_MANY_ITERATIONS: (
        "Newton's method did not reach the tolerance; try smaller steps or a nearer start, "
        "or, if a wall force is large, a stiffer contact or a larger activation gap"
    ),
    Status.PENETRATING: (
        "the wire starts inside the wall; check that the lumen's entrance is wider than the wire "
        "and that the lumen starts straight"
    ),
}

"""What is to be known at the end of a drive."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from magwire.drive.account import Account
from magwire.drive.pilot import Pilot


@dataclass(frozen=True)
class Outcome:
    """How a drive went.

    Attributes
    ----------
    account
        Sums over all steps that stand.
    feed, rest
        Length of wire past the entrance, and what the tip has yet to go to the target [m].
    rewinds
        How often the wire was taken back.
    file
        What was recorded; None if nothing was.
    failure
        What brought it to an end, if anything did.
    """

    account: Account
    feed: float
    rest: float
    rewinds: int
    file: Path | None = None
    failure: str = ""

    @classmethod
    def of(cls, pilot: Pilot, rest: float, file: Path | None, failure: str = "") -> Outcome:
        """What a pilot has come to."""
        return cls(pilot.account, pilot.sight.feed, rest, pilot.rewinds, file, failure)

    def rows(self) -> dict[str, str]:
        """Names and values, as texts."""
        account = self.account
        rows = {
            "time": f"{account.time:.1f} s",
            "inserted": f"{1e3 * self.feed:.1f} mm",
            "tip from target": f"{1e3 * self.rest:.1f} mm",
            "path of the tip": f"{1e3 * account.path:.1f} mm",
            "peak wall force": f"{1e3 * account.peak_force:.3g} mN",
            "wall force over time": f"{1e3 * account.impulse:.3g} mN s",
            "work of the guide": f"{1e6 * account.work:.4f} uJ",
            "retractions": str(account.retractions),
            "rewinds": str(self.rewinds),
        }
        return rows | ({} if self.file is None else {"recorded to": str(self.file)})

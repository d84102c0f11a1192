"""The fast set of every group passes."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError

import pytest

from magwire.verify import engines
from magwire.verify.evidence import Line, Verdict
from magwire.verify.report import GROUPS, Entry, gather


def fault(entry: Entry) -> str:
    """A line that does not pass, in words."""
    if not isinstance(entry, Line):
        return f"{entry.case}: {entry.reason}"
    order = "" if entry.order is None else f", order {entry.order:.2f} of {entry.expected_order:g}"
    return (
        f"{entry.name}: {entry.value:.8g}, expected {entry.reference:.8g} {entry.unit}, "
        f"error {entry.error:.2e} of {entry.tolerance:.0e}{order}"
    )


@pytest.mark.parametrize("name", GROUPS)
def test_every_line_passes(name: str) -> None:
    (group,) = gather([name]).groups
    failed: Verdict = "fail"
    assert not [fault(entry) for entry in group.entries if entry.verdict == failed]
    assert {entry.group for entry in group.entries} == {name}
    names = [e.name for e in group.entries if isinstance(e, Line)]
    assert len(names) == len(set(names)), "two lines of a group have the same name"


@pytest.mark.parametrize(
    ("found", "reason"), [(None, "is not installed"), ("3.6.0", "version 4 or later is needed")]
)
def test_without_the_other_engine(
    monkeypatch: pytest.MonkeyPatch, found: str | None, reason: str
) -> None:
    """What cannot be compared is said to be skipped, and is no pass."""

    def version(_: str) -> str:
        if found is None:
            raise PackageNotFoundError
        return found

    monkeypatch.setattr(engines, "version", version)
    report = gather(["engines"])
    assert report.counts == {"skipped": 2}
    assert not report.passed
    assert all(reason in entry.reason for entry in report.groups[0].entries)  # type: ignore[union-attr]

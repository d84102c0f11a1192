"""The fast set of every group passes."""

from __future__ import annotations

import pytest

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

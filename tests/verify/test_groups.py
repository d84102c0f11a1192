"""The fast set of every group passes."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from importlib.metadata import PackageNotFoundError
from typing import Any

import pytest

from magwire.engine import system
from magwire.evidence.verify import engines
from magwire.evidence.verify.evidence import Line, Skipped, Verdict
from magwire.evidence.verify.report import GROUPS, Entry, gather
from magwire.evidence.verify.rig import Rig
from magwire.wire import Mesh, Wire


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
    ("name", "wrong", "indifferent"),
    [
        ("elastica", "bending_stiffness", ("no load",)),
        ("magnetic", "moment", ()),
        ("twist", "bending_stiffness", ()),  # ends at the helix, which is not found
    ],
)
def test_two_percent_off_is_found_out(
    name: str, wrong: str, indifferent: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every case fails but those in which the number that is wrong plays no part."""
    right, start = system.lay_out, Rig.__init__

    def off(wire: Wire) -> Mesh:
        mesh = right(wire)
        return replace(mesh, **{wrong: 1.02 * getattr(mesh, wrong)})

    def start_off(rig: Rig, nodes: int, **options: Any) -> None:
        start(rig, nodes, **options)
        rig.rod.bend[:] *= 1.02

    monkeypatch.setattr(system, "lay_out", off)
    monkeypatch.setattr(Rig, "__init__", start_off)
    (group,) = gather([name]).groups
    caught = {entry.case for entry in group.entries if entry.verdict != "pass"}
    missed = {entry.case for entry in group.entries} - caught
    assert not [case for case in missed if not any(word in case for word in indifferent)]


@pytest.mark.parametrize(
    ("name", "wrong", "factor", "caught"),
    [
        ("dynamics", "mass", 1.05, ("no field, let go", "against")),
        ("contact", "bending_stiffness", 1.06, ("bottom", "wound up", "dhat = 0.02 mm")),
        ("consistency", "bending_stiffness", 1.02, ("sensitivities",)),
        ("engines", "bending_stiffness", 1.02, ("cantilever",)),
    ],
)
def test_a_few_percent_off_are_found_out(
    name: str, wrong: str, factor: float, caught: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """In each of these cases there is a line that fails."""
    right = system.lay_out

    def off(wire: Wire) -> Mesh:
        mesh = right(wire)
        return replace(mesh, **{wrong: factor * getattr(mesh, wrong)})

    monkeypatch.setattr(system, "lay_out", off)
    missing = set(caught)
    for piece in import_module(f"magwire.evidence.verify.{name}").evidence(False):
        if isinstance(piece, Skipped):
            pytest.skip(piece.reason)
        if isinstance(piece, Line) and not piece.passed:
            missing -= {part for part in missing if part in piece.case}
        if not missing:
            return
    assert not missing


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

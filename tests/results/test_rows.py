"""Records as rows of numbers: what they hold, and what it takes to keep many of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import magwire as mw
from magwire.engine import plant as engine
from magwire.results import Result, Writer, disk, writer
from magwire.results.contract import derive, layout_of
from magwire.results.rows import Held, Rows
from records import info, records


def test_derived_numbers_of_a_record_do_not_depend_on_the_others() -> None:
    run = info(nodes=100)
    rows = Rows(run, 10**7)
    generator = np.random.default_rng(1)
    for record in records(run, 73):
        record.contact_force[:] *= generator.normal(size=(run.nodes, 3))
        record.contact_force[40:] += 1e-3 * generator.normal(size=(60, 3)) * (record.feed > 0.02)
        rows.append(record)
    columns, layout = rows.columns(), layout_of(run)
    whole = derive(columns, layout)
    for size in (1, 7, 32):
        for first in range(0, 73, size):
            some = slice(first, first + size)
            part = derive({name: column[some] for name, column in columns.items()}, layout)
            for name, values in part.items():
                np.testing.assert_array_equal(values, whole[name][some], err_msg=name)


def test_pieces_in_memory_are_forgotten_from_a_record_on() -> None:
    run, held = info(), Held()
    for first in (0, 5, 10, 7):
        rows = Rows(run, 10**6)
        for record in list(records(run, first + 5))[first:]:
            rows.append(record)
        held.add(first, rows.columns())
    np.testing.assert_allclose(held.read("time", 99), np.arange(12.0), rtol=1e-12)
    assert held.columns()["position"].shape == (12, run.nodes, 3)


def test_a_record_is_one_call_and_one_piece_of_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = []

    def counted(*args: object) -> None:
        calls.append(args)
        compiled(*args)

    compiled = engine.survey
    monkeypatch.setattr(engine, "survey", counted)
    wire = mw.Wire.uniform(
        length=0.1, radius=0.6e-3, youngs_modulus=3e6, shear_modulus=1e6, density=2000.0, nodes=20
    )
    lumen = mw.Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
    with mw.Simulation(wire, lumen).session(feed=0.02) as session:
        calls.clear()
        first = session.record()
        assert len(calls) == 1
        assert all(np.shares_memory(getattr(first, n), first.row) for n in ("position", "slip"))
        kept = first.row.copy()
        session.step(feed_speed=1e-3, duration=0.05)
        later = session.record()
    np.testing.assert_array_equal(first.row, kept)
    assert later.feed > first.feed
    assert later.totals.steps == 5
    assert np.linalg.norm(later.contact_force[-1]) == pytest.approx(later.tip_force, rel=1e-15)


def test_many_records_between_two_flushes_are_one_draft(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run, opened = info(), []
    begin = disk.Draft.__init__

    def counted(draft: disk.Draft, path: Path) -> None:
        opened.append(path)
        begin(draft, path)

    monkeypatch.setattr(disk.Draft, "__init__", counted)
    monkeypatch.setattr(writer, "MOST_WAITING", 2**15)
    made = Writer(run, tmp_path / "result.nc")
    for k, record in enumerate(records(run, 60)):
        made.append(record)
        if k == 0:
            opened.clear()
            monkeypatch.setattr(made, "_due", float("inf"))
    made.close("complete")
    assert len(opened) == 1
    assert Result.load(tmp_path / "result.nc").time.size == 60

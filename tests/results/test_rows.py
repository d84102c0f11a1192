"""Records as rows of numbers: what they hold, and what it takes to keep many of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest

import magwire as mw
from magwire.engine import plant as engine
from magwire.engine.record import BLOCKS, MAY_BE_ABSENT
from magwire.errors import ResultError
from magwire.kernels._handle import resolved
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

    def looked_up(entry: object, *example: object) -> Callable[..., object]:
        """What the plant calls, counted if it is the one that fills a record."""
        code = resolved(entry, *example)

        def counted(*args: object) -> object:
            calls.append(entry)
            return code(*args)

        return counted if entry is engine.survey else code

    monkeypatch.setattr(engine, "resolved", looked_up)
    wire = mw.Wire.uniform(
        length=0.1, radius=0.6e-3, youngs_modulus=3e6, shear_modulus=1e6, density=2000.0, nodes=20
    )
    lumen = mw.Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
    with mw.Simulation(wire, lumen).session(feed=0.02) as session:
        calls.clear()
        first = session.record()
        assert len(calls) == 1
        assert all(np.shares_memory(getattr(first, n), first.row) for n in ("position", "inputs"))
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


@pytest.mark.parametrize(
    ("made", "absent"),
    [
        ({}, set(MAY_BE_ABSENT)),
        ({"friction": mw.Friction(0.1)}, {"wall_indentation", "wall_displacement"}),
        ({"friction": mw.Friction(0.0)}, set(MAY_BE_ABSENT)),
        (
            {"contact": mw.Barrier(foundation=1e8)},
            {"friction_force", "slip", "wall_displacement"},
        ),
        (
            {"wall_motion": mw.WallMotion((0.0, 0.0, 1e-3), period=1.0, ramp=10e-3)},
            {"friction_force", "slip", "wall_indentation"},
        ),
    ],
)
def test_what_nothing_makes_is_absent_and_reads_as_zeros(
    made: dict[str, object], absent: set[str], tmp_path: Path
) -> None:
    wire = mw.Wire.uniform(
        length=0.1, radius=0.6e-3, youngs_modulus=3e6, shear_modulus=1e6, density=2000.0, nodes=20
    )
    lumen = mw.Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
    simulation = mw.Simulation(wire, lumen, **made)  # type: ignore[arg-type]
    assert simulation.info().absent == absent
    with simulation.session(feed=0.05, record_every=1e-3, out=tmp_path / "result.nc") as session:
        session.step(feed_speed=1e-2, duration=0.5)
        record = session.record()
    assert set(record.kind.names or ()) & set(BLOCKS) == set(BLOCKS) - absent
    result = Result.load(tmp_path / "result.nc")
    for name in MAY_BE_ABSENT:
        kept = getattr(result, name)
        assert getattr(record, name).shape == kept.shape[1:]
        assert np.any(kept) == (name not in absent), name
    with h5py.File(tmp_path / "result.nc") as file:
        stored = {name for name in MAY_BE_ABSENT if file[name].id.get_storage_size()}
    assert stored == set(MAY_BE_ABSENT) - absent


def test_rows_without_absent_arrays_are_those_with_them_less_the_zeros(tmp_path: Path) -> None:
    run = info()
    lean = replace(run, absent=frozenset(MAY_BE_ABSENT))
    results = []
    for kind, path in ((run, None), (lean, None), (lean, tmp_path / "lean.nc")):
        writing = Writer(kind, path)
        for record in records(kind, 40):
            writing.append(record)
        writing.close("complete")
        results.append(writing.result())
    for other in results[1:]:
        assert list(other.dataset.variables) == list(results[0].dataset.variables)
        for name, variable in results[0].dataset.variables.items():
            there = 0.0 * variable if name in MAY_BE_ABSENT else variable
            np.testing.assert_array_equal(other.dataset[name], there, err_msg=str(name))


@pytest.mark.parametrize(
    ("name", "length"), [("slip", 10**9), ("friction_force", 10**9), ("clearance", 40)]
)
def test_only_what_may_be_absent_is_taken_for_zeros(name: str, length: int, tmp_path: Path) -> None:
    path = tmp_path / "result.nc"
    lean = replace(info(), absent=frozenset(MAY_BE_ABSENT))
    with Writer(lean, path) as writing:
        for record in records(lean, 40):
            writing.append(record)
    with h5py.File(path, "r+") as file:
        if name in MAY_BE_ABSENT:
            file[name].resize(length, axis=0)
        else:
            shape, dims = file[name].shape, file[name].dims
            scales = [dim[0] for dim in dims]
            del file[name]
            empty = file.create_dataset(
                name, shape, float, maxshape=(None, *shape[1:]), chunks=True
            )
            for dim, scale in zip(empty.dims, scales, strict=True):
                dim.attach_scale(scale)
    with pytest.raises(ResultError, match=f"is damaged: {name} claims"):
        Result.load(path)

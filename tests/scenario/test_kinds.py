"""Kinds of tables: known once, checked by themselves, built once."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import numpy as np
import pytest

from magwire import units
from magwire.errors import MagwireError, ScenarioError
from magwire.lumen import Lumen
from magwire.scenario import Scenario, checks, load, parse
from magwire.scenario.kind import FAMILIES
from magwire.scenario.kinds import FieldTable, kind
from magwire.scenario.measured import Measured, Numbers
from magwire.scenario.quantity import Quantity, Row, Rows
from magwire.scenario.table import FaultyKeyError

PASSIVE = ["navigate.method=none"]


@pytest.fixture
def registry() -> Iterator[None]:
    """Whatever a test makes known is forgotten after it."""
    before = {name: dict(family.kinds) for name, family in FAMILIES.items()}
    yield
    for name, kinds in before.items():
        FAMILIES[name].kinds.clear()
        FAMILIES[name].kinds.update(kinds)
    Scenario.model_rebuild(force=True)


def test_a_kind_needs_one_name() -> None:
    with pytest.raises(MagwireError, match=r"Class Nameless must have a key kind with one name"):

        @kind
        class Nameless(FieldTable):
            pass


def test_a_name_is_taken_once(registry: None) -> None:
    with pytest.raises(MagwireError, match="Kind of field 'uniform' must be new; received one"):

        @kind
        class Other(FieldTable):
            kind: Literal["uniform"]

    assert FAMILIES["field"].kinds["uniform"].__name__ == "UniformFieldTable"


def test_a_fault_of_a_new_kind_is_not_hidden(
    registry: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An attribute that a class lacks is a fault of the program, also next to a fault of a file."""

    @kind
    class Wrong(FieldTable):
        kind: Literal["wrong"]

        def faults(self) -> Iterator[str]:
            yield self.strength  # type: ignore[attr-defined]

    with pytest.raises(AttributeError, match="strength"):
        load("half-circle", [*PASSIVE, "field={kind='wrong'}", "wire.radius=-1 mm"])


def test_checks_that_need_a_faulty_key_are_left_out() -> None:
    with pytest.raises(ScenarioError) as caught:
        load("half-circle", [*PASSIVE, "lumen.radius=-1 mm", "feed.distance=120 mm"])
    assert caught.value.faults == (
        "Input lumen.radius must be positive; received -1 mm.",
        "Input feed.distance must be at most the length of the wire, 100 mm; received 120 mm.",
    )


def test_a_table_without_a_key_says_so() -> None:
    from magwire.scenario.partial import partial_scenario

    raw = {"lumen": {"shape": "straight", "radius": "3 mm"}}
    partial = partial_scenario(raw, {("wire",), ("lumen", "length"), ("feed",)})
    assert partial.lumen.narrowest == 3e-3
    with pytest.raises(FaultyKeyError, match="length"):
        partial.lumen.build()
    with pytest.raises(FaultyKeyError, match="feed"):
        next(checks.feed_within_wire(partial))


@pytest.mark.parametrize("name", ["half-circle", "left-branch", "tortuous"])
def test_models_are_built_once(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    built: list[str] = []
    for table in ("wire", "lumen", "field", "feed"):
        for kind_of in FAMILIES[table].kinds.values():
            create = kind_of.create  # type: ignore[attr-defined]

            def counted(self: object, create: object = create, table: str = table) -> object:
                built.append(table)
                return create(self)  # type: ignore[operator]

            monkeypatch.setattr(kind_of, "create", counted)
    scenario = load(name, ["feed.distance=1 mm", "output.record_every=1 mm", *PASSIVE])
    job = scenario.build()
    scenario.unsteered().build()
    assert job.simulation.system.lumen is scenario.lumen.build()
    assert sorted(built) == ["feed", "field", "lumen", "wire"]


def test_a_changed_copy_builds_its_own() -> None:
    lumen = load("half-circle").lumen
    other = lumen.model_copy(update={"radius": 2e-3})
    assert other.build().narrowest == 2e-3
    assert lumen.build().narrowest == 3e-3


TABLES = """
[wire]
length = "100 mm"
nodes = 100
radius = "0.6 mm"
youngs_modulus = "3 MPa"
shear_modulus = "1 MPa"
density = "2000 kg/m^3"
[feed]
speed = "1 mm/s"
distance = "30 mm"
[lumen]
shape = "points"
"""


def line(count: int) -> tuple[np.ndarray, np.ndarray]:
    t = np.linspace(0.0, 1.0, count)
    places = np.column_stack([90.0 * t, 8.0 * np.sin(5.0 * t), 6.0 * np.cos(4.0 * t) - 6.0])
    return places.round(9), (3.0 + 0.3 * np.sin(9.0 * t)).round(9)


@pytest.mark.parametrize("style", ["{!r}", "{:.18e}", " {!r} ", '"{!r}"'])
@pytest.mark.parametrize("unit", ["mm", "m", "in"])
def test_a_file_gives_the_numbers_that_texts_give(tmp_path: Path, style: str, unit: str) -> None:
    """To the last bit, however the numbers are written."""
    places, radius = line(30)
    scale = {"mm": 1.0, "m": 1e-3, "in": 1.0 / 25.4}[unit]
    cells = [
        [style.format(float(scale * value)) for value in (*place, r)]
        for place, r in zip(places, radius, strict=True)
    ]
    rows = "\n".join(map(",".join, cells))
    (tmp_path / "line.csv").write_text(f"x,y,z,radius\n{rows}\n", encoding="utf-8")
    found = parse(TABLES + f'file = "line.csv"\nunits = "{unit}"\n', folder=tmp_path)
    bare = [[cell.strip('" ') for cell in row] for row in cells]
    points = [[f"{cell} {unit}" for cell in row[:3]] for row in bare]
    radii = [f"{row[3]} {unit}" for row in bare]
    texts = parse(TABLES + f"points = {points}\nradius = {radii}\n")
    assert found == texts
    assert parse(found.to_toml()) == texts


def test_points_of_a_file_do_not_go_through_text(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Neither parsed one by one, nor is the lumen built more than once, however many they are."""
    places, radius = line(2000)
    np.savetxt(
        tmp_path / "line.csv", np.column_stack([places, radius]),
        delimiter=",", header="x,y,z,radius", comments="",
    )  # fmt: skip
    calls = {"parse": 0, "through": 0}
    parse_one, through = units.parse, Lumen.through

    def counted(*arguments: object) -> float:
        calls["parse"] += 1
        return parse_one(*arguments)  # type: ignore[arg-type]

    def built(*arguments: object) -> Lumen:
        calls["through"] += 1
        return through(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(units, "parse", counted)
    monkeypatch.setattr(Lumen, "through", built)
    scenario = parse(TABLES + 'file = "line.csv"\nunits = "mm"\n', folder=tmp_path)
    scenario.build()
    assert calls["parse"] < 60
    assert calls["through"] == 1
    np.testing.assert_allclose(scenario.lumen.points, 1e-3 * places, rtol=1e-15)


def test_a_fault_among_measured_numbers_is_told_as_it_is_written(tmp_path: Path) -> None:
    (tmp_path / "line.csv").write_text("x,y,z,radius\n0,0,0,0.3\n9,0,0,-0.3\n", encoding="utf-8")
    with pytest.raises(ScenarioError) as caught:
        parse(TABLES + 'file = "line.csv"\nunits = "cm"\n', folder=tmp_path)
    assert caught.value.faults == ("Input lumen.radius must be positive; received -0.3 cm.",)


def test_numbers_are_a_sequence_of_tuples_that_stays() -> None:
    numbers = Rows(Row((Quantity("length"),) * 2)).read([["1 mm", "2 mm"], ["3 mm", "4 mm"]])
    assert numbers == ((1e-3, 2e-3), (3e-3, 4e-3))
    assert numbers == ((1e-3, 2e-3), (3e-3, 4e-3))
    assert numbers != ((1e-3, 2e-3),)
    assert numbers[1] == (3e-3, 4e-3)
    assert numbers[:1] == ((1e-3, 2e-3),)
    assert {numbers: 1}[Numbers(np.array(numbers))] == 1
    with pytest.raises(ValueError, match="read-only"):
        numbers.values[0, 0] = 1.0


def test_too_few_measured_rows_are_told() -> None:
    kind_of = Rows(Row((Quantity("length"),)), least=2)
    measured = Measured(np.array([[1e-3]]), lambda: [["1 mm"]])
    with pytest.raises(Exception, match="must have at least 2 rows; received 1"):
        kind_of.read(measured)

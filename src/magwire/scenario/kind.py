"""Kinds of wire, lumen, field, feed, navigator, actuator: each is known by a class in one file.

A kind is a table of the scenario file that says which keys it has, reads its files into numbers,
checks itself and builds its model. ``kind`` makes it known; the file format, the messages and the
JSON schema follow.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple, TypeVar, Union, get_args

from pydantic import BaseModel, Discriminator, Field, GetCoreSchemaHandler, Tag
from pydantic_core import CoreSchema

from magwire.errors import InputError, MagwireError
from magwire.scenario.table import Table

Faults = Iterator[str]
_OWNER = re.compile(r"^Input (\w+) of \w+(?:\.\w+)?\b")


class Inlined(NamedTuple):
    """A table as read, with the numbers of its files in it.

    Attributes
    ----------
    table
        The table; None if it cannot be made.
    faults
        What is wrong with the files or with the keys that name them.
    unread
        Keys that are missing because of these faults, such as ("lumen", "points").
    notes
        What was done to the files, a sentence each.
    reach
        How far a wire is fed if the scenario does not say it, such as "80 mm"; None if it must say.
    """

    table: dict[str, Any] | None
    faults: list[str]
    unread: tuple[tuple[str, ...], ...] = ()
    notes: tuple[str, ...] = ()
    reach: str | None = None


class KindTable(Table):
    """What all kinds have in common."""

    family: ClassVar[str]
    """The table of the scenario that it stands in."""
    ruled_by: ClassVar[tuple[str, ...]] = ()
    """Keys that only this kind has, and that tell it where nothing else does."""

    @classmethod
    def inline(cls, table: dict[str, Any], folder: Path) -> Inlined:
        """The table with the numbers of its files in it.

        Parameters
        ----------
        table
            As read, before anything is checked.
        folder
            What a relative file name starts from.
        """
        return Inlined(table, [])

    def clashes(self) -> Faults:
        """Faults between its keys that leave no sense in comparing it with other tables."""
        yield from ()

    def faults(self) -> Faults:
        """Other faults between its keys."""
        yield from ()


class ModelTable(KindTable):
    """A kind whose model is the same whatever it is used for, so that it is built once."""

    def create(self) -> Any:
        """The model."""
        raise NotImplementedError

    def build(self) -> Any:
        """The model, which is created when it is first asked for.

        Raises
        ------
        InputError
            If the model refuses what the table says.
        """
        return self._model

    @cached_property
    def _model(self) -> Any:
        return self.create()

    def model_copy(
        self, *, update: Mapping[str, Any] | None = None, deep: bool = False
    ) -> ModelTable:
        """A copy, which creates a model of its own if it is another."""
        copy = super().model_copy(update=update, deep=deep)
        if update:
            copy.__dict__.pop("_model", None)
        return copy


@dataclass
class Family:
    """The kinds that one table of the scenario may be.

    Attributes
    ----------
    name
        That of the table.
    selector
        The key that tells which kind it is; "" if the keys that only one kind has do.
    kinds
        The tables by the names of the kinds, in the order in which messages name them.
    """

    name: str
    selector: str
    kinds: dict[str, type[KindTable]] = field(default_factory=dict)

    def add(self, table: type[KindTable]) -> None:
        """Take up a kind.

        Raises
        ------
        MagwireError
            If there is another kind of this name, or the table does not say its name.
        """
        name = table.__name__
        if self.selector:
            said = table.model_fields.get(self.selector)
            names = get_args(said.annotation) if said else ()
            if len(names) != 1:
                raise MagwireError(
                    f"Class {name} must have a key {self.selector} with one name, such as "
                    f"{self.selector}: Literal['mine']; received {said and said.annotation}."
                )
            (name,) = names
        known = self.kinds.get(name)
        if known and (known.__module__, known.__qualname__) != (
            table.__module__,
            table.__qualname__,
        ):
            raise MagwireError(
                f"Kind of {self.name} {name!r} must be new; received one that "
                f"{known.__module__} has made known."
            )
        self.kinds[name] = table

    def of(self, given: Mapping[str, Any]) -> type[KindTable] | None:
        """The kind of a table as read; None if it does not say, or none is known by that name."""
        if self.selector in given:
            name = given[self.selector]
            return self.kinds.get(name) if isinstance(name, str) else None
        return self.kinds.get(self._told_by(given))

    def _told_by(self, given: Mapping[str, Any]) -> str:
        """The name of the kind that the keys tell; "" if they do not."""
        plain = ""
        for name, table in self.kinds.items():
            if any(key in given for key in table.ruled_by):
                return name
            if not table.ruled_by:
                plain = plain or name
        return "" if self.selector else plain

    def _tag(self, value: Any) -> str:
        given = vars(value) if isinstance(value, BaseModel) else value
        return self._told_by(given if isinstance(given, dict) else {})

    def union(self) -> Any:
        """What pydantic takes for "one of these tables"."""
        if self.selector:
            return Annotated[Union[tuple(self.kinds.values())], Field(discriminator=self.selector)]  # noqa: UP007
        tagged = tuple(Annotated[table, Tag(name)] for name, table in self.kinds.items())
        return Annotated[Union[tagged], Discriminator(self._tag)]  # noqa: UP007


FAMILIES = {
    name: Family(name, selector)
    for name, selector in (
        ("wire", ""),
        ("lumen", "shape"),
        ("field", "kind"),
        ("feed", ""),
        ("navigate", "method"),
        ("actuator", "kind"),
    )
}
"""Tables of the scenario that come in several kinds."""


@dataclass(frozen=True)
class AnyKind:
    """Annotation of a table that may be any kind of a family."""

    family: str

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return handler.generate_schema(FAMILIES[self.family].union())


_RENEWALS: list[Callable[[], object]] = []


def on_new_kind(renew: Callable[[], object]) -> None:
    """Have something done whenever a kind is made known."""
    _RENEWALS.append(renew)


Kind = TypeVar("Kind", bound=type[KindTable])


def kind(table: Kind) -> Kind:
    """Make a kind known: a decorator of its table.

    Raises
    ------
    MagwireError
        If there is another kind of this name, or the table does not say its name.
    """
    FAMILIES[table.family].add(table)
    for renew in _RENEWALS:
        renew()
    return table


def refusals(family: str, build: Callable[[], object]) -> Faults:
    """What a model refuses, in the words of the table that it is built from."""
    try:
        build()
    except InputError as error:
        yield _OWNER.sub(lambda found: f"Input {family}.{found[1]}", str(error), count=1)

"""Kinds of outside field, and what they have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING

from magwire.scenario.kind import ModelTable

if TYPE_CHECKING:
    from magwire.field import FieldSource


class FieldTable(ModelTable):
    """A kind of field: its key ``kind`` says which."""

    family = "field"
    kind: str

    def create(self) -> FieldSource:
        """The field as a model."""
        raise NotImplementedError

    def build(self) -> FieldSource:
        """The field as a model, created once."""
        model: FieldSource = super().build()
        return model

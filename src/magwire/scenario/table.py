"""What every table of a scenario is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, ConfigDict, Field


class FaultyKeyError(Exception):
    """A check asks for a key that has a fault of its own, so that the check has no sense."""


class Table(BaseModel):
    """A table of the file: keys it does not know are faults, and it does not change."""

    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True)

    if not TYPE_CHECKING:  # a type checker would take any attribute to be there

        def __getattr__(self, name: str) -> Any:
            """Refuse what a table lacks; one without faults lacks nothing, see ``partial``."""
            if name in type(self).model_fields:
                raise FaultyKeyError(name)
            return super().__getattr__(name)


def preset(text: Any) -> Any:
    """A default, written as it would be in the file."""
    return Field(default=text)

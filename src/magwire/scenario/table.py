"""What every table of a scenario is."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field


class Table(BaseModel):
    """A table of the file: keys it does not know are faults, and it does not change."""

    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True)


def preset(text: Any) -> Any:
    """A default, written as it would be in the file."""
    return Field(default=text)

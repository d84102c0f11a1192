"""Types of options that several commands have; what they mean is said with each command."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

Flag = Annotated[bool, Parameter(negative="")]
Names = Annotated[list[str] | None, Parameter(consume_multiple=True, negative="")]
Overrides = Annotated[list[str] | None, Parameter(name="--set", consume_multiple=True, negative="")]

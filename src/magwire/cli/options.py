"""Options that several commands have."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

Flag = Annotated[bool, Parameter(negative="")]
Folder = Annotated[Path | None, Parameter(help="Folder for the output.")]
Force = Annotated[bool, Parameter(negative="", help="Overwrite what is there.")]
Names = Annotated[list[str] | None, Parameter(consume_multiple=True)]
Overrides = Annotated[list[str] | None, Parameter(name="--set", consume_multiple=True)]

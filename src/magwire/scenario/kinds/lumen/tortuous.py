"""A vessel that winds."""

from __future__ import annotations

from typing import Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.lumen.formula import FormulaLumen, Seed
from magwire.scenario.quantity import Length, LengthOrZero
from magwire.scenario.table import preset


@kind
class TortuousLumen(FormulaLumen):
    """A tapered vessel that winds in space; ``length`` is from end to end."""

    formula = "tortuous"
    shape: Literal["tortuous"]
    length: Length = preset("120 mm")
    radius: Length = preset("3 mm")
    end_radius: Length = preset("1.5 mm")
    amplitude: LengthOrZero = preset("6 mm")
    seed: Seed = preset(0)

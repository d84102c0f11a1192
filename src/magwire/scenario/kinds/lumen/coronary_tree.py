"""A left coronary artery."""

from __future__ import annotations

from typing import Annotated, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.lumen.formula import FormulaLumen, Seed
from magwire.scenario.quantity import Length, Whole
from magwire.scenario.table import preset


@kind
class CoronaryTreeLumen(FormulaLumen):
    """A left main coronary artery that parts into two, the first of which has side branches."""

    formula = "coronary_tree"
    shape: Literal["coronary-tree"]
    target: Literal["anterior", "circumflex", "diagonal 1", "diagonal 2", "diagonal 3"]
    radius: Length = preset("2.2 mm")
    diagonals: Annotated[int, Whole(0, 3)] = preset(2)
    seed: Seed = preset(0)

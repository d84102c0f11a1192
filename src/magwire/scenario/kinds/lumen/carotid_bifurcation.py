"""A bifurcation of the carotid artery."""

from __future__ import annotations

from typing import Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.lumen.formula import FormulaLumen
from magwire.scenario.quantity import Length, PositiveAngle
from magwire.scenario.table import preset


@kind
class CarotidBifurcationLumen(FormulaLumen):
    """A common carotid artery that parts into the internal one, with its bulb, and the external."""

    formula = "carotid_bifurcation"
    shape: Literal["carotid-bifurcation"]
    target: Literal["internal", "external"]
    radius: Length = preset("3.2 mm")
    common: Length = preset("50 mm")
    length: Length = preset("45 mm")
    angle: PositiveAngle = preset("0.45 rad")

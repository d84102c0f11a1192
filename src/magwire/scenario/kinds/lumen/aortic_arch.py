"""An aortic arch."""

from __future__ import annotations

from typing import Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.lumen.formula import FormulaLumen
from magwire.scenario.quantity import Length
from magwire.scenario.table import preset


@kind
class AorticArchLumen(FormulaLumen):
    """An aortic arch with its three supra-aortic branches, entered from the descending aorta."""

    formula = "aortic_arch"
    shape: Literal["aortic-arch"]
    target: Literal["left carotid", "left subclavian", "brachiocephalic", "ascending aorta"]
    arch_radius: Length = preset("35 mm")
    radius: Length = preset("11 mm")
    ascending_radius: Length = preset("14 mm")
    descending: Length = preset("60 mm")
    ascending: Length = preset("50 mm")

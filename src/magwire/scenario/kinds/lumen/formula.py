"""What vessels with a formula have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from magwire.scenario.kind import Faults, refusals
from magwire.scenario.kinds.lumen import LumenTable
from magwire.scenario.quantity import Whole

if TYPE_CHECKING:
    from magwire.lumen import Lumen

Seed = Annotated[int, Whole(0, 2**32 - 1)]


class FormulaLumen(LumenTable):
    """A vessel with a formula: its keys are what the formula takes."""

    formula: ClassVar[str]
    """Name of a function of ``magwire.vessel.synthetic``."""

    def clashes(self) -> Faults:
        """The formula can be carried out."""
        for fault in refusals("lumen", self.build):  # the points are no key of such a lumen
            yield fault.replace("Input lumen.points must", "Input lumen must", 1)

    def without_entry(self) -> Lumen:
        """The lumen as a model, but for its entry."""
        from magwire.vessel import synthetic

        others = {"shape", *LumenTable.model_fields}
        keys = {name: getattr(self, name) for name in type(self).model_fields.keys() - others}
        made: Lumen = getattr(synthetic, self.formula)(**keys)
        return made

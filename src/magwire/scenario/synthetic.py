"""The lumen tables of vessels with a formula, one for each shape."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from magwire.scenario.lumens import LumenTable
from magwire.scenario.quantity import Length, LengthOrZero, PositiveAngle, Whole
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.lumen import Lumen

Seed = Annotated[int, Whole(0, 2**32 - 1)]


class SyntheticLumen(LumenTable):
    """What these shapes have in common: their keys are what their formula takes."""

    formula: ClassVar[str]
    """Name of a function of ``magwire.vessel.synthetic``."""

    @property
    def narrowest(self) -> float:
        """Smallest radius on the way to the target [m]."""
        return self._model.path().narrowest

    def shape_model(self) -> Lumen:
        """The lumen as a model, without its entry."""
        return self._model

    @cached_property
    def _model(self) -> Lumen:
        from magwire.vessel import synthetic

        others = {"shape", *LumenTable.model_fields}
        keys = {name: getattr(self, name) for name in type(self).model_fields.keys() - others}
        made: Lumen = getattr(synthetic, self.formula)(**keys)
        return made


class AorticArchLumen(SyntheticLumen):
    """An aortic arch with its three supra-aortic branches, entered from the descending aorta."""

    formula = "aortic_arch"
    shape: Literal["aortic-arch"]
    target: Literal["left carotid", "left subclavian", "brachiocephalic", "ascending aorta"]
    arch_radius: Length = preset("35 mm")
    radius: Length = preset("11 mm")
    ascending_radius: Length = preset("14 mm")
    descending: Length = preset("60 mm")
    ascending: Length = preset("50 mm")


class CarotidBifurcationLumen(SyntheticLumen):
    """A common carotid artery that parts into the internal one, with its bulb, and the external."""

    formula = "carotid_bifurcation"
    shape: Literal["carotid-bifurcation"]
    target: Literal["internal", "external"]
    radius: Length = preset("3.2 mm")
    common: Length = preset("50 mm")
    length: Length = preset("45 mm")
    angle: PositiveAngle = preset("0.45 rad")


class CoronaryTreeLumen(SyntheticLumen):
    """A left main coronary artery that parts into two, the first of which has side branches."""

    formula = "coronary_tree"
    shape: Literal["coronary-tree"]
    target: Literal["anterior", "circumflex", "diagonal 1", "diagonal 2", "diagonal 3"]
    radius: Length = preset("2.2 mm")
    diagonals: Annotated[int, Whole(0, 3)] = preset(2)
    seed: Seed = preset(0)


class TortuousLumen(SyntheticLumen):
    """A tapered vessel that winds in space; ``length`` is from end to end."""

    formula = "tortuous"
    shape: Literal["tortuous"]
    length: Length = preset("120 mm")
    radius: Length = preset("3 mm")
    end_radius: Length = preset("1.5 mm")
    amplitude: LengthOrZero = preset("6 mm")
    seed: Seed = preset(0)

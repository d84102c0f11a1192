"""Kinds of lumen, and what they have in common."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, Annotated

from magwire.scenario.kind import Faults, ModelTable, refusals
from magwire.scenario.quantity import Length, LengthOrZero, Whole
from magwire.scenario.table import preset
from magwire.units import show

if TYPE_CHECKING:
    from magwire.lumen import Lumen

Points = Annotated[int, Whole(5, 200_000)]  # of a million, a tree takes 1.4 GB


class LumenTable(ModelTable):
    """A kind of lumen: its key ``shape`` says which."""

    family = "lumen"
    entry: LengthOrZero = preset("0 mm")

    @property
    def narrowest(self) -> float:
        """Smallest radius on the way to the target [m]."""
        return self.build().path().narrowest

    def faults(self) -> Faults:
        """The model can be made: above all, it bends more gently than it is wide."""
        if not any(self.clashes()):
            yield from refusals("lumen", self.build)

    def without_entry(self) -> Lumen:
        """The lumen as a model, but for its entry."""
        raise NotImplementedError

    def create(self) -> Lumen:
        """The lumen as a model."""
        lumen = self.without_entry()
        return lumen.with_entry(self.entry) if self.entry > 0.0 else lumen

    def build(self) -> Lumen:
        """The lumen as a model, created once."""
        model: Lumen = super().build()
        return model


class RoundLumen(LumenTable):
    """A lumen of one radius along a curve with a formula."""

    radius: Length

    @property
    def narrowest(self) -> float:
        """Smallest radius [m]."""
        return self.radius

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centreline [m]."""
        raise NotImplementedError

    def faults(self) -> Faults:
        """It bends more gently than it is wide, and the model can be made."""
        if any(self.clashes()):
            return
        if self.tightest_bend <= self.radius:
            yield (
                "Input lumen must bend with a radius larger than lumen.radius, "
                f"{show(self.radius, 'length')}; received a bend radius of "
                f"{show(self.tightest_bend, 'length')}."
            )
        else:
            yield from refusals("lumen", self.build)


def unknown_target(target: str, outlets: Collection[str]) -> Faults:
    """A target that is none of the outlets."""
    if target not in outlets:
        words = ", ".join(f"'{name}'" for name in outlets)
        yield f"Input lumen.target must be one of the outlets {words}; received {target!r}."

"""Any set of coils."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator

from magwire.errors import received
from magwire.scenario.kind import kind
from magwire.scenario.kinds.actuator import CircuitTable, CoilsTable, Heading, unlimited
from magwire.scenario.quantity import Length, LengthOrZero, Place, Share, at_least_one, fault
from magwire.scenario.table import Table, preset

if TYPE_CHECKING:
    from magwire.actuate import Coil, Input, Loops

_WORD = re.compile(r"[A-Za-z_][\w.-]*")


def _one_word(value: Any) -> Any:
    if not isinstance(value, str) or not _WORD.fullmatch(value):
        raise fault(f"must be a name in one word such as 'I1'; received {received(value)}")
    return value


Name = Annotated[str, BeforeValidator(_one_word)]


class CoilTable(Table):
    """A round coil; coils with one input are in series."""

    input: Name
    centre: Place
    axis: Heading
    radius: Length
    turns: Annotated[float, Share(-1e6, 1e6)] = 1.0
    width: LengthOrZero = preset("0 mm")
    height: LengthOrZero = preset("0 mm")

    def build(self) -> Coil:
        """The coil as a model."""
        from magwire.actuate import Coil

        return Coil(**{name: getattr(self, name) for name in type(self).model_fields})


class CurrentTable(CircuitTable):
    """What the current of an input may be."""

    input: Name

    def build(self) -> Input:
        """The input as a model."""
        from magwire.actuate.inputs import current

        return current(self.input, self.most, self.circuit())


@kind
class LoopsTable(CoilsTable):
    """Any set of round coils; its inputs are their currents, by the names of the coils' inputs."""

    kind: Literal["loops"]
    coils: Annotated[tuple[CoilTable, ...], at_least_one("coil")]
    currents: tuple[CurrentTable, ...] = ()

    def create(self) -> Loops:
        """The actuator as a model."""
        from magwire.actuate import Loops

        return Loops(
            pose=self.pose.build(),
            max_power=unlimited(self.max_power),
            coils=tuple(coil.build() for coil in self.coils),
            currents=tuple(current.build() for current in self.currents),
        )

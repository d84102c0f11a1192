"""Steering for any simulation: what a navigator is asked for, before it has a wire."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import get_args

from magwire.engine.system import System
from magwire.errors import instance, one_of, positive, whole
from magwire.navigate.demands import Demands
from magwire.navigate.model import InModel
from magwire.navigate.navigator import Navigator
from magwire.navigate.persistent import ATTEMPTS, persistent
from magwire.navigate.stable import StableNavigator


@dataclass(frozen=True)
class TipNavigator:
    """Keeps the tip clear of the wall and the wire stable, with the least field (P-22).

    It has no memory and may be given to any number of runs: each makes a ``StableNavigator`` of
    its own, which believes wire, lumen and wall to be those of the simulation.

    Parameters
    ----------
    demands
        What the field must keep to.
    update_every
        Feed between two observations of the wire [m].
    plan_every
        Feed between two planned fields [m]; half a percent of the wire if left out.
    attempts
        In a tree, how often it tries in one place, with other demands after the first time.
    friction
        ``"model"``: the plan is made with the simulation's friction; ``"none"``: without.

    Raises
    ------
    InputError
        If a length is not positive.
    """

    demands: Demands = field(default_factory=Demands)
    update_every: float = 5e-4
    plan_every: float | None = None
    attempts: int = ATTEMPTS
    friction: InModel = "none"

    def __post_init__(self) -> None:
        instance("TipNavigator", "demands", self.demands, Demands)
        positive("TipNavigator", "update_every", self.update_every, "m")
        whole("TipNavigator", "attempts", self.attempts, minimum=1)
        one_of("TipNavigator", "friction", self.friction, get_args(InModel))
        if self.plan_every is not None:
            positive("TipNavigator", "plan_every", self.plan_every, "m")

    def start(self, system: System) -> Navigator:
        """The navigator of one run; see ``Steering.start``."""
        plain = StableNavigator(
            system, demands=self.demands, plan_every=self.plan_every, friction=self.friction
        )
        return persistent(plain, self.attempts)

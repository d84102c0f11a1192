"""Kinds of feed, and what they have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from magwire.scenario.kind import ModelTable

if TYPE_CHECKING:
    from magwire.engine.feed import Feed


class FeedTable(ModelTable):
    """A kind of feed."""

    family = "feed"
    length_key: ClassVar[str]
    """The key that says how far the wire is fed."""

    @property
    def farthest(self) -> float:
        """Largest fed length [m]."""
        raise NotImplementedError

    @property
    def duration(self) -> float:
        """How long feeding takes [s]."""
        raise NotImplementedError

    def create(self) -> Feed:
        """The feed as a model."""
        raise NotImplementedError

    def build(self) -> Feed:
        """The feed as a model, created once."""
        model: Feed = super().build()
        return model

"""Lumens of every kind, made once."""

from __future__ import annotations

import pytest

from magwire.lumen import Lumen

from .tubes import LUMENS


@pytest.fixture(scope="session")
def lumens() -> dict[str, Lumen]:
    """Every lumen, made once."""
    return {name: make() for name, make in LUMENS.items()}


@pytest.fixture(params=sorted(LUMENS))
def lumen(request: pytest.FixtureRequest, lumens: dict[str, Lumen]) -> Lumen:
    """One lumen after the other."""
    return lumens[request.param]

"""What numba finds out of a call is asked for once."""

from __future__ import annotations

import operator
from typing import Any

import numba
import pytest

from magwire.kernels import _known


def test_the_meaning_of_a_sum_is_looked_up_once(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[object] = []
    find = _known._find

    def noted(function: Any, *rest: Any) -> Any:
        asked.append(function.typing_key)
        return find(function, *rest)

    monkeypatch.setattr(_known, "_known", {})
    monkeypatch.setattr(_known, "_find", noted)
    _known.remember_calls()
    first, second = numba.njit(lambda a, b: a + b), numba.njit(lambda a, b: b + a + b)
    assert (first(1.0, 2.5), second(1.0, 2.5)) == (3.5, 6.0)
    assert asked.count(operator.add) == 1
    assert first(2, 3) == 5
    assert type(first(2, 3)) is int
    assert asked.count(operator.add) == 2  # of integers it is another

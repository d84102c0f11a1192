"""Nothing public changes unnoticed, and its examples are true."""

from __future__ import annotations

import doctest
import importlib
from pathlib import Path

import pytest

import magwire
from public import SNAPSHOT, snapshot

SOURCES = Path(magwire.__file__).parent
EXAMPLES = [
    ".".join(("magwire", *path.relative_to(SOURCES).with_suffix("").parts))
    for path in sorted(SOURCES.rglob("*.py"))
    if any(line.lstrip().startswith(">>> ") for line in path.read_text("utf-8").splitlines())
]


def test_the_public_interface_is_the_one_that_is_kept() -> None:
    """Mend what broke, or renew the file with ``python tests/public.py`` and say so in a note."""
    now = snapshot().splitlines()
    kept = SNAPSHOT.read_text(encoding="utf-8").splitlines()
    assert [line for line in kept if line not in now] == []  # gone or changed
    assert [line for line in now if line not in kept] == []  # new


def test_every_public_name_is_there() -> None:
    assert sorted(magwire.__all__) == sorted({*magwire._HOMES, "__version__"})
    for name in magwire.__all__:
        assert getattr(magwire, name).__doc__


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_in_docstrings(name: str) -> None:
    found = doctest.testmod(importlib.import_module(name))
    assert found.attempted > 0
    assert found.failed == 0

"""Settings for all tests."""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path

# Matrices are small: threads of BLAS cost more than they gain, most of all on a busy machine. It is
# read when numpy is loaded.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ["MPLBACKEND"] = "agg"  # tests draw without a screen, in subprocesses too

import pytest
from hypothesis import settings

from magwire.report import progress

# The first call of a kernel may compile it, which takes longer than any deadline for one example.
settings.register_profile("magwire", deadline=None)
settings.load_profile("magwire")
progress.EVERY = float("inf")  # on a slow machine lines of progress would stand among others


ROOT = Path(__file__).parent
FIRST = (
    "test_session.py",
    "faces/test_plot.py",
    "physics/test_moving_walls.py",
    "scenario/test_actuators.py",
    "lumen/test_surface.py",
    "physics/test_friction.py",
    "env/test_env.py",
    "physics/test_soft_walls.py",
)
"""Files by the kernels that they compile on a new machine: no two alike side by side.

The second draws pictures: what all kinds of steps have in common is compiled beside it, once.
"""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Files that compile most go first, others by how many tests they have, for two processes."""
    many = Counter(item.path for item in items)
    first = {ROOT / name: k for k, name in enumerate(FIRST)}
    items.sort(key=lambda item: (first.get(item.path, len(FIRST)), -many[item.path]))

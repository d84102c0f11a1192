"""Calibration files of real systems, which are not part of magwire."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

_NEXT_TO_US = Path(__file__).parents[2].parent / "shared" / "data"
FOLDER = Path(os.environ.get("MAGWIRE_SHARED_DATA", _NEXT_TO_US)) / "actuators"
needs_files = pytest.mark.skipif(not FOLDER.is_dir(), reason="the calibration files are not here")

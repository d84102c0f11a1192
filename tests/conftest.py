"""Settings for all tests."""

from __future__ import annotations

import os

from hypothesis import settings

os.environ["MPLBACKEND"] = "agg"  # tests draw without a screen, in subprocesses too

# The first call of a kernel may compile it, which takes longer than any deadline for one example.
settings.register_profile("magwire", deadline=None)
settings.load_profile("magwire")

"""Settings for all tests."""

from __future__ import annotations

import os

# Matrices are small: threads of BLAS cost more than they gain, most of all on a busy machine. It is
# read when numpy is loaded.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ["MPLBACKEND"] = "agg"  # tests draw without a screen, in subprocesses too

from hypothesis import settings

# The first call of a kernel may compile it, which takes longer than any deadline for one example.
settings.register_profile("magwire", deadline=None)
settings.load_profile("magwire")

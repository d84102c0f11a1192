"""Results: the record of a run, NetCDF in and NetCDF out."""

from __future__ import annotations

from magwire.results.result import Result
from magwire.results.writer import Writer

__all__ = ["Result", "Writer"]

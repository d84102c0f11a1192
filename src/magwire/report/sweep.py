"""What to know of a sweep, as lines of text."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

import numpy as np

from magwire.status import RunStatus
from magwire.units import show

if TYPE_CHECKING:
    import xarray as xr


def lines(table: xr.Dataset) -> list[str]:
    """What to know of a sweep, a line each."""
    status = Counter(str(word) for word in table["status"].values)
    ended = ", ".join(f"{count} {word}" for word, count in status.most_common())
    whole = table["status"].values == RunStatus.COMPLETE  # others had not met all
    tips, wires = (
        int(np.count_nonzero(table[f"{part}_contact_free"].values[whole] == 1.0))
        for part in ("tip", "wire")
    )
    rows = {
        "runs": f"{table.sizes['run']}: {ended}",
        "varied": str(table.attrs["parameters"]),
        "tip clear throughout": f"in {tips} of {int(whole.sum())} complete runs",
        "wire clear, too": f"in {wires} of {int(whole.sum())} complete runs",
    }
    for name, label, dimension in (
        ("max_tip_force", "peak tip force", "force"),
        ("max_wall_force", "peak wire force", "force"),
        ("max_push_force", "peak push at guide", "force"),
        ("peak_field", "peak field", "flux_density"),
    ):
        values = table[name].values[np.isfinite(table[name].values)]
        if values.size:
            low, high = (show(float(f"{x:.4g}"), dimension) for x in (values.min(), values.max()))
            rows[label] = f"{low} to {high}" if low != high else low
    return [f"{name:22}{text}" for name, text in rows.items()]

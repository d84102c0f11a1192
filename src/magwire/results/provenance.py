"""Where and with what something was computed."""

from __future__ import annotations

import platform
import time
from importlib.metadata import PackageNotFoundError, version

PACKAGES = ("numpy", "scipy", "numba", "llvmlite", "daqp", "h5py", "h5netcdf", "xarray")
"""Those that may have a say in the numbers, or in how they are written."""


def attributes() -> dict[str, str]:
    """Date, packages and machine, as attributes of a file."""
    return {
        "date_created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
        "packages": ", ".join(f"{name} {number}" for name, number in versions(PACKAGES).items()),
        "platform": f"{platform.system()} {platform.release()} {platform.machine()}",
    }


def versions(names: tuple[str, ...]) -> dict[str, str]:
    """Python's version and those of packages; "not installed" where there is none."""
    found = {"python": platform.python_version()}
    for name in names:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = "not installed"
    return found

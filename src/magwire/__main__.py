"""``python -m magwire``, the same as the command ``magwire``."""

from __future__ import annotations

import sys

from magwire.cli import main

if __name__ == "__main__":
    sys.exit(main())

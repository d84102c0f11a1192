"""``python -m magwire``, the same as the command ``magwire``."""

from __future__ import annotations

import sys


def start() -> int:
    """Run the command line; Ctrl-C is told in a word also while it is still being loaded."""
    try:
        from magwire.cli import main
    except KeyboardInterrupt:
        sys.stderr.write("Interrupted.\n")
        return 130
    return main()


if __name__ == "__main__":
    sys.exit(start())

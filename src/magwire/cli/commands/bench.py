"""The command ``magwire bench``."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from magwire.cli.options import Flag
from magwire.cli.words import say


def bench(
    *,
    repeats: int = 5,
    quick: Flag = False,
    as_json: Annotated[bool, Parameter(name="--json", negative="")] = False,
    read: Annotated[Path | None, Parameter(name="--read")] = None,
) -> int:
    """Measure times, counts and ratios on this machine: one page, in one thread.

    Parameters
    ----------
    repeats
        How often each thing is measured.
    quick
        One repeat of a short feed, which shows that it works.
    as_json
        Print all samples as JSON in place of the page.
    read
        File of such samples to make the page of, without measuring.
    """
    import os
    import subprocess

    from magwire.errors import whole
    from magwire.many.children import ONE_THREAD

    whole("bench", "--repeats", repeats, minimum=1)
    if read is None and any(os.environ.get(name) != one for name, one in ONE_THREAD.items()):
        # Libraries look at these when they are loaded, which they are by now.
        words = ["bench", "--repeats", str(repeats), *["--quick"] * quick, *["--json"] * as_json]
        command = [sys.executable, "-m", "magwire", *words]
        return subprocess.run(command, env=os.environ | ONE_THREAD, check=False).returncode
    from magwire.evidence.bench import page

    if read is None:
        from rich.console import Console

        from magwire.evidence.bench.run import measure

        with Console(stderr=True).status("measuring ...") as status:
            results = measure(repeats=repeats, quick=quick, tell=status.update)
    else:
        results = page.load(read)
    if as_json:
        say(json.dumps(results, indent=1))
    else:
        page.show(results)
    return 0

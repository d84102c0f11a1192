"""A process that does runs one after the other: jobs come as lines of JSON, and so do outcomes.

Started by ``magwire.many.processes``. It ends when there are no more lines, also because the
process that writes them is gone.
"""

from __future__ import annotations

import json
import os
import signal
import sys

from magwire.many.task import run


def serve() -> None:
    """Answer every line."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # how it is told to stop in a run
    # What else is printed must not come between the answers.
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    for line in sys.stdin:
        job = json.loads(line)
        answers.write(json.dumps(run(job["scenario"], job["file"])) + "\n")
        answers.flush()


if __name__ == "__main__":
    serve()

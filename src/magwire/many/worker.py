"""A process that does runs one after the other: jobs come as lines of JSON, and so do outcomes.

Started by ``magwire.many.processes``. It ends when there are no more lines, also because the
process that writes them is gone: a run that nobody waits for would keep its result from the next
one.
"""

from __future__ import annotations

import _thread
import json
import os
import queue
import signal
import sys
import threading

from magwire.many.task import run


def serve() -> None:
    """Answer every line."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # how it is told to stop in a run
    # What else is printed must not come between the answers.
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    orders: queue.SimpleQueue[str] = queue.SimpleQueue()
    busy = threading.Event()
    threading.Thread(target=_listen, args=(orders, busy), daemon=True).start()
    while line := orders.get():
        busy.set()
        job = json.loads(line)
        answers.write(json.dumps(run(job["scenario"], job["file"])) + "\n")
        answers.flush()
        busy.clear()


def _listen(orders: queue.SimpleQueue[str], busy: threading.Event) -> None:
    """Pass on what comes in; where nobody is left to answer to, end the run as Ctrl-C does."""
    for line in sys.stdin:
        orders.put(line)
    orders.put("")
    if busy.is_set():
        _thread.interrupt_main()


if __name__ == "__main__":
    serve()

"""A process that plans for one outlet after the other: names come pickled, and so do answers.

Started by ``magwire.many.planners``. It ends with the process that started it.
"""

from __future__ import annotations

import os
import pickle
import queue
import sys
import threading

from magwire.errors import MagwireError
from magwire.many.planners import Task
from magwire.planning import plan


def serve() -> None:
    """Answer every name with its prospect, or with what is wrong in words."""
    # What else is printed must not come between the answers.
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    task: Task = pickle.load(sys.stdin.buffer)
    names: queue.SimpleQueue[str | None] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(names,), daemon=True).start()
    while (name := names.get()) is not None:
        try:
            (answer,) = plan(
                task.lumen,
                task.wire,
                demands=task.demands,
                contact=task.contact,
                outlets=(name,),
            )
            pickle.dump(answer, answers)
        except MagwireError as error:
            pickle.dump(str(error), answers)
        answers.flush()


def _listen(names: queue.SimpleQueue[str | None]) -> None:
    """Pass on what comes in; where nobody is left to answer to, end at once."""
    while True:
        try:
            names.put(pickle.load(sys.stdin.buffer))
        except (EOFError, OSError):
            os._exit(0)


if __name__ == "__main__":
    serve()

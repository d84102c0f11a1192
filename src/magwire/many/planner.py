"""A process that plans for one outlet after the other: orders come pickled, and so do answers.

Started by ``magwire.many.planners``. It ends with the process that started it.
"""

from __future__ import annotations

import os
import pickle
import queue
import sys
import threading

from magwire.errors import MagwireError
from magwire.many.planners import Check, Task
from magwire.planning import Prospect, Trial, plan
from magwire.planning.perturbations import tried


def serve() -> None:
    """Answer every order with what comes of it, or with what is wrong in words."""
    # What else is printed must not come between the answers.
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    task: Task = pickle.load(sys.stdin.buffer)
    orders: queue.SimpleQueue[str | Check] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(orders,), daemon=True).start()
    while True:
        try:
            pickle.dump(_done(task, orders.get()), answers)
        except MagwireError as error:
            pickle.dump(str(error), answers)
        answers.flush()


def _done(task: Task, order: str | Check) -> Prospect | Trial:
    """What comes of an order."""
    if isinstance(order, Check):
        return tried(*order, task.lumen, task.wire, task.demands, task.contact)
    (prospect,) = plan(
        task.lumen, task.wire, demands=task.demands, contact=task.contact, outlets=(order,)
    )
    return prospect


def _listen(orders: queue.SimpleQueue[str | Check]) -> None:
    """Pass on what comes in; where nobody is left to answer to, end at once."""
    while True:
        try:
            orders.put(pickle.load(sys.stdin.buffer))
        except (EOFError, OSError):
            os._exit(0)


if __name__ == "__main__":
    serve()

"""Plans for several outlets at a time, in processes of their own.

What travels are the models themselves, pickled, to the bit.
"""

from __future__ import annotations

import pickle
from collections.abc import Generator, Sequence
from typing import NamedTuple

from magwire.contact import Barrier
from magwire.errors import MagwireError
from magwire.lumen import Lumen
from magwire.many.children import Child, side_by_side
from magwire.navigate.demands import Demands
from magwire.planning import Prospect
from magwire.wire import Wire


class Task(NamedTuple):
    """What is planned for every outlet; see ``magwire.planning.plan``."""

    lumen: Lumen
    wire: Wire
    demands: Demands
    contact: Barrier | None


class Planner(Child):
    """A process that plans a task for one outlet after the other."""

    def __init__(self, task: Task) -> None:
        super().__init__("magwire.many.planner")
        self._task: Task | None = task

    def plan(self, name: str) -> Prospect:
        """What to expect on the path to an outlet.

        Raises
        ------
        MagwireError
            What planning raises, in its words; or that the process has died, and its last words.
        """
        try:
            if self._task is not None:
                pickle.dump(self._task, self.orders)
                self._task = None
            pickle.dump(name, self.orders)
            self.orders.flush()
            answer: Prospect | str = pickle.load(self.answers)
        except (OSError, EOFError, pickle.UnpicklingError) as error:
            ended = f"The process that planned for '{name}' ended with {self.last_words()}."
            raise MagwireError(ended) from error
        if isinstance(answer, str):
            raise MagwireError(answer)
        return answer


def plan_at_once(task: Task, names: Sequence[str], workers: int) -> Generator[Prospect, None, None]:
    """Plan for outlets in processes, yielded as they are done.

    Each is bit for bit what ``magwire.planning.plan`` gives for it alone.

    Parameters
    ----------
    task
        What is planned.
    names
        Outlets, begun in this order.
    workers
        Number of processes.

    Raises
    ------
    MagwireError
        If planning fails, or a process dies.
    """
    pool = [Planner(task) for _ in range(min(workers, len(names)))]
    yield from side_by_side(pool, names, lambda planner, name, _: planner.plan(name))

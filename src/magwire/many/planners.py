"""Plans for several outlets at a time, and what is tried of them, in processes of their own.

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
from magwire.planning import Prospect, Trial
from magwire.wire import Wire


class Task(NamedTuple):
    """What is planned for every outlet; see ``magwire.planning.plan``."""

    lumen: Lumen
    wire: Wire
    demands: Demands
    contact: Barrier | None


class Check(NamedTuple):
    """What is to be tried of a way that is reached; see ``mw.robustness``."""

    change: str
    prospect: Prospect


class Planner(Child):
    """A process that plans a task for one outlet after the other, or tries what was planned."""

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
        answer = self._answer(name, name)
        assert isinstance(answer, Prospect)
        return answer

    def check(self, order: Check) -> tuple[str, Trial]:
        """The outlet, and how the way there went with a change; raises as ``plan`` does."""
        outlet = order.prospect.outlet
        answer = self._answer(order, outlet)
        assert isinstance(answer, Trial)
        return outlet, answer

    def _answer(self, order: str | Check, outlet: str) -> Prospect | Trial:
        try:
            if self._task is not None:
                pickle.dump(self._task, self.orders)
                self._task = None
            pickle.dump(order, self.orders)
            self.orders.flush()
            answer: Prospect | Trial | str = pickle.load(self.answers)
        except (OSError, EOFError, pickle.UnpicklingError) as error:
            ended = f"The process that planned for '{outlet}' ended with {self.last_words()}."
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


def check_at_once(
    task: Task, orders: Sequence[Check], workers: int
) -> Generator[tuple[str, Trial], None, None]:
    """Try what was planned, in processes, with the outlet of each, yielded as they are done.

    Parameters and errors are those of ``plan_at_once``.
    """
    pool = [Planner(task) for _ in range(min(workers, len(orders)))]
    yield from side_by_side(pool, orders, lambda planner, order, _: planner.check(order))

"""Plans for several outlets at a time, and what is tried of them, in processes of their own.

What travels are the models themselves, pickled, to the bit. The processes can be started before it
is known what they are to plan, so that they load while a vessel is read: this module loads little.
"""

from __future__ import annotations

import pickle
from collections.abc import Generator, Sequence
from types import TracebackType
from typing import TYPE_CHECKING, NamedTuple, cast

from magwire.errors import MagwireError
from magwire.many.children import Child, side_by_side

if TYPE_CHECKING:
    from magwire.contact import Barrier
    from magwire.lumen import Lumen
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

    def __init__(self) -> None:
        super().__init__("magwire.many.planner")
        self._task: Task | None = None

    def take(self, task: Task) -> Planner:
        """Give it the task that all its orders are about; returns itself."""
        self._task = task
        return self

    def plan(self, name: str) -> Prospect:
        """What to expect on the path to an outlet.

        Raises
        ------
        MagwireError
            What planning raises, in its words; or that the process has died, and its last words.
        """
        return cast("Prospect", self._answer(name, name))

    def check(self, order: Check) -> tuple[str, Trial]:
        """The outlet, and how the way there went with a change; raises as ``plan`` does."""
        outlet = order.prospect.outlet
        return outlet, cast("Trial", self._answer(order, outlet))

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


class Crew:
    """Planners that load while it is not known yet what they are to plan; a context.

    Parameters
    ----------
    size
        How many are started.
    """

    def __init__(self, size: int) -> None:
        self._waiting = [Planner() for _ in range(size)]

    def __enter__(self) -> Crew:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """End those that were not needed."""
        for planner in self._waiting:
            planner.stop()
            planner.close()

    def take(self, task: Task, count: int) -> list[Planner]:
        """So many planners with a task; where too few are waiting, new ones."""
        missing = max(0, count - len(self._waiting))
        ready, self._waiting = self._waiting[:count], self._waiting[count:]
        return [planner.take(task) for planner in [*ready, *(Planner() for _ in range(missing))]]


NOBODY = Crew(0)


def plan_at_once(
    task: Task, names: Sequence[str], workers: int, crew: Crew = NOBODY
) -> Generator[Prospect, None, None]:
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
    crew
        Some of them that have been started already.

    Raises
    ------
    MagwireError
        If planning fails, or a process dies.
    """
    pool = crew.take(task, min(workers, len(names)))
    yield from side_by_side(pool, names, lambda planner, name, _: planner.plan(name))


def check_at_once(
    task: Task, orders: Sequence[Check], workers: int
) -> Generator[tuple[str, Trial], None, None]:
    """Try what was planned, in processes, with the outlet of each, yielded as they are done.

    Parameters and errors are those of ``plan_at_once``.
    """
    pool = NOBODY.take(task, min(workers, len(orders)))
    yield from side_by_side(pool, orders, lambda planner, order, _: planner.check(order))

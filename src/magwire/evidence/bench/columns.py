"""What the tables of the page are made of."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from rich import box
from rich.markup import escape
from rich.table import Table

from magwire.evidence.bench.repeats import Sample, least, median

Row = dict[str, Any]
Pick = Callable[[Sequence[Sample], str], float]
PICKS: tuple[Pick, ...] = (median, least)


def table(title: str, *columns: str) -> Table:
    made = Table(
        title=title,
        box=box.SIMPLE_HEAD,
        padding=(0, 1),
        collapse_padding=True,
        pad_edge=False,
    )
    for number, name in enumerate(columns):
        made.add_column(
            escape(name),
            justify="right" if number else "left",
            vertical="bottom",
            no_wrap=True,
        )
    return made


def per_step(samples: Sequence[Sample], pick: Pick = median) -> float:
    """Wall time of a step [ms]."""
    return 1e3 * pick(samples, "seconds") / samples[0]["steps"]


def step_times(samples: Sequence[Sample]) -> list[str]:
    """Wall time of a step [ms], median and least."""
    return [f"{per_step(samples, pick):.4f}" for pick in PICKS]


def iterations(samples: Sequence[Sample]) -> float:
    return samples[0]["newton_iterations"]


def passes(samples: Sequence[Sample]) -> float:
    """Evaluations of the residual: one to begin with in each attempt, one after each iteration."""
    first = samples[0]
    return first["steps"] + first["retries"] + first["newton_iterations"]


def counts(samples: Sequence[Sample]) -> list[str]:
    """Iterations and factorisations per step, retries; a march that broke off says so."""
    first = samples[0]
    retries = f"{first['retries']}"
    if not first["converged"]:
        retries = f"[red]stopped at step {first['steps']}[/]"
    return [
        f"{first['newton_iterations'] / first['steps']:.2f}",
        f"{first['factorisations'] / first['steps']:.2f}",
        retries,
    ]

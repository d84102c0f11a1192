"""The tables of what surrounds the steps: control, starts, files, memory, many runs, engines."""

from __future__ import annotations

from collections.abc import Sequence

from rich.table import Table

from magwire.evidence.bench.columns import PICKS, Row, table
from magwire.evidence.bench.repeats import Sample, column, least, median

STARTS_NOTE = "First step: of what `magwire run half-circle` does. Cold: nothing compiled yet."
UPDATES_NOTE = (
    "Navigator alone, one field in each update. Ratios: paper's optimiser over newton, same dX.\n"
    "It needs more equilibria because it takes many small steps, each with three differences."
)
STEERED_NOTE = "Whole runs with plant, records and result. Real time: less than 1."
MANY_NOTE = (
    "Speed-up: one worker's time over two workers'. Threads queue for the interpreter, in which\n"
    "a navigator plans; the times of processes include their start."
)
ENGINES_NOTE = (
    "A step of magwire next to one of the engine, and where both come to rest. Left out: not "
    "installed."
)

LEARNING_NOTE = (
    "Half-circle, 100 nodes, an action is a step of 10 ms; observation and reward included.\n"
    "MuJoCo: 100 nodes in a channel, steps of 0.07 ms, nothing observed."
)
DRIVING_NOTE = (
    "Half-circle, dt = 10 ms, a headless Chromium, all on this machine. From the key's event to\n"
    "the picture in which a pixel has changed, the wire at rest before; the screen comes on top."
)

# What it is, which start, from which mark to which.
STARTS = (
    ("import magwire", "import", "python", "magwire"),
    ("  and every public name", "names", "python", "names"),
    ("warm start: process to first step", "warm", None, "step"),
    ("  Python itself", "warm", None, "python"),
    ("  import of the command line", "warm", "python", "command line"),
    ("  scenario, models, result file, first step", "warm", "command line", "step"),
    ("cold start: process to first step", "cold", None, "step"),
)


def by_update(rows: Sequence[Row], push: float) -> Table:
    """What an update of the control costs."""
    made = table(
        f"5  Update of the control by navigator and dX: half-circle, X = 0 to {push:g}",
        *("navigator", "dX", "updates", "median\n[ms]", "least\n[ms]", "longest\n[ms]"),
        *("equilibria\n/update", "ratio in\nequilibria", "ratio\nin time"),
    )
    known = {(row["method"], row["update"]): row["samples"] for row in rows}
    for row in rows:
        samples, newton = row["samples"], known["newton", row["update"]]
        first = samples[0]
        ratios = ("", "")
        if row["method"] == "paper":
            ratios = (
                f"{first['solves'] / newton[0]['solves']:.1f}",
                f"{median(samples, 'total') / median(newton, 'total'):.1f}",
            )
        updates = f"{first['updates']}" + (" [red]stopped[/]" if first["stopped"] else "")
        made.add_row(
            row["method"],
            f"{row['update']:g}",
            updates,
            f"{1e3 * median(samples, 'seconds'):.2f}",
            f"{1e3 * least(samples, 'seconds'):.2f}",
            f"{1e3 * median(samples, 'longest'):.1f}",
            f"{first['solves'] / first['updates']:.1f}",
            *ratios,
        )
        if row["method"] == "stable":
            made.add_section()
    return made


def by_steered(rows: Sequence[Row]) -> Table:
    """The paper's figure of relative compute time against the update step."""
    made = table(
        "6  Relative compute time of control by the paper's optimiser: half-circle, dt = 10 ms",
        *("dX", "computing\n/ simulated", "of min", "tip force"),
    )
    for row in rows:
        samples = row["samples"]
        simulated = samples[0]["simulated"]
        ended = "none" if samples[0]["contact_free"] else "touches"
        made.add_row(
            f"{row['update']:g}",
            *(f"{pick(samples, 'seconds') / simulated:.4f}" for pick in PICKS),
            ended if samples[0]["complete"] else "[red]stopped[/]",
        )
    return made


def by_memory(samples: dict[str, list[Sample]]) -> Table:
    """Peak memory of whole runs."""
    made = table("9  Peak memory of a process with a whole run", *("scenario", "MB"))
    for name, found in samples.items():
        made.add_row(name, f"{median(found, 'peak') / 1e6:.0f}")
    return made


def by_workers(rows: Sequence[Row]) -> Table:
    """How many runs scale."""
    made = table(
        f"10  {rows[0]['runs']} steered half-circles side by side",
        *("", "workers", "s", "min", "speed-up", "of min", "load average"),
    )
    for row in rows:
        samples = row["samples"]
        alone = next(r["samples"] for r in rows if r["how"] == row["how"])
        made.add_row(
            row["how"],
            f"{row['workers']}",
            f"{median(samples, 'seconds'):.1f}",
            f"{least(samples, 'seconds'):.1f}",
            *(f"{pick(alone, 'seconds') / pick(samples, 'seconds'):.2f}" for pick in PICKS),
            f"{median(samples, 'load'):.1f}",
        )
    return made


def by_engine(rows: Sequence[Row]) -> Table:
    """Other engines on the same jobs."""
    made = table(
        "11  Other engines",
        *("job", "engine", "nodes", "dt\n[ms]", "ms/step", "min", "x real\ntime"),
        *("tip\nx / L", "tip\ny / L"),
    )
    job = rows[0]["job"]
    for row in rows:
        samples = row["samples"]
        if row["job"] != job:
            made.add_section()
            job = row["job"]
        made.add_row(
            row["job"],
            row["engine"],
            f"{row['nodes']}",
            f"{1e3 * row['time_step']:.3g}",
            f"{1e3 * median(samples, 'seconds'):.4f}",
            f"{1e3 * least(samples, 'seconds'):.4f}",
            f"{row['time_step'] / median(samples, 'seconds'):.1f}",
            *(f"{samples[0][name]:.4f}" for name in ("tip_x", "tip_y")),
        )
    return made


def by_environment(rows: Sequence[Row]) -> Table:
    """Steps and resets a second of environments."""
    made = table(
        "12  Environments: actions of 10 ms, in contact, and resets",
        *("", "threads", "a second", "of best", "Newton\n/step"),
    )
    for row in rows:
        samples = row["samples"]
        newton = median(samples, "newton")
        made.add_row(
            row["what"],
            f"{row['threads']}",
            f"{median(samples, 'rate'):.4g}",
            f"{max(column(samples, 'rate')):.4g}",
            f"{newton:.2f}" if newton == newton else "",
        )
    return made


def by_driving(rows: Sequence[Row]) -> Table:
    """The live simulator in a browser."""
    made = table(
        "14  Live simulator: key to changed picture, and pictures while a key is held",
        *("", "painted by", "key to picture\n[ms]", "worst", "pictures\n/s", "clock"),
    )
    for row in rows:
        latencies = sorted(row["latencies"])
        made.add_row(
            row["what"],
            row["painter"],
            f"{1e3 * latencies[len(latencies) // 2]:.0f}",
            f"{1e3 * latencies[-1]:.0f}",
            f"{row['pictures']:.0f}",
            f"{row['clock']:.2f}",
        )
    return made


def by_start(starts: dict[str, list[Sample]]) -> Table:
    made = table(
        "7  Starts, each in a fresh process",
        *("", "s", "min", "repeats"),
    )
    for name, key, begin, end in STARTS:
        if key not in starts:
            made.add_row(name, "left out", "", "0")
            continue
        spans = [{"s": s[end] - (s[begin] if begin else 0.0)} for s in starts[key]]
        made.add_row(name, f"{median(spans, 's'):.3f}", f"{least(spans, 's'):.3f}", f"{len(spans)}")
    if "cold" in starts:
        compiling = median(starts["cold"], "step") - median(starts["warm"], "step")
        made.add_row("  compiling: cold less warm", f"{compiling:.3f}", "", "")
    return made


def by_writing(writing: dict[str, list[Sample]]) -> Table:
    made = table(
        "8  What recording and the result file cost: half-circle, dt = 10 ms",
        *("", "s", "min", "records", "file\n[kB]", "added, part\nof the whole"),
    )
    whole = median(writing["file"], "seconds")
    before = 0.0
    for name, key in (
        ("stepping alone", "stepping"),
        ("Simulation.run without out", "no_file"),
        ("Simulation.run with out", "file"),
    ):
        samples = writing[key]
        seconds = median(samples, "seconds")
        made.add_row(
            name,
            f"{seconds:.3f}",
            f"{least(samples, 'seconds'):.3f}",
            f"{samples[0].get('records', 0):.0f}",
            f"{max(column(samples, 'bytes')) / 1e3:.0f}" if key == "file" else "",
            f"{100 * (seconds - before) / whole:+.0f} %",
        )
        before = seconds
    back = median(writing["file"], "reading")
    made.add_row(
        "  of it: reading the file back",
        f"{back:.3f}",
        f"{least(writing['file'], 'reading'):.3f}",
        *("", "", f"{100 * back / whole:+.0f} %"),
    )
    return made

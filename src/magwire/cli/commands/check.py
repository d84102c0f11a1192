"""The command ``magwire check``."""

from __future__ import annotations

from pathlib import Path

from magwire.cli.words import say


def check(
    schedule: Path,
    /,
    *,
    actuator: str,
    tolerance: str | None = None,
    max_speed: str | None = None,
) -> int:
    """Dry run of a schedule on an actuator: all limits, and the field that the hardware makes.

    The exit status is 1 if any limit is not kept, or the field is off the planned one.

    Parameters
    ----------
    schedule
        inputs.nc or inputs.csv of 'magwire export --to inputs', or the folder that holds them.
    actuator
        TOML file, or scenario of the library, with the actuator as it is, with its saturation.
    tolerance
        How far the field may be off the planned one, such as "0.5 mT"; 2 percent of the largest
        planned field if left out.
    max_speed
        Largest speed of the feed, such as "5 mm/s"; that of the schedule's advancer if left out.
    """
    from magwire.actuate import dry_run
    from magwire.export import read_timetable
    from magwire.report import schedule as report
    from magwire.scenario import load_actuator
    from magwire.units import parse

    off = None if tolerance is None else parse(tolerance, "flux_density", "--tolerance")
    fast = None if max_speed is None else parse(max_speed, "speed", "--max-speed")
    hardware = load_actuator(actuator)
    table = read_timetable(schedule)
    found = dry_run(table, hardware, tolerance=off, max_speed=fast)
    for line in report.figures(table, hardware, off):
        say(line)
    for violation in found:
        say(str(violation))
    say(report.verdict(found))
    return 1 if found else 0

"""From a name or a file to a scenario that can be run, or to all that is wrong with it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from magwire.errors import ScenarioError
from magwire.files import TextFaultError, parse_toml, read_text
from magwire.scenario.checks import cross_faults
from magwire.scenario.faults import Key, key_of, sentence, suggestion
from magwire.scenario.kind import FAMILIES
from magwire.scenario.model import Scenario
from magwire.scenario.overrides import apply
from magwire.scenario.partial import partial_scenario
from magwire.scenario.unlikely import unlikely


def names() -> tuple[str, ...]:
    """Names of the scenarios that come with magwire."""
    entries = files("magwire.scenario").joinpath("library").iterdir()
    return tuple(sorted(e.name.removesuffix(".toml") for e in entries if e.name.endswith(".toml")))


def load(name_or_path: str | Path, overrides: Sequence[str] = ()) -> Scenario:
    """Read a scenario.

    Parameters
    ----------
    name_or_path
        Name of a scenario of the library, or a TOML file.
    overrides
        Keys to set, ``key=value`` each.

    Raises
    ------
    ScenarioError
        With all faults of the scenario, one sentence each.
    """
    text, folder = text_of(name_or_path)
    return parse(text, overrides, folder=folder, source=str(name_or_path))


def parse(
    text: str, overrides: Sequence[str] = (), *, folder: Path | None = None, source: str = "text"
) -> Scenario:
    """A scenario from the text of a TOML file.

    Parameters
    ----------
    text
        The TOML.
    overrides
        Keys to set, ``key=value`` each.
    folder
        What file names in the scenario start from; the working folder if left out.
    source
        What messages call the text.

    Raises
    ------
    ScenarioError
        With all faults of the scenario, one sentence each.
    """
    if not text.strip():
        raise ScenarioError(f"Scenario '{source}' is empty.")
    try:
        raw = parse_toml(text)
    except TextFaultError as error:
        raise ScenarioError(f"Scenario '{source}' is not valid TOML: {error}.") from None
    faults = apply(raw, overrides)
    unread: set[Key] = set()
    notes: tuple[str, ...] = ()
    for name, family in FAMILIES.items():
        table = raw.get(name)
        kind = family.of(table) if isinstance(table, dict) else None
        if isinstance(table, dict) and kind is not None:
            raw[name], more, missing, said, reach = kind.inline(table, folder or Path())
            faults += more
            notes += said
            unread.update(missing, [(name,)] if raw[name] is None else [])
            if reach is not None:
                _feed_to(raw, reach)
    scenario = _validate(raw, faults, unread)
    return scenario.with_notes(notes + unlikely(scenario))


def _feed_to(raw: dict[str, Any], reach: str) -> None:
    """Feed as far as a file reaches, unless the scenario says how far."""
    feed = raw.get("feed")
    if isinstance(feed, dict) and not {"distance", "table", "twist_table"} & set(feed):
        raw["feed"] = {**feed, "distance": reach}


def json_schema() -> dict[str, Any]:
    """JSON schema of scenario files."""
    schema = Scenario.model_json_schema()
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    return schema


def _validate(raw: dict[str, Any], faults: list[str], unread: set[Key]) -> Scenario:
    faulty, scenario = set(unread), None
    try:
        scenario = Scenario.model_validate(raw)
    except ValidationError as errors:
        for error in errors.errors(include_url=False):
            key = key_of(error)
            if key not in unread:
                faults.append(sentence(error))
                faulty.add(key)
    faults += cross_faults(scenario or partial_scenario(raw, faulty))
    if faults or scenario is None:
        raise ScenarioError(faults)
    return scenario


def text_of(name_or_path: str | Path) -> tuple[str, Path]:
    """The text of a scenario as it stands, and the folder that file names in it start from.

    Raises
    ------
    ScenarioError
        If there is none, or it cannot be read.
    """
    name = str(name_or_path)
    if isinstance(name_or_path, str) and name in names():
        entry = files("magwire.scenario").joinpath("library", f"{name}.toml")
        return entry.read_text(encoding="utf-8"), Path()
    path = Path(name_or_path)
    if not os.path.exists(path) and path.suffix != ".toml" and path.name == name:
        raise ScenarioError(f"There is no scenario '{name}'; {suggestion(name, names())}")
    if path.is_dir():
        raise ScenarioError(f"Scenario '{name}' is a folder; expected a TOML file.")
    try:
        return read_text(path), path.parent
    except UnicodeDecodeError:
        raise ScenarioError(f"Scenario '{name}' is not a text file.") from None
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise ScenarioError(f"Scenario '{name}' cannot be read: {reason}.") from None

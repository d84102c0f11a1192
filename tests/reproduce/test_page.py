"""Pages from made-up runs, and a short real one."""

from __future__ import annotations

import html.parser
import re
from dataclasses import replace
from pathlib import Path

import pytest

from magwire.cli import main
from magwire.evidence.reproduce import report, runs, tables
from magwire.evidence.reproduce.chapter import Chapter
from magwire.evidence.reproduce.claim import Claim
from magwire.evidence.reproduce.page import Heading, Picture, claims_table, to_html, to_markdown
from magwire.evidence.reproduce.runs import REPLAYS, Ask, Replay, Run, Runs
from magwire.results import Result, Writer
from records import helix, info, records
from reproduce.made import UNIT, outcome, stopped

SHORT = (
    "feed.distance=8 mm",
    "wire.nodes=40",
    "solver.time_step=100 ms",
    "output.record_every=0.5 mm",
)


def made_up(ask: Ask, made: Runs, common: object = ()) -> Run:
    """A run that touches, and stops half-way if the paper's optimiser steers it."""
    run = info(helix() if "helix" in ask.scenario else None, title=ask.scenario)
    writer = Writer(run)
    stops = ask.method == "paper"
    for record in records(run, 30 if stops else 73):
        writer.append(record)
    status = "no field" if stops else "complete"
    writer.close(status, "At 29 mm <there> is | no field." if stops else "")
    return Run(writer.result(), (0.1, 0.4))


class Words(html.parser.HTMLParser):
    """Tags that are open, and the pictures."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.pictures: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "img":
            self.pictures.append(str(dict(attrs)["src"]))
        elif tag != "meta":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def check_page(folder: Path) -> tuple[str, str]:
    """HTML is well-formed, both pages show the same pictures, and those are there."""
    page = (folder / "reproduce.html").read_text(encoding="utf-8")
    text = (folder / "reproduce.md").read_text(encoding="utf-8")
    words = Words()
    words.feed(page)
    assert words.open == []
    assert words.pictures == re.findall(r"!\[.*?\]\((.*?)\)", text)
    for picture in words.pictures:
        assert (folder / picture).stat().st_size > 1000
    return page, text


def test_both_formats_say_the_same() -> None:
    claim = Claim("Fig. 1", "F < 2 | always", "F = 3", "no", "it & that")
    blocks = [Heading("Part"), "Text <here>.", claims_table([claim]), Picture("a.png", "Both")]
    page, text = to_html("Title", blocks), to_markdown("Title", blocks)
    assert "| Fig. 1 | F < 2 \\| always | F = 3 | no | it & that |" in text
    assert '<td><b class="no">no</b></td>' in page
    assert "Text &lt;here&gt;." in page
    assert "![Both](a.png)" in text
    Words().feed(page)


@pytest.mark.parametrize("name", ["passive", "helix", "branches", "authors", "speed"])
def test_every_part_of_the_page(
    name: report.Name, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runs, "perform", made_up)
    seen: list[str] = []
    (chapter,) = report.reproduce(tmp_path, [name], watch=seen.append)
    assert len(seen) == len(report.asks([name])) + 1
    page, text = check_page(tmp_path)
    assert chapter.claims
    assert all(claim.says in text for claim in chapter.claims)
    judged = [claim for claim in chapter.claims if claim.agrees != "not checked"]
    assert all("yes" in claim.because for claim in judged)  # the rule is stated
    assert "This is only a part of the page." in page
    if name == "helix":
        assert "The paper&#x27;s optimiser stops: At 29 mm &lt;there&gt; is | no field." in page
        assert "helix, stable: the tip touches with" in text
        assert chapter.broken


def test_a_short_part_in_earnest(tmp_path: Path) -> None:
    (chapter,) = report.reproduce(tmp_path, ["half-circle"], common=SHORT)
    assert chapter.broken == []
    _, text = check_page(tmp_path)
    assert "images/navigation.gif" in text
    assert text.count("free, tip within 0.") == len(REPLAYS)
    assert [row[2] for row in chapter.reductions] == ["none", "planner only", "planner only"]


def test_a_navigator_that_stops_has_no_replay() -> None:
    limited = ("feed.distance=16 mm", *SHORT[1:], "navigate.max_field=0.1 mT")
    ask = Ask("half-circle", "stable", limited)
    replay = Ask("half-circle", "stable", limited, Replay())
    seen: list[str] = []
    found = runs.make_all([ask, ask, replay], seen.append)
    assert seen == ["half-circle, stable", "half-circle, stable, replay as is"]
    assert list(found) == [ask]
    assert found[ask].result.status == "no field"
    assert found[ask].steering > 0.0


def test_forces_are_compared_as_far_as_both_go() -> None:
    passive, steered = outcome(lambda push: 100.0 * push), stopped(outcome(1.0), 0.36)
    ((lumen, _, tube, end, peak, impulse, whole, _),) = tables.reduction_rows(
        "bend", passive, {"newton": steered}
    )
    assert (lumen, tube, end) == ("bend", "planner only", "0.360 (stops)")
    milli = 1e3 * UNIT
    assert peak == f"{36 * milli:.3g} → {milli:.3g} (-97\u00a0%)"
    assert impulse == f"{0.5 * 36 * 36 * milli:.3g} → {36 * milli:.3g} (-94\u00a0%)"
    assert tables.reduction_rows("bend", passive, {"stable": outcome(0.01)})[0][4].endswith(
        "(-99.9\u00a0%)"
    )
    assert tables.reduction_rows("bend", passive, {"stable": outcome(0.0)})[0][4].endswith(
        "→ 0 (-100\u00a0%)"
    )
    assert whole == f"{72 * milli:.3g} → {2 * milli:.3g} (-97\u00a0%)"


def test_times_of_navigators() -> None:
    whole = made_up(Ask("half-circle", "stable"), {})
    stops = replace(made_up(Ask("half-circle", "paper"), {}), plans=(0.001, 0.002, 0.5))
    made = {("bend", "stable"): (whole, whole), ("bend", "paper"): (stops, None)}
    first, second = tables.pace_table(made).rows
    pace = f"{whole.outcome.pace:.3f}"
    assert first == ("bend", "least field", "250.00", "0.4", pace, pace)
    assert second[2:4] == ("2.00", "0.5")
    assert second[4].endswith(" (stops)")
    assert second[5] == "-"


def test_fates_of_replays() -> None:
    runs_made = {
        "as is": outcome(0.0),
        "touching": outcome(lambda push: 3.0 * (push > 0.4)),
        "broken": stopped(outcome(0.0), 0.2),
    }
    row = tables.replay_row("bend", outcome(0.0), runs_made, 1e-4)
    assert row == (
        "bend",
        "free, tip within 0.10 R",
        "touches from X = 0.401 on, F* up to 3.0",
        "no field at X = 0.200",
    )
    row = tables.replay_row("bend", stopped(outcome(0.0), 0.2), {}, 1e-4)
    assert set(row[1:]) == {"no schedule to the end"}


@pytest.fixture
def written(monkeypatch: pytest.MonkeyPatch) -> list[Chapter]:
    """What the command gets in place of the runs."""
    chapters = [Chapter("Half-circle")]

    def fake(folder: Path, names: object, **others: object) -> list[Chapter]:
        (folder / report.PAGE).write_text("page", encoding="utf-8")
        return chapters

    monkeypatch.setattr(report, "reproduce", fake)
    return chapters


def test_command(
    tmp_path: Path, written: list[Chapter], capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["reproduce", "--only", "helix", "passive", "--out", str(tmp_path / "page")]
    assert main(words) == 0
    assert capsys.readouterr().out.endswith("reproduce.html\n")
    assert main(words) == 1
    assert "use --force to overwrite" in capsys.readouterr().err
    written[0].broken.append("helix, stable: At 34 mm there is no field.")
    assert main([*words, "--force"]) == 1
    assert capsys.readouterr().err == "helix, stable: At 34 mm there is no field.\n"


def test_unknown_part(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "page"
    assert main(["reproduce", "--only", "spiral", "--out", str(folder)]) == 1
    said = capsys.readouterr().err
    assert said.startswith("Input --only must be among setup, passive,")
    assert said.endswith("received 'spiral'.\n")
    assert not folder.exists()


def test_parts_come_in_the_order_of_the_page() -> None:
    assert report.chosen(["speed", "passive"]) == ["passive", "speed"]
    assert report.chosen(None) == list(report.PARTS)


def test_replays_come_after_what_they_replay() -> None:
    asks = report.asks(list(report.PARTS))
    assert len(asks) == len(set(asks))
    for place, ask in enumerate(asks):
        if ask.replay is not None:
            assert ask.source in asks[:place]


def test_made_up_result_is_read_right() -> None:
    result = made_up(Ask("half-circle"), {}).result
    assert isinstance(result, Result)
    found = Run(result).outcome
    assert found.complete
    assert found.largest == pytest.approx(result.max_tip_force / result.force_scale)
    assert found.contacts()[0][0] == pytest.approx(result.first_contact / 0.1)

"""How a run ended, as a word and as a member of an enumeration."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest

import magwire as mw

WIRE = mw.Wire.uniform(0.1, 0.6e-3, 3e6, 1e6, 2000.0, 24)


def ended(out: Path | None, ending: mw.Ending | None) -> mw.Result:
    simulation = mw.Simulation(WIRE, mw.Lumen.straight(0.1, 3e-3))
    return simulation.run(mw.Feed(1e-3, 2e-3), time_step=0.1, watch=lambda _: ending, out=out)


@pytest.mark.parametrize("status", list(mw.RunStatus))
def test_members_are_their_words(status: mw.RunStatus) -> None:
    assert status == status.value == str(status)
    assert mw.RunStatus.of(status.value) is status
    assert pickle.loads(pickle.dumps(status)) is status


@pytest.mark.parametrize("to_file", [False, True])
def test_a_result_has_a_member_or_the_word_of_a_watcher(to_file: bool, tmp_path: Path) -> None:
    out = tmp_path / "result.nc" if to_file else None
    assert ended(out, None).status is mw.RunStatus.COMPLETE
    assert ended(out, mw.Ending(mw.RunStatus.UNSTABLE)).status is mw.RunStatus.UNSTABLE
    own = ended(out, mw.Ending("off the path", "It is off.")).status
    assert own == "off the path"
    assert not isinstance(own, mw.RunStatus)

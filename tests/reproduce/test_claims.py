"""Verdicts follow from numbers, both ways."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from magwire.evidence.reproduce import active_claims, passive_claims, setup_claims, speed_claims
from magwire.evidence.reproduce.claim import judged, percent
from reproduce.made import PUSH, outcome, stopped


def bump(centre: float, width: float, height: float):  # type: ignore[no-untyped-def]
    """A force that is zero but for a bump."""
    return lambda push: height * np.clip(1.0 - ((push - centre) / width) ** 2, 0.0, None)


def test_words() -> None:
    assert [judged(True), judged(False, True), judged(False)] == ["yes", "partly", "no"]
    assert percent(0.0361) == "3.6 %"
    assert percent(8.6e-10) == "less than 0.001 %"


def test_printed_formulas() -> None:
    assert setup_claims.moment(0.1448).agrees == "yes"
    assert setup_claims.moment(128e3).agrees == "no"
    assert setup_claims.half_circle_entrance().agrees == "no"
    assert "at 90°" in setup_claims.half_circle_entrance().finds
    assert setup_claims.sinusoid_extent().agrees == "no"
    assert setup_claims.helix_length().agrees == "yes"
    assert setup_claims.helix_entrance().agrees == "partly"
    assert "9.0°" in setup_claims.helix_entrance().finds


@pytest.mark.parametrize(("factor", "verdict"), [(1.001, "yes"), (1.05, "no")])
def test_quasi_static(factor: float, verdict: str) -> None:
    slow = outcome(bump(0.4, 0.2, 20.0))
    assert setup_claims.quasi_static(slow, outcome(bump(0.4, 0.2, 20.0 * factor))).agrees == verdict


@pytest.mark.parametrize(("peak", "verdict"), [(20.1, "yes"), (21.0, "partly"), (30.0, "no")])
def test_convergence_study(peak: float, verdict: str) -> None:
    finer = {"200 nodes": outcome(20.0), "dt = 5 ms": outcome(peak)}
    claim = setup_claims.fine_enough(outcome(20.0), finer)
    assert claim.agrees == verdict
    assert "200 nodes less than 0.001 %" in claim.finds


def test_a_run_that_fails_is_not_fine() -> None:
    broken = stopped(outcome(20.0), 0.3)
    assert setup_claims.fine_enough(outcome(20.0), {"200 nodes": broken}).agrees == "no"
    assert setup_claims.quasi_static(outcome(20.0), broken).agrees == "no"


@pytest.mark.parametrize(("end", "verdict"), [(0.48, "yes"), (0.34, "partly"), (0.6, "no")])
def test_first_stage_of_contact(end: float, verdict: str) -> None:
    run = outcome(bump(0.5 * (end + 0.1), 0.5 * (end - 0.1), 40.0))
    assert passive_claims.first_stage(run).agrees == verdict


def test_no_contact_at_all() -> None:
    run = outcome(0.0)
    assert passive_claims.first_stage(run).agrees == "no"
    assert passive_claims.valley(run, 0.51).agrees == "no"
    assert passive_claims.touches(run, None).agrees == "no"
    assert passive_claims.touches(outcome(3.0), 0.09).agrees == "yes"


@pytest.mark.parametrize(("arc", "verdict"), [(0.52, "yes"), (0.3, "no")])
def test_contact_returns_at_the_valley(arc: float, verdict: str) -> None:
    both = outcome(lambda push: bump(0.2, 0.1, 40.0)(push) + bump(0.6, 0.08, 40.0)(push))
    assert passive_claims.valley(both, arc).agrees == verdict


@pytest.mark.parametrize(("peak", "verdict"), [(41.0, "yes"), (45.2, "partly"), (60.0, "no")])
def test_second_peak(peak: float, verdict: str) -> None:
    claim = passive_claims.second_peak(outcome(bump(0.6, 0.1, peak)))
    assert claim.agrees == verdict
    assert claim.finds.startswith(f"F* = {peak:.1f}")


@pytest.mark.parametrize(("peak", "verdict"), [(90.0, "yes"), (50.0, "partly"), (40.0, "no")])
def test_helix_against_the_plane(peak: float, verdict: str) -> None:
    planar = {"half-circle": outcome(20.0), "sinusoid": outcome(45.0)}
    assert passive_claims.higher_in_space(outcome(peak), planar).agrees == verdict


@pytest.mark.parametrize(("factor", "verdict"), [(1.03, "yes"), (1.08, "partly"), (1.2, "no")])
def test_curves_of_the_authors(factor: float, verdict: str) -> None:
    curve = np.column_stack([[0.1, 0.2], [30.0, 40.0]])
    run = outcome(lambda push: factor * np.interp(push, [0.25, 0.35], [30.0, 40.0]))
    assert passive_claims.authors_force("Bend", run, curve, 0.15).agrees == verdict
    ours, theirs = factor * curve[:, 1], curve[:, 1]
    assert passive_claims.authors_field(theirs, ours).agrees == verdict


def test_shapes_of_the_authors() -> None:
    assert passive_claims.authors_shapes([0.001, 0.003]).agrees == "yes"
    assert passive_claims.authors_shapes([0.001, 0.007]).agrees == "partly"
    assert passive_claims.authors_shapes([0.001, 0.02]).agrees == "no"


def test_nothing_of_the_experiments_is_checked() -> None:
    assert passive_claims.experiment("Fig.", "They agree.").agrees == "not checked"
    assert passive_claims.danger("tube", outcome(20.0)).agrees == "not checked"


def test_elimination() -> None:
    free, touching = outcome(0.0), outcome(bump(0.4, 0.1, 2.0))
    half = stopped(free, 0.3)

    def verdict(stable: object, newton: object, paper: object) -> str:
        runs = {"stable": stable, "newton": newton, "paper": paper}
        return active_claims.eliminated("Fig.", "tube", runs).agrees  # type: ignore[arg-type]

    assert verdict(touching, touching, free) == "yes"
    assert verdict(free, touching, half) == "partly"
    assert verdict(half, touching, half) == "no"
    claim = active_claims.eliminated("Fig.", "tube", {"stable": half, "paper": touching})
    assert claim.finds == (
        "Least field: F* = 0, stops at X = 0.300; the paper's optimiser: F* up to 2.0."
    )


@pytest.mark.parametrize(("offset", "verdict"), [(2e-5, "yes"), (3e-4, "partly"), (1e-3, "no")])
def test_on_the_centreline(offset: float, verdict: str) -> None:
    run = outcome(0.0, offset=np.full(len(PUSH), offset))
    assert active_claims.on_the_centreline("Fig.", run, 3e-3).agrees == verdict
    assert active_claims.on_the_centreline("Fig.", stopped(run, 0.3), 3e-3).agrees == "no"


def test_nonlinear_field() -> None:
    assert active_claims.nonlinear(outcome(field=lambda push: 100.0 * push)).agrees == "no"
    assert active_claims.nonlinear(outcome(field=lambda push: 300.0 * push**2)).agrees == "partly"
    waves = outcome(field=lambda push: np.sin(10.0 * push))
    assert active_claims.nonlinear(waves).agrees == "yes"
    early = outcome(field=lambda push: 100.0 * push + 1e3 * (push < 0.05))
    assert active_claims.nonlinear(early).agrees == "no"


@pytest.mark.parametrize(("where", "verdict"), [(0.52, "yes"), (0.6, "partly"), (0.3, "no")])
def test_pronounced_change(where: float, verdict: str) -> None:
    run = outcome(field=lambda push: 10.0 * push + 50.0 * np.tanh((push - where) / 0.05))
    claim = active_claims.pronounced_change(run)
    assert claim.agrees == verdict
    assert f"X = {where:.2f}" in claim.finds
    even = outcome(field=lambda push: 10.0 * push)
    assert active_claims.pronounced_change(even).agrees == "no"
    assert active_claims.pronounced_change(stopped(run, 0.05)).agrees == "no"


def test_contact_that_is_not_there_explains_nothing() -> None:
    assert active_claims.contact_interactions(outcome(0.0)).agrees == "partly"
    assert active_claims.contact_interactions(outcome(1.0)).agrees == "yes"


def test_branches() -> None:
    free = outcome(0.0)
    assert active_claims.reaches("left", free, 3e-3).agrees == "yes"
    assert active_claims.reaches("left", outcome(1.0), 3e-3).agrees == "partly"
    elsewhere = replace(free, offset=np.full(len(PUSH), 2e-2))
    assert active_claims.reaches("left", elsewhere, 3e-3).agrees == "no"
    assert active_claims.reaches("left", stopped(free, 0.3), 3e-3).agrees == "no"


def test_large_time_steps() -> None:
    runs = {("bend", 0.1): outcome(20.1), ("bend", 0.01): outcome(20.0)}
    assert speed_claims.large_steps(runs).agrees == "yes"
    runs["bend", 0.1] = outcome(25.0)
    assert speed_claims.large_steps(runs).agrees == "partly"
    runs["bend", 0.1] = stopped(outcome(20.0), 0.3)
    assert speed_claims.large_steps(runs).agrees == "no"


@pytest.mark.parametrize(("pace", "verdict"), [(0.5, "yes"), (1.5, "no")])
def test_real_time(pace: float, verdict: str) -> None:
    runs = {("bend", 0.01): outcome(pace=0.1), ("bend", 0.003): outcome(pace=pace)}
    runs["bend", 0.001] = outcome(pace=7.0)  # below the bound, where it does not matter
    assert speed_claims.real_time(runs).agrees == verdict
    steps = {("bend", 0.005): outcome(pace=pace), ("bend", 0.001): outcome(pace=7.0)}
    assert speed_claims.controlled_in_real_time(steps).agrees == verdict


def test_contact_at_rare_updates() -> None:
    runs = {("bend", step): outcome(0.0) for step in (0.1, 0.02)}
    runs |= {("wave", step): outcome(0.0) for step in (0.1, 0.02)}
    assert speed_claims.contact_free_up_to(runs).agrees == "yes"
    runs["wave", 0.1] = outcome(3.0)
    claim = speed_claims.contact_free_up_to(runs)
    assert claim.agrees == "partly"
    assert "Free in all cases at: 0.02." in claim.finds
    runs["bend", 0.1] = stopped(outcome(0.0), 0.2)
    assert speed_claims.contact_free_up_to(runs).agrees == "no"

"""Plans that are made with the wall's friction in the model."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.contact import Friction
from magwire.engine.feed import Feed
from magwire.errors import InputError
from magwire.navigate.model import Model
from magwire.navigate.stable import StableNavigator
from magwire.navigate.tip import TipNavigator
from magwire.simulation import Simulation
from wires import L, lumen, paper_wire

SIM = Simulation(paper_wire(40), lumen("half-circle"), friction=Friction(0.3))


def rubbing() -> Model:
    """A model that has been fed onto the wall."""
    model = Model(SIM.system, SIM.system.path, friction="model")
    assert model.feed_to(0.45 * L)
    return model


def test_fields_that_are_tried_leave_no_trace() -> None:
    """Of several fields at a feed only the last one is what the wire went through."""
    model, flux = rubbing(), np.array([0.0, 2e-3, 0.0])
    start = model.remember()
    assert model.settle(flux)
    once = model.remember()
    model.return_to(start)
    for part in (0.5, -1.0, 2.0, 1.0):
        assert model.settle(part * flux)
    again = model.remember()
    np.testing.assert_array_equal(again.state.q, once.state.q)
    np.testing.assert_array_equal(again.state.contact, once.state.contact)
    assert np.abs(once.state.contact).max() > 0.0


def test_equilibria_are_with_friction_and_views_without() -> None:
    """The tip is where friction lets it be, and a view has the stability of a smooth wall there."""
    models = [rubbing(), Model(SIM.system, SIM.system.path)]
    assert models[1].feed_to(0.45 * L)
    apart = np.linalg.norm(models[0].tip()[1] - models[1].tip()[1])
    assert apart > 5e-7
    views = [model.look() for model in models]
    assert views[0] is not None
    assert views[1] is not None
    assert views[0].eigenvalue == pytest.approx(views[1].eigenvalue, rel=0.2)


def test_a_run_is_steered_by_a_plan_with_friction() -> None:
    navigator = TipNavigator(friction="model")
    run = SIM.run(Feed(0.02, 0.5 * L), navigator, record_every=1e-3)
    assert run.status == "complete"
    assert run.tip_contact_free
    assert run.peak_field < 20e-3


def test_a_model_has_none_unless_it_is_asked_for() -> None:
    assert not StableNavigator(SIM.system).model._plant.system.rubs
    assert StableNavigator(SIM.system, friction="model").model._plant.system.rubs
    with pytest.raises(InputError, match="friction"):
        TipNavigator(friction="some")  # type: ignore[arg-type]

"""Balanced truncation of normalised coprime factors."""

import control
import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.gripper.loop_shaping import coprime_margin, glover_mcfarlane
from softgrip.gripper.order_reduction import reduce_order

W = 1j * np.geomspace(1e-3, 1e3, 400)


def test_states_that_do_nothing_are_left_out_without_a_trace():
    """A pole and a zero 1e-6 apart: the system of one order less is the same to 1e-5."""
    whole = control.tf(np.poly([-1, -3 - 3e-6]), np.poly([-2, -3, 1]))
    found = reduce_order(control.ss(whole), 2)
    assert found.nstates == 2
    assert found(W) == pytest.approx(whole(W), rel=1e-5)


def test_an_unstable_system_keeps_its_unstable_pole():
    whole = control.ss(control.tf([1.0, 5], np.poly([1, -4, -200])))
    found = reduce_order(whole, 1)
    assert found.poles().real.item() == pytest.approx(1, rel=0.2)


def test_a_controller_without_its_least_states_still_holds_its_plant():
    plant = control.ss(control.tf([120.0], np.poly([-1, -2, -3, -4, -5])))
    design = glover_mcfarlane(plant)
    margins = [coprime_margin(plant, reduce_order(design.controller, k)) for k in (1, 3, 5)]
    assert margins == sorted(margins)
    assert margins[1] > 0.9 * margins[2]


@pytest.mark.parametrize("order", [0, 3])
def test_orders_that_it_does_not_have_are_refused(order):
    with pytest.raises(InvalidInputError, match="1 to 2"):
        reduce_order(control.ss(control.tf([1.0], [1, 3, 2])), order)

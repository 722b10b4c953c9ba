"""The controllers of many grippers are those of one."""

import numpy as np
import pytest

from book.twin.gripper_tests import internal_model_law
from softgrip.gripper.internal_model import controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED, FingerDynamics, Gripper
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.shaping_filter import filter_state_space
from softgrip.simulator.sampled_law import AXES

OTHER = Gripper((FingerDynamics(7.0, 40.0, 2.0), FingerDynamics(0.5, 1.5, 3.0)))


@pytest.mark.parametrize("target_loop", list(FILTERS))
def test_internal_models_are_those_of_single_grippers(target_loop):
    grippers = (PRINTED, OTHER)
    elements = np.array(
        [
            [[getattr(f, name) for f in one.fingers] for one in grippers]
            for name in ("damping", "stiffness", "gain")
        ]
    )
    found = internal_model_law(elements, target_loop, np.ones((2, 2))).matrices
    low_pass = filter_state_space(*FILTERS[target_loop])
    for k, one in enumerate(grippers):
        known = controller_matrices(one, mean_inverse(one), low_pass)
        for name in set(AXES) & set(vars(known)):
            values = getattr(known, name)
            own = np.broadcast_to(getattr(found, name)[k], values.shape)
            # The plant's exponential and the filter's powers are summed in another order.
            assert own == pytest.approx(values, rel=1e-9, abs=1e-9 * np.abs(values).max()), name

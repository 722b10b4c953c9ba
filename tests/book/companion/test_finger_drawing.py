"""The drawn finger: its outline is the section, bent to an arc."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from book.companion.finger_drawing import bent_outline
from softgrip.actuator.section import Section

SECTION = Section(0.02, 0.004, 0.03, 0.0015)


@given(st.floats(-6, 6))
def test_neutral_surface_keeps_its_length_and_turns_by_the_angle(angle):
    outline = bent_outline(SECTION, 0.094, angle, points=2000)
    top, bottom = outline[:2000], outline[2000:][::-1]
    neutral = bottom + (top - bottom) * 4 / 24
    length = np.linalg.norm(np.diff(neutral, axis=0), axis=1).sum()
    assert length == pytest.approx(0.094, rel=1e-5)
    across = (top - bottom)[-1] / 0.024
    assert across == pytest.approx([np.sin(angle), np.cos(angle)], abs=1e-9)


def test_a_full_turn_closes():
    outline = bent_outline(SECTION, 0.2, 2 * np.pi)
    assert outline[0] == pytest.approx(outline[59], abs=1e-12)

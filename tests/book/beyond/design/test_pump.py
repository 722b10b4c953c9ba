"""The pump of a point: what it asks for by hand, and that the named parts really do it."""

import pytest

from book.beyond.design.pump import DEAD, RISE, asked_of_pump, pump_for, pump_words
from book.beyond.design.tables import chosen_points
from softgrip.actuator.front import KEPT
from softgrip.pump.gas import ATMOSPHERE
from softgrip.units import REV

FEASIBLE = [row for row in KEPT.read() if row.answer.feasible]


def test_air_grows_with_the_length():
    """By hand: 1 + P A_c / (A_w E) of the printed rubber's point."""
    point = next(p for p in chosen_points() if p.question.material == "Dragon Skin 20")
    a, b, w, t = (1e3 * getattr(point.answer, x) for x in ("top", "bottom", "width", "wall"))
    ratio = (a - t) * (w - 2 * t) / (w * (b + t) + 2 * t * (a - t))
    wanted = asked_of_pump(point)
    assert wanted.volume_at_pressure / wanted.volume_at_rest == pytest.approx(
        1 + point.question.pressure * ratio / 0.34e6, rel=1e-6
    )
    assert asked_of_pump(point, 3).volume_at_rest == pytest.approx(3 * point.answer.air)


@pytest.mark.parametrize("point", FEASIBLE[::12], ids=lambda p: p.question.material)
def test_what_is_said_of_a_pump_is_so(point):
    """The gas law at the end of the stroke, and the motor's speed, by hand."""
    found, wanted = pump_for(point), asked_of_pump(point)
    swept = found.stroke * found.syringe.area
    before = ATMOSPHERE * (found.syringe.volume + wanted.volume_at_rest + DEAD)
    after = found.syringe.volume - swept + wanted.volume_at_pressure + DEAD
    assert before / after == pytest.approx(ATMOSPHERE + point.question.pressure, rel=1e-9)
    speed = found.stroke / found.screw.lead / RISE
    assert speed == pytest.approx(found.motor_speed / REV, rel=1e-9)
    can = speed <= 5 + 1e-9 and swept <= found.syringe.volume and found.margin >= 1.5
    assert found.feasible == can
    assert pump_words(found).startswith("none") == (not can)

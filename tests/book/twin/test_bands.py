"""Bands are the middle of what the ensemble does, in the units of the figures."""

import numpy as np
import pytest

from book.companion.band import band
from book.twin import bands
from book.twin.fitted import best_rig, ensemble
from book.twin.laboratory import Laboratory
from book.twin.space import space
from softgrip.errors import UnknownNameError
from softgrip.logs.reader import kept_log, read_log

NAMES = [*space()]


def test_the_band_of_the_torque_is_that_of_a_straight_line():
    # Held straight, the torque is proportional to the pressure.
    slopes = ensemble()[:, NAMES.index("finger.torque_per_pressure")] * 1e6
    x, low, high = band("torque")
    assert low == pytest.approx(np.percentile(slopes, 5) * x, rel=1e-3, abs=1e-9)
    assert high == pytest.approx(np.percentile(slopes, 95) * x, rel=1e-3, abs=1e-9)


def test_steps_end_about_the_angle_that_all_rigs_are_pushed_to():
    for name in ("step-60", "step-90", "step-fx-60", "step-fx-90"):
        _, low, high = band(name)
        wanted = float(name.rpartition("-")[2])
        assert low[0] == pytest.approx(0, abs=1)
        # Two corrections of the travel leave a tenth of a degree, the spread from run to run some.
        assert low[-1] - 2 < wanted < high[-1] + 2


def test_rigs_of_a_band_do_one_experiment_and_differ_otherwise():
    lab = bands.laboratory()
    best = dict(zip(NAMES, best_rig().tolist(), strict=True))
    for name in NAMES:
        if name.startswith("choice."):
            assert (lab[name] == best[name]).all()
    assert np.ptp(lab["rubber.power"]) > 0


def test_curves_of_the_best_rig_alone_are_those_of_the_chapters():
    columns = {name: np.array([value]) for name, value in zip(NAMES, best_rig(), strict=True)}
    found = {name: (x, y[0]) for name, x, y in bands.curves(Laboratory(columns))}
    log = read_log(kept_log("pid-full"))
    time, angle = found["pid-full"]
    assert time == pytest.approx(log["time"])
    # Kept gains have six digits, and the angle comes in counts of 0.12 deg: some are two off.
    assert angle == pytest.approx(np.degrees(log["angle"]), abs=0.4)


def test_a_band_that_is_not_kept_is_refused():
    with pytest.raises(UnknownNameError, match="torque"):
        band("no such curve")

"""The files that the book simulates with are the best rig, in the form of a reader's own."""

import numpy as np
import pytest

from book.companion.choices import UNITS, choice
from book.twin import kept_rigs, rigs
from book.twin.fitted import best_rig, ensemble
from book.twin.pad_tests import layer_of, pad_of
from book.twin.space import space
from softgrip.errors import UnknownNameError
from softgrip.provenance import data_file, data_folder
from softgrip.simulator import fitted_rigs
from softgrip.simulator.free_parameters import parameter_values
from softgrip.simulator.parameters import Spread
from softgrip.simulator.rig_file import read_rig

ROW = dict(zip(space(), best_rig().tolist(), strict=True))
MADE = {
    fitted_rigs.DESIGN_1: (rigs.design_1, fitted_rigs.design_1),
    fitted_rigs.DESIGN_2: (rigs.design_2, fitted_rigs.design_2),
    fitted_rigs.DESIGN_3: (rigs.design_3, fitted_rigs.design_3),
    fitted_rigs.GRIPPER: (rigs.gripper, fitted_rigs.printed_gripper),
}


@pytest.mark.parametrize("file", MADE)
def test_a_rig_of_the_package_is_the_best_one_to_the_last_digit(file):
    made, own = MADE[file]
    assert parameter_values(own()) == parameter_values(made(ROW))
    assert own(spread=False).spread == Spread()


@pytest.mark.parametrize("file", MADE)
def test_an_interval_is_the_middle_of_the_ensemble_or_reaches_to_the_best_rig(file):
    make, _ = MADE[file]
    several = [
        parameter_values(make(dict(zip(space(), row, strict=True)))) for row in ensemble().tolist()
    ]
    for line in read_rig(data_file(file).path).lines:
        own = np.array([one[line.name] for one in several])
        if line.status == "given":
            assert np.ptp(own) == 0
            continue
        low, high = np.percentile(own, [5, 95])
        assert line.low == pytest.approx(min(low, line.value), rel=1e-5)
        assert line.high == pytest.approx(max(high, line.value), rel=1e-5)


def test_what_the_prints_tell_is_narrow_and_what_they_do_not_is_wide():
    lines = {one.name: one for one in read_rig(data_file(fitted_rigs.DESIGN_1).path).lines}
    assert lines["finger.fractional_power"].status == "told"
    assert lines["pump.area"].status == "given"
    prior = np.linspace(0.0, 1.0, 1001)
    assert kept_rigs._status(0.4 * prior, prior) == "told"
    assert kept_rigs._status(0.6 * prior, prior) == "not told"


def test_pad_and_layer_of_the_package_are_the_best_ones():
    assert fitted_rigs.fitted_pad() == pad_of(ROW)
    assert fitted_rigs.fitted_layer() == layer_of(ROW)


def test_choices_are_those_of_the_best_rig_in_si():
    for name, one in space().items():
        if name.startswith("choice."):
            own = choice(name.removeprefix("choice."))
            assert own == pytest.approx(ROW[name] * UNITS[one.unit or "1"], rel=1e-12)
    with pytest.raises(UnknownNameError, match="lqr_step"):
        choice("no such choice")


def test_written_files_are_the_kept_ones(tmp_path, monkeypatch):
    kept = {path.name: path.read_text() for path in (data_folder() / "calibration").glob("*.csv")}
    monkeypatch.setattr(kept_rigs, "data_folder", lambda: tmp_path)
    for path in kept_rigs.write():
        assert path.read_text() == kept[path.name]

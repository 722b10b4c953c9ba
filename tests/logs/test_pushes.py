"""The three pressure models against logs: who errs how far, and on which side."""

import numpy as np
import pytest

from book.companion.claims import printed
from softgrip.errors import DataFileError
from softgrip.logs.pump import check_start, pump_of
from softgrip.logs.pushes import compare, measure_noise, reference_noise
from softgrip.logs.reader import read_log
from softgrip.provenance import data_folder
from softgrip.pump.flow import parameter_set
from tests.logs.example_logs import push_log

PUSHES = {"push-a": "default", "push-b": "larger area", "push-c": "smaller lead",
          "push-d": "higher speed"}  # fmt: skip


@pytest.fixture(scope="module", params=PUSHES)
def found(request):
    return compare(data_folder() / "simulated" / f"{request.param}.csv")


def test_kept_noise_levels_are_what_the_record_gives():
    kept, measured = reference_noise(), measure_noise().levels
    # Four digits are kept. The pressure step is not told from zero: only its smallness is.
    assert measured.elastance_step == pytest.approx(kept.elastance_step, rel=0.02)
    assert measured.sensor == pytest.approx(kept.sensor, rel=0.005)
    assert max(measured.pressure_step, kept.pressure_step) < 0.01 * kept.sensor


def test_constant_capacity_stays_below_a_closed_syringe(found):
    """The sign follows from the gas law , the text has the other one."""
    assert found.error(found.constant) < -0.3
    assert np.all(found.constant[found.measured > 0.1e6] < found.measured[found.measured > 0.1e6])


def test_fitted_growth_is_negative_and_the_modified_model_close(found):
    assert found.growth < 0
    # As near as the text has it.
    assert abs(found.error(found.modified)) <= abs(printed("4.3-modified-error")) / 100


def test_filter_is_between_the_two(found):
    errors = [abs(found.error(one)) for one in (found.modified, found.filtered, found.constant)]
    assert errors[0] < errors[1] < errors[2] / 2


@pytest.mark.parametrize("name", PUSHES)
def test_modified_model_of_the_example_rig_is_close(name):
    found = compare(push_log(name))
    assert abs(found.error(found.modified)) < 0.05


@pytest.mark.parametrize(("name", "parameters"), PUSHES.items())
def test_log_names_the_pump_of_table_4_1(name, parameters):
    path = data_folder() / "simulated" / f"{name}.csv"
    assert pump_of(path, read_log(path)) == parameter_set(parameters).pump


def test_log_without_a_push_is_refused():
    words = r"a push from below 0\.03 to above 0\.1 MPa, got .* to 0\.0\d\d MPa"
    with pytest.raises(DataFileError, match=words):
        compare(data_folder() / "simulated" / "step-60-1.csv")


def test_a_push_of_few_volumes_is_refused(tmp_path):
    for swept in ([0.0] * 9 + [1e-6], [0.0, 1e-6] * 5, [*np.linspace(0, 1e-20, 9), 1.0]):
        with pytest.raises(DataFileError, match="volumes"):
            check_start(tmp_path, np.array(swept), np.zeros(10))

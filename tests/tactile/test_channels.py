"""Columns that are no channels and rows that are not independent are found; channels are not."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import DataFileError, DependentRowsWarning
from softgrip.tactile.channels import near_equal, no_channel, no_channels, order_of_alike
from softgrip.tactile.own_pad import read_readings
from softgrip.units import GRAM_FORCE

RNG = np.random.default_rng(0)
PRESSES, SAMPLES = 12, 10


@given(
    start=st.floats(-1e3, 1e3),
    step=st.floats(1e-3, 1e3),
    lost=st.sets(st.integers(1, 38), max_size=8),
    name=st.sampled_from(["x", "e0", "column 1"]),
)
def test_clock_is_no_channel_whatever_its_name_period_and_lost_rows(start, step, lost, name):
    kept = np.delete(np.arange(40.0), list(lost))
    assert no_channel(name, start + step * kept, False)


@given(seed=st.integers(0, 10_000), rows=st.integers(2, 200), counts=st.sampled_from([0, 1023]))
def test_noise_is_a_channel(seed, rows, counts):
    volts = 5 * np.random.default_rng(seed).random(rows)
    if counts:
        volts = np.round(volts / 5 * counts) * 5 / counts
    if np.ptp(volts):
        assert no_channel("e1", volts, False) is None


@pytest.mark.parametrize(
    "name", ["time", "Time [s]", "t (ms)", " timestamp", "", "Index", "press", "No"]
)
def test_name_of_a_clock_or_a_counter_is_enough(name):
    assert "name" in no_channel(name, RNG.random(20), False)


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        (np.full(9, 1.5), "1.5 throughout"),
        (np.repeat(np.arange(5.0), 4), "never falls"),
        (np.sort(RNG.random(30)), "never falls"),
        (-np.sort(RNG.random(30)), "never rises"),
        (np.tile(np.arange(10.0), 4), "rises by 1 from row to row"),
    ],
    ids=["constant", "press number", "drift", "falling", "time that is reset"],
)
def test_what_rises_or_rests_is_no_channel(values, reason):
    assert reason in no_channel("x", values, False)


def test_channel_may_rise_with_known_weights_in_their_order():
    weights = np.sort(RNG.random(20))
    volts = 5 * weights / (1 + weights)
    clock = np.arange(20.0)
    assert set(no_channels({"layer": volts, "x": clock}, weights)) == {"x"}
    assert set(no_channels({"layer": volts}, np.where(weights > 0.5, "much", "little"))) == {
        "layer"
    }


def table(path, *, lead="", press=False, noise=0.05, repeat=1):
    """Write presses of three kinds, some samples each, with a column ahead."""
    rng, kinds = np.random.default_rng(1), ["point", "line", "surface"]
    lines = [",".join(filter(None, [lead, "press" if press else "", "e1", "e2", "kind"]))]
    for k in range(PRESSES * SAMPLES):
        p, s = divmod(k, SAMPLES)
        if s == 0:
            centre = rng.random(2)
        volts = centre + noise * rng.normal(size=2)
        cells = [f"{v:.4f}" for v in volts]
        row = [*([f"{0.025 * k:.3f}"] if lead else []), *([f"p{p}"] if press else []), *cells]
        lines += [",".join([*row, kinds[p % 3]])] * repeat
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize("lead", ["time", "clock_1", "x"])
def test_time_column_of_a_file_is_refused_unless_it_is_named(path, lead):
    file = table(path, lead=lead)
    with pytest.raises(DataFileError, match=rf"line 1: .*{lead} is one.*channels=\('e1', 'e2'\)"):
        read_readings(file, label="kind")
    with pytest.warns(DependentRowsWarning):
        assert read_readings(file, label="kind", channels=["e1", "e2"]).channels == ("e1", "e2")
    with pytest.warns(DependentRowsWarning):
        every = read_readings(file, label="kind", channels=[lead, "e1", "e2"])
    assert every.voltages.shape == (PRESSES * SAMPLES, 3)


@pytest.mark.parametrize(("noise", "repeat"), [(0.0, 1), (0.02, 1), (0.2, 2)])
def test_samples_of_one_press_are_warned_of_unless_the_press_is_named(path, noise, repeat):
    file = table(path, press=True, noise=noise, repeat=repeat)
    with pytest.warns(DependentRowsWarning, match="group="):
        read_readings(file, label="kind", channels=("e1", "e2"))
    found = read_readings(file, label="kind", group="press")
    assert found.channels == ("e1", "e2")
    assert np.unique(found.groups).size == PRESSES


@pytest.mark.parametrize("channels", [1, 2, 5])
@pytest.mark.parametrize("seed", range(4))
def test_independent_rows_are_not_warned_of(path, channels, seed):
    names = [f"e{k}" for k in range(channels)]
    volts = np.random.default_rng(seed).random((200, channels))
    rows = [",".join([*map(str, row), "pl"[k % 2]]) for k, row in enumerate(volts.round(4))]
    path.write_text("\n".join([",".join([*names, "kind"]), *rows]))
    assert read_readings(path, label="kind").groups is None  # warnings are errors


def test_known_weights_in_their_order_are_read(path):
    path.write_text("v,weight\n0.2,0\n0.9,5\n1.6,20\n2.3,50\n2.6,70\n2.7,80\n2.8,90\n2.9,99\n")
    assert read_readings(path, label="weight", unit=GRAM_FORCE).voltages.size == 8


def test_near_equal_is_a_thousandth_of_the_range_in_every_channel():
    volts = np.array([[0.0, 0.0], [1.0, 1.0], [1.0005, 1.0005], [1.0, 0.5], [0.9995, 1.0]])
    assert near_equal(volts, ["a", "b", "b", "b", "a"]) == 2
    assert near_equal(volts, ["a"] * 5) == 3


def test_rows_in_any_order_are_alike_by_chance_and_a_walk_is_not():
    volts = RNG.random((300, 4))
    # A distance deviates by 0.7 of its mean: the mean of 300 by 4 %.
    assert order_of_alike(volts, ["a"] * 300) == pytest.approx(1.0, abs=0.15)
    walk = np.cumsum(RNG.normal(size=(300, 4)), axis=0)
    assert order_of_alike(walk, ["a"] * 300) < 0.3
    assert order_of_alike(walk[:9], ["a"] * 9) == 1.0

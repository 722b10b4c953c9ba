"""A reader's own pad of any number of channels: fitted, refused, kept and read back."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.exceptions import NotFittedError

from softgrip.errors import DataFileError, InvalidInputError
from softgrip.tactile.contact_kind import bagged_neighbours, nearest_neighbours
from softgrip.tactile.own_pad import PadReadings
from softgrip.tactile.pad_model import TOP_COUNT, ForceSettings, KindSettings, PadModel, load, save


def kinds_of(channels=8, count=60, seed=0):
    rng = np.random.default_rng(seed)
    voltages = 4 * rng.random((count, channels))
    labels = np.array(["flat", "edge", "tip"])[np.arange(count) % 3]
    return PadReadings(tuple(f"e{k}" for k in range(channels)), voltages, labels)


def forces_of(channels=1, count=40):
    voltages = 4 * np.random.default_rng(1).random((count, channels))
    return PadReadings(
        tuple(f"v{k}" for k in range(channels)), voltages, voltages.sum(axis=1) ** 2 / 20
    )


@settings(max_examples=10)
@given(st.integers(1, 12), st.integers(0, 99))
def test_it_says_what_the_classifier_of_the_text_says(channels, seed):
    mine, new = kinds_of(channels), kinds_of(channels, 20, seed + 1).voltages
    found = PadModel(KindSettings(seed=seed)).fit(mine).predict(new)
    same = bagged_neighbours(features=max(1, channels - 1), seed=seed)
    assert found.tolist() == same.fit(mine.voltages, mine.labels).predict(new).tolist()


def test_single_classifier_is_had_by_no_estimators():
    mine, new = kinds_of(), kinds_of(seed=7).voltages
    found = PadModel(KindSettings(estimators=0)).fit(mine).predict(new)
    assert (
        found.tolist() == nearest_neighbours().fit(mine.voltages, mine.labels).predict(new).tolist()
    )


def test_force_is_read_near_the_readings():
    mine = forces_of()
    found = PadModel(ForceSettings()).fit(mine).predict(mine.voltages)
    # The curve is smooth and has 40 readings on it: a tenth of its range is coarse.
    assert np.abs(found - mine.labels).max() < 0.1 * np.ptp(mine.labels)


def test_model_that_is_not_fitted_says_so(tmp_path):
    with pytest.raises(NotFittedError, match="call fit"):
        PadModel(KindSettings()).predict([[0.1] * 8])
    with pytest.raises(NotFittedError):
        save(PadModel(KindSettings()), tmp_path / "mine.json")


@pytest.mark.parametrize(
    ("reading", "message"),
    [
        ([[0.1] * 7], r"shape \(N, 8\), channels e0, e1"),
        ([0.1] * 8, r"shape \(N, 8\)"),
        ([[0.1] * 8, [0.1] * 3 + [np.nan] * 5], "reading 1, channel e3: expected a finite number"),
        ([[0.1] * 7 + [TOP_COUNT]], "reading 0, channel e7: .* or it is saturated, got 4.99"),
    ],
)
def test_bad_reading_is_refused_by_name(reading, message):
    with pytest.raises(InvalidInputError, match=message):
        PadModel(KindSettings()).fit(kinds_of()).predict(reading)


def test_saturated_training_is_refused_unless_the_converter_reaches_further():
    mine = kinds_of()
    high = PadReadings(mine.channels, mine.voltages + 3, mine.labels)
    with pytest.raises(InvalidInputError, match="saturated"):
        PadModel(KindSettings()).fit(high)
    assert PadModel(KindSettings(), saturation=10.0).fit(high).readings is high


@pytest.mark.parametrize(
    ("config", "readings", "message"),
    [
        (KindSettings(), PadReadings(("e",), [[1.0]] * 9, ["tip"] * 9), "at least two kinds"),
        (KindSettings(), forces_of(), "at least two kinds"),
        (ForceSettings(), kinds_of(), "at least two forces"),
        (ForceSettings(), PadReadings(("v",), [[1.0], [2.0]], [0.5, 0.5]), "at least two forces"),
        (KindSettings(), kinds_of(count=11), "enough to draw 10"),
        (KindSettings(estimators=0), kinds_of(count=2), "enough to draw 3"),
    ],
)
def test_what_cannot_be_fitted_is_refused(config, readings, message):
    with pytest.raises(InvalidInputError, match=message):
        PadModel(config).fit(readings)


@pytest.mark.parametrize(
    ("config", "readings"),
    [
        (KindSettings(seed=3), kinds_of()),
        (KindSettings(estimators=0, neighbours=5), kinds_of(3)),
        (ForceSettings(), forces_of()),
        (ForceSettings(bandwidth=0.05), forces_of(2)),
    ],
)
def test_loaded_model_is_the_saved_one(config, readings, tmp_path):
    model = PadModel(config, saturation=4.5).fit(readings)
    save(model, tmp_path / "mine.json")
    loaded = load(tmp_path / "mine.json")
    new = 4 * np.random.default_rng(9).random((50, len(readings.channels)))
    assert loaded.predict(new).tolist() == model.predict(new).tolist()
    assert (loaded.settings, loaded.saturation) == (config, 4.5)


def test_file_holds_no_code(tmp_path):
    save(PadModel(KindSettings()).fit(kinds_of()), tmp_path / "mine.json")
    record = json.loads((tmp_path / "mine.json").read_text())
    assert (record["format"], record["version"]) == ("softgrip pad model", 1)
    assert np.shape(record["voltages"]) == (60, 8)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"version": 2}, "version 1"),
        ({"format": "another"}, "softgrip pad model"),
        ({"task": "colour"}, "can be fitted"),
        ({"settings": {"depth": 3}}, "can be fitted"),
        ({"labels": ["tip"] * 60}, "at least two kinds"),
        ({"voltages": [[1.0] * 7] * 60}, "can be fitted"),
        ({"answers": ["tip"] * 32}, "answers it was saved with"),
        ({"settings": {"neighbours": 1}}, "answers it was saved with"),
    ],
)
def test_changed_file_is_found_out(change, message, tmp_path):
    path = tmp_path / "mine.json"
    save(PadModel(KindSettings()).fit(kinds_of()), path)
    path.write_text(json.dumps(json.loads(path.read_text()) | change))
    with pytest.raises(DataFileError, match=message):
        load(path)


@pytest.mark.parametrize("answer", [{}, 10**400, "0.5", None])
def test_an_answer_that_is_no_force_is_found_out(answer, tmp_path):
    path, volts = tmp_path / "mine.json", np.linspace(0.1, 3, 40)[:, None]
    save(PadModel(ForceSettings()).fit(PadReadings(("layer",), volts, volts[:, 0] / 3)), path)
    record = json.loads(path.read_text())
    record["answers"][3] = answer
    path.write_text(json.dumps(record))
    with pytest.raises(DataFileError, match=r"saved with|can be fitted"):
        load(path)


@pytest.mark.parametrize("text", ["", "[]", "{}", "e1,e2\n"])
def test_file_that_is_no_model_is_refused(text, tmp_path):
    path = tmp_path / "mine.json"
    path.write_text(text)
    with pytest.raises(DataFileError, match="softgrip pad model"):
        load(path)
    with pytest.raises(DataFileError, match="expected a file"):
        load(tmp_path / "none.json")


def test_whole_forces_are_fitted():
    mine = PadReadings(("layer",), [[0.2], [0.9], [1.6], [2.3]], [0, 1, 2, 5])
    assert PadModel(ForceSettings(bandwidth=0.01)).fit(mine).predict([[0.9]]) == pytest.approx([1])
    assert 0 <= PadModel(ForceSettings()).fit(mine).predict([[1.0]])[0] <= 5


def test_whole_presses_are_left_out_to_choose_the_bandwidth(tmp_path):
    rng = np.random.default_rng(0)
    forces = np.repeat(np.linspace(0, 5, 12), 6)
    volts = (np.repeat(np.linspace(0.1, 4, 12) + 0.1 * rng.normal(size=12), 6))[:, None]
    volts = volts + 1e-3 * rng.normal(size=volts.shape)
    groups = np.repeat(np.arange(12), 6)
    alone = PadModel(ForceSettings()).fit(PadReadings(("v",), volts, forces))
    mine = PadModel(ForceSettings()).fit(PadReadings(("v",), volts, forces, groups))
    width = [model.estimator[-1].bandwidth_ for model in (alone, mine)]
    # Samples of one press tell each other's force: a bandwidth that is next to none seems best.
    assert width[1] > 3 * width[0]
    save(mine, tmp_path / "mine.json")
    loaded = load(tmp_path / "mine.json")
    assert loaded.readings.groups.tolist() == mine.readings.groups.tolist()
    assert loaded.estimator[-1].bandwidth_ == width[1]


def test_file_without_groups_is_read(tmp_path):
    path = tmp_path / "mine.json"
    save(PadModel(ForceSettings()).fit(forces_of()), path)
    record = json.loads(path.read_text())
    del record["groups"]
    path.write_text(json.dumps(record))
    assert load(path).readings.groups is None


def test_forces_of_one_group_are_refused():
    mine = PadReadings(("v",), [[0.1], [0.2]], [1.0, 2.0], ["a", "a"])
    with pytest.raises(InvalidInputError, match="two groups"):
        PadModel(ForceSettings()).fit(mine)

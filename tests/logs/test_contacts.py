"""A log of the pad, written here row by row: what is found in it, and what it must not lack."""

import numpy as np
import pytest

from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.contacts import HELD, STILL, TRUTH, read_contacts, read_weights, weight_of
from softgrip.logs.schema import PAD_CHANNELS, LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.provenance import Provenance
from softgrip.tactile.contact_pose import FELT
from softgrip.units import GRAM_FORCE

PERIOD = 0.025
HEADER = LogHeader(Provenance.LOGGED, "a test", "board", PERIOD, set_up="pad")
VOLT = 1024 / 5
"""Counts."""
EYE = np.eye(8)
CALIBRATION = [("rest", 1.0, 0 * EYE[0], 0.0)]
CALIBRATION += [(f"press: element {k + 1}", 1.0, EYE[k], 1.0) for k in range(8)]


def write(path, stretches, more=(), shake=0.0):
    """Write stretches of words, s, responses (at full range 2 V above 1 V) and the layer's V."""
    chance, time = np.random.default_rng(0), 0
    with LogWriter(path, HEADER, more=dict.fromkeys(more, "m")) as log:
        for words, seconds, responses, layer in stretches:
            for row in range(round(seconds / PERIOD)):
                volts = np.append(1 + 2 * np.asarray(responses), layer)
                counts = np.rint(VOLT * (volts + shake * chance.uniform(-0.5, 0.5, 9)))
                counts = counts.clip(0, 1023)
                log.write(
                    time=time * PERIOD, command=0.0, event=words if row == 0 else "",
                    **{f"{c}_counts": n for c, n in zip(PAD_CHANNELS, counts, strict=True)},
                    **dict(zip(PAD_CHANNELS, counts / VOLT, strict=True)),
                    **dict.fromkeys(more, 0.0),
                )  # fmt: skip
                time += 1
    return path


CARROT = np.array([0.5, 0.8, 0.2, 0, 0, 0, 0, 0])
PRESSED = [("line: carrot", 0.5, 0 * CARROT, 0.0), ("", 1.0, CARROT, 1.5)]


def test_contact_is_normalised_by_the_logs_own_calibration(path):
    found = read_contacts(write(path, [*CALIBRATION, *PRESSED]))
    assert (found.kinds.tolist(), found.objects.tolist()) == (["line"], ["carrot"])
    # A step of the converter is 5 mV of 2 V; two of them make a response.
    np.testing.assert_allclose(found.responses[0], CARROT, atol=2 * 5 / 1024 / 2)
    assert found.layer == pytest.approx([1.5], abs=5 / 1024)
    assert 9.5 < found.times[0] < 10.5
    for truth in (found.places, found.angles, found.forces):
        assert np.isnan(truth).all()


def test_each_press_that_is_held_is_one_contact(path):
    brief = HELD / 2
    presses = [("contact: pear", 0.5, 0 * CARROT, 0.0)]
    for seconds, part in ((1.0, 0.5), (brief, 1.0), (1.0, 0.25)):
        presses += [("", seconds, part * CARROT, 1.0), ("", 0.5, 0 * CARROT, 0.0)]
    found = read_contacts(write(path, [*CALIBRATION, *presses]))
    assert found.kinds.tolist() == ["", ""]
    np.testing.assert_allclose(found.responses[:, 1], [0.4, 0.2], atol=0.01)


@pytest.mark.parametrize(("left", "contacts"), [(0.4, 2), (0.6, 1)])
def test_press_ends_where_half_of_what_is_felt_is_left(path, left, contacts):
    part = left * FELT / CARROT.max()
    presses = [("contact: pear", 1.0, CARROT, 1.0), ("", 0.5, part * CARROT, 0.0)]
    presses += [("", 1.0, 0.9 * CARROT, 1.0)]
    assert len(read_contacts(write(path, [*CALIBRATION, *presses]))) == contacts


def test_of_one_press_the_hardest_that_is_held_still_counts(path):
    steps = [("point: tip", 1.0, 0.3 * EYE[4], 0.5), ("", 1.0, 0.7 * EYE[4], 0.9)]
    steps += [("", 0.1, 0.9 * EYE[4], 1.2), ("", 1.0, 0.5 * EYE[4], 0.7)]
    found = read_contacts(write(path, [*CALIBRATION, *steps]))
    assert found.responses[:, 4] == pytest.approx([0.7], abs=0.01)
    assert found.layer == pytest.approx([0.9], abs=0.01)


def test_touch_too_light_to_be_felt_is_a_contact(path):
    found = read_contacts(write(path, [*CALIBRATION, ("surface: tofu", 1.0, 0.02 * EYE[0], 0.3)]))
    assert (len(found), found.responses.max() < 0.05) == (1, True)


def test_labels_afterwards_say_what_events_say(path, tmp_path):
    said = read_contacts(write(path, [*CALIBRATION, *PRESSED]))
    unsaid = [("", *row[1:]) for row in (*CALIBRATION, *PRESSED)]
    words = [row[0] for row in CALIBRATION]
    labels = [(k, k + 1.0, what) for k, what in enumerate(words)] + [(9.0, 10.5, "line: carrot")]
    later = read_contacts(write(tmp_path / "later.csv", unsaid), labels)
    np.testing.assert_array_equal(later.responses, said.responses)
    assert later.objects.tolist() == said.objects.tolist()


def test_other_words_neither_end_nor_begin_a_stretch(path):
    with_fault = [
        *PRESSED,
        ("line found again", 0.2, CARROT, 1.5),
        ("2 lost; rest", 1, 0 * CARROT, 0),
    ]
    found = read_contacts(write(path, [*CALIBRATION, *with_fault]))
    np.testing.assert_allclose(found.responses, [CARROT], atol=0.01)


def test_weights_with_none_of_them_at_rest(path):
    weights = [("weight: 20 gf", 1.0, CARROT, 1.6), ("weight: 0.5 N", 1.0, CARROT, 2.5)]
    found = read_weights(write(path, [*CALIBRATION, *weights]))
    assert found.channels == ("layer",)
    np.testing.assert_allclose(found.voltages[:, 0], [0, 1.6, 2.5], atol=5 / 1024)
    np.testing.assert_allclose(found.labels, [0, 20 * GRAM_FORCE, 0.5])


@pytest.mark.parametrize("words", ["weight: 20", "weight: heavy gf", "weight: 20 lb"])
def test_weight_that_is_none_is_refused(words):
    with pytest.raises(InvalidInputError, match="weight: 20 gf"):
        weight_of(words)


@pytest.mark.parametrize(
    ("stretches", "message"),
    [
        (PRESSED, "event 'rest', got none: begin .*calibration_steps"),
        ([*CALIBRATION[:3], *CALIBRATION[4:], *PRESSED], "no .'press: element 3'.*calibration_st"),
        (CALIBRATION, "contacts: events, or labels, such as 'line: small carrot'"),
        ([*CALIBRATION, ("line: carrot", HELD / 2, CARROT, 1.0)], "take longer, and hold still"),
        ([*CALIBRATION, ("line: carrot", 1.0, 2.5 * CARROT, 1.0)], "element_2_counts.* saturated"),
        ([*CALIBRATION, ("line: carrot", 1.0, CARROT, 5.0)], "layer_counts.* saturated"),
        ([*CALIBRATION[:8], ("press: element 8", 1.0, -EYE[7] / 4, 1.0)], "element_8 to rise"),
    ],
)  # fmt: skip
def test_what_is_missing_is_named_and_how_to_record_it(path, stretches, message):
    with pytest.raises(DataFileError, match=message):
        read_contacts(write(path, stretches))


def test_what_trembles_is_not_held_still(path):
    with pytest.raises(DataFileError, match="hold still"):
        read_contacts(write(path, [*CALIBRATION, *PRESSED], shake=3 * STILL))
    again = path.with_name("calmer.csv")
    assert len(read_contacts(write(again, [*CALIBRATION, *PRESSED], shake=STILL / 2))) == 1


def test_log_without_weights_says_how_to_record_them(path):
    with pytest.raises(DataFileError, match="weight_steps"):
        read_weights(write(path, [*CALIBRATION, *PRESSED]))


@pytest.mark.parametrize("label", [(50.0, 60.0, "line: carrot"), (9.0, 10.0, "a carrot")])
def test_label_without_rows_or_sense_is_refused(path, label):
    with pytest.raises(InvalidInputError, match="labels"):
        read_contacts(write(path, [*CALIBRATION, *PRESSED]), [label])


def test_part_of_the_truth_is_refused(path):
    with pytest.raises(DataFileError, match=r"only \['contact_x'\]"):
        read_contacts(write(path, [*CALIBRATION, *PRESSED], more=[*TRUTH][:1]))

"""What is told of contacts is that of the models and the geometry, and of nothing known."""

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.tactile.contact_pose import line_angle, place
from softgrip.tactile.contacts import Contacts
from softgrip.tactile.estimate import NOTHING, estimate, kind_readings
from softgrip.tactile.own_pad import PadReadings
from softgrip.tactile.pad_layout import THREE_TWO_THREE as PAD
from softgrip.tactile.pad_model import ForceSettings, KindSettings, PadModel

SHAPES = {"point": [0.8, 0, 0, 0, 0, 0, 0, 0], "line": [0.5, 0.5, 0.5, 0, 0, 0, 0, 0]}
UNKNOWN = np.full(24, np.nan)


def touched(kinds):
    """Return 24 contacts, a point and a line in turn, of which these kinds are known."""
    chance = np.random.default_rng(0)
    felt = np.tile([*SHAPES.values()], (12, 1)) * chance.uniform(0.8, 1.2, (24, 1))
    return Contacts(
        felt, 2 * felt.sum(axis=1), np.arange(24.0), kinds, ["x"] * 24,
        np.stack([UNKNOWN] * 2, axis=1), UNKNOWN, UNKNOWN,
    )  # fmt: skip


CONTACTS = touched([*SHAPES] * 12)
MODEL = PadModel(KindSettings()).fit(kind_readings(CONTACTS))
FORCE = PadModel(ForceSettings()).fit(PadReadings(("layer",), [[0.0], [2.0], [4.0]], [0, 0.2, 0.4]))


def test_it_is_what_each_model_says():
    told = estimate(CONTACTS, MODEL, FORCE)
    assert told.kinds.tolist() == [*SHAPES] * 12
    np.testing.assert_array_equal(told.places, place(CONTACTS.responses, PAD))
    np.testing.assert_array_equal(told.angles[1::2], line_angle(CONTACTS.responses[1::2], PAD))
    assert np.isnan(told.angles[::2]).all()
    np.testing.assert_array_equal(told.forces, FORCE.predict(CONTACTS.layer[:, None]))


def test_what_is_known_is_not_looked_at():
    other = estimate(touched(["surface"] * 24), MODEL, FORCE)
    assert other.kinds.tolist() == [*SHAPES] * 12


def test_nothing_felt_is_no_kind_and_without_weights_there_is_no_force():
    light = Contacts(*(0.04 * CONTACTS.responses, *[getattr(CONTACTS, name) for name in (
        "layer", "times", "kinds", "objects", "places", "angles", "forces")]))  # fmt: skip
    told = estimate(light, MODEL)
    assert set(told.kinds) == {NOTHING}
    for nothing in (told.places, told.angles, told.forces):
        assert np.isnan(nothing).all()


def test_only_known_kinds_are_learnt_from():
    some = touched([*SHAPES, "", ""] * 6)
    assert len(kind_readings(some).labels) == 12
    with pytest.raises(InvalidInputError, match="known kind"):
        kind_readings(touched([""] * 24))

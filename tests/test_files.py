"""Every reader of a file says so when it is given none."""

from functools import partial

import pytest

from softgrip.board import calibration
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs import check, contacts, reader, staircase, steps
from softgrip.materials import tensile, tester
from softgrip.rig import acceptance
from softgrip.rig.replay import Replay
from softgrip.simulator import rig_file
from softgrip.tactile import own_pad, pad_model


@pytest.mark.parametrize(
    "read",
    [
        reader.read_log, steps.judge_step_log, staircase.judge_staircase, contacts.read_contacts,
        check.contents, tester.read_export, tensile.parse, pad_model.load, rig_file.read_rig,
        calibration.load, Replay, partial(own_pad.read_readings, label="kind"),
        partial(acceptance.judge, experiment="lqr"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("path", [None, 5, b"log.csv", "no such file", "."])
def test_what_is_no_file_is_said(read, path):
    with pytest.raises((InvalidInputError, DataFileError), match="a file"):
        read(path)

"""The pages on a pad of one's own, run cell by cell: from the recording to what touched it."""

from pathlib import Path
from tempfile import TemporaryDirectory

import jupytext
import numpy as np
import pytest

from book.chapter_2.own_pad import contact_table
from softgrip.logs.contacts import read_contacts
from softgrip.provenance import data_file
from softgrip.tactile.estimate import Estimate


def run(page, only="", **names):
    """Run the cells of a page that hold a word, all by default, and return their names."""
    for cell in jupytext.read(page).cells:
        if cell.cell_type == "code" and only in cell.source:
            exec(cell.source, names)  # as a notebook would
    return names


def test_page_of_ones_own_pad_runs_from_the_recording_to_the_estimates(root, capsys):
    found = run(root / "book" / "own-pad.md")
    contacts, presses = found["contacts"], found["pad"].hand.presses
    assert contacts.objects.tolist() == [press.item.name for press in presses]
    new = presses[-len(found["new"]) :]
    told = found["estimate"](found["new"], found["model"], found["force"])
    # Between two of its weights the regressor is a step: of 5 gf at most, 0.05 N.
    assert told.forces == pytest.approx([press.force for press in new], abs=0.025)
    away = np.linalg.norm(told.places - [press.pose.place for press in new], axis=1)
    assert np.median(away) < 5.5e-3  # half the pitch of the elements
    said = capsys.readouterr().out
    assert "no ['press: element 4']" in said
    assert "weight_steps" in said


def test_live_page_records_a_pad_and_reads_its_contacts(root):
    found = run(
        root / "book" / "rig.md", "carrot", Path=Path, TemporaryDirectory=TemporaryDirectory
    )
    assert len(found["contacts"]) == len(found["pad"].hand.presses) == 4
    assert len(found["weights"].labels) == 4  # three, and none
    found["runs"].cleanup()


def test_errors_are_shown_where_the_truth_is_known_only():
    contacts = read_contacts(data_file("simulated/pad-objects.csv").path).take(range(3))
    told = Estimate(contacts.kinds, contacts.places, contacts.angles, contacts.forces)
    table = contact_table(contacts, told)
    assert table["force off (N)"].tolist() == [0, 0, 0]
    unknown = {"places": np.full((3, 2), np.nan), "angles": [np.nan] * 3, "forces": [np.nan] * 3}
    given = {name: getattr(contacts, name) for name in contacts.__dataclass_fields__}
    table = contact_table(type(contacts)(**given | unknown), told)
    assert not [name for name in table if "off" in name]

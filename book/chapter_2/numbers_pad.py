"""Recomputation of the numbers printed in Chapter 2 on the pad and its board."""

import numpy as np

from softgrip.ledger.verdict import simulated
from softgrip.provenance import data_file
from softgrip.rig.contacts_log import read_contacts
from softgrip.rig.pad_accuracy import place_errors
from softgrip.rig.pad_calibration_table import ceiling_force
from softgrip.rig.pad_parameters import PadParameters
from softgrip.tactile.pad_layout import THREE_TWO_THREE


def converter_rate(clock: float = 16e6, divider: float = 128, cycles: float = 13) -> float:
    """Return the rate of a converter that takes some cycles of a divided clock (Hz), kHz."""
    return clock / divider / cycles / 1e3


@simulated
def element_ceiling() -> float:
    """Return the force that brings an element of the simulated pad to its end, N."""
    return ceiling_force(PadParameters())


@simulated
def elements_of_a_line(share: float) -> float:
    """Return how many elements feel a line at most in a share of the simulated eight-food log."""
    contacts = read_contacts(data_file("simulated/pad-objects.csv").path)
    felt = place_errors(contacts, THREE_TWO_THREE).elements[contacts.kinds == "line"]
    # Of whole numbers, the one that is reached, none between two of them.
    return float(np.quantile(felt, share, method="inverted_cdf"))

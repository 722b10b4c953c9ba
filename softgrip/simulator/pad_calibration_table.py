"""What is assumed of the simulated pad, and how it stands to what Chapter 2 prints.

``python -m softgrip.simulator.pad_calibration_table`` writes ``data/calibration/pad.csv``, as
`calibration_table` does for the rig with one finger. Nothing printed is calibrated to.
"""

from scipy.optimize import brentq

from softgrip.kept import Kept
from softgrip.simulator.calibration_entry import Entry, assumed, checked
from softgrip.simulator.calibration_table import NOTES
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.tactile.element import compliance
from softgrip.tactile.element_sensitivity import CEILING, resistance
from softgrip.units import MM

FILE = "calibration/pad.csv"
NOISES = 3.0
"""Change of a voltage that is taken as felt, in deviations of its noise."""


def ceiling_force(pad: PadParameters) -> float:
    """Return the force on an element at which its resistance reaches the printed ceiling, N."""
    soft, height = compliance(pad.element, pad.young_modulus), pad.element.height
    # Just below the ceiling: from there on the law is flat.
    almost = CEILING * (1 - 1e-9)
    return float(brentq(lambda force: resistance(soft * force, height) - almost, 0, 1))


def least_force(pad: PadParameters) -> float:
    """Return the force on an element that moves its voltage by three deviations of the noise, N.

    A step of the converter, where it is larger, counts as the deviation.
    """
    soft, height = compliance(pad.element, pad.young_modulus), pad.element.height
    step = max(pad.noise, pad.supply / pad.levels)
    ohms = NOISES * step * pad.gain_resistor / pad.reference
    rest = resistance(0.0, height)
    return float(brentq(lambda force: resistance(soft * force, height) - rest - ohms, 0, 1))


def entries() -> tuple[Entry, ...]:
    """List what is assumed of the pad, and two printed numbers beside what it gives."""
    pad = PadParameters()
    places, hour = pad.layout.places, 3600.0

    def own(quantity: str, unit: str, name: str, rig: float | None = None) -> Entry:
        return assumed(quantity, unit, name, getattr(pad, name), rig)

    return (
        checked("Section 2.2", "force that brings an element to its end (0.1 to 0.2)", "0.2", "N",
                ceiling_force(pad)),
        checked("Section 2.2", "least force that a pyramid feels", "0.01", "N", least_force(pad)),
        assumed("pitch of the elements in a row", "mm", "layout",
                float(places[1, 0] - places[0, 0])),
        assumed("pitch of the rows", "mm", "layout", float(places[0, 1] - places[3, 1])),
        assumed("width of a pyramid's top", "mm", "element.cut", pad.element.cut,
                pad.element.cut * pad.element.width / MM),
        own("thickness of the cover", "mm", "cover"),
        own("side of the square that presses a pyramid", "mm", "spread", 2 * pad.spread / MM),
        own("reference of the amplifier", "V", "reference"),
        own("resistor of the amplifier", "Ohm", "gain_resistor"),
        own("spread of the resistance at rest", "%", "rest_spread"),
        own("spread of the gain", "%", "gain_spread"),
        own("spread of the stiffness", "%", "stiffness_spread"),
        own("spread of the height", "mm", "height_spread"),
        own("repeatability of the resistance change", "%", "repeatability"),
        own("noise of a voltage", "mV", "noise"),
        own("drift of the resistance at rest in an hour", "%", "drift", 100 * hour * pad.drift),
        own("tilt of what is held", "deg", "tilt"),
        own("force that halves the resistance of the force layer", "N", "layer_force"),
        own("gain of the force layer's amplifier", "", "layer_gain"),
    )  # fmt: skip


KEPT = Kept(FILE, Entry, entries, "python -m softgrip.simulator.pad_calibration_table", NOTES)

if __name__ == "__main__":
    KEPT.main()

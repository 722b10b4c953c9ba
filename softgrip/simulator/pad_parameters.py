"""What the simulated pad is made of. The defaults are those with which the fit began."""

from dataclasses import dataclass, field

from softgrip.checks import check_fields
from softgrip.tactile.element import STATED_MODULUS, Element
from softgrip.tactile.pad_layout import THREE_TWO_THREE, PadLayout
from softgrip.units import MM

ZERO_ALLOWED = (
    "rest_spread", "gain_spread", "stiffness_spread", "height_spread", "repeatability", "noise",
    "drift", "tilt", "cover",
)  # fmt: skip


@dataclass(frozen=True)
class PadParameters:
    """The pad, its cover, its circuits and its imperfections; each stands with its reason.

    No default was chosen by what an estimator makes of the pad; `fitted_rigs.fitted_pad` was.

    Attributes:
        layout: Places of the elements (assumed: rows of 3, 2 and 3; not printed).
        element: A pyramid of the printed size; its top, 0.72 mm wide, is the one that Table 2.1
            asks for.
        young_modulus: Of elements and cover, Pa: that of Section 2.2.
        cover: Thickness of the sheet over the elements, m (assumed: of 8 mm, elements take 3; the
            base and the force layer the most of the rest).
        spread: Half the side of the square of the cover through which a pyramid is pressed, m
            (assumed: half its top, and the thickness of the cover, as if the load spread under 45
            degrees).
        reference, gain_resistor: Of a non-inverting amplifier ``reference (1 + R /
            gain_resistor)``, V and Ohm (assumed: 1 to 1.5 MOhm give 2.5 to 3.5 V, with room for the
            spread).
        supply, levels: Of the converter, V; 10 bits (Section 2.4).
        rest_spread, gain_spread: Deviations from element to element of the resistance at rest and
            of its relative change (assumed: ink that is painted by hand).
        stiffness_spread, height_spread: The same of an element's stiffness, and of its height, m
            (assumed: moulds).
        repeatability: Deviation of the resistance change from contact to contact (assumed: powder
            settles anew).
        noise: Of a voltage, V rms (assumed: below one step of the converter, 4.9 mV).
        drift: Deviation of the linear change of the resistance at rest, 1/s (assumed: 1 % in an
            hour).
        tilt: Deviation of how level an object is held, rad (assumed: 1 degree).
        layer_force, layer_gain: The force layer: force that halves the resistance, N, and gain of
            the bridge's amplifier (assumed: 4 V at the printed range of 0.7 N). It is without
            memory here.
    """

    layout: PadLayout = THREE_TWO_THREE
    element: Element = field(default_factory=lambda: Element("pyramid", cut=0.12))
    young_modulus: float = STATED_MODULUS
    cover: float = 1 * MM
    spread: float = 1.36 * MM
    reference: float = 0.5
    gain_resistor: float = 0.25e6
    supply: float = 5.0
    levels: int = 1024
    rest_spread: float = 0.05
    gain_spread: float = 0.10
    stiffness_spread: float = 0.05
    height_spread: float = 0.05 * MM
    repeatability: float = 0.03
    noise: float = 3e-3
    drift: float = 0.01 / 3600
    tilt: float = 0.0175
    layer_force: float = 0.2
    layer_gain: float = 2.5

    def __post_init__(self) -> None:
        check_fields(self, zero=ZERO_ALLOWED, other=("layout", "element"))

"""Recomputation of the numbers printed in Section 2.2 on the sensing elements."""

from softgrip.ledger.verdict import simulated
from softgrip.tactile.element import STATED_MODULUS, Element, Shape, cut_sphere, shortening
from softgrip.tactile.element_resistance import AT_REST
from softgrip.tactile.element_results import fem_deformation
from softgrip.tactile.element_sensitivity import least_force, resistance_under
from softgrip.tactile.element_table import ASSUMED
from softgrip.tactile.hertz import hertz_approach
from softgrip.units import MM, MPa


def cylinder_by_equation(force: str, modulus: float = 0.125, width: float = 6.0) -> float:
    """Return the deformation of a cylinder 3 mm high by Eq. (2.1), mm; width in mm."""
    return shortening(Element("cylinder", width * MM), _newtons(force), modulus * MPa) / MM


def hemisphere_by_equation(force: str, modulus: float, cut: float) -> float:
    """Return the deformation of a sphere's half, 3 mm in radius and cut flat, by Eq. (2.1), mm."""
    return shortening(cut_sphere(cut), _newtons(force), modulus * MPa) / MM


def pyramid_by_equation(force: str, modulus: float, cut: float) -> float:
    """Return the deformation of a pyramid, 6 mm wide, 3 mm high and cut flat, by Eq. (2.1), mm."""
    return shortening(Element("pyramid", cut=cut), _newtons(force), modulus * MPa) / MM


def hertzian(force: str, modulus: float = 0.125, corrected: bool = False) -> float:
    """Return the right side of Eq. (2.2) for a radius of 3 mm; corrected, a length in mm.

    As printed, without the exponent 2/3, it is no length: the number then stands for 1e-3 m^1.5.
    """
    exponent = 2 / 3 if corrected else 1.0
    found = hertz_approach(_newtons(force), young_modulus=modulus * MPa, exponent=exponent)
    return found / MM


def by_finite_elements(
    force: str, shape: Shape, modulus: float = 0.125, assumed: bool = False, of: str = "largest"
) -> float:
    """Return the displacement of the top by finite elements, mm.

    Assumed: the element that the analytic row asks for; else 6 mm wide, 3 mm high and not cut, of
    which only the cylinder has a top to be loaded.
    """
    element = ASSUMED[shape] if assumed else Element(shape)
    return fem_deformation(element, _newtons(force), modulus * MPa, of) / MM


@simulated
def least_force_felt(shape: Shape) -> float:
    """Return the force whose resistance change is that of the pyramid at 0.01 N, N.

    The deformation is that of Eq. (2.1), the law of the skin our own.
    """
    return least_force(ASSUMED[shape], _threshold(), STATED_MODULUS)


@simulated
def ceiling_force(modulus: float = 0.125) -> float:
    """Return the force at which the pyramid's resistance has reached 1.5 MOhm, N."""
    return least_force(ASSUMED["pyramid"], 0.5e6, modulus * MPa)


def _threshold() -> float:
    return float(resistance_under(ASSUMED["pyramid"], 0.01, STATED_MODULUS)) - AT_REST


def _newtons(force: str) -> float:
    return float(force.removesuffix(" N"))

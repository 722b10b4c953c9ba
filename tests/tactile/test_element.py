"""Eq. (2.1): closed forms against quadrature, limits, divergence, refusals; and the volumes."""

from math import inf, pi, sqrt

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.integrate import quad

from softgrip.errors import InvalidInputError
from softgrip.tactile.element import (
    SHAPES,
    STATED_MODULUS,
    Element,
    compliance,
    cross_section,
    cut_sphere,
    shortening,
)
from softgrip.units import MM

CUTS = st.floats(0.02, 1.0)
TAPERED = ("hemisphere", "pyramid")


@pytest.mark.parametrize("shape", TAPERED)
@example(cut=1 - 2**-53, width=0.01, height=0.01)
@given(cut=CUTS, width=st.floats(1e-3, 2e-2), height=st.floats(5e-4, 2e-2))
def test_closed_form_is_the_quadrature(shape, cut, width, height):
    """Eq. (2.1) integrated by quadrature, slice by slice."""
    element = Element(shape, width, height, cut)
    # Over the part of the height, so that the tolerance is relative to a number near one.
    mean = quad(
        lambda part: element.base_area / cross_section(element, part * height),
        0, 1, epsrel=1e-10, limit=200,
    )[0]  # fmt: skip
    found = mean * height / (STATED_MODULUS * element.base_area)
    # The quadrature asks for 1e-10.
    assert compliance(element) == pytest.approx(found, rel=1e-9)
    assert shortening(element, 0.3) == pytest.approx(0.3 * found, rel=1e-9)


@pytest.mark.parametrize("shape", TAPERED)
@given(cut=st.floats(0.0, 1.0))
def test_volume_is_the_integral_of_the_cross_section(shape, cut):
    element = Element(shape, cut=cut)
    found = quad(lambda part: cross_section(element, part * element.height), 0, 1)[0]
    assert element.volume == pytest.approx(found * element.height, rel=1e-9)


@pytest.mark.parametrize("shape", TAPERED)
def test_sharper_tops_give_way_more_without_limit(shape):
    soft = [compliance(Element(shape, cut=cut)) for cut in (1.0, 0.5, 1e-2, 1e-4, 1e-8)]
    assert (np.diff(soft) > 0).all()
    assert compliance(Element(shape, cut=0.0)) == inf


def test_divergence_is_logarithmic_for_the_hemisphere_and_a_power_for_the_pyramid():
    """Per decade of the cut: a step that stays, and a factor of ten."""
    cuts = (1e-4, 1e-5, 1e-6)
    round_ones = [compliance(Element("hemisphere", cut=cut)) for cut in cuts]
    step = np.log(10) * 3 * MM / (0.125e6 * pi * (3 * MM) ** 2)
    assert np.diff(round_ones) == pytest.approx([step, step], rel=1e-6)
    square = [compliance(Element("pyramid", cut=cut)) for cut in cuts]
    assert np.divide(square[1:], square[:-1]) == pytest.approx([10, 10], rel=1e-9)


@pytest.mark.parametrize("shape", TAPERED)
def test_uncut_is_a_prism(shape):
    prism = Element(shape, cut=1.0)
    assert compliance(prism) == pytest.approx(prism.height / (0.125e6 * prism.base_area))
    assert compliance(Element(shape, cut=1 - 1e-9)) == pytest.approx(compliance(prism), rel=1e-6)


def test_cut_sphere_lies_on_the_sphere():
    element = cut_sphere(0.3)
    y = np.linspace(0, element.height, 7)
    assert cross_section(element, y) == pytest.approx(pi * ((3 * MM) ** 2 - y**2), rel=1e-12)
    assert element.top_area == pytest.approx(pi * (0.9 * MM) ** 2)


def test_printed_cross_sections():
    """The pyramid's as printed; the hemisphere's as printed, times pi."""
    w, L = 6 * MM, 3 * MM
    y = np.linspace(0, L, 5)
    assert cross_section(Element("pyramid", cut=0.0), y) == pytest.approx((w - w * y / L) ** 2)
    assert cross_section(cut_sphere(0.0), y) == pytest.approx(pi * ((w / 2) ** 2 - y**2))


@given(force=st.floats(0, 1), cut=CUTS, factor=st.floats(0.1, 10))
def test_shortening_is_linear_in_force_and_inverse_in_modulus(force, cut, factor):
    """Eq. (2.1): a prism under 1 N gives way by F L / (E A), and every element in proportion."""
    element = Element("pyramid", cut=cut)
    once = shortening(element, force)
    assert shortening(element, factor * force) == pytest.approx(factor * once)
    assert shortening(element, force, 0.125e6 * factor) == pytest.approx(once / factor)
    prism = Element("pyramid", 6 * MM, 3 * MM, 1.0)
    assert shortening(prism, 1.0, 0.125e6) == pytest.approx(0.003 / (0.125e6 * 0.006**2))


@given(factor=st.floats(0.1, 10))
def test_compliance_scales_as_one_over_length(factor):
    small, large = Element("pyramid", 1.0, 0.5, 0.3), Element("pyramid", factor, 0.5 * factor, 0.3)
    assert compliance(large) == pytest.approx(compliance(small) / factor)


def test_shortening_takes_arrays():
    force = np.array([[0.0, 0.1], [0.2, 0.3]])
    found = shortening(Element("cylinder"), force)
    assert found.shape == (2, 2)
    assert found[1, 1] == pytest.approx(shortening(Element("cylinder"), 0.3))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: Element("cube"), "shape: expected one of"),
        (lambda: Element("pyramid", width=0.0), "width"),
        (lambda: Element("pyramid", cut=1.2), "cut: expected 0 to 1"),
        (lambda: Element("cylinder", cut=0.5), "1 for a cylinder"),
        (lambda: cut_sphere(1.0), "cut: expected 0 to below 1"),
        (lambda: shortening(Element("pyramid", cut=0.0), 0.1), "a flat top"),
        (lambda: shortening(Element("pyramid"), np.array([0.1, -0.1])), "force: expected N, >= 0"),
        (lambda: shortening(Element("pyramid"), float("nan")), "force"),
        (lambda: cross_section(Element("pyramid"), 4 * MM), "y: expected 0 to 0.003 m"),
        (lambda: compliance(Element("cylinder"), 0.0), "young_modulus"),
    ],
)
def test_bad_input_is_refused(call, message):
    with pytest.raises(InvalidInputError, match=message):
        call()


def test_every_shape_has_a_round_or_square_base():
    assert [round(Element(s, width=2.0).base_area, 9) for s in SHAPES] == [
        round(pi, 9),
        round(pi, 9),
        4.0,
    ]
    assert Element("pyramid", width=2.0, cut=0.5).top_area == pytest.approx(sqrt(1.0))

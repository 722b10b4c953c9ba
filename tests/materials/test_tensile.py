"""Tensile tests of the public database: the files as they are, and all that a file can lack."""

import numpy as np
import pytest

from softgrip.errors import DataFileError, InvalidInputError
from softgrip.materials import tensile
from softgrip.materials.table import table_5_1
from softgrip.materials.tensile import COLUMNS

HEADER = "PARAMETER;INFO;URL;;\nMaterial;Rubber;;;\n;;;;\n"
TITLES = ";".join(COLUMNS) + "\n"
ROWS = [
    f"{0.1 * i:.1f};{0.09 * i:.2f};{0.02 * i:.2f};{0.1 * i:.1f};{0.01 * i:.2f}" for i in range(15)
]
BODY = "\n".join(ROWS) + "\n"


@pytest.fixture
def write(tmp_path):
    def write(content):
        path = tmp_path / "Rubber.csv"
        path.write_bytes(content if isinstance(content, bytes) else content.encode("latin-1"))
        return path

    return write


def test_good_file(write):
    test = tensile.parse(write(HEADER + TITLES + BODY))
    assert (test.name, test.strain.shape) == ("Rubber", (15,))
    assert (test.strain[-1], test.stress[-1]) == pytest.approx((1.4, 0.14e6))
    assert (test.true_strain[-1], test.true_stress[-1]) == pytest.approx((1.26, 0.28e6))


@pytest.mark.parametrize(
    "content",
    [
        (HEADER + TITLES + BODY).replace("\n", "\r\n"),
        HEADER * 4 + TITLES + BODY,
        TITLES + BODY,
        HEADER.replace("Rubber", "Caoutchouc \xe9lastique") + TITLES + BODY,
        HEADER + TITLES + BODY.replace("0.01\n", "-0.01\n"),
    ],
    ids=["other line ends", "long header", "no header", "accent", "negative first stress"],
)
def test_harmless_differences(write, content):
    assert tensile.parse(write(content)).strain.shape == (15,)


def replaced(row, by):
    return HEADER + TITLES + "\n".join([*ROWS[:row], by, *ROWS[row + 1 :]]) + "\n"


@pytest.mark.parametrize(
    ("content", "line", "expected"),
    [
        ("", 1, "a tensile test, got an empty file"),
        ("\n \n", 1, "got an empty file"),
        (HEADER, 3, "a row of columns Time .*got the end of the file"),
        (HEADER + TITLES.replace("True Strain", "Strain") + BODY, 4, "columns Time .*got Time"),
        (HEADER + TITLES.replace(";True Strain", "") + BODY, 4, "columns Time"),
        (HEADER + TITLES.rstrip()[:-4], 4, "line end after the last row"),
        (HEADER + TITLES, 4, "at least 10 rows of numbers, got 0"),
        (HEADER + TITLES + "\n".join(ROWS[:9]) + "\n", 13, "at least 10 rows of numbers, got 9"),
        (HEADER + TITLES + BODY[:-2], 19, "a line end after the last row"),
        (replaced(14, "1.4;1.26"), 19, "5 cells separated by semicolons, got 2"),
        (replaced(3, ""), 8, "5 cells separated by semicolons, got 1"),
        (replaced(3, "0,3;0,27;0,06;0,3;0,03"), 8, r"'Time \(s\)' with a decimal point, got '0,3'"),
        (replaced(3, "0.3;0.27;0.06;0.3;n/a"), 8, r"'Engineering Stress \(MPa\)', got 'n/a'"),
        (replaced(3, "0.3;0.27;0.06;0.3;nan"), 8, "a finite number for .*, got 'nan'"),
        (replaced(3, "0.3;0.27;0.06;inf;0.03"), 8, "a finite number for 'Engineering Strain'"),
        (replaced(3, "0.3;0.27;0.06;0.2;0.03"), 8, "'Engineering Strain' above that of the row"),
        ((HEADER + TITLES + BODY).encode("utf-16"), 1, "one byte a character .*got zero bytes"),
    ],
)
def test_bad_file_names_line_and_what_was_expected(write, content, line, expected):
    with pytest.raises(DataFileError, match=rf"Rubber\.csv, line {line}: expected .*{expected}"):
        tensile.parse(write(content))


@pytest.fixture
def rubber(write):
    return tensile.parse(write(HEADER + TITLES + BODY))


def test_arrays_cannot_be_written_to(rubber):
    with pytest.raises(ValueError, match="read-only"):
        rubber.stress[0] = 1.0


def test_arrays_must_be_of_one_shape():
    with pytest.raises(InvalidInputError, match="true_stress: expected the shape"):
        tensile.TensileTest("x", np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(4))


def test_up_to_peak_drops_what_follows_the_break(write):
    torn = tensile.parse(write(replaced(14, "1.4;1.26;0.10;1.4;0.01")))
    kept = tensile.up_to_peak(torn)
    assert kept.strain.size == 14
    assert kept.stress[-1] == torn.stress.max()


def test_hundred_percent_modulus(rubber):
    assert tensile.hundred_percent_modulus(rubber) == pytest.approx(0.1e6)


def test_hundred_percent_modulus_is_not_extrapolated(write):
    short = tensile.parse(write(HEADER + TITLES + "\n".join(ROWS[:10]) + "\n"))
    with pytest.raises(InvalidInputError, match=r"on both sides of 1, got '0 to 0\.9'"):
        tensile.hundred_percent_modulus(short)


@pytest.mark.usefixtures("tensile_tests")
@pytest.mark.parametrize("name", table_5_1())
def test_published_file(name):
    test = tensile.load(name)
    assert test.name == name
    assert test.strain.size >= 222
    assert test.strain[-1] > 5
    np.testing.assert_allclose(test.true_strain, np.log1p(test.strain), atol=1e-5)
    # The first row of one file has a true stress of the other sign; later rows all agree.
    np.testing.assert_allclose(
        test.true_stress[1:], (test.stress * (1 + test.strain))[1:], rtol=2e-3, atol=200
    )
    # Loads below 0.1 N are noise of a 1 kN cell, so a first stress can be negative; no other is.
    assert test.stress[1:].min() > 0
    assert tensile.up_to_peak(test).strain.size >= test.strain.size - 1


@pytest.mark.usefixtures("tensile_tests")
def test_printed_moduli_lie_above_the_measured_stress_at_strain_one():
    # Were they the 100 % moduli of these tests, the ratios would be near 1.
    ratios = {
        name: m.young_modulus / tensile.hundred_percent_modulus(tensile.load(name))
        for name, m in table_5_1().items()
    }
    assert min(ratios.values()) > 1.05
    assert max(ratios, key=ratios.get) == "Dragon Skin FX Pro"
    assert ratios["Dragon Skin FX Pro"] == pytest.approx(4.17, abs=0.01)

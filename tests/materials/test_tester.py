"""Testers' exports: the forms are those of their makers, the numbers are made up, E and n known."""

import csv
import io

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softgrip.errors import DataFileError, InvalidInputError, SoftgripError, UnknownNameError
from softgrip.materials import ludwick
from softgrip.materials.tester import read_export

E, N = 0.12e6, 1.6  # Pa, and the power
GAUGE, AREA = 30e-3, 12e-6  # m, m^2
STRAIN = np.linspace(0, 3, 61)
STRESS = E * STRAIN**N
TIME, MM, NEWTON = STRAIN * 10, STRAIN * GAUGE * 1e3, STRESS * AREA
SIZES = {"gauge_length": "30 mm", "area": "12 mm^2"}


@pytest.fixture
def export(tmp_path):
    def read(text, encoding="utf-8", **options):
        path = tmp_path / "rubber.csv"
        path.write_bytes(text.encode(encoding))
        return read_export(path, **options)

    return read


def rows(*columns, separator=",", decimal=".", quote="", digits=7):
    """Return the lines of columns of numbers."""
    lines = zip(*columns, strict=True)
    return "".join(
        separator.join(f"{quote}{x:.{digits}f}{quote}".replace(".", decimal) for x in line) + "\n"
        for line in lines
    )


def check(found, rel=1e-3):
    fit = ludwick.fit(found.test.strain, found.test.stress)
    assert (fit.young_modulus, fit.fractional_power) == pytest.approx((E, N), rel=rel)


def test_instron_bluehill(export):
    """Results and sizes before the names, units in a row below, every number quoted."""
    check(
        export(
            '"Dimension : Length","30.00","mm"\n"Dimension : Width","6.0","mm"\n'
            + '"Dimension : Thickness","2.0","mm"\n\n'
            + '"Time","Extension","Load"\n"(s)","(mm)","(N)"\n'
            + rows(TIME, MM, NEWTON, quote='"')
        )
    )


def test_instron_bluehill_with_stress_and_what_its_strain_is_of(export):
    found = export(
        "Time,Displacement,Force,Tensile strain (Displacement),Tensile stress\n"
        "(s),(mm),(kN),(%),(MPa)\n"
        + rows(TIME, MM, NEWTON / 1e3, STRAIN * 100, STRESS / 1e6, digits=9),
        encoding="utf-16",
    )
    check(found)
    assert found.notes[:2] == (
        "the strain is 'Tensile strain (Displacement) [%]'",
        "the stress is 'Tensile stress [MPa]'",
    )


@pytest.mark.parametrize("strain", [("Dehnung", "%", 100), ("Dehnung", "mm", GAUGE * 1e3)])
def test_zwickroell_testxpert(export, strain):
    """German names, semicolons and decimal commas; its Dehnung is a share or a length."""
    name, unit, factor = strain
    check(
        export(
            "Probe;1;\nMesslänge;30,00;mm\nQuerschnittsfläche;12,0;mm²\n\n"
            f"Prüfzeit;{name};Standardkraft\ns;{unit};N\n"
            + rows(TIME, STRAIN * factor, NEWTON, separator=";", decimal=","),
            encoding="latin-1",
        )
    )


def test_shimadzu_trapezium(export):
    """The specimen's name above the names, units below, two columns of the same travel."""
    text = (
        '"Name","Thickness","Width","Gauge"\n"Size Unit:","mm","mm","mm"\n"r1",2.0,6.0,30.0\n\n'
        '"r1"\n"Time","Force","Disp.","Stroke"\n"sec","N","mm","mm"\n'
    )
    check(export(text + rows(TIME, NEWTON, MM, MM), **SIZES))
    with pytest.raises(DataFileError, match=r"one column of extension, or which.*'Stroke \[mm\]'"):
        export(text + rows(TIME, NEWTON, MM, 1.1 * MM), **SIZES)
    check(
        export(
            text + rows(TIME, NEWTON, MM, 1.1 * MM), columns={"extension": "Disp. [mm]"}, **SIZES
        )
    )


def test_mts_testsuite(export):
    """Tabs; a position that begins anywhere, force in kN."""
    check(
        export(
            "Data Header:\tGeneral\nStation Name:\tmine\n"
            "Axial Displacement\tAxial Force\tRunning Time\nmm\tkN\ts\n"
            + rows(MM + 105.3, NEWTON / 1e3, TIME, separator="\t", digits=9),
            **SIZES,
        )
    )


def test_mecmesin_and_ametek(export):
    check(export("Load (N),Displacement (mm)\n" + rows(NEWTON, MM), **SIZES))
    check(
        export(
            "Load (N),Machine Extension (mm),Percentage Strain (%)\n"
            + rows(NEWTON, MM, STRAIN * 100),
            area="12 mm^2",
        )
    )


def test_database_of_soft_materials(export):
    check(
        export(
            "PARAMETER;INFO;;;\nTime (s);True Strain;True Stress (MPa);Engineering Strain;"
            "Engineering Stress (MPa)\n"
            + rows(
                TIME, np.log1p(STRAIN), STRESS * (1 + STRAIN) / 1e6, STRAIN, STRESS / 1e6,
                separator=";", digits=9,
            )
        )
    )  # fmt: skip


def test_quoted_forces_of_a_tester_as_a_reader_posts_them(export):
    """A force in kN, quoted, its units below: 0.120 MPa and 1.600."""
    check(
        export(
            "Time,Displacement,Force\n(s),(mm),(kN)\n"
            + rows(TIME, MM, NEWTON / 1e3, quote='"', digits=7),
            **SIZES,
        )
    )


def test_preload_of_a_reader_is_taken_off(export):
    """20 kPa at strain 0: 0.100 MPa and 1.60."""
    found = export("strain,stress [Pa]\n" + rows(STRAIN, 20e3 + STRESS, digits=5))
    assert found.preload == pytest.approx(20e3, abs=20)
    check(found)


def test_compression_above_zero_is_asked_and_turned(export):
    text = "Load (N),Displacement (mm)\n" + rows(-NEWTON, -MM)
    with pytest.raises(DataFileError, match="compression_positive"):
        export(text, **SIZES)
    check(export(text, compression_positive=True, **SIZES))
    force_only = "Load (N),Displacement (mm)\n" + rows(-NEWTON, MM)
    check(export(force_only, compression_positive=True, **SIZES))
    true = "Strain [-],True stress [MPa]\n" + rows(-STRAIN, -STRESS * (1 + STRAIN) / 1e6)
    check(export(true, compression_positive=True))


def test_a_sample_that_is_pressed_to_nothing_is_refused(export):
    crushed = "Strain [-],True stress [MPa]\n" + rows(STRAIN - 1, STRESS / 1e6)
    with pytest.raises(DataFileError, match=r"strains above -1, .*got -1"):
        export(crushed)


def test_true_stress_is_never_taken_for_engineering(export):
    true = STRESS * (1 + STRAIN) / 1e6
    for name in ("True stress", "wahre Spannung", "Cauchy stress"):
        check(export(f"Strain [%],{name} [MPa]\n" + rows(STRAIN * 100, true)))
    check(export("True strain,True stress [MPa]\n" + rows(np.log1p(STRAIN), true)))
    unnamed = "Strain [%],Stress [MPa],Force [N]\n" + rows(STRAIN * 100, true, NEWTON)
    with pytest.raises(DataFileError, match="in proportion to the force"):
        export(unnamed)
    check(export(unnamed, columns={"true stress": "Stress [MPa]", "force": "Force [N]"}, area=AREA))


def test_other_names_and_units_are_given(export):
    text = "x;y\n" + rows(STRAIN * 100, STRESS / 1e3, separator=";")
    check(export(text, columns={"strain": "x [%]", "stress": "y [kPa]"}))
    for columns, words in (
        ({}, "a column of strain, or of extension.*got 'x', 'y'"),
        ({"strain": "x", "stress": "y [kPa]"}, "a unit of 'x'"),
        ({"strain": "x [%]", "stress": "y"}, "a unit of 'y'"),
        ({"strain": "x [%]", "stress": "y [mm]"}, "expected a pressure"),
        ({"strain": "z", "stress": "y"}, "a column 'z', got 'x', 'y'"),
    ):
        with pytest.raises(DataFileError, match=words):
            export(text, columns=columns)
    with pytest.raises(UnknownNameError, match="no column of a test is named 'stretch'"):
        export(text, columns={"stretch": "x"})


@pytest.mark.parametrize(
    ("head", "options", "words"),
    [
        ("", {"area": AREA}, "a gauge length"),
        ("", {"gauge_length": GAUGE}, "a cross-section"),
        ("Gauge length: 30\n", {"area": AREA}, "a unit of the size"),
        ("Gauge length: 30 N\n", {"area": AREA}, "a length: m, cm, mm"),
        ("Gauge length: 0 mm\n", {"area": AREA}, "a finite number > 0"),
        ("Gauge length: 30 mm\nGrip separation: 60 mm\n", {"area": AREA}, "gauge_length="),
    ],
)
def test_sizes_that_are_missing_or_doubtful_are_asked(export, head, options, words):
    with pytest.raises(DataFileError, match=words):
        export(head + "Load (N),Displacement (mm)\n" + rows(NEWTON, MM), **options)


@pytest.mark.parametrize(
    "head",
    [
        "Gauge length [mm]: 30\nArea (mm2): 12\n",
        "L0 = 30 mm\nS0 = 12 mm^2\n",
        "Gage Length;3 cm\nDiameter;3.9088 mm\n",
        "Initial length,30,mm\nWidth,6,mm\nThickness,2,mm\n",
    ],
)
def test_sizes_of_the_file(export, head):
    check(export(head + "Load (N),Displacement (mm)\n" + rows(NEWTON, MM)))


@pytest.mark.parametrize("size", [0, -1, float("nan"), "30", "30 N", "thirty"])
def test_sizes_that_are_none_are_refused(export, size):
    with pytest.raises(InvalidInputError, match="gauge_length"):
        export("Load (N),Displacement (mm)\n" + rows(NEWTON, MM), gauge_length=size, area=AREA)


LENGTHS = {"mm": 1e-3, "cm": 1e-2, "in": 25.4e-3, "m": 1.0}
FORCES = {"N": 1.0, "kN": 1e3, "mN": 1e-3, "gf": 9.80665e-3, "lbf": 4.4482216152605}
STRESSES = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "psi": 6894.757293168, "N/mm^2": 1e6}


@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_any_dress_of_a_test_gives_its_law_or_is_refused(data, tmp_path_factory):
    """Separators, decimal signs, units and the order of columns."""
    pick = lambda *of: data.draw(st.sampled_from(of))  # noqa: E731
    decimal, separator = pick(*".,"), pick(",", ";", "\t")
    length, force, stress = (pick(*units) for units in (LENGTHS, FORCES, STRESSES))
    columns = {"Time": ("s", TIME)}
    if pick(True, False):
        columns[pick("Extension", "Stroke", "Weg")] = length, STRAIN * GAUGE / LENGTHS[length]
    else:
        columns[pick("Strain", "Dehnung")] = pick(("%", STRAIN * 100), ("1", STRAIN))
    if pick(True, False):
        columns[pick("Load", "Kraft", "Test Force")] = force, NEWTON / FORCES[force]
    else:
        columns[pick("Stress", "Spannung")] = stress, STRESS / STRESSES[stress]
    order = data.draw(st.permutations(list(columns)))
    digits = data.draw(st.integers(2, 6))
    below = pick(True, False)
    stream = io.StringIO()
    writer = csv.writer(stream, delimiter=separator, quoting=pick(csv.QUOTE_MINIMAL, csv.QUOTE_ALL))
    writer.writerow([name if below else f"{name} [{columns[name][0]}]" for name in order])
    if below:
        writer.writerow([f"({columns[name][0]})" for name in order])
    numbers = [
        [f"{x:.{digits}e}".replace(".", decimal) for x in columns[name][1]] for name in order
    ]
    writer.writerows(zip(*numbers, strict=True))
    path = tmp_path_factory.mktemp("tester") / "any.csv"
    path.write_text(stream.getvalue())
    lengthens, loads = (
        any(unit == length for unit, _ in columns.values()),
        force in {unit for unit, _ in columns.values()},
    )
    options = ({"gauge_length": GAUGE} if lengthens else {}) | ({"area": AREA} if loads else {})
    try:
        found = read_export(path, **options)
    except SoftgripError:
        assert decimal == "," or digits == 3  # what may be thousands
        return
    # As many digits as were written.
    check(found, rel=max(1e-3, 20 * 10.0**-digits))

"""Tables as other programs save them: one way to read them gives its numbers, two are refused."""

import csv
import io

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from softgrip.errors import DataFileError
from softgrip.text_table import read_table

PLAIN = "time [s],pressure [kPa],kind\n0.5,-1.25,a\n1,20,b c\n"


@pytest.fixture
def table(tmp_path):
    def write(content, **options):
        path = tmp_path / "mine.csv"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_table(path, **options)

    return write


def contents(found):
    return (
        found.names[:2],
        found.units[:2],
        [found.numbers(name).tolist() for name in found.names[:2]],
    )


WHOLE = ("time", "pressure"), ("s", "kPa"), [[0.5, 1.0], [-1.25, 20.0]]


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "latin-1"]
)
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", "\r\r\n"])
def test_encodings_and_line_ends(table, encoding, end):
    text = PLAIN.replace("b c", "b µ").replace("\n", end)
    found = table(text.encode(encoding))
    assert contents(found) == WHOLE
    assert found.cells("kind") == ("a", "b µ")


@pytest.mark.parametrize(
    "text",
    [
        PLAIN.replace(",", ";"),
        PLAIN.replace(",", "\t"),
        PLAIN.replace(",", ", "),
        PLAIN.replace(",", ";").replace(".", ","),
        PLAIN.replace(",", "\t").replace(".", ","),
        PLAIN.replace(",", "   ").replace("b c", "b"),
        PLAIN.replace(",", "  ").replace(".", ",").replace("b c", "b"),
        '"time [s]","pressure [kPa]","kind"\n"0.5","-1.25","a"\n"1","20","b, c"\n',
        '"time [s]","pressure [kPa]","kind"\n"0,5","-1,25","a"\n"1","20","b, c"\n',
        "time (s), pressure (kPa), kind\n0.5, -1.25, a\n1, 20, b\n",
        "time / s;pressure, kPa;kind\n0,5;-1,25;a\n1;20;b\n",
        "time,pressure,kind\n(s),(kPa),\n0.5,-1.25,a\n1,20,b\n",
        "time;pressure;kind\n[s];[kPa];[-]\n\n0.5;-1.25;a\n1;20;b\n",
        "time\tpressure\tkind\ns\tkPa\t\n0.5\t-1.25\ta\n1\t20\tb\n",
        "Rig;of mine;;\nGauge length;30;mm;\n;;;\n"
        "time [s];pressure [kPa];kind;\n0.5;-1.25;a;\n1;20;b;\n",
        "sep=;\ntime [s];pressure [kPa];kind\n0.5;-1.25;a\n1;20;b\n",
        "# by me\n" + PLAIN + "\nMean,9.4\nEnd of test\n",
        PLAIN + "\nSummary,,\nname,value,unit\npeak,20,kPa\n",
        "Results\nspecimen,peak\n1,3\n\n" + PLAIN.replace("1,20,b c\n", "1,20,b\n" * 1 + ""),
        "time [s],pressure [kPa],kind\n5E-1,\u22121.25,a\n+1.0e0,.2e2,b\n",
    ],
)  # fmt: skip
def test_the_same_table_in_other_dress(table, text):
    assert contents(table(text)) == WHOLE


def test_lines_before_the_names_are_kept(table):
    found = table('"# who: me, and you",,\n# shows: a push,,\nGauge length,30,mm\n' + PLAIN)
    assert found.head == ("# who: me, and you", "# shows: a push", "Gauge length,30,mm")
    assert (found.names_line, found.lines) == (4, (5, 6))


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ('P [Pa],x\n"1,234.5",2\n"980",3\n', [1234.5, 980]),
        ('P [Pa],x\n"1,234,567",2\n"980",3\n', [1234567, 980]),
        ("P [Pa];x\n1.234,5;2\n980;3\n", [1234.5, 980]),
        ("P [Pa];x\n1 234,5;2\n980;3\n", [1234.5, 980]),
        ("P [Pa];x\n1\u202f234\u202f567;2,5\n980;3\n", [1234567, 980]),
        ("P [Pa];x\n1'234.5;2\n980;3\n", [1234.5, 980]),
        ('P [Pa],x\n"1,234",0.5\n"980",3\n', [1234, 980]),  # points are decimal here
        ("P [Pa];x\n1,234;0,5\n980;3\n", [1.234, 980]),
        ("P [Pa];x\n0,234;2\n980;3\n", [0.234, 980]),
        ("P [Pa],x\n1.234,2\n980,3\n", [1.234, 980]),
    ],
)
def test_thousands_are_told_from_decimals_by_the_other_numbers(table, text, numbers):
    assert table(text).numbers("P").tolist() == numbers


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('P [Pa],x\n"980",2\n"1,234",3\n', "line 3: expected a decimal sign that can be told"),
        ("P [Pa];x\n1,234;2\n", "got '1,234', a number with thousands or with decimals"),
        ("P [Pa];x\n1.234;2\n", "got '1.234', a number with thousands or with decimals"),
        ("P [Pa];x\n1,5;2\n1.5;3\n", "line 2: expected one decimal sign, got '1,5', but '1.5'"),
        ("t,p\n0,05,1,5\n", "2 names in line 1, 4 cells in line 2"),
        ("t,p\n1,2\n0,05,1,5\n", "line 3: expected 2 cells, got 4"),
        ("1,2\n3,4\n", "a number in line 1, before any name"),
        ("time,force\n", "no line with a number"),
        ("", "no line with a number"),
        ("t,p\n1,2\n3,4\n\nt,p\n1,2\n3,4\n", "table 1 under line 1, 2 rows; table 2 under line 5"),
        (b"PK\x03\x04", "expected text.*save the sheet as CSV"),
        ('t,p\n"1,2\n3,4\n', "expected"),
    ],
)  # fmt: skip
def test_what_can_be_read_in_two_ways_or_none_is_refused(table, text, words):
    with pytest.raises(DataFileError, match=words):
        table(text)


def test_what_decides_can_be_given(table):
    doubtful = "P [Pa];x\n1,234;2\n"
    assert table(doubtful, decimal=",").numbers("P").tolist() == [1.234]
    assert table(doubtful, decimal=".").numbers("P").tolist() == [1234]
    two = "t,p\n1,2\n3,4\n\nt,p\n5,6\n7,8\n"
    assert table(two, table=2).numbers("t").tolist() == [5, 7]
    assert table("a;b,c\n1;2,5\n", separator=";").numbers("b,c").tolist() == [2.5]
    with pytest.raises(DataFileError, match="a table 3, got 2"):
        table(two, table=3)


@pytest.mark.parametrize(
    "cell", ["", "x", "NaN", "inf", "1_000", "0x10", "1.2.3", "12:30", "5 kPa", "1e999"]
)
def test_cells_that_are_no_finite_numbers_are_named(table, cell):
    found = table(f"t,p\n1,2\n2,{cell}\n3,4\n")
    with pytest.raises(DataFileError, match=r"mine\.csv, line 3: expected a finite number under p"):
        found.numbers("p")


def test_cells_of_what_was_not_measured_may_be_let_through(table):
    found = table("t,p\n1,2\n2,\n3,NaN\n4,#N/A\n5,x\n")
    with pytest.raises(DataFileError, match=r"line 6.*'x'"):
        found.numbers("p", missing=True)
    found = table("t,p\n1,2\n2,\n3,NaN\n4,#N/A\n5,6\n")
    np.testing.assert_array_equal(found.numbers("p", missing=True), [2, *[np.nan] * 3, 6])


def test_columns_are_found_by_name_or_heading_and_only_if_there_is_one(table):
    found = table("Strain (%),Strain (mm/mm),Force,force\n1,0.01,2,3\n")
    assert found.numbers("Strain [%]") == found.numbers("strain (%)") == [1.0]
    assert found.numbers("force") == [3.0]
    for name in ("Strain", "FORCE"):
        with pytest.raises(DataFileError, match="one column"):
            found.numbers(name)
    with pytest.raises(DataFileError, match=r"a column 'stress', got 'Strain \[%\]', "):
        found.numbers("stress")


def test_a_cut_last_line_is_left_out_and_an_unended_one_is_said(table):
    assert table(PLAIN).ended
    assert not table(PLAIN[:-1]).ended
    cut = table(PLAIN[:-6])
    assert (cut.notes, cut.ended, len(cut.rows)) == (
        ("the cut last line, 3, was left out",),
        True,
        1,
    )


def test_what_is_not_in_the_table_is_said(table):
    found = table("Results\nspecimen,peak\n1,3\n\n" + PLAIN + "\nMean,9.4\nEnd of test\n")
    assert found.notes == (
        "lines 9 to 10, after the table, were left out",
        "the table of 1 rows under line 2 was left out",
    )
    assert table(PLAIN + "\nEnd\n").notes == ("line 5, after the table, was left out",)


ALPHABET = "abcdefgh \u00b5\u00e9"
names = st.lists(
    st.text(ALPHABET, min_size=1, max_size=8).map(lambda s: " ".join(s.split())).filter(bool),
    min_size=2, max_size=4, unique_by=str.casefold,
)  # fmt: skip
values = st.floats(-1e6, 1e6, allow_nan=False) | st.integers(-3000, 3000).map(float)


def written(value, digits, decimal, thousands):
    text = f"{value:,.{digits}f}" if thousands else f"{value:.{digits}f}"
    return text.replace(",", "\0").replace(".", decimal).replace("\0", thousands)


@settings(max_examples=400, deadline=None)
@given(data=st.data(), labels=names, digits=st.integers(0, 4))
def test_any_dress_gives_the_value_or_is_refused(data, labels, digits, tmp_path_factory):
    decimal = data.draw(st.sampled_from(".,"))
    separator = data.draw(st.sampled_from([",", ";", "\t"]))
    # Nobody parts thousands by points, and then cells by commas: there a point is a decimal one.
    other = {".": ",", ",": "." if separator != "," else " "}[decimal]
    thousands = data.draw(st.sampled_from(["", "", other, " ", "'"]))
    unit = data.draw(st.sampled_from(["{} [kPa]", "{} (kPa)", "{}/kPa", "{}"]))
    row = st.lists(values, min_size=len(labels), max_size=len(labels))
    rows = data.draw(st.lists(row, min_size=1, max_size=6))
    quoting = data.draw(st.sampled_from([csv.QUOTE_MINIMAL, csv.QUOTE_ALL]))
    stream = io.StringIO()
    writer = csv.writer(stream, delimiter=separator, quoting=quoting)
    writer.writerow([unit.format(label) for label in labels])
    if unit == "{}":
        writer.writerow(["(kPa)"] * len(labels))
    writer.writerows([[written(v, digits, decimal, thousands) for v in row] for row in rows])
    path = tmp_path_factory.mktemp("table") / "any.csv"
    encoding = data.draw(st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "latin-1"]))
    path.write_bytes(stream.getvalue().encode(encoding))
    try:
        found = read_table(path)
        numbers = np.array([found.numbers(label) for label in labels]).T
    except DataFileError:
        # Only a sign that may be either is refused: one with three digits after it.
        signs = {decimal} if digits == 3 else set()
        assert (signs | {thousands}) & set(",.")
        return
    assert found.units == ("kPa",) * len(labels)
    # As many digits as were written.
    np.testing.assert_allclose(numbers, rows, atol=0.500001 * 10.0**-digits, rtol=1e-12)


@settings(max_examples=300, deadline=None)
@given(
    content=st.binary(max_size=60)
    | st.text("0123456789.,;\t \"'\n\rab[]()#=-eE", max_size=60).map(str.encode)
)
@example(content=b'"')
@example(content=b"\xff\xfe0")
def test_any_bytes_are_a_table_or_refused_by_name(content, tmp_path_factory):
    path = tmp_path_factory.mktemp("bytes") / "any.csv"
    path.write_bytes(content)
    try:
        found = read_table(path)
        for heading in found.headings:
            found.numbers(heading, missing=True)
    except DataFileError as error:
        assert "any.csv" in str(error)  # noqa: PT017

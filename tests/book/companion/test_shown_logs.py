"""A figure made from logs shows the logs that it is given, and says whose they are."""

import shutil

import pytest

from book.companion.exhibit import exhibit, with_logs
from book.companion.save import make, numbers
from book.companion.show import show
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.provenance import Provenance, data_folder

PUSH = data_folder() / "simulated" / "push-d.csv"


@pytest.fixture
def mine(tmp_path):
    """Return the log of another rig: a real one, by its header."""
    path = tmp_path / "mine.csv"
    text = PUSH.read_text().replace("# provenance: simulated", "# provenance: logged")
    path.write_text(text.replace("# back_end: simulated rig", "# back_end: board"))
    return path


def test_other_log_is_drawn_and_named(mine):
    item = with_logs(exhibit("Figure 4.4"), [mine])
    assert item.provenance is Provenance.LOGGED
    made = make(item)
    assert made.data[0].path == mine
    drawn = numbers(made.shown)
    assert set(drawn["panel"].str.split().str[0]) == {"mine"}
    assert "logged" in set(drawn["series"])
    shown = show("Figure 4.4", logs=[mine])._repr_mimebundle_()["text/html"]
    assert "mine.csv (logged" in shown


def test_page_without_logs_of_its_own_shows_those_of_the_book():
    assert show("Figure 4.7", logs=[]).exhibit.provenance is Provenance.SIMULATED


@pytest.mark.parametrize("title", ["Figure 3.12", "Figure 4.5", "Table 3.C", "Table 4.C"])
def test_one_log_has_the_first_place_and_three_are_refused(title):
    step = data_folder() / "simulated" / "pid-full.csv"
    assert make(with_logs(exhibit(title), str(step))).shown is not None
    with pytest.raises(InvalidInputError, match="logs: expected 2 at most"):
        make(with_logs(exhibit(title), [step] * 3))


def test_log_of_a_spreadsheet_is_shown(tmp_path):
    path = tmp_path / "mine.csv"
    rows = "".join(f"{40 * k};{min(k, 40)},0;40,0\n" for k in range(375))
    path.write_text("Zeit [ms];Winkel [°];Soll [°]\n" + rows, encoding="latin-1")
    told = '[columns]\ntime = "Zeit"\nangle = "Winkel"\nreference = "Soll"\n'
    path.with_suffix(".toml").write_text(told)
    for title in ("Figure 4.5", "Figure 4.7", "Table 4.C"):
        shown = show(title, logs=path)
        assert [(data.path, data.provenance) for data in shown.made.data[:1]] == [(path, "logged")]
        assert "mine.csv (logged" in shown._repr_mimebundle_()["text/html"]


def test_figure_that_takes_no_logs_says_so(mine):
    with pytest.raises(InvalidInputError, match=r"none for Figure 4\.3"):
        with_logs(exhibit("Figure 4.3"), [mine])


def test_file_that_is_no_log_is_refused(tmp_path):
    path = tmp_path / "plain.csv"
    path.write_text("time,pressure\n0,0\n")
    with pytest.raises(DataFileError, match="a unit of 'time'"):
        with_logs(exhibit("Figure 4.4"), [path])
    shutil.copy(PUSH, path)
    assert with_logs(exhibit("Figure 4.4"), [path]).logs == (path,)

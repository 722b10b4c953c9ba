"""Where the public files come from: a folder that is named, else the network, else an error."""

from pathlib import Path

import pytest

from softgrip.errors import DataFileError, DataUnavailableError, UnknownNameError
from softgrip.materials import database, tensile
from softgrip.materials.table import table_5_1

NAME = "Ecoflex 00-30"


@pytest.fixture
def folder(monkeypatch, tmp_path):
    monkeypatch.setenv(database.FOLDER_VARIABLE, str(tmp_path))
    return tmp_path


@pytest.fixture
def network(monkeypatch, tmp_path):
    """Replace the downloader by a function of (url, file), and the cache by an empty folder."""
    calls = []

    def install(download):
        def recorded(url, output_file, pooch):
            calls.append(url)
            download(url, output_file)

        monkeypatch.setattr(database.pooch, "HTTPDownloader", lambda **options: recorded)
        return calls

    monkeypatch.delenv(database.FOLDER_VARIABLE, raising=False)
    monkeypatch.setattr(database.pooch, "os_cache", lambda name: tmp_path / name)
    database._store.cache_clear()
    database._network_gives_all.cache_clear()
    yield install
    database._store.cache_clear()
    database._network_gives_all.cache_clear()


def no_network(url, output_file):
    raise OSError("no route to host")


def test_every_material_of_the_table_has_a_file():
    assert set(database.SHA256) == set(table_5_1())


def test_unknown_material_lists_the_valid_ones(folder):
    with pytest.raises(UnknownNameError, match="'Ecoflex'; valid are: Dragon Skin 10 MEDIUM"):
        tensile.load("Ecoflex")


def test_folder_that_does_not_exist(monkeypatch, tmp_path):
    monkeypatch.setenv(database.FOLDER_VARIABLE, str(tmp_path / "none"))
    with pytest.raises(DataUnavailableError, match=r"SOFTGRIP_MATERIALS_DIR .* is not a folder"):
        tensile.load(NAME)


def test_folder_without_the_file(folder):
    with pytest.raises(DataUnavailableError, match=r"has no file 'Ecoflex 00-30\.csv'"):
        tensile.load(NAME)


def test_wrong_folder_does_not_pass_for_missing_data(folder):
    with pytest.raises(DataUnavailableError):
        tensile.available()


def test_changed_file_says_so(folder):
    (folder / "Ecoflex 00-30.csv").write_text("Time (s)\n")
    with pytest.raises(DataFileError, match=r"the published bytes.*got a changed file"):
        tensile.load(NAME)


@pytest.fixture
def published(tensile_tests):
    return database.locate(NAME).read_bytes()


def test_changed_line_ends_are_a_change(published, folder):
    (folder / "Ecoflex 00-30.csv").write_bytes(published.replace(b"\n", b"\r\n"))
    with pytest.raises(DataFileError, match="line ends count"):
        tensile.load(NAME)


def test_fetched_file_is_read_and_kept(published, network):
    calls = network(lambda url, file: Path(file).write_bytes(published))
    assert tensile.load(NAME).name == tensile.load(NAME).name == NAME
    assert calls == [f"{database.URL}Ecoflex%2000-30.csv"]


def test_without_network_the_error_tells_both_ways(network):
    network(no_network)
    with pytest.raises(DataUnavailableError, match="no route to host") as caught:
        tensile.load(NAME)
    assert "SOFTGRIP_MATERIALS_DIR" in str(caught.value)
    assert database.URL in str(caught.value)


def test_other_bytes_than_published_are_refused(network):
    network(lambda url, file: Path(file).write_text("<html>Sign in</html>"))
    with pytest.raises(DataUnavailableError, match="hash"):
        tensile.load(NAME)


def test_available_tries_the_network_once(network):
    calls = network(no_network)
    assert [tensile.available() for _ in range(3)] == [False] * 3
    assert len(calls) == 1


def test_address_is_quoted(network):
    calls = network(no_network)
    with pytest.raises(DataUnavailableError):
        tensile.load("SORTA-Clear 40")
    assert calls == [f"{database.URL}SortaClear%2040.csv"]

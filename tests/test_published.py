"""Where published files come from: a folder that is named, else the network, else an error."""

import hashlib
from pathlib import Path

import pytest

from softgrip import published
from softgrip.errors import DataFileError, DataUnavailableError
from softgrip.published import PublishedFiles

VARIABLE = "SOFTGRIP_TRIED_DIR"
BYTES = {"a file.csv": b"1\n2\n", "b.csv": b"3\n"}


@pytest.fixture
def files():
    return PublishedFiles(
        VARIABLE,
        "https://example.org/at/",
        {name: hashlib.sha256(content).hexdigest() for name, content in BYTES.items()},
        {"b.csv": "renamed.csv"},
    )


@pytest.fixture
def folder(monkeypatch, tmp_path):
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    for name, content in BYTES.items():
        (tmp_path / name).write_bytes(content)
    return tmp_path


@pytest.fixture
def network(monkeypatch, tmp_path):
    """Replace the downloader by a function of (url, file), and the cache by an empty folder."""
    calls = []

    def install(download):
        def recorded(url, output_file, pooch):
            calls.append(url)
            download(url, output_file)

        monkeypatch.setattr(published.pooch, "HTTPDownloader", lambda **options: recorded)
        return calls

    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setattr(published.pooch, "os_cache", lambda name: tmp_path / name)
    return install


def no_network(url, output_file):
    raise OSError("no route to host")


def test_file_of_the_named_folder_is_taken(files, folder):
    assert files.locate("a file.csv") == folder / "a file.csv"
    assert files.available()


def test_second_name_is_taken_too(files, folder):
    (folder / "b.csv").rename(folder / "renamed.csv")
    assert files.locate("b.csv") == folder / "renamed.csv"
    (folder / "renamed.csv").unlink()
    with pytest.raises(DataUnavailableError, match=r"no file 'b\.csv' or 'renamed\.csv'"):
        files.locate("b.csv")


def test_folder_that_does_not_exist(files, monkeypatch, tmp_path):
    monkeypatch.setenv(VARIABLE, str(tmp_path / "none"))
    with pytest.raises(DataUnavailableError, match=r"SOFTGRIP_TRIED_DIR .* is not a folder"):
        files.locate("b.csv")


def test_wrong_folder_does_not_pass_for_missing_data(files, folder):
    (folder / "a file.csv").unlink()
    with pytest.raises(DataUnavailableError, match=r"has no file 'a file\.csv'"):
        files.available()


def test_changed_line_ends_are_a_change(files, folder):
    (folder / "a file.csv").write_bytes(b"1\r\n2\r\n")
    with pytest.raises(DataFileError, match=r"the published bytes.*line ends count.*changed file"):
        files.locate("a file.csv")


def test_fetched_file_is_read_and_kept(files, network):
    calls = network(lambda url, file: Path(file).write_bytes(BYTES["a file.csv"]))
    assert files.locate("a file.csv") == files.locate("a file.csv")
    assert files.locate("a file.csv").read_bytes() == BYTES["a file.csv"]
    assert calls == ["https://example.org/at/a%20file.csv"]


def test_without_network_the_error_tells_both_ways(files, network):
    network(no_network)
    with pytest.raises(DataUnavailableError, match="no route to host") as caught:
        files.locate("b.csv")
    assert VARIABLE in str(caught.value)
    assert files.address in str(caught.value)


def test_other_bytes_than_published_are_refused(files, network):
    network(lambda url, file: Path(file).write_text("<html>Sign in</html>"))
    with pytest.raises(DataUnavailableError, match="hash"):
        files.locate("b.csv")


def test_available_tries_the_network_once(files, network):
    calls = network(no_network)
    assert [files.available() for _ in range(3)] == [False] * 3
    assert len(calls) == 1

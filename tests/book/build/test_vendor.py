import base64
import hashlib
import tarfile

import pytest

from book.build import vendor
from softgrip.errors import DataFileError


def test_archive_with_another_digest_is_refused(tmp_path):
    archive = tmp_path / "package.tgz"
    archive.write_bytes(b"what came")
    good = "sha512-" + base64.b64encode(hashlib.sha512(b"what came").digest()).decode()
    vendor.check(archive, good)
    archive.write_bytes(b"what comes too")
    with pytest.raises(DataFileError, match=r"package\.tgz: expected digest"):
        vendor.check(archive, good)


def test_without_npm_the_folder_stays_empty_and_is_tried_again(tmp_path, monkeypatch):
    def unreachable(package, folder):
        raise vendor.UnreachableError(package.name)

    monkeypatch.setattr(vendor, "_pack", unreachable)
    assert not vendor.ensure(tmp_path / "vendor")
    assert list((tmp_path / "vendor").iterdir()) == []
    assert not vendor.ensure(tmp_path / "vendor")


def test_what_is_there_is_not_fetched_again(tmp_path, monkeypatch):
    fetched = []
    monkeypatch.setattr(vendor, "_install", lambda package, place: fetched.append(package.name))
    assert vendor.ensure(tmp_path)
    assert vendor.ensure(tmp_path)
    assert fetched == [package.name for package in vendor.PACKAGES]


@pytest.mark.parametrize("filters", [True, False])
@pytest.mark.filterwarnings("ignore:Python 3.14 will, by default, filter:DeprecationWarning")
def test_archives_are_unpacked_on_pythons_without_filters(tmp_path, monkeypatch, filters):
    (tmp_path / "main.js").write_text("1")
    with tarfile.open(tmp_path / "package.tgz", "w:gz") as tar:
        tar.add(tmp_path / "main.js", "package/main.js")
    if not filters:
        monkeypatch.delattr(tarfile, "data_filter", raising=False)
    vendor.unpack(tmp_path / "package.tgz", tmp_path / "out")
    assert (tmp_path / "out/package/main.js").read_text() == "1"

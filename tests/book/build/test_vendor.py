import base64
import hashlib

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

"""The citation names the edition that is here, and has what its format asks for."""

import re
import tomllib

import pytest
import yaml

import softgrip


@pytest.fixture(scope="module")
def cited(root):
    return yaml.safe_load((root / "CITATION.cff").read_text(encoding="utf-8"))


def test_version_and_licence_are_those_of_the_package(cited, root):
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert str(cited["version"]) == project["version"] == softgrip.__version__
    assert cited["license"] == project["license"]


def test_it_has_a_date_if_and_only_if_the_version_is_released(cited, root):
    latest = re.search(r"^## (\S+) \((.+)\)$", (root / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert latest[1] == str(cited["version"])
    released = latest[2] != "unreleased"
    assert ("date-released" in cited) == released
    assert not released or str(cited["date-released"]) == latest[2]


def test_it_has_what_the_format_asks_for(cited):
    # Required by the schema of version 1.2.0, of the whole and of each reference.
    assert cited["cff-version"] == "1.2.0"
    assert {"authors", "message", "title"} <= cited.keys()
    for reference in cited["references"]:
        assert {"authors", "title", "type"} <= reference.keys()
    # It must promise no address that is not there.
    assert not {"doi", "url", "repository-code", "identifiers"} & cited.keys()


def test_the_works_it_recomputes_are_those_of_the_book(cited, root):
    text = (root / "book" / "references.bib").read_text(encoding="utf-8")
    dois = [one["doi"] for one in cited["references"] if "doi" in one]
    assert dois
    assert all(doi in text for doi in dois)

"""The public tensile tests: which files they are, and where they are asked for."""

import pytest

from softgrip.errors import DataUnavailableError, UnknownNameError
from softgrip.materials import database, tensile
from softgrip.materials.table import table_5_1


@pytest.fixture
def empty_folder(monkeypatch, tmp_path):
    monkeypatch.setenv("SOFTGRIP_MATERIALS_DIR", str(tmp_path))


def test_every_material_of_the_table_has_a_file():
    assert set(database.SHA256) == set(table_5_1())
    assert len(set(database.FILES.sha256.values())) == len(table_5_1())


def test_unknown_material_lists_the_valid_ones():
    with pytest.raises(UnknownNameError, match="'Ecoflex'; valid are: Dragon Skin 10 MEDIUM"):
        tensile.load("Ecoflex")


@pytest.mark.usefixtures("empty_folder")
def test_a_material_is_asked_for_by_the_name_of_its_file():
    with pytest.raises(DataUnavailableError, match=r"has no file 'SortaClear 40\.csv'"):
        tensile.load("SORTA-Clear 40")


@pytest.mark.usefixtures("empty_folder")
def test_wrong_folder_does_not_pass_for_missing_data():
    with pytest.raises(DataUnavailableError, match="SOFTGRIP_MATERIALS_DIR"):
        tensile.available()


@pytest.mark.usefixtures("tensile_tests")
def test_a_test_bears_the_name_of_its_material():
    assert tensile.load("Ecoflex 00-30").name == "Ecoflex 00-30"

"""Tensile tests as testers export them: any material, force and extension or stress and strain.

Names and units are found in the header, or given. What is read is the first loading, from where the
specimen takes load; what was done to come there is said in `Export.notes`.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np

from softgrip.arrays import LARGEST_STRAIN, Floats
from softgrip.errors import InvalidInputError
from softgrip.materials.first_loading import Zero, first_loading
from softgrip.materials.tensile import FEWEST_ROWS, SOFTEST, TensileTest
from softgrip.materials.tester_columns import UNITS, column, misfit
from softgrip.materials.tester_sizes import area as area_of
from softgrip.materials.tester_sizes import size
from softgrip.quantities import expected_units
from softgrip.text_table import TextTable, read_table

PROPORTIONAL = 0.02
"""Share of the largest stress by which force over area may differ from a stress that is
engineering."""


@dataclass(frozen=True, eq=False)
class Export:
    """A test that was read, and what was done to it.

    Attributes:
        test: First loading; engineering strain and stress, and true ones of a solid that keeps its
            volume.
        preload, preload_error: Stress that was taken off, and its standard error, Pa.
        slack: Strain that was taken off, dimensionless.
        notes: What was found, taken, and left out, one sentence each.
    """

    test: TensileTest
    preload: float
    preload_error: float
    slack: float
    notes: tuple[str, ...]


def read_export(
    path: Path | str,
    *,
    columns: Mapping[str, str] = MappingProxyType({}),
    gauge_length: float | str | None = None,
    area: float | str | None = None,
    zero: Zero | None = None,
    compression_positive: bool = False,
) -> Export:
    """Read a tester's export.

    Args:
        path: Of a text file; see `read_table` for what it may be like.
        columns: Headings by what they are, such as ``{"force": "F [N]"}``; see
            `tester_columns.column`.
        gauge_length: First length of what is stretched, m, or words such as ``"30 mm"``; not needed
            with a column of strain, or if the file says it. If given, the extension is used.
        area: First cross-section, m^2, or words; likewise.
        zero: What the strain is counted from; see `first_loading`.
        compression_positive: Whether the tester counts compression above zero.

    Raises:
        DataFileError: If a column, a unit or a size is missing, or the record cannot be used; it
            says what is expected and what there is.
        InvalidInputError: If a size is not above zero.

    >>> found = read_export("rubber.csv", gauge_length="30 mm", area="12 mm^2")  # doctest: +SKIP
    """
    table = read_table(path)
    notes = list(table.notes)
    strain = _strain(table, columns, gauge_length, notes)
    # Some turn the force only.
    if compression_positive and strain.max() - strain[0] <= strain[0] - strain.min():
        strain = -strain
    if np.any(strain <= -1):
        raise table.refusal(
            "strains above -1, where nothing would be left of the sample: does the tester count "
            "compression above zero (compression_positive)?",
            f"{float(strain.min()):.4g}",
        )
    stress = _stress(table, columns, area, strain, notes) * (-1 if compression_positive else 1)
    if np.ptp(strain) > LARGEST_STRAIN:
        raise table.refusal(
            f"strains of up to {LARGEST_STRAIN:g}: is the gauge length right, and the unit?",
            f"a range of {np.ptp(strain):.4g}",
        )
    stiffness = float(np.ptp(stress) / np.ptp(strain)) if np.ptp(strain) else SOFTEST
    if stiffness < SOFTEST:
        raise table.refusal(
            f"{SOFTEST:g} Pa or more over the whole strain: are the units right, and is the strain "
            "in %?",
            f"{stiffness:.3g} Pa",
        )
    try:
        first = first_loading(strain, stress, zero=zero)
    except InvalidInputError as error:
        raise table.refusal("a pull", str(error)) from None
    strain, stress = first.strain, first.stress
    if strain.size < FEWEST_ROWS:
        raise table.refusal(f"{FEWEST_ROWS} rows of a first loading or more", f"{strain.size}")
    test = TensileTest(Path(path).stem, strain, stress, np.log1p(strain), stress * (1 + strain))
    return Export(test, first.preload, first.preload_error, first.slack, (*notes, *first.notes))


def _strain(
    table: TextTable, columns: Mapping[str, str], length: float | str | None, notes: list[str]
) -> Floats:
    if length is None and "extension" not in columns:
        if found := column(table, columns, "strain"):
            notes.append(f"the strain is {found[0]!r}")
            return found[1]
        if found := column(table, columns, "true strain"):
            notes.append(f"the strain is that of {found[0]!r}, a logarithm")
            return np.expm1(found[1])
    found = column(table, columns, "extension")
    if found is None and length is not None and column(table, columns, "strain"):
        raise table.refusal(
            "a column of extension; for one of strain, leave the gauge length out",
            ", ".join(map(repr, table.headings)),
        )
    if found is None:
        raise _missing(table, "strain, or of extension", "Extension [mm]", "extension")
    gauge, note = size(table, "gauge_length", length)
    if gauge is None:
        raise table.refusal('a gauge length: gauge_length="30 mm", or a line of the file', "none")
    notes.append(f"the strain is {found[0]!r} over {gauge:g} m{note}")
    return found[1] / gauge


def _stress(
    table: TextTable,
    columns: Mapping[str, str],
    section: float | str | None,
    strain: Floats,
    notes: list[str],
) -> Floats:
    force = column(table, columns, "force")
    if section is None and "force" not in columns:
        if found := column(table, columns, "stress"):
            if force:
                _check_engineering(table, found[1], force[1])
            notes.append(f"the stress is {found[0]!r}")
            return found[1]
        if not force and (found := column(table, columns, "true stress")):
            notes.append(f"the stress is {found[0]!r} over 1 + strain, of a solid of one volume")
            return found[1] / (1 + strain)
    if force is None:
        raise _missing(table, "engineering stress, or of force", "Force [N]", "force")
    cross, note = area_of(table, section)
    if cross is None:
        raise table.refusal('a cross-section: area="12 mm^2", or lines of the file', "none")
    notes.append(f"the stress is {force[0]!r} over {cross:g} m^2{note}")
    return force[1] / cross


def _check_engineering(table: TextTable, stress: Floats, force: Floats) -> None:
    """Refuse a stress that is not the force on one area: a true one without its name."""
    if not force.any():
        return
    force = force / np.abs(force).max()  # the square of a tiny one would be zero
    apart = np.abs(stress - force * float(force @ stress / (force @ force)))
    if apart.max() > PROPORTIONAL * np.abs(stress).max():
        raise table.refusal(
            "a stress on the first area, in proportion to the force: name another by columns=",
            "one that is not, as true stress",
        )


def _missing(table: TextTable, what: str, such: str, key: str) -> Exception:
    if other := misfit(table, key):
        return table.refusal(f"{other!r} as {expected_units(UNITS[key])}", "another unit")
    return table.refusal(
        f'a column of {what}, such as {such!r}; columns={{"{key}": ...}} names another',
        ", ".join(map(repr, table.headings)),
    )

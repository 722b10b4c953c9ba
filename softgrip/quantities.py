"""Units of what comes from elsewhere, into SI by the dimension that is wanted.

The conversions are those of `pint`, whose registry is made on first use. Two things differ from its
defaults. An angle and a count are dimensions here, so that a count is no radian and a hertz no
rad/s. And a unit outside the span of the usual ones is taken for a slip: a pressure in mPa or Mbar
is one in MPa or mbar.
"""

import re
from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, floats, is_symbol, one_number
from softgrip.errors import InvalidInputError, UnknownNameError

if TYPE_CHECKING:
    from pint import UnitRegistry

DIMENSIONS: Mapping[str, tuple[str, str]] = {
    "s": ("time", "s ms us min h"),
    "Hz": ("frequency", "Hz kHz 1/s 1/min"),
    "rad": ("angle", "rad mrad deg ° rev"),
    "rad/s": ("speed of rotation", "rad/s deg/s °/s rpm rev/s rev/min"),
    "m": ("length", "m cm mm um in ft"),
    "m^2": ("area", "m^2 cm^2 mm^2 in^2"),
    "m^3": ("volume", "m^3 L mL uL cm^3 mm^3 in^3"),
    "m/s": ("speed", "m/s cm/s mm/s um/s mm/min in/min"),
    "m^3/s": ("flow", "m^3/s L/s L/min mL/s mL/min uL/s uL/min cm^3/s mm^3/s"),
    "Pa": (
        "pressure",
        "Pa hPa kPa MPa GPa mbar bar psi psig barg mmHg torr inHg cmH2O inH2O atm N/mm^2 kgf/cm^2",
    ),
    "N": ("force", "N mN uN kN gf kgf lbf ozf"),
    "N m": ("torque", "N·m mN·m N·mm kgf·cm"),
    "N/m": ("stiffness", "N/m N/mm mN/m kN/m"),
    "Pa s": ("viscosity", "Pa·s mPa·s cP P"),
    "kg": ("mass", "kg g mg lb oz"),
    "kg/m^3": ("density", "kg/m^3 g/cm^3 g/mL"),
    "K": ("temperature", "K degC °C degF °F"),
    "V": ("voltage", "V mV uV kV"),
    "A": ("current", "A mA uA"),
    "ohm": ("resistance", "ohm kohm Mohm Ω kΩ MΩ"),
    "count": ("count of a converter", "count counts LSB"),
    "1": ("share", "1 % percent m/m mm/mm in/in microstrain"),
}
"""What is measured, and the usual units of it, by its SI unit."""

_UNIT = re.compile(
    # A product of powers, without numbers that would have to be computed first.
    r"(?:1|{word})(?:[ */·.]{word})*".format(word=r"[^\W\d]+(?:2O)?(?:\^-?[1-4])?|%|°[^\W\d]?")
)
_LONGEST = 60
_OWN = (
    "radian = [angle] = rad",
    "count = [count] = count = counts = LSB",
    "rev = revolution",
    "r = revolution",  # r/min, as data sheets of motors have it
    "psig = psi",  # above the atmosphere, as each pressure here
    "barg = bar",
)


@lru_cache(maxsize=1)
def _registry() -> "UnitRegistry[Any]":
    # pint takes a second to import, which nothing needs that is in SI already.
    from importlib.resources import files

    from pint import UnitRegistry

    # What is known of a unit is computed when it is loaded with the registry: the angle would then
    # keep none, so the definitions come one after the other.
    made: UnitRegistry[Any] = UnitRegistry(None, on_redefinition="ignore")
    made.load_definitions(str(files("pint") / "default_en.txt"))
    for line in _OWN:
        made.define(line)
    return made


def usual_units(wanted: str) -> tuple[str, ...]:
    """Return the usual units of a dimension, given by its SI unit.

    >>> usual_units("rad/s")
    ('rad/s', 'deg/s', '°/s', 'rpm', 'rev/s', 'rev/min')
    """
    return tuple(_dimension(wanted)[1].split())


def _dimension(wanted: str) -> tuple[str, str]:
    if wanted not in DIMENSIONS:
        raise UnknownNameError("SI unit", wanted, list(DIMENSIONS))
    return DIMENSIONS[wanted]


def expected_units(wanted: str) -> str:
    """Say in which units a dimension may be, for an error.

    >>> expected_units("rad")
    'an angle: rad, mrad, deg, °, rev'
    """
    dimension, _ = _dimension(wanted)
    article = "an" if dimension[0] in "aeiou" else "a"
    return f"{article} {dimension}: {', '.join(usual_units(wanted))}"


def _plain(unit: str) -> str:
    """Return a unit as `pint` reads it: powers by a caret, one sign for each."""
    text = unit.strip().replace("**", "^").replace("²", "^2").replace("³", "^3")
    text = text.replace("º", "°").replace("\u2126", "Ω").replace("µ", "u").replace("μ", "u")
    # A point between letters is a product, which `pint` 0.26, unlike 0.25, does not read.
    text = re.sub(r"(?<=[^\W\d])\.(?=[^\W\d])", "·", text)
    text = re.sub(r"\s*([*/·^])\s*", r"\1", text)
    return re.sub(r"(?<=[^\W\d])([23])(?![\w])", r"^\1", text)


@lru_cache(maxsize=256)
def _parsed(unit: str, wanted: str) -> Any:
    """Return a unit of the registry, or None if it is not one of the dimension wanted."""
    registry = _registry()
    if not _UNIT.fullmatch(unit) or len(unit) > _LONGEST:
        return None
    try:
        found = registry.parse_units(unit)
        same = found.dimensionality == registry.parse_units(_plain(wanted)).dimensionality
    except Exception:  # whatever a word of a stranger makes of pint's parser
        return None
    return found if same else None


def _factor(unit: Any, wanted: str) -> float:
    registry = _registry()
    one, none = (registry.Quantity(x, unit).to(_plain(wanted)).magnitude for x in (1.0, 0.0))
    return float(one - none)


@lru_cache(maxsize=64)
def _span(wanted: str) -> tuple[float, float]:
    """Return the smallest and the largest of the usual units."""
    factors = [_factor(_parsed(_plain(unit), wanted), wanted) for unit in usual_units(wanted)]
    return min(factors), max(factors)


@lru_cache(maxsize=256)
def _found(unit: str, wanted: str) -> Any:
    """Return the unit that is meant, or None."""
    text = _plain(unit)
    found = _parsed(text, wanted)
    if found is None:
        # Another case is a slip, but not where a milli would become a mega.
        alike = [
            usual
            for usual in map(_plain, usual_units(wanted))
            if usual.casefold() == text.casefold()
            and (usual[0] == text[0] or usual[0].casefold() != "m" or len(usual) == 1)
        ]
        found = _parsed(alike[0], wanted) if len(alike) == 1 else None
    if found is None:
        return None
    low, high = _span(wanted)
    return found if 0.999 * low <= _factor(found, wanted) <= 1.001 * high else None


def is_unit(text: str) -> bool:
    """Tell whether words are one of the usual units, in any case; `pint` is not asked.

    >>> [is_unit(text) for text in ("mm", "MPA", "N/mm2", "tensile", "-")]
    [True, True, True, False, True]
    """
    return text.strip() in ("", "-", "—") or _plain(text).casefold() in _all_usual()


@lru_cache(maxsize=1)
def _all_usual() -> frozenset[str]:
    more = "sec secs second seconds minutes degree degrees rps m3/h n*m n*mm pa.s mpa.s pas mpas"
    more += " inch inches ksi"
    usual = " ".join(units for _, units in DIMENSIONS.values())
    return frozenset(_plain(unit).casefold() for unit in f"{usual} {more}".split())


def convert(values: ArrayLike, unit: str, wanted: str, *, name: str = "unit") -> Floats:
    """Return values in SI.

    Args:
        values: Numbers in the unit.
        unit: As a file has it, such as ``psi``, ``kgf/cm2`` or ``°``.
        wanted: SI unit of the dimension that is wanted, one of `DIMENSIONS`.
        name: Of the column or argument, for the error.

    Raises:
        InvalidInputError: If the unit is not known, not one of that dimension, or so far from the
            usual ones that another prefix was meant.

    >>> convert([0.0, 14.5], "psi", "Pa").round().tolist()
    [0.0, 99974.0]
    """
    (found,) = floats(**{name: values})
    if not isinstance(unit, str):
        raise InvalidInputError(name, expected=expected_units(wanted), got=unit)
    if unit == wanted:
        return found
    meant = _found(unit, wanted)
    if meant is None:
        raise InvalidInputError(name, expected=expected_units(wanted), got=unit)
    registry = _registry()
    return np.asarray(registry.Quantity(found, meant).to(_plain(wanted)).magnitude)


def same_unit(first: str, second: str) -> bool:
    """Tell whether two spellings are one unit.

    >>> same_unit("N/mm2", "MPa"), same_unit("s", "ms"), same_unit("my own", "My own")
    (True, False, True)
    """
    if first.casefold() == second.casefold():
        return True
    try:
        wanted = si_unit(first)
        one, other = (float(convert(1.0, unit, wanted)) for unit in (first, second))
    except InvalidInputError:
        return False
    return abs(one - other) <= 1e-9 * abs(one)


def si_unit(unit: str, *, name: str = "unit") -> str:
    """Return the SI unit of the dimension of a unit: that of a column nobody asked for.

    Raises:
        InvalidInputError: If the unit is of none of `DIMENSIONS`.

    >>> si_unit("mL/min"), si_unit("°")
    ('m^3/s', 'rad')
    """
    for wanted in DIMENSIONS:
        if unit == wanted or _found(unit, wanted) is not None:
            return wanted
    dimensions = ", ".join(f"{what} ({si})" for si, (what, _) in DIMENSIONS.items())
    raise InvalidInputError(name, expected=f"a unit of one of: {dimensions}", got=unit)


_WORDS = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")


def fields_in_si(record: object, units: Mapping[str, str]) -> None:
    """Put the fields of a frozen dataclass into SI, as its ``__post_init__`` does; see `in_si`.

    Args:
        record: The dataclass.
        units: SI unit of each field, by its name; a field may be a tuple of quantities.

    Raises:
        InvalidInputError: As of `in_si`.
    """
    for name, unit in units.items():
        given = getattr(record, name)
        several = isinstance(given, tuple | list)
        found = tuple(in_si(name, one, unit) for one in given) if several else None
        object.__setattr__(record, name, found or in_si(name, given, unit))


def in_si(name: str, value: object, wanted: str) -> float:
    """Return a quantity that a caller gives, in SI.

    Args:
        name: Of the argument, for the error.
        value: A number, which is in SI; words such as ``"20 kPa"``; or a quantity of `pint`.
        wanted: SI unit of the dimension that is wanted, one of `DIMENSIONS`.

    Raises:
        InvalidInputError: If it is none of these, or of another dimension.

    >>> in_si("pressure", "20 kPa", "Pa"), in_si("pressure", 20e3, "Pa")
    (20000.0, 20000.0)
    """
    number, unit = value, wanted
    if is_symbol(value):
        return value  # type: ignore[return-value]
    if isinstance(value, str):
        words = _WORDS.fullmatch(value)
        if words is None:
            raise InvalidInputError(
                name, expected=f"a number, a blank and {expected_units(wanted)}", got=value
            )
        number, unit = words.groups()
    elif hasattr(value, "magnitude") and hasattr(value, "units"):
        number, unit = value.magnitude, str(value.units)
    try:
        (found,) = one_number(**{name: number})  # type: ignore[arg-type]
    except InvalidInputError:
        raise InvalidInputError(name, expected=f"a finite number in {wanted}", got=value) from None
    return float(convert(found, unit, wanted, name=name))

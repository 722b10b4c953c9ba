#!/usr/bin/env bash
# Units, pint: a product written with a point is one in 0.25, and a syntax error in 0.26.
#
# Guess: "N.m" and "mPa.s" are products in every pint, as UCUM and the exports of testers and
#        viscometers write them, and as 0.25 reads them. (Guessed of 0.26 before it was tried there.)
# Seen:  0.25.3 gives meter * newton and millipascal * second; 0.26.2 raises DefinitionSyntaxError,
#        unknown operator '.'. A lock for several Pythons brings one or the other by the Python, as
#        0.26 wants 3.12: the same file is then read on 3.11 and refused on 3.13. A middle dot (U+00B7)
#        is a product in both.
# Meets: who reads units from instruments' files, on more than one Python.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
cat >"$folder/units.py" <<'PY'
import pint

registry = pint.UnitRegistry()
for text in ("N.m", "mPa.s", "N·m", "mPa·s"):
    try:
        print(pint.__version__, text, "is", registry.parse_units(text))
    except pint.errors.DefinitionSyntaxError as error:
        print(pint.__version__, text, "is refused:", error)
PY
for version in 0.25.3 0.26.2; do
  "${PYTHON:-python3}" -m venv "$folder/$version" # 3.12 or newer
  "$folder/$version/bin/pip" install -q --disable-pip-version-check "pint==$version"
  "$folder/$version/bin/python" "$folder/units.py"
done | tee "$folder/seen"
grep -q "^0.25.3 N.m is meter \* newton" "$folder/seen"
grep -q "^0.25.3 mPa.s is millipascal \* second" "$folder/seen"
grep -q "^0.26.2 N.m is refused: unknown operator '.'" "$folder/seen"
grep -q "^0.26.2 mPa·s is millipascal \* second" "$folder/seen"

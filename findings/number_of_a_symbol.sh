#!/usr/bin/env bash
# Symbols, CasADi: a function of the math module takes a symbol SX for NaN, and says nothing.
#
# Guess: math.sqrt(x) and float(x) of a symbol raise, as int(x) does, and as both do for an MX.
# Seen:  3.8.2 gives NaN. A law that asks for the number somewhere inside is then recorded as a
#        constant, or takes one branch of every comparison.
# Meets: who runs a function that was written for floats on symbols, to see whether it can be translated.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check casadi==3.8.2 "numpy==2.3.5"
"$folder/venv/bin/python" -W ignore - <<'PY' | tee "$folder/seen"
import math

import casadi as ca


def told(ask, symbol):
    try:
        return ask(symbol)
    except (RuntimeError, TypeError):
        return "refused"


for kind in (ca.SX, ca.MX):
    x = kind.sym("x")
    print(f"{kind.__name__}:", *(told(ask, x) for ask in (math.sqrt, float, int)))
PY
grep -q "^SX: nan nan refused" "$folder/seen"
grep -q "^MX: refused refused refused" "$folder/seen"

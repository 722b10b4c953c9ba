#!/usr/bin/env bash
# Symbols, CasADi: in the mode that its own warning recommends, an array times a symbol has another
# shape than the symbol times the array.
#
# Guess: np.linspace(0, 1, 4) * x and x * np.linspace(0, 1, 4) have one shape, and the last of the
#        four elements is [-1] of both: the mode is for "shape-correct" results.
# Seen:  3.8.2 warns of its legacy mode, where both are columns (4, 1). With setNumpyMode(1), as the
#        warning says, the array first gives a row (1, 4), whose [-1] is that whole row, and the symbol
#        first a column (4, 1). No error: the last element of a curve is silently all of it.
# Meets: who writes one function for NumPy arrays and CasADi symbols, and follows the warning.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check casadi==3.8.2 "numpy==2.3.5"
"$folder/venv/bin/python" -W ignore - <<'PY' | tee "$folder/seen"
import casadi as ca
import numpy as np

x, grid = ca.SX.sym("x"), np.linspace(0, 1, 4)
for mode in (-1, 1):
    ca.GlobalOptions.setNumpyMode(mode)
    first, last = grid * x, x * grid
    print(f"mode {mode}: array first {first.shape}, [-1] {np.shape(first[-1])};",
          f"symbol first {last.shape}, [-1] {np.shape(last[-1])}")
PY
grep -q "^mode -1: array first (4, 1), \[-1\] (1, 1); symbol first (4, 1), \[-1\] (1, 1)" "$folder/seen"
grep -q "^mode 1: array first (1, 4), \[-1\] (4, 1); symbol first (4, 1), \[-1\] (1, 1)" "$folder/seen"

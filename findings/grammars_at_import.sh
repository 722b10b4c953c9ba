#!/usr/bin/env bash
# JSON schemas, jsonschema with its extra "format-nongpl": the import alone takes over a second.
#
# Guess: a checker of formats costs nothing until a schema asks for one; the extra adds some files,
#        and the import takes as long as without, a tenth of a second or two.
# Seen:  4.26.0 imports rfc3987-syntax 1.1.0, which, when it is imported, compiles a grammar of its own
#        with lark for each of 38 parts of an address: several times as long as all the rest.
# Meets: who runs a short command again and again where jupyter-server is installed, which asks for the
#        extra: each jupyter, jupyter-book or Sphinx with it pays, though no schema has an address.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check "jsonschema[format-nongpl]==4.26.0" \
  rfc3987-syntax==1.1.0 lark==1.3.1
cat > "$folder/look.py" <<'PY'
import subprocess
import sys

CODE = """
import sys, time
if "without" in sys.argv:
    sys.modules["rfc3987_syntax"] = None
start = time.process_time()
import jsonschema
print(time.process_time() - start)
lark = sys.modules.get("lark")
"""


def seconds(*words):
    command = [sys.executable, "-c", CODE, *words]
    return min(float(subprocess.check_output(command)) for _ in range(4))


with_it, without = seconds(), seconds("without")
print(f"import jsonschema: {with_it:.2f} s of computing, {without:.2f} s without rfc3987-syntax")
print("at least three times as long" if with_it > 3 * without else "about as long")
PY
"$folder/venv/bin/python" "$folder/look.py" | tee "$folder/seen"
grep -qx "at least three times as long" "$folder/seen"

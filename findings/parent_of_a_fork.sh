#!/usr/bin/env bash
# Kernels, ipykernel: JPY_PARENT_PID is read when the module is imported, not when a kernel starts.
#
# Guess: who sets the variable, as jupyter_client does for each kernel, and then makes the application
#        gives it the parent to watch; whether the module had been imported before does not matter.
# Seen:  7.4.0 takes it as the default of a trait when the class is made. Set later it is ignored:
#        the kernel has no parent to watch, outlives it, and prints how to connect to it. The option
#        --IPKernelApp.parent_handle is read when the kernel starts.
# Meets: who forks kernels from a process that has imported the libraries already, to start faster.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check ipykernel==7.4.0
cat > "$folder/look.py" <<'PY'
import os
import sys

before = "before" in sys.argv
if before:
    os.environ["JPY_PARENT_PID"] = "4242"
else:
    os.environ.pop("JPY_PARENT_PID", None)
from ipykernel.kernelapp import IPKernelApp

os.environ["JPY_PARENT_PID"] = "4242"
app = IPKernelApp()
word = "before" if before else "after"
print(f"set {word} the import: parent {app.parent_handle}")
app.parse_command_line(["--IPKernelApp.parent_handle=77"])
print(f"set {word} the import, with the option: parent {app.parent_handle}")
PY
for when in before after; do "$folder/venv/bin/python" "$folder/look.py" $when; done | tee "$folder/seen"
grep -qx "set before the import: parent 4242" "$folder/seen"
grep -qx "set after the import: parent 0" "$folder/seen"
grep -qx "set after the import, with the option: parent 77" "$folder/seen"

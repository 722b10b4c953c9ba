"""A page's trace holds the files that it used, and tells when one of them has changed."""

import json
import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from book.build import tracing

AROUND = {"python": "3"}


def run(code, trace, root):
    code = f"from book.build import tracing\ntracing.record({str(trace)!r})\n{code}"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=root, env=os.environ)
    return set(json.loads(trace.read_text()))


def test_modules_and_data_files_that_were_used_are_recorded(tmp_path, root):
    files = run(
        "from softgrip.materials import table; table.table_5_1()", tmp_path / "t.json", root
    )
    assert {"softgrip/materials/table.py", "data/materials/table_5_1.csv"} <= files
    assert "softgrip/materials/tensile.py" not in files
    assert not [name for name in files if name.startswith("book/build")]


def test_what_was_not_used_is_not_recorded(tmp_path, root):
    assert run("import softgrip.units", tmp_path / "t.json", root) == {
        "softgrip/__init__.py",
        "softgrip/reads.py",  # which listens
        "softgrip/units.py",
    }


def test_a_kernel_that_is_killed_has_recorded_its_cells(tmp_path, root):
    trace = tmp_path / "t.json"
    trace.write_text("of an earlier process")
    cells = [
        f"from book.build import tracing; tracing.record({str(trace)!r})",
        "import softgrip.units",
        "import os; os._exit(9)",
    ]
    code = (
        "from IPython.core.interactiveshell import InteractiveShell\n"
        f"shell = InteractiveShell.instance()\nfor cell in {cells!r}: shell.run_cell(cell)"
    )
    ended = subprocess.run([sys.executable, "-c", code], cwd=root, env=os.environ)
    assert ended.returncode == 9
    assert "softgrip/units.py" in json.loads(trace.read_text())


def test_files_that_a_thread_opens_meanwhile_do_no_harm(tmp_path, monkeypatch):
    hooks = []
    monkeypatch.setattr(tracing.reads, "listen", lambda note, *_: hooks.append(note))
    monkeypatch.setattr(tracing.atexit, "register", hooks.append)
    monkeypatch.setattr(tracing, "get_ipython", lambda: None)
    tracing.record(str(tmp_path / "t.json"))
    note, write = hooks
    ended = threading.Event()

    def open_files():
        number = 0
        while not ended.is_set():
            note(Path(f"/nowhere/{(number := number + 1)}"))
            ended.wait(1e-5)  # else there are millions, and to sort them takes a minute

    # Another thread comes in between any two steps, not every 5 ms.
    usual = sys.getswitchinterval()
    sys.setswitchinterval(1e-4)
    thread = threading.Thread(target=open_files)
    thread.start()
    try:
        for _ in range(3):
            write()
    finally:
        ended.set()
        thread.join()
        sys.setswitchinterval(usual)
    assert (tmp_path / "t.json").exists()


def test_listed_folder_is_recorded(tmp_path, root):
    code = "from book.companion.claims import read_claims; read_claims()"
    assert "data/claims" in run(code, tmp_path / "t.json", root)


def test_new_file_in_a_listed_folder_changes_its_digest(tmp_path):
    before = tracing.digest(tmp_path)
    (tmp_path / "chapter_9.toml").write_text("")
    assert tracing.digest(tmp_path) != before


@pytest.fixture
def trace(tmp_path, monkeypatch):
    monkeypatch.setattr(tracing, "ROOT", tmp_path)
    source = tmp_path / "softgrip" / "a.py"
    source.parent.mkdir()
    source.write_text("A = 1\n")
    path = tmp_path / "page.json"
    path.write_text(json.dumps({"softgrip/a.py": tracing.digest(source)}))
    path.with_suffix(".context.json").write_text(json.dumps(AROUND))
    return path


def test_trace_holds_while_nothing_changes(trace):
    assert tracing.is_current(trace, AROUND)


def test_changed_file_makes_the_page_stale(trace, tmp_path):
    (tmp_path / "softgrip" / "a.py").write_text("A = 2\n")
    assert not tracing.is_current(trace, AROUND)


def test_removed_file_makes_the_page_stale(trace, tmp_path):
    (tmp_path / "softgrip" / "a.py").unlink()
    assert not tracing.is_current(trace, AROUND)


def test_other_surroundings_make_the_page_stale(trace):
    assert not tracing.is_current(trace, AROUND | {"python": "4"})


def test_page_without_a_trace_is_stale(tmp_path):
    assert not tracing.is_current(tmp_path / "none.json", AROUND)

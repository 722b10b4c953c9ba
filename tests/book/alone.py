"""``python -m tests.book.alone FOLDER``: each exhibit, made and saved with nothing in memory.

Each is made in a process of its own, which has imported everything and computed nothing. The files
that it opens are heard by a hook of our own, and printed as JSON: by title, below ``data/``.
"""

import json
import multiprocessing
import os
import sys
from pathlib import Path

from book.companion.exhibit import exhibits
from book.companion.save import save
from softgrip.provenance import data_folder

DATA = data_folder().resolve()
OPENED: set[str] = set()


def hear(event, args):
    if event == "open" and isinstance(args[0], str | os.PathLike):
        OPENED.add(os.path.realpath(args[0]))


def read_by(index):
    OPENED.clear()
    save(ITEMS[index], Path(sys.argv[1]))
    return sorted(os.path.relpath(path, DATA) for path in OPENED if path.startswith(f"{DATA}/"))


if __name__ == "__main__":
    sys.addaudithook(hear)
    ITEMS = exhibits()
    imported = [path for path in OPENED if path.startswith(f"{DATA}/")]
    with multiprocessing.get_context("fork").Pool(os.cpu_count(), maxtasksperchild=1) as pool:
        found = pool.map(read_by, range(len(ITEMS)), chunksize=1)
    titles = [item.title for item in ITEMS]
    print(json.dumps({"an import": imported, **dict(zip(titles, found, strict=True))}))

"""``python -m book.companion.figures [NAME ...]``: write figures and tables into a folder.

Without a name all are written; a name is a title ("Figure 5.1") or a file's name ("figure-5-1").
"""

import argparse
from pathlib import Path

from book.companion.exhibit import exhibit, exhibits
from book.companion.save import save


def _title(name: str) -> str:
    kind, _, number = name.replace(" ", "-").partition("-")
    return f"{kind} {number.replace('-', '.')}"


def main() -> None:
    """Write the exhibits that are asked for, and say where."""
    parser = argparse.ArgumentParser(prog="python -m book.companion.figures", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--into", type=Path, default=Path("book/_build/figures"), metavar="FOLDER")
    asked = parser.parse_args()
    for item in [exhibit(_title(name)) for name in asked.names] or exhibits():
        seconds = save(item, asked.into).seconds
        print(f"{item.title:12} {seconds:6.2f} s  {asked.into / item.name}")


if __name__ == "__main__":
    main()

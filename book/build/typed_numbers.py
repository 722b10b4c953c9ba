"""Numbers that are typed in prose: an error of the build, as they are to be computed or a claim's.

A page sets what a claim prints by the role ``claim``, and what is computed by ``glue:text``.
"""

import re
from collections.abc import Iterator
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.util import logging

logger = logging.getLogger(__name__)

LIST = r"(?:(?:,| and| to| or|-) ?\(?[\d.]+\w?\)?)*"
NOT_NUMBERS = re.compile(
    # Computed, code, symbols, links, HTML; then what has a number for a name: places of the
    # dissertation, materials, parts, versions, dates, preprints.
    r"\{\{ \S+ \}\}|\{[\w:]+\}`[^`]*`|`[^`]*`|\$[^$]*\$|\]\([^)]*\)|<[^>]*>"
    r"|(?:Sections?|Chapters?|Figures?|Tables?|Eqs?\.|Theorem|Assumption|Remark|Task)"
    rf" \(?[\d.]+\w?\)?{LIST}"
    rf"|(?:Designs?|SPA|Variances?|[Rr]ows?|[Pp]arts?) \d{LIST}"
    r"|Ecoflex™? \d\d-\d\d|Dragon Skin \d\d|Mold Star \d\d\w*|SORTA-Clear \d\d"
    r"|(?:NEMA|MEGA|Mega|Python|version) [\d.]+|\b[A-Za-z]+_?\d\w*\b"
    r"|\b(?:In|\d\d? [A-Z][a-z]+) (?:19|20)\d\d\b|\b\d{4}\.\d{5}\b"
)
UNITS = "degrees?|deg|millimet(?:re|er)s?|seconds?|minutes?|percent|times (?:as|too|that|the)"
IN_WORDS = re.compile(
    r"\b(?:two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|\w+teen|twenty|hundred)"
    rf"(?: and a half)? (?:{UNITS})\b"
    r"|\b(?:once|twice) and a half\b|\b(?:two|three|four) (?:thirds|quarters|fifths)\b"
)
PROSE = "admonition|glossary|note|tip|warning"
"""Directives whose content is prose."""
NO_PROSE = re.compile(
    rf"\A---\n.*?\n---\n|^ *(`{{3,}})(?!\{{(?:{PROSE})\}})[^`\n]*\n.*?^ *\1$"
    r"|^\$\$$.*?^\$\$[^\n]*$|^ *\d\. ",
    re.DOTALL | re.MULTILINE,
)
"""Front matter, fenced blocks such as cells, displayed equations, numbers of a list's points."""


def typed(text: str) -> list[str]:
    """Return the numbers of a text that stand there as such: figures, and words before a unit.

    >>> typed("within 5 % by Eq. (3.10), as {claim}`5.4-rms` says, ten degrees on")
    ['5', 'ten degrees']
    """
    rest = NOT_NUMBERS.sub("", " ".join(text.split()))
    return re.findall(r"\d[\d.,]*", rest) + IN_WORDS.findall(rest)


def typed_on_page(source: str) -> Iterator[tuple[int, list[str]]]:
    r"""Yield the numbers that are typed in the prose of a page, with the line of each paragraph.

    >>> [*typed_on_page("# A title\n\nWithin\n5 %.\n")]
    [(3, ['5'])]
    """
    # What is no prose leaves its lines behind, so that those of the rest can be told.
    prose = NO_PROSE.sub(lambda found: "\n" * found[0].count("\n"), source)
    for paragraph in re.finditer(r"(?:.+\n?)+", prose):
        if numbers := typed(paragraph[0]):
            yield prose.count("\n", 0, paragraph.start()) + 1, numbers


def check(app: Sphinx, page: str, source: list[str]) -> None:
    """Warn, which is an error of the build, of each number that is typed in a page of Markdown."""
    if Path(app.env.doc2path(page)).suffix == ".md":
        for line, numbers in typed_on_page(source[0]):
            logger.warning(
                "typed in prose: %s. Set it by {claim} or {glue:text}.",
                ", ".join(numbers),
                location=(page, line),
            )


def setup(app: Sphinx) -> None:
    """Connect the check to the reading of pages."""
    app.connect("source-read", check)

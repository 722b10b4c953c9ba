"""What a search finds is read from pages: a document for each thing, its words, its place."""

import json

import pytest

from book.build import search, search_index
from book.build.search_index import Document, Kind, Name, article, documents, index, names, script

PAGE = """
<article class="bd-article"><section id="the-law"><h1>The law<a class="headerlink">#</a></h1>
<p>Stress <span class="math">\\(\\tau\\)</span> grows, as <em>Lud</em>wick says:
  <a class="claim" href="ledger.html#claim-5.2-n">2.365</a>.</p>
<script>ignored</script><div class="provenance"><p>sha256</p></div>
<details class="cell_input"><summary>Show</summary><pre>code()</pre></details>
<div class="math notranslate" id="equation-eq-5-2"><span class="eqno">(5.2)<a
class="headerlink">#</a></span>\\[
\\sigma = E \\varepsilon^{1/n}
\\]</div>
<figure id="fig-5-1"><img alt="Ten panels."><figcaption><p><span class="caption-number">Figure 5.1
</span><span class="caption-text">Ten elastomers.</span><a class="headerlink">#</a></p></figcaption>
</figure>
<section id="below"><h2>Below</h2><p>Softer.</p>
<table id="tab-5-a"><caption><span class="caption-number">Table 5.A </span><span
class="caption-text">Two of them.</span></caption>
<tr><td><p>0.05</p></td><td><p>0.06</p></td></tr></table>
<table><tr><td>7.5</td></tr></table>
</section></section></article>
"""

LEDGER = """
<section id="all"><h1>All</h1><p>Numbers.</p>
<table class="ledger numbers"><thead><tr><th data-sort="what">what</th><th
data-sort="printed">printed</th><th data-sort="recomputed">recomputed</th>
<th data-sort="outcome">outcome</th></tr></thead>
<tbody data-place="Section 5.2"><tr><th colspan="4">Section 5.2</th></tr>
<tr id="claim-5.2-n" data-outcome="open"><td>the power <a class="permalink"
href="ledger.html#claim-5.2-n">#</a><details>Stands on <a href="ledger.html#claim-5.2-m">m</a>
</details></td><td class="number">about 2.365</td><td class="number">2.273</td>
<td><span>◇ open</span></td></tr>
</tbody></table></section>
"""

TERMS = """
<section id="glossary"><h1>Glossary</h1><dl class="simple glossary">
<dt id="term-SPA">SPA<a class="headerlink">#</a></dt><dd><p>A finger of rubber.</p></dd></dl>
</section>
<section id="symbols"><h1>Symbols</h1><table><thead><tr><th>symbol</th><th>means</th></tr></thead>
<tbody><tr><td><span class="math">\\(C_i\\)</span></td><td>capacity</td></tr></tbody></table>
</section>
"""


@pytest.fixture(scope="module")
def found() -> dict[str, Document]:
    """Return the documents of a page by the ends of their places."""
    return {d.place.partition("#")[2]: d for d in documents("five", article(PAGE))}


def test_all_things_of_a_page_are_found_each_at_its_anchor(found):
    assert {place: document.kind for place, document in found.items()} == {
        "the-law": Kind.SECTION,
        "equation-eq-5-2": Kind.EQUATION,
        "fig-5-1": Kind.EXHIBIT,
        "below": Kind.SECTION,
        "tab-5-a": Kind.EXHIBIT,
    }
    assert {document.place.partition("#")[0] for document in found.values()} == {"five.html"}
    assert [found[name].section for name in ("the-law", "below", "fig-5-1", "tab-5-a")] == [
        "",
        "five.html#the-law",
        "five.html#the-law",
        "five.html#below",
    ]


def test_a_section_has_its_own_words_alone(found):
    law, below = found["the-law"], found["below"]
    assert (law.title, law.text) == ("The law", "Stress τ grows, as Ludwick says: 2.365.")
    assert (below.title, below.text) == ("Below", "Softer. 7.5")


def test_an_equation_has_its_number_its_tex_and_the_words_before_it(found):
    equation = found["equation-eq-5-2"]
    assert equation.label == equation.title == "Eq. (5.2)"
    assert equation.more == {"tex": r"\sigma = E \varepsilon^{1/n}"}
    assert equation.text.startswith("Stress τ grows")


def test_an_exhibit_has_caption_cells_and_what_a_picture_tells(found):
    figure, table = found["fig-5-1"], found["tab-5-a"]
    assert (figure.label, figure.text) == ("Figure 5.1", "Ten elastomers. Ten panels.")
    assert (table.label, table.text.strip()) == ("Table 5.A", "Two of them. 0.05 0.06")


def test_a_row_of_the_ledger_is_found_there_and_not_where_it_is_copied():
    section, row = documents("ledger", LEDGER)
    assert section.text == "Numbers."
    assert section.more == {}, "a row that stands on another is no place where that one stands"
    assert (row.kind, row.title, row.label, row.text) == (
        Kind.CLAIM,
        "the power",
        "about 2.365",
        "Section 5.2",
    )
    assert row.place == "ledger.html#claim-5.2-n"
    assert row.more == {"recomputed": "2.273", "outcome": "◇ open"}
    assert [d.kind for d in documents("five", LEDGER)] == [Kind.SECTION]


def test_terms_and_symbols_are_found():
    terms = [d for d in documents("words", TERMS) if d.kind == Kind.TERM]
    assert [(d.title, d.text, d.place) for d in terms] == [
        ("SPA", "A finger of rubber.", "words.html#term-SPA"),
        ("C_i", "capacity", "words.html#symbols"),
    ]


def test_the_index_tells_where_things_are_and_where_numbers_stand():
    pages = {
        "book": [Document(Kind.SECTION, "book.html#book", "Book")],
        "five": documents("five", article(PAGE)),
        "six": [Document(Kind.SECTION, "six.html#six", "Six")],
        "ledger": documents("ledger", LEDGER),
    }
    rows = index(pages, {"six": "five"}, {"5.2": "The stress."})["documents"]
    by_place = {row[1]: row for row in rows}

    def above(place):
        at = by_place[place][3]
        return rows[at][1] if at >= 0 else None

    assert above("five.html#the-law") is None
    assert above("five.html#below") == "five.html#the-law"
    assert above("six.html#six") == "five.html#the-law"
    assert above("ledger.html#claim-5.2-n") == "ledger.html#all"
    assert by_place["five.html#equation-eq-5-2"][4] == "The stress."
    claim = by_place["ledger.html#claim-5.2-n"]
    assert [rows[at][1] for at in claim[6]["stands"]] == ["five.html#the-law"]


def test_names_are_those_of_python_with_what_they_say():
    inventory = {
        "py:function": {"a.f": ("", "", "a.html#a.f", "-")},
        "std:label": {"index": ("", "", "genindex.html", "-")},
    }
    assert names(inventory, {"a.f": "Return it."}) == [Name("function", "a.f", "a", "Return it.")]


def test_no_word_of_an_index_ends_the_script():
    made = {"documents": [["section", "a.html#a", "</script>", -1, "µ", ""]], "names": []}
    text = script(made)
    assert "</" not in text
    assert json.loads(text.removeprefix("window.softgripSearch = ").removesuffix(";\n")) == made


def test_a_page_is_read_again_when_it_or_the_reading_has_changed(tmp_path, monkeypatch):
    read = []

    def build(**sources):
        kept = search.Kept(tmp_path / "kept")
        for name, text in sources.items():
            assert kept.get(name, text, lambda text=text: read.append(text) or [text]) == [text]
        kept.write()

    build(a="1", b="1")
    build(a="1", b="2")
    assert read == ["1", "1", "2"]
    build(a="1")
    build(a="1", b="2")  # what was gone for a while is not kept
    assert read == ["1", "1", "2", "2"]
    other = tmp_path / "other.py"
    other.touch()
    monkeypatch.setattr(search_index, "__file__", str(other))
    build(a="1", b="2")
    assert read == ["1", "1", "2", "2", "1", "2"]
    (tmp_path / "kept").write_bytes(b"cut")
    build(a="1")
    assert read[-1] == "1"


def test_first_lines_are_told_of_modules_classes_and_methods():
    found = search.first_lines()
    assert found["softgrip.units"].startswith("Factors into SI")
    assert found["book.build.search"].startswith("The search:")
    assert found["book.build.search.Kept.get"].startswith("Return what was kept")
    assert "`" not in "".join(found.values())

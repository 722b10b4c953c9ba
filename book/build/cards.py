"""Cards: what stands behind a number, a term or an equation that a page's prose names.

A card lies hidden at the end of the page whose links have it, in the HTML, so that it needs neither
a network nor a kernel; `book/_static/cards` shows it. Of a claim it tells the verdict of this
build, of a term its definition in the glossary, of an equation the equation. A page whose cards
have changed is written anew, without being run or read.
"""

import hashlib
import re
from collections.abc import Iterator
from functools import cache
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.util import logging

from book.build import judging
from book.companion.claim_card import claim_card
from book.companion.claims import claim_by_id
from book.companion.judged import judged
from book.companion.verdict import Entry

logger = logging.getLogger(__name__)

TARGET = re.compile(r"(?<=#)(claim|term|equation)-(.+)$")
"""End of the address of what has a card: its kind and its name."""
LEADS = {
    "claim": "Its row in the ledger",
    "term": "In the glossary",
    "equation": "Where it stands",
}
"""Words of the link in a card, by kind."""


def _links(doctree: nodes.document) -> Iterator[tuple[nodes.reference, str, str, str]]:
    """Yield the links to what may have a card, with address, kind and name."""
    for link in doctree.findall(nodes.reference):
        address = link.get("refuri") or f"#{link.get('refid', '')}"
        if link.get("internal") and (found := TARGET.search(address)):
            yield link, address, found[1], found[2]


def forget(_app: Sphinx, env: Any, page: str) -> None:
    """Forget what a page links to, which is gone or about to be read."""
    env.card_uses = {name: used for name, used in _uses(env).items() if name != page}
    env.card_equations = getattr(env, "card_equations", {})


def _uses(env: Any) -> dict[str, set[tuple[str, str]]]:
    """Return the kind and name, as they are written, of all that each page links to."""
    return getattr(env, "card_uses", {})


def note(app: Sphinx, doctree: nodes.document) -> None:
    """Note what a page that has been read links to, and its equations."""
    env: Any = app.env
    kinds = {"term": "term", "eq": "equation"}
    env.card_uses[env.docname] = {(kind, name) for _, _, kind, name in _links(doctree)} | {
        (kinds[link["reftype"]], link["reftarget"])
        for link in doctree.findall(addnodes.pending_xref)
        if link.get("reftype") in kinds
    }
    for block in doctree.findall(nodes.math_block):
        if label := block.get("label"):
            env.card_equations[label] = block.astext(), block.get("nowrap", False)


@cache
def _definitions(env: Any) -> dict[str, nodes.definition]:
    """Return the definitions of all terms, by the anchors of these and by their names."""
    objects = env.get_domain("std").objects
    terms = {key[1]: place for key, place in objects.items() if key[0] == "term"}
    by_anchor = {
        anchor: item.next_node(nodes.definition)
        for page in sorted({page for page, _ in terms.values()})
        for item in env.get_doctree(page).findall(nodes.definition_list_item)
        for term in item.findall(nodes.term)
        for anchor in term["ids"]
    }
    named = {name.lower(): by_anchor[anchor] for name, (_, anchor) in terms.items()}
    return named | by_anchor


def _verdict(name: str) -> Entry | None:
    """Return what this build has judged of a claim."""
    entry: Entry | None = judged(claim_by_id(name).chapter, name)
    return entry


def _source(env: Any, kind: str, name: str) -> str:
    """Return what a card is made of, as text: it changes when the card does."""
    if kind == "claim":
        entry = _verdict(name)
        return f"{entry.outcome} {claim_card(entry)}" if entry else ""
    found = _definitions(env).get(name.lower()) if kind == "term" else env.card_equations.get(name)
    return str(found)


def find_changed(_app: Sphinx, env: Any) -> list[str]:
    """Have the pages whose cards have changed written anew; that a verdict is missing is told."""
    before, now = getattr(env, "card_digests", {}), {}
    claims = {(name, page) for page, used in _uses(env).items() for k, name in used if k == "claim"}
    judging.ensure({claim_by_id(name).chapter for name, _ in claims})
    for name, page in sorted(claims):
        if _verdict(name) is None:
            logger.warning("claim %s has no verdict", name, location=page)
    for page, used in _uses(env).items():
        sources = [_source(env, *each) for each in sorted(used)]
        now[page] = hashlib.sha256("\0".join(sources).encode()).hexdigest()
    env.card_digests = now
    return [page for page in now if now[page] != before.get(page)]


def mark(_app: Sphinx, doctree: nodes.document, _page: str) -> None:
    """Give links to claims the outcome, and the first to each term of a page a sign, as a class."""
    seen = set()
    for link, address, kind, name in _links(doctree):
        if kind == "claim" and (entry := _verdict(name)):
            link["classes"].append(str(entry.outcome))
        if kind == "term" and address not in seen:
            link["classes"].append("term")
        seen.add(address)


def _definition(app: Sphinx, page: str, anchor: str) -> nodes.Node | None:
    """Return the definition of a term, for a page, without links."""
    found = _definitions(app.env).get(anchor)
    if found is None:
        return None
    place = nodes.container("", *(child.deepcopy() for child in found.children))
    app.env.apply_post_transforms(place, page)
    for link in list(place.findall(nodes.reference)):
        link.replace_self(link.children)
    return place


def _equation(app: Sphinx, label: str) -> nodes.Node | None:
    tex, nowrap = app.env.card_equations.get(label, ("", False))  # type: ignore[attr-defined]
    return nodes.math_block(tex, tex, nowrap=nowrap, number=None) if tex else None


def _content(app: Sphinx, page: str, kind: str, name: str) -> tuple[str, bool]:
    """Return what a card of a page says, as HTML, and whether mathematics is in it."""
    if kind == "claim":
        entry = _verdict(name)
        return claim_card(entry) if entry else "", False
    node = _equation(app, name) if kind == "equation" else _definition(app, page, f"term-{name}")
    if node is None:
        return "", False
    html = app.builder.render_partial(node)["fragment"]  # type: ignore[attr-defined]
    return html, any(node.findall(lambda n: isinstance(n, nodes.math | nodes.math_block)))


def add(
    app: Sphinx, page: str, _template: str, context: dict[str, Any], doctree: nodes.document | None
) -> None:
    """Lay the cards of a page at its end, each once, and have equations in them set."""
    if doctree is None:
        return
    cards = {address: (kind, name) for _, address, kind, name in _links(doctree)}
    for address, (kind, name) in cards.items():
        content, mathematics = _content(app, page, kind, name)
        if content:
            context["body"] += (
                f'<div class="note-card" id="card-{kind}-{name}" data-of="{address}">{content}'
                f'<p><a href="{address}">{LEADS[kind]}</a></p></div>'
            )
        if mathematics:
            app.env.get_domain("math").data["has_equations"][page] = True


def setup(app: Sphinx) -> None:
    """Connect the parts to the stages of a build; scripts of a page are chosen after its cards."""
    app.connect("env-purge-doc", forget)
    app.connect("doctree-read", note)
    app.connect("env-get-updated", find_changed)
    app.connect("doctree-resolved", mark)
    app.connect("html-page-context", add, priority=400)

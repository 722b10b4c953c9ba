"""Chapters that are judged once a build: the same verdicts, and no longer than they hold."""

import json
from dataclasses import replace

import pytest

from book.build import judging, tracing
from book.companion import judged
from book.companion.claims import read_claims
from book.companion.verdict import judge

CHAPTER = 5
"""Judged in a few seconds."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("verdicts")
    judging.judge_apart(folder, CHAPTER)
    assert judged.file_of(folder, CHAPTER).is_file()
    return folder


@pytest.fixture
def from_build(folder, monkeypatch):
    """Let this process take verdicts from the build."""
    monkeypatch.setenv(judged.VARIABLE, str(folder))


def test_an_entry_of_the_build_is_the_one_that_judging_gives(folder, monkeypatch):
    for claim in read_claims(CHAPTER)[::7]:
        monkeypatch.delenv(judged.VARIABLE, raising=False)
        own = judge(claim)
        monkeypatch.setenv(judged.VARIABLE, str(folder))
        assert judged.judged(CHAPTER, claim.id).record() == own.record()
        assert judge(claim) is judged.judged(CHAPTER, claim.id)


@pytest.mark.usefixtures("from_build")
def test_a_claim_that_says_something_else_is_judged_anew():
    claim = next(c for c in read_claims(CHAPTER) if c.function and c.printed == "2.4")
    assert judge(replace(claim, printed="2.5")).claim.printed == "2.5"


@pytest.mark.usefixtures("from_build")
def test_who_takes_an_entry_has_read_what_it_hangs_on():
    from softgrip import reads

    judged.judged(CHAPTER, read_claims(CHAPTER)[0].id)
    names = {path.relative_to(tracing.ROOT).as_posix() for path in reads.elsewhere}
    assert {"book/chapter_5/numbers.py", f"data/claims/chapter_{CHAPTER}.toml"} <= names


def test_without_a_build_there_is_nothing_to_take(monkeypatch, tmp_path):
    monkeypatch.delenv(judged.VARIABLE, raising=False)
    assert judged.judged(CHAPTER, "5.2-correlations-shown-in") is None
    monkeypatch.setenv(judged.VARIABLE, str(tmp_path))
    assert judged.judged(CHAPTER, "5.2-correlations-shown-in") is None


def test_verdicts_that_hang_on_a_changed_file_are_forgotten(folder, tmp_path):
    kept = judged.file_of(folder, CHAPTER)
    own = judged.file_of(tmp_path, CHAPTER)
    own.write_bytes(kept.read_bytes())
    trace = judging.trace_of(own)
    trace.write_bytes(judging.trace_of(kept).read_bytes())
    tracing.context_of(trace).write_bytes(tracing.context_of(judging.trace_of(kept)).read_bytes())
    judging.forget_stale(tmp_path)
    assert own.is_file()
    seen = json.loads(trace.read_text())
    trace.write_text(json.dumps(seen | {"book/chapter_5/numbers.py": "other"}))
    judging.forget_stale(tmp_path)
    assert not own.exists()


@pytest.mark.parametrize(
    ("page", "chapters"),
    [
        ("show_verdicts(4)", [4]),
        ("show('Figure 5.1')\nshow_verdicts(5)", [5]),
        ("show_counts()", [6, 3, 2, 5, 4]),
        ("show_verdicts()", [6, 3, 2, 5, 4]),
        ("show('Figure 5.1')", []),
    ],
)
def test_what_pages_tell_is_judged(page, chapters, tmp_path):
    assert judging.missing([page], tmp_path) == chapters
    for chapter in chapters:
        judged.file_of(tmp_path, chapter).touch()
    assert judging.missing([page], tmp_path) == []

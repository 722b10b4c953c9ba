"""What recomputes the numbers of Chapter 6, and what the notes of its claims say of it."""

import pytest

from book.chapter_6.numbers import settling


def test_second_finger_settles_alone_when_the_note_says():
    # "At 5 % SPA 2 alone takes 0.56 s", to two decimals; both take as long as the slower one.
    assert settling(spa="2") == pytest.approx(0.56, abs=0.005)
    assert settling(spa="1") > settling(spa="2")
    assert settling() == settling(spa="1")

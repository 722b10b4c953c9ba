import pytest

from book.build.numbering import number


@pytest.mark.parametrize(
    ("label", "expected"),
    [
        ("fig-5-1", (5, 1)),
        ("eq-5-17", (5, 17)),
        ("tab-2-2", (2, 2)),
        ("fig-5-b", (5, "B")),
        ("fig-51", None),
        ("section-5-1", None),
    ],
)
def test_label_carries_the_dissertations_number(label, expected):
    assert number(label) == expected

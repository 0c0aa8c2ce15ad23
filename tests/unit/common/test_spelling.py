"""Names as users spell them, and lists of names."""

import pytest

from garage2usd.common.spelling import spans_in_words


@pytest.mark.parametrize(
    ("names", "words"),
    [
        ([f"A1-{number:02}" for number in range(1, 30) if number != 12], "A1-01 to A1-11, A1-13 to A1-29"),
        (["B1-02", "A1-09", "A1-10", "B1-01", "B1-02"], "A1-09, A1-10, B1-01, B1-02"),
        (["9", "10", "11", "7"], "7, 9 to 11"),
        (["098", "099", "100", "U2/A1-01", "12a", "\u00c42"], "098 to 100, 12a, U2/A1-01, \u00c42"),
        ([f"S{3 * number}" for number in range(20)], ", ".join(f"S{3 * at}" for at in range(12)) + ", and 8 more"),
        ([], ""),
    ],
)
def test_names_are_listed_in_spans(names, words):
    assert spans_in_words(names) == words
    assert spans_in_words(reversed(names)) == words

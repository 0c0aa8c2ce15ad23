"""JSON in few bytes says what it was given."""

import json

from hypothesis import given
from hypothesis import strategies as st

from garage2usd.common.documents import json_text

NUMBERS = st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.integers(-999, 999).map(float)
STRINGS = st.text() | st.from_regex(r'"?[0-9]*\\?\.0["\],}\\]*', fullmatch=True)
VALUES = st.recursive(
    NUMBERS | STRINGS | st.none() | st.booleans(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(STRINGS, inner, max_size=4),
    max_leaves=12,
)


@given(st.dictionaries(STRINGS, VALUES, max_size=4))
def test_json_says_what_it_was_given(document):
    assert json.loads(json_text(document)) == document


def test_whole_numbers_of_json_are_short():
    document = {"C": [5.4, 6.0, -0.5, 100.0], "x 2.0": {"version": "1.0", "most": 1e22, "least": -3.0}}
    assert json_text(document) == '{\n"C":[5.4,6,-0.5,100],\n"x 2.0":{"version":"1.0","most":1e+22,"least":-3}\n}\n'

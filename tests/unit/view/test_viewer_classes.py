"""The viewer has a colour of its own for each semantic class."""

import re

from support.sample_files import REPOSITORY

from garage2usd.objects import CLASSES


def test_each_class_has_a_colour_and_no_two_the_same():
    text = (REPOSITORY / "garage2usd" / "view" / "web" / "src" / "classes.ts").read_text()
    colours = dict(
        re.findall(r"^  (\w+): \"(#[0-9a-f]{6})\",$", text.partition("= {")[2].partition("};")[0], re.MULTILINE)
    )
    assert colours.keys() == {each.label for each in CLASSES}
    assert len(set(colours.values())) == len(colours)

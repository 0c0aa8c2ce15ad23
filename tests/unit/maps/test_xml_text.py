"""XML text: the same as ElementTree's, which it is written instead of."""

import xml.etree.ElementTree as ET

from garage2usd.maps.xml_text import child, element_lines, number_text, tag_text


def _tree():
    root = ET.Element("root", {"plain": "a"})
    inner = child(root, "inner", size=1.25, name='quote " & < > \t\r\n', from_="1")
    child(inner, "text").text = "a < b & c"
    child(child(root, "other"), "empty", value=0.0)
    return root


def test_lines_are_those_of_elementtree():
    root = _tree()
    lines = element_lines(root)
    ET.indent(root)
    assert "\n".join(lines) == ET.tostring(root, encoding="unicode")


def test_tags_read_back_as_they_were():
    values = {"k": 'a "quoted" & <odd> name', "v": "line\nfeed\ttab\rreturn"}
    assert ET.fromstring(f"{tag_text('tag', values)} />").attrib == values


def test_numbers_are_short_and_have_no_negative_zero():
    assert [number_text(value) for value in (-0.0, 3.0, 0.1 + 0.2, 1e-10, -2.5)] == ["0", "3", "0.3", "0", "-2.5"]

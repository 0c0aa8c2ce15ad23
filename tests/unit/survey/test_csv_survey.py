"""CSV: rectangles turned by shapely come back, and lines that are wrong are named."""

import math

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import affinity

from garage2usd.common.errors import ConfigError
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.survey.reader import read_survey

HEADER = "x,y,width_m,length_m,heading_deg"
metres = st.floats(-1000, 1000)
sides = st.floats(1.0, 20.0)
degrees = st.floats(-720, 720)


def read(tmp_path, text):
    path = tmp_path / "lot.csv"
    path.write_text(text, encoding="utf-8")
    return read_survey(path)


def ground(stall):
    """The ground of a stall with y upwards."""
    return shapely.transform(shapely.Polygon(stall.corners), lambda points: points * (1, -1))


@given(st.lists(st.tuples(metres, metres, sides, sides, degrees), min_size=1, max_size=5), st.sampled_from(",;"))
def test_rectangles_stand_where_shapely_turns_them(tmp_path_factory, rectangles, delimiter):
    lines = [HEADER, *(",".join(map(repr, rectangle)) for rectangle in rectangles)]
    survey = read(tmp_path_factory.mktemp("csv"), "\n".join(lines).replace(",", delimiter))
    assert len(survey.stalls) == len(rectangles)
    for stall, (x, y, width_m, length_m, heading) in zip(survey.stalls, rectangles, strict=True):
        flat = shapely.box(x - length_m / 2, y - width_m / 2, x + length_m / 2, y + width_m / 2)
        expected = affinity.rotate(flat, heading, origin=(x, y))
        assert ground(stall).hausdorff_distance(expected) < 1e-5
        start, end = stall.corners[stall.mouth], stall.corners[(stall.mouth + 1) % 4]
        tail = x - length_m / 2 * math.cos(math.radians(heading)), y - length_m / 2 * math.sin(math.radians(heading))
        assert ((start[0] + end[0]) / 2, -(start[1] + end[1]) / 2) == pytest.approx(tail, abs=1e-5)


@given(st.tuples(metres, metres), sides, sides, st.floats(-5, 5))
def test_corners_are_those_of_the_file(tmp_path_factory, first, width_m, length_m, lean_m):
    x, y = first
    corners = [(x, y), (x + width_m, y), (x + width_m + lean_m, y + length_m), (x + lean_m, y + length_m)]
    row = ",".join(repr(value) for corner in corners for value in corner)
    quad = shapely.Polygon(corners)
    survey = read(tmp_path_factory.mktemp("csv"), f"x1,y1,x2,y2,x3,y3,x4,y4\n{row}\n")
    (stall,) = survey.stalls
    assert ground(stall).hausdorff_distance(quad) < 1e-5
    assert stall.mouth is None


def test_what_people_write_is_read(tmp_path):
    text = (
        f"\ufeffID; {HEADER.replace(',', ';')}; Use; size; number\r\na;0;0;2,5;5;0;;;\r\n".replace("2,5", "2.5")
        + "\r\nb;10;0;2.5;5;90;accessible;van;17\r\na;20;0;2.5;5;90;EV;compact;A 3\r\n"
    )
    first, second, third = read(tmp_path, text).stalls
    assert (first.name, first.use, first.size, first.number) == ("a", StallUse.STANDARD, SizeClass.STANDARD, "")
    assert (second.name, second.use, second.size, second.number) == ("b", StallUse.ACCESSIBLE, SizeClass.VAN, "17")
    assert (third.name, third.use, third.size, third.number) == ("a (2)", StallUse.EV, SizeClass.COMPACT, "A 3")


def test_what_is_no_quadrilateral_is_named(tmp_path):
    survey = read(
        tmp_path,
        "id,x1,y1,x2,y2,x3,y3,x4,y4\n"
        "good,0,0,2,0,2,5,0,5\ncrossed,0,0,2,5,2,0,0,5\nflat,0,0,1,0,2,0,2,5\ninwards,0,0,4,0,1,1,0,4\n",
    )
    assert [stall.name for stall in survey.stalls] == ["good"]
    assert survey.unread == (
        ("crossed", "a stall whose sides cross or touch each other"),
        ("flat", "a stall of 3 corners instead of 4"),
        ("inwards", "a stall with a corner that points inwards"),
    )


COLUMNS = "x, y, width_m, length_m, heading_deg, x1, y1, x2, y2, x3, y3, x4, y4, id, use, size, number"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (f"{HEADER},colour\n", f"lot.csv: header: got 'colour'; allowed: one of the columns {COLUMNS}"),
        (f"{HEADER},x\n", "lot.csv: header: got 'x'; allowed: each column once"),
        (
            "x,y\n",
            (
                "lot.csv: header: got 'x, y'; allowed: all of x, y, width_m, length_m, heading_deg, "
                "or all of x1, y1, x2, y2, x3, y3, x4, y4"
            ),
        ),
        (f"{HEADER}\n1,2,3\n", "lot.csv: line 2: got '3 fields'; allowed: 5 fields, as in the header"),
        (
            f"{HEADER}\n\n1,2,nan,5,0\n",
            "lot.csv: line 3, width_m: got 'nan'; allowed: a number of metres from -1000 to 1000",
        ),
        (
            f"{HEADER}\n1,2,0,5,0\n",
            "lot.csv: line 2, width_m: got '0'; allowed: a number of metres above 0, up to 1000",
        ),
        (
            f"{HEADER}\n1_0,2,2,5,0\n",
            "lot.csv: line 2, x: got '1_0'; allowed: a number of metres from -1e+08 to 1e+08",
        ),
        (
            f"{HEADER},use\n1,2,2,5,0,boats\n",
            (
                "lot.csv: line 2, use: got 'boats'; allowed: one of standard, turning, ev, accessible, access_aisle, "
                "unreachable, motorcycle"
            ),
        ),
        (
            f"{HEADER},size\n1,2,2,5,0,tiny\n",
            "lot.csv: line 2, size: got 'tiny'; allowed: one of standard, compact, large, van, motorcycle",
        ),
    ],
)
def test_wrong_lines_are_refused(tmp_path, text, message):
    with pytest.raises(ConfigError) as raised:
        read(tmp_path, text)
    assert str(raised.value) == message


def test_files_without_a_stall_are_refused(tmp_path):
    with pytest.raises(ConfigError, match=r"SOURCE: got '.*lot.csv'; allowed: a file with a stall of four corners$"):
        read(tmp_path, f"{HEADER}\n")
    with pytest.raises(ConfigError, match=r"a header with x, y, width_m"):
        read(tmp_path, "\n")
    with pytest.raises(ConfigError, match=r"corners \(1: a stall of 3 corners instead of 4\)$"):
        read(tmp_path, "x1,y1,x2,y2,x3,y3,x4,y4\n0,0,1,0,2,0,2,5\n")

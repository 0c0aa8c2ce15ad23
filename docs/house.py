"""Draw the rooms of the package and what they import, from the imports themselves, as ``docs/pictures/house.svg``."""

import sys
import tomllib
from collections import Counter
from pathlib import Path
from xml.sax.saxutils import escape

import grimp

REPOSITORY = Path(__file__).parents[1]
PICTURE = REPOSITORY / "docs/pictures/house.svg"
PACKAGE = "garage2usd"
WIDTH, ROW, BOX_HEIGHT, MARGIN = 1180, 62, 38, 20
GAP = 14
BOUNDS = 2, 6, 16
"""Numbers of modules from which an arrow is thin, thicker and thick."""
EVERYWHERE = {"common", "config"}


def layers() -> list[list[str]]:
    """Rooms in layers, the top one first: each imports from lower ones only."""
    settings = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))
    contract = settings["tool"]["importlinter"]["contracts"][0]
    return [[room.strip().removeprefix(f"{PACKAGE}.") for room in layer.split("|")] for layer in contract["layers"]]


def arrows(rooms: set[str]) -> Counter[tuple[str, str]]:
    """How many modules of a room import from another one: two or more, of rooms that not all others use."""
    graph = grimp.build_graph(PACKAGE, cache_dir=None)
    found: Counter[tuple[str, str]] = Counter()
    for module in sorted(graph.modules):
        start = room_of(module)
        ends = {room_of(other) for other in graph.find_modules_directly_imported_by(module)}
        found.update((start, end) for end in ends if start != end and {start, end} <= rooms and end not in EVERYWHERE)
    return Counter({arrow: count for arrow, count in found.items() if count >= BOUNDS[0]})


def room_of(module: str) -> str:
    """The room of a module."""
    return module.removeprefix(f"{PACKAGE}.").split(".")[0]


def picture() -> str:
    """The picture as SVG."""
    floors = layers()
    place: dict[str, tuple[float, float, float]] = {}
    for number, rooms in enumerate(floors):
        width = (WIDTH - 2 * MARGIN - GAP * (len(rooms) - 1)) / max(len(rooms), 3)
        left = (WIDTH - len(rooms) * width - GAP * (len(rooms) - 1)) / 2
        for index, room in enumerate(rooms):
            place[room] = left + index * (width + GAP), MARGIN + number * ROW, width
    height = 2 * MARGIN + ROW * len(floors)
    counts = arrows(set(place))
    drawn = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-family="sans-serif">',
        f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
    ]
    for (start, end), count in sorted(counts.items(), key=lambda item: (item[1], item[0])):
        (x0, y0, w0), (x1, y1, w1) = place[start], place[end]
        begin, stop = (x0 + w0 / 2, y0 + BOX_HEIGHT), (x1 + w1 / 2, y1)
        bend = (stop[1] - begin[1]) / 2
        share = sum(count >= bound for bound in BOUNDS) / len(BOUNDS)
        drawn.append(
            f'<path d="M{begin[0]:.0f} {begin[1]:.0f} C{begin[0]:.0f} {begin[1] + bend:.0f} {stop[0]:.0f} '
            f'{stop[1] - bend:.0f} {stop[0]:.0f} {stop[1]:.0f}" fill="none" stroke="#31688e" '
            f'stroke-width="{0.6 + 3.4 * share:.1f}" stroke-opacity="{0.1 + 0.5 * share:.2f}"/>'
        )
    for room, (x, y, width) in place.items():
        box = f'width="{width:.0f}" height="{BOX_HEIGHT}" rx="5" fill="#eef3f7" stroke="#31688e"'
        text = f'x="{x + width / 2:.0f}" y="{y + 24}" text-anchor="middle" font-size="15"'
        drawn.append(f'<rect x="{x:.0f}" y="{y}" {box}/>')
        drawn.append(f"<text {text}>{escape(room)}</text>")
    return "\n".join([*drawn, "</svg>", ""])


if __name__ == "__main__":
    PICTURE.write_text(picture(), encoding="utf-8", newline="\n")
    sys.stdout.write(f"{PICTURE}\n")

"""Damaged surveys: small sound files of every format, each with one to three mutations drawn from a seed and a number.

A new format joins by a sound file in `SOUND`, and by a structural mutation in `_STRUCTURAL` unless its lines do.
"""

import json
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from copy import deepcopy
from random import Random

from support.fuzzing.command_inputs import ABSURD, ABSURD_WORDS, Case

NUMBERS = (
    "0", "-0.0", "-1", "1e-300", "1e-9", "1e7", "-1e12", "1e308", "1e400", "9" * 400, "nan", "NaN", "Infinity", "-inf",
    "abc", "", "1,5", "0x10", "1_0", "٣", "90.0001", "-179.99999", "180", "181", "3000000000", "--1", "1e", "½",
)  # fmt: skip
WORDS = (
    "", " ", "yes", "-1", "\u202eabc", "\x1b[31m\x1b]0;owned\x07", "x" * 5000, "12a", "車", "🚗", "a\tb", "%s%n",
    "\u0000", "stall", "parking", "column", "entrance", "disabled", "../../x", "'; --", "\ufeff", "\ud800",
    "level", "1;2;3", "-3-7",
)  # fmt: skip
ENTITIES = (
    '<!DOCTYPE a [<!ENTITY x "y">]>',
    "<!DOCTYPE a [" + '<!ENTITY a "aaaaaaaaaa">' + "".join(
        f'<!ENTITY {chr(98 + at)} "{f"&{chr(97 + at)};" * 10}">' for at in range(12)) + "]>",
    '<!DOCTYPE a SYSTEM "file:///etc/passwd">',
    '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///dev/zero">]>',
    '<!DOCTYPE a [<!ENTITY % p SYSTEM "http://127.0.0.1:9/x"> %p;]>',
)  # fmt: skip
ENCODINGS = (
    "utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-8-sig", "latin-1", "cp1252", "shift_jis", "utf-7", "cp037",
)  # fmt: skip
_NUMBER = re.compile(r"(?<![\w.#])-?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w.])")
Mutation = Callable[[bytes, Random], bytes]


def draw_survey_case(sound: dict[str, list[bytes]], seed: int, number: int) -> Case:
    """A call of ``import`` on a damaged file; suffixes take turns, so that any count has each of them."""
    suffixes = sorted(sound)
    suffix = suffixes[number % len(suffixes)]
    rng = Random(f"{seed} {number}")  # noqa: S311
    data, names = rng.choice(sound[suffix]), []
    for _ in range(rng.choice((1, 1, 2, 3))):
        mutate = rng.choice([*_ALL, *2 * _structural_of(suffix)])
        names.append(mutate.__name__.strip("_"))
        data = mutate(data, rng)
    arguments = ["import", f"lot{suffix}", "-o", "out/lot.usda"]
    if rng.random() < 0.8:
        arguments.append("--no-proofs")
    return Case(f"{suffix} {' '.join(sorted(set(names)))}", tuple(arguments), {f"lot{suffix}": data})


def _structural_of(suffix: str) -> list[Mutation]:
    return _STRUCTURAL.get(suffix, [_lines])


def _text(data: bytes) -> str:
    return data.decode("utf-8", "surrogateescape")


def _bytes(text: str) -> bytes:
    is_odd = any("\ud800" <= sign < "\udc80" for sign in text)
    return text.encode("utf-8", "surrogatepass" if is_odd else "surrogateescape")


def _flipped(data: bytes, rng: Random) -> bytes:
    """Other bits here and there."""
    changed = bytearray(data)
    for _ in range(rng.choice((1, 3, 30))):
        if changed:
            changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def _cut(data: bytes, rng: Random) -> bytes:
    """Cut short, or without a piece."""
    start = rng.randrange(len(data) + 1)
    return data[:start] + (b"" if rng.random() < 0.5 else data[start + rng.randrange(200) :])


def _repeated(data: bytes, rng: Random) -> bytes:
    """A piece comes twice, or many times."""
    start = rng.randrange(len(data) + 1)
    piece = data[start : start + rng.choice((1, 10, 300))]
    return data[:start] + piece * rng.choice((2, 3, 300)) + data[start:]


def _numbers(data: bytes, rng: Random) -> bytes:
    """Other numbers: extremes, words, decimal commas."""
    text = _text(data)
    found = list(_NUMBER.finditer(text))
    for place in sorted(rng.sample(found, min(len(found), rng.choice((1, 2, 8)))), key=lambda each: -each.start()):
        text = text[: place.start()] + rng.choice((*NUMBERS, *ABSURD_WORDS[:5])) + text[place.end() :]
    return _bytes(text)


def _moved(data: bytes, rng: Random) -> bytes:
    """All numbers moved, scaled, swapped in pairs, or with decimal commas."""
    change = rng.choice(("far", "large", "small", "swapped", "commas", "rounded", "noise"))
    text = _text(data)
    if change == "swapped":
        found = list(_NUMBER.finditer(text))
        for one, other in reversed(list(zip(found[::2], found[1::2], strict=False))):
            text = text[: one.start()] + other[0] + text[one.end() : other.start()] + one[0] + text[other.end() :]
        return _bytes(text)

    def other_number(place: re.Match[str]) -> str:
        value = float(place[0])
        if change == "commas":
            return place[0].replace(".", ",")
        if "." not in place[0] and change != "large":
            return place[0]  # ids stay, so that the file holds together
        return repr(
            {
                "far": value + 171.0,
                "large": value * 1e5,
                "small": value * 1e-5,
                "rounded": round(value, 3),
                "noise": value + rng.uniform(-1e-4, 1e-4),
            }[change]
        )

    return _bytes(_NUMBER.sub(other_number, text))


def _encoded(data: bytes, rng: Random) -> bytes:
    """In another encoding, declared or not; with letters that differ there."""
    text = _text(data).replace("stall", "Stellplätze", 1) if rng.random() < 0.3 else _text(data)
    name = rng.choice(ENCODINGS)
    if rng.random() < 0.5:
        text = f'<?xml version="1.0" encoding="{rng.choice((name, "nonsense", "utf-16", "idna"))}"?>' + re.sub(
            r"^\s*<\?xml.*?\?>", "", text
        )
    return text.encode(name, "replace") if name != "utf-7" else text.encode("utf-7", "ignore")


def _nested(data: bytes, rng: Random) -> bytes:
    """Something nested deeply, or a long line, somewhere."""
    text = _text(data)
    at = rng.choice([0, len(text), *(place.start() for place in re.finditer(r"[\[{<,]", text))])
    depth = rng.choice((100, 3000, 100_000))
    deep = rng.choice(
        ("[" * depth, "[" * depth + "]" * depth, "<a>" * depth, '{"a":' * depth, "a" * depth, "(" * depth)
    )
    return _bytes(text[:at] + deep + text[at:])


def _words(data: bytes, rng: Random) -> bytes:
    """Other text between quotation marks."""
    text = _text(data)
    found = list(re.finditer(r'"[^"\n]*"', text))
    for place in sorted(rng.sample(found, min(len(found), rng.choice((1, 3)))), key=lambda each: -each.start()):
        text = f'{text[: place.start()]}"{rng.choice(WORDS)}"{text[place.end() :]}'
    return _bytes(text)


def _lines(data: bytes, rng: Random) -> bytes:
    """Lines left out, doubled, in another order, joined, with other separators."""
    lines = _text(data).split("\n")
    at = rng.randrange(len(lines))
    match rng.randrange(6):
        case 0:
            del lines[at]
        case 1:
            lines[at:at] = [lines[at]] * rng.choice((1, 50))
        case 2:
            rng.shuffle(lines)
        case 3:
            return _bytes(rng.choice(("\r", "\r\n", "", "\u2028", "\x00\n")).join(lines))
        case 4:
            old, new = rng.choice(
                ((",", ";"), (",", "\t"), (",", "|"), (".", ","), ("=", ":"), ('"', "'"), ("#", "//"))
            )
            lines = [line.replace(old, new) for line in lines]
        case 5:
            lines.insert(0, rng.choice(("sep=;", "sep=\t", "sep=", "#" * 70_000, '"sep=,"', "\ufeff", '"')))
    return _bytes("\n".join(lines))


def _elements(data: bytes, rng: Random) -> bytes:
    """Elements of XML left out, doubled, moved, renamed; attributes left out, emptied, swapped; entities."""
    if rng.random() < 0.2:
        text = re.sub(r"^\s*<\?xml.*?\?>", "", _text(data))
        return _bytes('<?xml version="1.0"?>' + rng.choice(ENTITIES) + text.replace('"yes"', '"&x;"'))
    try:
        root = ET.fromstring(data)
    except (ET.ParseError, ValueError, LookupError):
        return data
    elements = list(root.iter())
    parents = {child: parent for parent in elements for child in parent}
    for _ in range(rng.choice((1, 2, 10))):
        element = rng.choice(elements)
        parent = parents.get(element)
        match rng.randrange(8):
            case 0 if parent is not None and element in list(parent):
                parent.remove(element)
            case 1 if parent is not None:
                parent.insert(rng.randrange(len(parent) + 1), deepcopy(element))
            case 2:
                children = list(element)
                rng.shuffle(children)
                element[:] = children
            case 3:
                element.tag = rng.choice(elements).tag
            case 4 if element.attrib:
                del element.attrib[rng.choice(list(element.attrib))]
            case 5 if element.attrib:
                element.set(rng.choice(list(element.attrib)), rng.choice((*NUMBERS, *WORDS)).replace("\0", ""))
            case 6 if element.attrib:
                other = rng.choice(elements)
                element.attrib.update(other.attrib)
            case 7 if parent is not None:
                rng.choice(elements[:1] + list(parent)).append(deepcopy(element))
    return ET.tostring(root, encoding="unicode").encode("utf-8", "replace")


def _values(data: bytes, rng: Random) -> bytes:
    """Values of JSON left out, doubled, replaced, in another order."""
    try:
        document = json.loads(data)
    except (ValueError, RecursionError):
        return data
    for _ in range(rng.choice((1, 2, 10))):
        holders = list(_holders(document))
        if not holders:
            break
        holder = rng.choice(holders)
        key = rng.choice(list(holder) if isinstance(holder, dict) else range(len(holder)))
        match rng.randrange(5):
            case 0:
                del holder[key]
            case 1:
                holder[key] = rng.choice([each for each in ABSURD if each != "x" * 100_000])
            case 2:
                holder[key] = deepcopy(rng.choice(holders))
            case 3 if isinstance(holder, list):
                holder.insert(key, deepcopy(holder[key]))
            case 4 if isinstance(holder, list):
                rng.shuffle(holder)
    return json.dumps(document).encode()


def _holders(value: object) -> "list[dict[str, object] | list[object]]":
    found, left = [], [value]
    while left:
        each = left.pop()
        if isinstance(each, dict | list) and each:
            found.append(each)
            left += each.values() if isinstance(each, dict) else each
    return found


_ALL: list[Mutation] = [_flipped, _cut, _repeated, _numbers, _numbers, _moved, _moved, _encoded, _nested, _words]
_STRUCTURAL: dict[str, list[Mutation]] = {
    ".osm": [_elements],
    ".xodr": [_elements],
    ".geojson": [_values],
    ".json": [_values],
}  # drawings, models and venues have the mutations of all


def sound_surveys(folder) -> dict[str, list[bytes]]:
    """Sound files by suffix: those of the tests, the sample, and maps that a small garage is exported to."""
    from garage2usd.exports import export
    from garage2usd.imports import import_layout
    from support.sample_files import REPOSITORY
    from support.small_survey import SURVEY
    from support.survey_files import program_files
    from support.survey_texts import TEXTS

    sound = {f".{suffix}": [text.encode()] for suffix, text in TEXTS.items()} | program_files()
    sound[".json"] = sound[".geojson"]
    sound[".toml"] += [(REPOSITORY / "samples/surveys/lot.toml").read_bytes(), SURVEY.encode()]
    (folder / "small.toml").write_text(SURVEY)
    made = import_layout(folder / "small.toml", folder / "small.usda", proves=False)
    export(made.stage, [folder / "small.osm", folder / "small.xodr"])
    for suffix in (".osm", ".xodr"):
        sound[suffix].append((folder / f"small{suffix}").read_bytes())
    return sound

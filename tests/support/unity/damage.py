"""Kinds of damage to the bytes of layers and packages: each a function of the bytes and a random generator."""

import re
import struct
from collections.abc import Callable
from functools import cache
from random import Random

from support.unity.crate_tables import CrateTables, unpacked

HUGE = (2**31 - 1, 2**31, 2**32 - 1, 2**40, 2**63 - 1, 2**63, 2**64 - 1, 65535, 1, 0)
WORDS = b"{ } [ ] ( ) \" ''' @ < /* - \0 \xff\xfe def over None 1e999 rel variantSet timeSamples".split(b" ")
TOKENS = (b"", b"/", b"..", b"a/b", b"a.b", b"{", b"{=}", b"{v=x}", b"\xff\xfe", b"typeName", b"default", b"references")
NUMBER = re.compile(rb"(?<![\w.])-?\d+(\.\d+)?")

Damage = Callable[[bytes, Random], bytes]


def flipped_bits(data: bytes, draw: Random) -> bytes:
    data = bytearray(data)
    for _ in range(draw.choice([1, 1, 2, 5, 20])):
        data[draw.randrange(len(data))] ^= 1 << draw.randrange(8)
    return bytes(data)


def other_bytes(data: bytes, draw: Random) -> bytes:
    """Some bytes replaced, half of the time at the ends, where the tables of contents stand."""
    data = bytearray(data)
    ends = [range(len(data)), range(min(96, len(data))), range(max(0, len(data) - 400), len(data))]
    for _ in range(draw.choice([1, 1, 2, 5, 20])):
        at = draw.choice(draw.choice([ends[0], *ends]))
        data[at] = draw.choice([0, 1, 127, 128, 254, 255, draw.randrange(256)])
    return bytes(data)


def truncated(data: bytes, draw: Random) -> bytes:
    return data[: draw.randrange(len(data))]


def huge_counts(data: bytes, draw: Random) -> bytes:
    """Numbers of 16, 32 or 64 bits that are far too large, or not there."""
    data = bytearray(data)
    for _ in range(draw.choice([1, 1, 2, 5])):
        letter = draw.choice("HIQ")
        number = struct.pack(f"<{letter}", draw.choice(HUGE) % 256 ** struct.calcsize(letter))
        at = draw.randrange(len(data))
        data[at : at + len(number)] = number
    return bytes(data)


def huge_numbers(data: bytes, draw: Random) -> bytes:
    """As huge_counts, of the numbers of a text."""
    places = list(NUMBER.finditer(data))
    for place in sorted(draw.sample(places, min(len(places), draw.choice([1, 2, 10]))), key=lambda one: -one.start()):
        number = draw.choice([b"9" * 400, b"1e400", b"-1e-400", b"0x10", *(str(one).encode() for one in HUGE)])
        data = data[: place.start()] + number + data[place.end() :]
    return data


def cut_out(data: bytes, draw: Random) -> bytes:
    at = draw.randrange(len(data))
    return data[:at] + data[at + draw.choice([1, 8, 30, 300]) :]


def repeated(data: bytes, draw: Random) -> bytes:
    """A piece of the file once more, or very often, at another place."""
    start, at = draw.randrange(len(data)), draw.randrange(len(data))
    piece = data[start : start + draw.randrange(1, 200)]
    return data[:at] + piece * draw.choice([1, 1, 3, 500]) + data[at:]


def stray_words(data: bytes, draw: Random) -> bytes:
    for _ in range(draw.choice([1, 2, 5])):
        at = draw.randrange(len(data) + 1)
        data = data[:at] + draw.choice(WORDS) + data[at:]
    return data


def wrong_tables(data: bytes, draw: Random) -> bytes:
    """A crate whose tables say something else, soundly compressed."""
    tables = _copied(unpacked_once(data))
    for _ in range(draw.choice([1, 1, 2, 5])):
        _damage_table(tables, draw)
    return tables.packed()


unpacked_once = cache(unpacked)


def _copied(tables: CrateTables) -> CrateTables:
    return CrateTables(**{name: value[:] if isinstance(value, list) else value for name, value in vars(tables).items()})


def _damage_table(tables: CrateTables, draw: Random) -> None:
    name = draw.choice([name for name, value in vars(tables).items() if name != "values" and value])
    if name == "path_count":
        tables.path_count = draw.choice([0, 1, tables.path_count + draw.choice([-1, 1, 1000]), 2**31 - 1, 2**63])
        return
    column = getattr(tables, name)
    at = draw.randrange(len(column))
    if draw.random() < 0.1:
        del column[at : draw.choice([at + 1, len(column)])]
    elif name == "tokens":
        column[at] = draw.choice([*TOKENS, column[at] * 300])
    elif name == "field_values":
        column[at] = _other_value(column, at, len(tables.values), draw)
    else:
        other = draw.choice(column)
        near = column[at] + draw.choice([-1, 1])
        column[at] = draw.choice([other, near, -column[at], at, 0, -1, -2, len(column), 2**31 - 1, -(2**31)])


def _other_value(values: list[int], at: int, end: int, draw: Random) -> int:
    """Another type, other flags, another place, or the value of another field."""
    value = values[at]
    match draw.randrange(4):
        case 0:
            return value & ~(0xFF << 48) | draw.randrange(64) << 48
        case 1:
            return value ^ 1 << draw.randrange(60, 64)
        case 2:
            return value >> 48 << 48 | draw.choice([draw.randrange(end), end, 0, 2**48 - 1, draw.choice(HUGE) % 2**48])
    return draw.choice(values)


OF_TEXTS: tuple[Damage, ...] = (flipped_bits, other_bytes, truncated, huge_numbers, cut_out, repeated, stray_words)
OF_CRATES: tuple[Damage, ...] = (flipped_bits, other_bytes, truncated, huge_counts, cut_out, repeated, wrong_tables)
OF_PACKAGES: tuple[Damage, ...] = (flipped_bits, other_bytes, truncated, huge_counts, cut_out, repeated)

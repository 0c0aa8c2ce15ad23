"""The tables of a crate as plain lists, so that they can be damaged behind their compression and packed again."""

import struct
from dataclasses import dataclass, field
from itertools import pairwise

HEADER = 24
"""Bytes before a crate's values: its name, its version, the place of the table of contents."""


@dataclass
class CrateTables:
    """All sections of a crate; ``values`` is what stands before them, where the fields' values lie."""

    values: bytes
    tokens: list[bytes] = field(default_factory=list)
    strings: list[int] = field(default_factory=list)
    field_tokens: list[int] = field(default_factory=list)
    field_values: list[int] = field(default_factory=list)
    field_sets: list[int] = field(default_factory=list)
    path_count: int = 0
    paths: list[int] = field(default_factory=list)
    path_tokens: list[int] = field(default_factory=list)
    path_jumps: list[int] = field(default_factory=list)
    spec_paths: list[int] = field(default_factory=list)
    spec_sets: list[int] = field(default_factory=list)
    spec_types: list[int] = field(default_factory=list)

    def packed(self, chunk_bytes: int | None = None) -> bytes:
        """The crate with these tables, whatever they say, and its compressed blocks in chunks if told so."""

        def block(data: bytes) -> bytes:
            packed = _lz4(data, chunk_bytes)
            return struct.pack("<Q", len(packed)) + packed

        text = b"".join(token + b"\0" for token in self.tokens)
        packed_text = _lz4(text, chunk_bytes)
        sections = {
            "TOKENS": struct.pack("<QQQ", len(self.tokens), len(text), len(packed_text)) + packed_text,
            "STRINGS": struct.pack("<Q", len(self.strings)) + _plain(self.strings, "I"),
            "FIELDS": _sized(
                self.field_tokens, block(_integers(self.field_tokens)) + block(_plain(self.field_values, "Q"))
            ),
            "FIELDSETS": _sized(self.field_sets, block(_integers(self.field_sets))),
            "PATHS": struct.pack("<QQ", self.path_count, len(self.paths))
            + b"".join(block(_integers(column)) for column in (self.paths, self.path_tokens, self.path_jumps)),
            "SPECS": _sized(
                self.spec_paths,
                b"".join(block(_integers(column)) for column in (self.spec_paths, self.spec_sets, self.spec_types)),
            ),
        }
        data, contents = bytearray(self.values), b""
        for name, section in sections.items():
            contents += name.encode().ljust(16, b"\0") + struct.pack("<QQ", len(data), len(section))
            data += section
        data[16:HEADER] = struct.pack("<Q", len(data))
        return bytes(data + struct.pack("<Q", len(sections)) + contents)


def unpacked(data: bytes) -> CrateTables:
    """The tables of a sound crate."""
    (contents,) = struct.unpack_from("<Q", data, 16)
    (count,) = struct.unpack_from("<Q", data, contents)
    starts = {}
    for index in range(count):
        name, start, _ = struct.unpack_from("<16sQQ", data, contents + 8 + 32 * index)
        starts[name.rstrip(b"\0").decode()] = start
    tables = CrateTables(data[: min(starts.values())])
    count, _, packed = struct.unpack_from("<QQQ", data, starts["TOKENS"])
    place = starts["TOKENS"] + 24
    tables.tokens = _unpacked_lz4(data[place : place + packed]).split(b"\0")[:count]
    (count,) = struct.unpack_from("<Q", data, starts["STRINGS"])
    tables.strings = list(struct.unpack_from(f"<{count}I", data, starts["STRINGS"] + 8))
    (count,) = struct.unpack_from("<Q", data, starts["FIELDS"])
    tables.field_tokens, place = _unpacked_integers(data, starts["FIELDS"] + 8, count)
    (packed,) = struct.unpack_from("<Q", data, place)
    tables.field_values = list(struct.unpack(f"<{count}Q", _unpacked_lz4(data[place + 8 : place + 8 + packed])))
    (count,) = struct.unpack_from("<Q", data, starts["FIELDSETS"])
    tables.field_sets, _ = _unpacked_integers(data, starts["FIELDSETS"] + 8, count)
    tables.path_count, count = struct.unpack_from("<QQ", data, starts["PATHS"])
    tables.paths, place = _unpacked_integers(data, starts["PATHS"] + 16, count)
    tables.path_tokens, place = _unpacked_integers(data, place, count)
    tables.path_jumps, place = _unpacked_integers(data, place, count)
    (count,) = struct.unpack_from("<Q", data, starts["SPECS"])
    tables.spec_paths, place = _unpacked_integers(data, starts["SPECS"] + 8, count)
    tables.spec_sets, place = _unpacked_integers(data, place, count)
    tables.spec_types, place = _unpacked_integers(data, place, count)
    return tables


def _sized(column: list[int], body: bytes) -> bytes:
    return struct.pack("<Q", len(column)) + body


def _plain(numbers: list[int], letter: str) -> bytes:
    size = struct.calcsize(letter)
    return b"".join((number % 256**size).to_bytes(size, "little") for number in numbers)


def _lz4(data: bytes, chunk_bytes: int | None = None) -> bytes:
    """Literals alone, in one chunk behind a zero, or in several behind their count, each behind its size."""
    if chunk_bytes is None:
        return b"\0" + _literals(data)
    chunks = [_literals(data[at : at + chunk_bytes]) for at in range(0, len(data), chunk_bytes)]
    return bytes([len(chunks)]) + b"".join(struct.pack("<i", len(chunk)) + chunk for chunk in chunks)


def _literals(data: bytes) -> bytes:
    rest = len(data) - 15
    more = b"" if rest < 0 else b"\xff" * (rest // 255) + bytes([rest % 255])
    return bytes([min(len(data), 15) << 4]) + more + data


def _unpacked_lz4(packed: bytes) -> bytes:
    out, at = bytearray(), 1
    while at < len(packed):
        token, at = packed[at], at + 1
        count, at = _length(packed, at, token >> 4)
        out += packed[at : at + count]
        at += count
        if at >= len(packed):
            break
        back, at = packed[at] | packed[at + 1] << 8, at + 2
        count, at = _length(packed, at, token & 15)
        for _ in range(count + 4):
            out.append(out[-back])
    return bytes(out)


def _length(packed: bytes, at: int, short: int) -> tuple[int, int]:
    """A length of LZ4, continued in further bytes where its four bits are full, and the place behind it."""
    total, more = short, short == 15
    while more:
        total, more, at = total + packed[at], packed[at] == 255, at + 1
    return total, at


def _integers(numbers: list[int]) -> bytes:
    """Differences in 32 bits each, which are as well a coding as shorter ones."""
    steps = [number - last for last, number in pairwise([0, *numbers])]
    return struct.pack("<i", 0) + b"\xff" * ((2 * len(numbers) + 7) // 8) + _plain(steps, "I")


def _unpacked_integers(data: bytes, place: int, count: int) -> tuple[list[int], int]:
    (packed,) = struct.unpack_from("<Q", data, place)
    raw = _unpacked_lz4(data[place + 8 : place + 8 + packed])
    (common,) = struct.unpack_from("<i", raw)
    at, number, numbers = 4 + (2 * count + 7) // 8, 0, []
    for index in range(count):
        code = raw[4 + index // 4] >> 2 * (index % 4) & 3
        width = (0, 1, 2, 4)[code]
        number += int.from_bytes(raw[at : at + width], "little", signed=True) if code else common
        at += width
        numbers.append(number)
    return numbers, place + 8 + packed

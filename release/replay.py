"""Repeat recorded calls of the loops in C by another library: ``replay.py LIBRARY CALLS``.

Needs nothing but Python, so that it runs where the packages do not. Prints the number of calls of each function, and
exits with 1 where a number or a byte of an array differs from the recording of `release/windows.py`.
"""

import ctypes
import gzip
import hashlib
import pickle
import struct
import sys
from collections import Counter
from typing import Any

_KINDS = {"d": ctypes.c_double, "q": ctypes.c_int64, "Q": ctypes.c_uint64, "?": ctypes.c_bool, "": None}


def main(library_path: str, calls_path: str) -> int:
    """Repeat all calls."""
    library = ctypes.CDLL(library_path)
    called: Counter[str] = Counter()
    differs: Counter[str] = Counter()
    with gzip.open(calls_path) as file:
        while True:
            try:
                call = pickle.load(file)  # noqa: S301 - our own recording
            except EOFError:
                break
            called[call["name"]] += 1
            differs[call["name"]] += not is_same(library, call)
    for name, count in sorted(called.items()):
        print(f"{name}: {count} calls, {differs[name]} differ")
    print(f"{sum(called.values())} calls of {len(called)} functions, {sum(differs.values())} differ")
    return 1 if sum(differs.values()) or not called else 0


def is_same(library: ctypes.CDLL, call: dict[str, Any]) -> bool:
    """Repeat a call; compare the result and the bytes of all arrays with the recorded ones."""
    regions = [ctypes.create_string_buffer(data, max(len(data), 1)) for data in call["before"]]

    def address(pointer: tuple[int, int]) -> int:
        region, offset = pointer
        return ctypes.addressof(regions[region]) + offset

    arguments: list[Any] = []
    kinds: list[Any] = []
    for kind, value in call["arguments"]:
        if kind == "pointer":
            arguments.append(address(value))
            kinds.append(ctypes.c_void_p)
        elif kind == "struct":
            layout, words = value
            numbers = [address(word) if isinstance(word, tuple) else word for word in words]
            arguments.append(struct.pack("=" + layout, *numbers))
            kinds.append(ctypes.c_char_p)
        else:
            arguments.append(value)
            kinds.append(_KINDS[kind])
    function = library[call["name"]]
    function.argtypes, function.restype = kinds, _KINDS[call["returns"]]
    result = function(*arguments)
    if call["returns"] == "d":
        result = struct.pack("=d", result)
    sizes = map(len, call["before"])
    after = [hashlib.sha256(region.raw[:size]).digest() for region, size in zip(regions, sizes, strict=True)]
    return bool(result == call["result"] and after == call["after"])


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

"""Stages and packages that are sound in form and hostile in content, drawn at random."""

import io
import struct
import warnings
import zipfile
from random import Random

Files = dict[str, str]
"""Names and texts of layers, the first the root; each statement on a line of its own, as ``pxr`` wants it."""


def circles(draw: Random) -> Files:
    """Arcs between any prims of up to three layers: most of them lead in circles."""
    names = ["root", "other", "third"][: draw.randrange(1, 4)]
    prims = [f"/P{index}{'/k' * depth}" for index in range(draw.choice([2, 4, 8])) for depth in range(3)]

    def arcs() -> str:
        lines = []
        for arc in ("references", "payload", "inherits", "specializes"):
            if draw.random() < 0.3:
                targets = draw.sample(prims, draw.randrange(1, 4))
                assets = [draw.choice(["", *(f"@{name}@" for name in names)]) for _ in targets]
                local = arc in {"inherits", "specializes"}
                items = [f"{'' if local else asset}<{prim}>" for asset, prim in zip(assets, targets, strict=True)]
                lines.append(
                    f"{draw.choice(['', 'prepend ', 'append ', 'add ', 'delete '])}{arc} = [{', '.join(items)}]"
                )
        if draw.random() < 0.3:
            lines.append("instanceable = true")
        if draw.random() < 0.3:
            lines += ['prepend variantSets = "v"', f'variants = {{\nstring v = "{draw.choice("abc")}"\n}}']
        return "(\n" + "\n".join(lines) + "\n)" if lines else ""

    def prim(index: str, depth: int) -> str:
        one, other = draw.sample(prims, 2)
        body = [f"rel r = [<{one}>, <{other}>]", f"float f.connect = <{draw.choice(prims)}.f>"]
        if depth < 2:
            body.append(prim("k", depth + 1))
        if draw.random() < 0.3:
            choices = "\n".join(f'"{name}" {arcs()} {{\n{prim("k", 2)}\n}}' for name in "ab")
            body.append(f'variantSet "v" = {{\n{choices}\n}}')
        kind = draw.choice(["def", "over", "class"])
        return f'{kind} "{index}" {arcs()} {{\n' + "\n".join(body) + "\n}"

    files = {}
    for name in names:
        below = draw.sample(names, draw.randrange(len(names) + 1))
        head = f"(\nsubLayers = [{', '.join(f'@{one}@' for one in below)}]\n)\n" if below else ""
        files[name] = head + "\n".join(prim(f"P{index}", 0) for index in range(len(prims) // 3))
    return files


def growing(draw: Random) -> Files:
    """Each of many prims leads to several others, so that what is composed doubles with every line."""
    depth, fan = draw.randrange(8, 40), draw.randrange(2, 6)
    arc = draw.choice(["references", "inherits", "payload", "specializes"])
    how = draw.choice(["arcs", "children", "instances", "chain"])
    lines = []
    if how == "chain":
        for level in range(draw.choice([50, 500, 3000])):
            child = f'def "k{level}" (\nreferences = </L0>\n) {{\n}}'
            lines.append(f'def "L{level}" (\nreferences = </L{level + 1}>\n) {{\n{child}\n}}')
    elif how == "arcs":
        for level in range(depth):
            targets = ", ".join(f"</L{level + 1}_{index}>" for index in range(fan))
            lines += [
                f'def "L{level}_{index}" (\n{arc} = [{targets}]\n) {{\nfloat a = {index}\n}}' for index in range(fan)
            ]
    else:
        shared = "instanceable = true\n" if how == "instances" else ""
        for level in range(depth):
            kids = [f'def "k{index}" (\n{shared}references = </L{level + 1}>\n) {{\n}}' for index in range(fan)]
            lines.append(f'def "L{level}" {{\n' + "\n".join(kids) + "\n}")
    return {"root": "\n".join(lines)}


def nested(draw: Random) -> Files:
    """Prims, variants, dictionaries or lists within each other."""
    depth = draw.choice([5, 35, 60, 150])
    match draw.randrange(3):
        case 0:
            text = "".join(f'def "A{level}" {{\n' for level in range(depth)) + "}\n" * depth
        case 1:
            text = 'def "x" {\n}\n'
            for level in range(min(depth, 60)):
                head = f'def "v{level}" (\nvariants = {{\nstring s = "a"\n}}\nprepend variantSets = "s"\n)'
                text = f'{head} {{\nvariantSet "s" = {{\n"a" {{\n{text}\n}}\n}}\n}}\n'
        case _:
            inner = "{\n" + "dictionary d = {\n" * depth + "}\n" * depth + "}"
            text = f'def "A" (\ncustomData = {inner}\n) {{\n}}'
    return {"root": text}


HOSTILE = (circles, growing, nested)


def _zipped(entries: list[tuple[str, bytes]], method: int = zipfile.ZIP_STORED, comment: bytes = b"") -> bytearray:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", method) as archive, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of names that are there twice
        for name, data in entries:
            info = zipfile.ZipInfo()
            info.filename, info.compress_type = name, method
            archive.writestr(info, data)
        archive.comment = comment
    return bytearray(buffer.getvalue())


def _directory(data: bytearray) -> int:
    return data.index(b"PK\x01\x02")


def escaping_name(sound: dict[str, bytes], draw: Random) -> bytes:
    name = draw.choice(
        [
            "../up.usda",
            "/root.usda",
            "a/../../b.usda",
            "C:/x.usda",
            "a\\..\\b.usda",
            "./x.usda",
            "a//b.usda",
            "..",
            "x\0.usda",
        ]
    )
    return bytes(_zipped([*sound.items(), (name, b"#usda 1.0\n")]))


def compressed(sound: dict[str, bytes], draw: Random) -> bytes:
    """A bomb: a megabyte of nothing in a thousand bytes."""
    return bytes(_zipped([*sound.items(), ("big.usda", bytes(draw.choice([100, 10**6])))], zipfile.ZIP_DEFLATED))


def entry_twice(sound: dict[str, bytes], draw: Random) -> bytes:
    return bytes(_zipped([*sound.items(), draw.choice(list(sound.items()))]))


def other_local_name(sound: dict[str, bytes], draw: Random) -> bytes:
    data = _zipped(list(sound.items()))
    data[30] ^= 1
    return bytes(data)


def wrong_directory(sound: dict[str, bytes], draw: Random) -> bytes:
    """Sizes, lengths and places of the directory of entries that are huge, zero or another's."""
    data = _zipped(list(sound.items()))
    at = _directory(data) + draw.choice([8, 10, 20, 24, 28, 30, 32, 42])
    data[at : at + 4] = struct.pack("<I", draw.choice([0, 1, 30, 65535, 2**31 - 1, 2**31, 2**32 - 1, _directory(data)]))
    return bytes(data)


def wrong_end(sound: dict[str, bytes], draw: Random) -> bytes:
    """Count and place of the directory, or a second end in the comment."""
    data = _zipped(list(sound.items()), comment=b"PK\x05\x06" + bytes(draw.randrange(40)))
    at = data.index(b"PK\x05\x06") + draw.choice([8, 10, 12, 16, 20])
    data[at : at + 4] = struct.pack("<I", draw.choice([0, 1, 65535, 2**31 - 1, 2**32 - 1, _directory(data) + 1]))
    return bytes(data)


def overlapping(sound: dict[str, bytes], draw: Random) -> bytes:
    """All entries of the directory at one place: small files of which thousands come."""
    data = _zipped([("a.usda", b"#usda 1.0\n")])
    start, end = _directory(data), data.index(b"PK\x05\x06")
    count = draw.choice([2, 1000, 65535])
    data[start:end] = bytes(data[start:end]) * count
    at = data.index(b"PK\x05\x06", start)
    data[at + 8 : at + 20] = struct.pack("<HHII", count, count, at - start, start)
    return bytes(data)


def package_in_package(sound: dict[str, bytes], draw: Random) -> bytes:
    inner = bytes(_zipped(list(sound.items())))
    text = b'#usda 1.0\ndef "A" ( references = [@in.usdz@</A>, @in.usdz[a.usda]@</A>] ) {}\n'
    return bytes(_zipped([("root.usda", text), ("in.usdz", inner)]))


def first_is_no_layer(sound: dict[str, bytes], draw: Random) -> bytes:
    return bytes(_zipped([("picture.png", b"\x89PNG"), *sound.items()]))


ZIP_TRICKS = (
    escaping_name, compressed, entry_twice, other_local_name, wrong_directory, wrong_end, overlapping,
    package_in_package, first_is_no_layer,
)  # fmt: skip

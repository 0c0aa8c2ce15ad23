"""Damaged files into the C# readers: ``python tests/unity/fuzz.py COUNT SEED``.

Each is read or refused with the one exception, within two seconds and a bounded memory.
"""

import random
import struct
import sys
import tempfile
import time
import zipfile
from pathlib import Path

import reader
from pxr import Sdf
from small_stages import SMALL_STAGES

SLOWEST_S = 2.0
LARGEST_BYTES = 600_000_000
STAGES = Path(__file__).parent / "stages"


def seeds(folder: Path) -> list[Path]:
    """Sound files of all three formats to damage: with every type of value, every arc, long arrays."""
    made = []
    texts = {"values": (STAGES / "values.usda").read_text()}
    for name in ("variants", "instances", "references", "list edits", "inherits", "sublayers with offsets"):
        root = next(iter(SMALL_STAGES[name].values()))
        texts[name.replace(" ", "_")] = "#usda 1.0\n" + root.replace(" }", "\n}")
    numbers = ", ".join(str(index * 7 % 1000) for index in range(4000))
    texts["arrays"] = (
        f'#usda 1.0\ndef Mesh "A" {{\n int[] i = [{numbers}]\n double[] d = [{numbers}]\n float[] f = [{numbers}]\n}}\n'
    )
    for name, text in texts.items():
        layer = Sdf.Layer.CreateAnonymous(".usda")
        layer.ImportFromString(text)
        for form in ("usda", "usdc"):
            path = folder / f"{name}.{form}"
            layer.Export(str(path))
            made.append(path)
        package = folder / f"{name}.usdz"
        with zipfile.ZipFile(package, "w", zipfile.ZIP_STORED) as archive:
            archive.write(folder / f"{name}.usdc", f"{name}.usdc")
            archive.write(folder / f"{name}.usda", f"sub/{name}.usda")
        made.append(package)
    return made


def damaged(data: bytes, draw: random.Random) -> bytes:
    """One kind of damage, or several."""
    data = bytearray(data)
    for _ in range(draw.choice([1, 1, 2, 5, 20])):
        kind = draw.randrange(8)
        place = draw.randrange(len(data)) if data else 0
        if kind == 0 and data:
            data[place] ^= 1 << draw.randrange(8)
        elif kind == 1 and data:
            data[place] = draw.choice([0, 1, 127, 128, 254, 255])
        elif kind == 2:
            del data[place:]
        elif kind == 3:
            huge = draw.choice([2**31 - 1, 2**32 - 1, 2**40, 2**63 - 1, 2**63, 2**64 - 1, 0, 1, 65535])
            data[place : place + 8] = struct.pack("<Q", huge)
        elif kind == 4:
            del data[place : place + draw.randrange(1, 30)]
        elif kind == 5:
            start = draw.randrange(len(data)) if data else 0
            data[place:place] = data[start : start + draw.randrange(1, 200)]
        elif kind == 6:
            data[place:place] = draw.choice(
                [b"{", b"}", b"[", b"(", b'"', b"@", b"<", b"def ", b"1e999", b"\xff\xfe", b"None"]
            )
        elif len(data) > 100:
            # near the end and the beginning stand tables of contents
            place = draw.choice([draw.randrange(8, 96), len(data) - 1 - draw.randrange(min(400, len(data) - 1))])
            data[place] = draw.randrange(256)
    return bytes(data)


def hostile(draw: random.Random) -> str:
    """Text that grows when it is composed: each of many prims leads to several others."""
    depth, fan = draw.randrange(8, 40), draw.randrange(2, 6)
    arc = draw.choice(["references", "inherits", "payload", "specializes", "children", "deep", "variants"])
    lines = ["#usda 1.0"]
    if arc == "children":
        for level in range(depth):
            kids = "".join(f'def "k{i}" ( references = </L{level + 1}> ) {{}}\n' for i in range(fan))
            lines.append(f'def "L{level}" {{\n{kids}}}')
    elif arc == "deep":
        count = draw.choice([50, 500, 3000])
        lines += [
            f'def "L{level}" ( references = </L{level + 1}> ) {{ def "k{level}" ( references = </L0> ) {{}}\n}}'
            for level in range(count)
        ]
    elif arc == "variants":
        inner = 'def "x" {}\n'
        for level in range(draw.choice([5, 30, 200])):
            head = f'def "v{level}" ( variants = {{ string s = "a" }} prepend variantSets = "s" )'
            inner = f'{head} {{ variantSet "s" = {{ "a" {{ {inner} }} }} }}\n'
        lines.append(inner)
    else:
        for level in range(depth):
            targets = ", ".join(
                f"</L{level + 1}/k{i}>" if arc == "inherits" and level % 2 else f"</L{level + 1}_{i}>"
                for i in range(fan)
            )
            for i in range(fan):
                lines.append(f'def "L{level}_{i}" ( {arc} = [{targets}] ) {{ float a = {i}\n }}')
    return "\n".join(lines)


def run(count: int, seed: int, usd_dump: reader.Reader, folder: Path) -> list[str]:
    """Whatever went wrong, one line each."""
    draw = random.Random(seed)  # noqa: S311 - of test inputs
    sound = [(path, path.read_bytes()) for path in seeds(folder)]
    wrong = []
    for number in range(count):
        if draw.random() < 0.05:
            path, data = folder / "hostile.usda", hostile(draw).encode()
        else:
            source, original = draw.choice(sound)
            path, data = folder / f"damaged{source.suffix}", damaged(original, draw)
        path.write_bytes(data)
        start = time.process_time(), time.monotonic()
        try:
            answer = usd_dump.ask("fuzz", path)
        except AssertionError as error:
            wrong.append(f"{seed}:{number} {path.suffix}: {error}")
            usd_dump.close()
            (folder / f"wrong_{number}{path.suffix}").write_bytes(data)
            continue
        seconds = answer["cpu_s"]
        if "crash" in answer or seconds > SLOWEST_S or answer["bytes"] > LARGEST_BYTES:
            wrong.append(f"{seed}:{number} {path.suffix}: {answer} {time.monotonic() - start[1]:.1f} s")
            (folder / f"wrong_{number}{path.suffix}").write_bytes(data)
    return wrong


def main() -> None:
    count, seed = int(sys.argv[1]), int(sys.argv[2])
    folder = Path(tempfile.mkdtemp(prefix="usd_fuzz_"))
    running = reader.Reader(reader.compile_program(folder))
    wrong = run(count, seed, running, folder)
    running.close()
    print("\n".join(wrong[:40]))  # noqa: T201
    print(f"{count} files, {len(wrong)} wrong; kept in {folder}")  # noqa: T201
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()

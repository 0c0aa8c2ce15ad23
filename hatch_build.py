"""Compiles the C files of ``garage2usd/native`` where a wheel is built or the repository is installed for development.

``python hatch_build.py`` does it by hand. The compiler is ``$CC``, else the system's ``cc``, else that of the package
``ziglang``, which an installation without a compiler fetches for the time of building.
"""
# ruff: noqa: S603 - compilers are run

import functools
import importlib.util
import os
import shlex
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

__all__ = ["NativeLoops", "compile_loops"]

NATIVE = Path(__file__).parent / "garage2usd" / "native"
LIBRARY = NATIVE / "loops.so"

_LANGUAGE = ("-std=c11", "-Wall", "-Wextra")
# a product and a sum are rounded one by one, so that plans are the same on every machine
_ARITHMETIC = ("-O3", "-ffp-contract=off", "-fno-math-errno")
# the checks of arrays' bounds are left out; the tests with sanitizers take them in by -UNDEBUG
_UNCHECKED = ("-DNDEBUG",)
_LIBRARY = ("-fPIC", "-shared", "-fvisibility=hidden")
_SMALLEST = b"#include <math.h>\n#include <stdint.h>\ndouble of(double x) { return log(x); }\n"


def compile_loops(library: Path = LIBRARY, source: Path = NATIVE, flags: tuple[str, ...] = ()) -> None:
    """Compile all C files of a folder into a shared library, which is there whole or not at all.

    Raises
    ------
    SystemExit
        If the compiler is not there, or refuses a file.
    """
    unfinished = library.with_name(f"{library.name}.{os.getpid()}")
    files = sorted(source.glob("*.c"))
    command = [
        *_compiler(),
        *_LANGUAGE,
        *_ARITHMETIC,
        *_UNCHECKED,
        *_LIBRARY,
        *flags,
        f'-DSOURCES_DIGEST="{_digest_of(source)}"',
        "-o",
        str(unfinished),
        *map(str, files),
        "-lm",
    ]
    try:
        subprocess.run(command, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"garage2usd's loops in C are not compiled ({error}); the environment variable CC names the compiler")
    unfinished.replace(library)


def _digest_of(source: Path) -> str:
    """The digest that ``garage2usd.native`` compares; its module is loaded alone, as NumPy is not there yet."""
    spec = importlib.util.spec_from_file_location("garage2usd_native_digest", NATIVE / "digest.py")
    if spec is None or spec.loader is None:
        sys.exit(f"{NATIVE / 'digest.py'} cannot be loaded")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return str(module.digest_of(source))


def _compiler() -> list[str]:
    if given := os.environ.get("CC"):
        return shlex.split(given)
    return ["cc"] if _has_system_compiler() else [sys.executable, "-m", "ziglang", "cc", "-mcpu=baseline"]


@functools.cache
def _has_system_compiler() -> bool:
    """Whether ``cc`` is there, with the headers of the C library."""
    command = ["cc", *_LIBRARY, "-x", "c", "-", "-o", os.devnull]
    try:
        return subprocess.run(command, input=_SMALLEST, capture_output=True, check=False).returncode == 0
    except OSError:
        return False


class NativeLoops(BuildHookInterface[Any]):
    """Puts the library into the wheel, which is then one for this kind of machine."""

    def dependencies(self) -> list[str]:
        """A compiler where there is none."""
        return [] if os.environ.get("CC") or _has_system_compiler() else ["ziglang>=0.13"]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:  # noqa: ARG002 - hatchling's interface
        """Compile before the files are gathered."""
        compile_loops()
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
        build_data["artifacts"].append("garage2usd/native/loops.so")


if __name__ == "__main__":
    compile_loops()

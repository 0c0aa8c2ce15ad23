"""Compiles the C files of ``garage2usd/native`` where a wheel is built or the repository is installed for development.

``python hatch_build.py`` does it by hand. The compiler is ``$CC``, else the system's ``cc``, else that of the package
``ziglang``, which an installation without a compiler fetches for the time of building.
"""

import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NATIVE = Path(__file__).parent / "garage2usd" / "native"
# no multiplication and addition in one rounding, so that plans are the same on every machine
FLAGS = ("-O2", "-std=c11", "-ffp-contract=off", "-fno-math-errno", "-fPIC", "-shared", "-fvisibility=hidden", "-Wall", "-Wextra")
LIBRARY = NATIVE / "loops.so"


def compile_loops(library: Path = LIBRARY, source: Path = NATIVE, flags: tuple[str, ...] = ()) -> None:
    """Compile all C files of a folder into a shared library, which is there whole or not at all."""
    unfinished = library.with_name(f"{library.name}.{os.getpid()}")
    command = [*_compiler(), *FLAGS, *flags, "-o", unfinished, *sorted(source.glob("*.c")), "-lm"]
    subprocess.run(command, check=True)
    unfinished.replace(library)


def _compiler() -> list[str]:
    given = os.environ.get("CC")
    if given:
        return shlex.split(given)
    system = shutil.which("cc")
    return [system] if system else [sys.executable, "-m", "ziglang", "cc", "-mcpu=baseline"]


class NativeLoops(BuildHookInterface[Any]):
    """Puts the library into the wheel, which is then one for this kind of machine."""

    def dependencies(self) -> list[str]:
        """A compiler where there is none."""
        return [] if os.environ.get("CC") or shutil.which("cc") else ["ziglang>=0.13"]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile before the files are gathered."""
        compile_loops()
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
        build_data["artifacts"].append("garage2usd/native/loops.so")


if __name__ == "__main__":
    compile_loops()

"""Compiles the C files of ``garage2usd/native`` where a wheel is built or the repository is installed for development.

``python hatch_build.py`` does it by hand. The compiler is ``$CC``, else the system's ``cc``, else that of the package
``ziglang``, which an installation without a compiler fetches for the time of building. The environment variable
``GARAGE2USD_TARGET`` names another system, one of `TARGETS`, whose wheel ``ziglang`` makes on this one.
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
from typing import Any, NamedTuple

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

__all__ = ["TARGETS", "NativeLoops", "Target", "compile_loops"]

NATIVE = Path(__file__).parent / "garage2usd" / "native"


class Target(NamedTuple):
    """A system for which wheels are made.

    Attributes
    ----------
    triple
        As the compiler has it, with the oldest C library or system that runs what it makes.
    tag
        As wheels name it.
    suffix
        How the names of its libraries end.
    """

    triple: str
    tag: str
    suffix: str


TARGETS = {
    "linux-x86_64": Target("x86_64-linux-gnu.2.17", "manylinux_2_17_x86_64", ".so"),
    "linux-aarch64": Target("aarch64-linux-gnu.2.17", "manylinux_2_17_aarch64", ".so"),
    "macos-x86_64": Target("x86_64-macos.11.0", "macosx_11_0_x86_64", ".dylib"),
    "macos-arm64": Target("aarch64-macos.11.0", "macosx_11_0_arm64", ".dylib"),
    "windows-x86_64": Target("x86_64-windows-gnu", "win_amd64", ".dll"),
}
"""By name. Neither Alpine Linux nor Windows on Arm has the package ``usd-core``."""
LIBRARY = NATIVE / f"loops{ {'win32': '.dll', 'darwin': '.dylib'}.get(sys.platform, '.so') }"

_ZIG = (sys.executable, "-m", "ziglang", "cc")
_ZIG_NEEDED = "ziglang>=0.13"
_LANGUAGE = ("-std=c11", "-Wall", "-Wextra")
# a product and a sum are rounded one by one, so that plans are the same on every machine
_ARITHMETIC = ("-O3", "-ffp-contract=off", "-fno-math-errno")
# the checks of arrays' bounds are left out; the tests with sanitizers take them in by -UNDEBUG
_UNCHECKED = ("-DNDEBUG",)
_LIBRARY = ("-shared", "-fvisibility=hidden")
_SMALLEST = b"#include <math.h>\n#include <stdint.h>\ndouble of(double x) { return log(x); }\n"


def compile_loops(
    library: Path = LIBRARY, source: Path = NATIVE, flags: tuple[str, ...] = (), target: Target | None = None
) -> None:
    """Compile all C files of a folder into a shared library, which is there whole or not at all.

    Parameters
    ----------
    library, source
        The library, and the folder.
    flags
        Of the compiler, beside the usual ones.
    target
        The system that the library is for; left out, this one.

    Raises
    ------
    SystemExit
        If the compiler is not there, or refuses a file.
    """
    unfinished = library.with_name(f"{library.name}.{os.getpid()}")
    files = sorted(source.glob("*.c"))
    command = [
        *_compiler(target),
        *_LANGUAGE,
        *_ARITHMETIC,
        *_UNCHECKED,
        *_LIBRARY,
        *(() if library.suffix == ".dll" else ("-fPIC",)),
        # without symbols for debuggers, which are many times the code
        *(("-s",) if target is not None and target.suffix != ".dylib" else ()),
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


def _compiler(target: Target | None) -> list[str]:
    if target is not None:
        return [*_ZIG, "-target", target.triple, "-mcpu=baseline"]
    if given := os.environ.get("CC"):
        return shlex.split(given)
    return ["cc"] if _has_system_compiler() else [*_ZIG, "-mcpu=baseline"]


@functools.cache
def _has_system_compiler() -> bool:
    """Whether ``cc`` is there, with the headers of the C library."""
    command = ["cc", *_LIBRARY, *(() if sys.platform == "win32" else ("-fPIC",)), "-x", "c", "-", "-o", os.devnull]
    try:
        return subprocess.run(command, input=_SMALLEST, capture_output=True, check=False).returncode == 0
    except OSError:
        return False


def _asked_target() -> Target | None:
    """The target that the environment names, None for this system.

    Raises
    ------
    SystemExit
        If there is no such target.
    """
    name = os.environ.get("GARAGE2USD_TARGET")
    if name and name not in TARGETS:
        sys.exit(f"GARAGE2USD_TARGET: got {name!r}; allowed: {', '.join(TARGETS)}")
    return TARGETS[name] if name else None


class NativeLoops(BuildHookInterface[Any]):
    """Puts the library into the wheel, which is then one for this kind of machine."""

    def dependencies(self) -> list[str]:
        """A compiler where there is none."""
        needs_zig = _asked_target() or not (os.environ.get("CC") or _has_system_compiler())
        return [_ZIG_NEEDED] if needs_zig else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:  # noqa: ARG002 - hatchling's interface
        """Compile before the files are gathered."""
        target = _asked_target()
        if target is None:
            compile_loops()
            library, tag = LIBRARY, sysconfig.get_platform().replace("-", "_").replace(".", "_")
        else:
            # beside that of this system, which stays
            library, tag = Path(self.root, "build", target.tag, f"loops{target.suffix}"), target.tag
            library.parent.mkdir(parents=True, exist_ok=True)
            compile_loops(library, target=target)
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{tag}"
        build_data["force_include"][str(library)] = f"garage2usd/native/{library.name}"


if __name__ == "__main__":
    compile_loops()

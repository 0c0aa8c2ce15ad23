"""Make the wheels of all systems on this one, and check them: ``python release/wheels.py FOLDER``.

Each wheel holds one library of loops, which is read: its machine, its names, what it needs of the system. Judges of
wheels see tags and metadata. Then the dependencies of each Python are resolved for the system, and with ``--download``
those of one Python fetched. ``make wheels`` installs what this needs.
"""
# ruff: noqa: S603 - builders and judges are run

import argparse
import importlib.util
import io
import os
import re
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple, Protocol

import pefile
from elftools.elf.elffile import ELFFile
from elftools.elf.gnuversions import GNUVerNeedSection
from macholib.mach_o import LC_CODE_SIGNATURE, LC_LOAD_DYLIB
from macholib.MachO import MachO
from macholib.SymbolTable import SymbolTable

REPOSITORY = Path(__file__).resolve().parent.parent
PACKAGE = "garage2usd"
PYTHONS = ("3.11", "3.12", "3.13", "3.14")
EXTRAS = ("dataset", "gymnasium", "sensors")
"""Those whose packages every system has; Blender's module is for one Python."""
_SCENARIOS = "maps"
_WITHOUT_SCENARIOS = {"linux-aarch64", "macos-arm64", "3.14"}
"""Systems and Pythons for which a package of OpenSCENARIO's has no wheel, so that a compiler makes it."""
_MACHINES = {
    "linux-x86_64": "EM_X86_64",
    "linux-aarch64": "EM_AARCH64",
    "macos-x86_64": 0x01000007,
    "macos-arm64": 0x0100000C,
    "windows-x86_64": 0x8664,
}
"""By target the machine as its format of libraries numbers it."""
_GLIBC = (2, 17)
_DEFINED_OUTSIDE = 0x0F
"""Type of a symbol in Apple's libraries that stands in a section and is found by others."""
_OF_LINKER = {"__dso_handle", "_mh_dylib_header"}
"""What Apple's linker adds to each library."""
_SYSTEM_LIBRARIES = {
    ".so": re.compile(r"lib(c|m|pthread|dl)\.so\.\d|ld-linux.*"),
    ".dylib": re.compile(r"/usr/lib/libSystem\.B\.dylib"),
    ".dll": re.compile(r"(KERNEL32|api-ms-win-crt-[a-z0-9-]+|ucrtbase)\.dll", re.IGNORECASE),
}
_UV_PLATFORMS = {
    "linux-x86_64": "x86_64-manylinux_2_28",
    "linux-aarch64": "aarch64-manylinux_2_28",
    "macos-x86_64": "x86_64-apple-darwin",
    "macos-arm64": "aarch64-apple-darwin",
    "windows-x86_64": "x86_64-pc-windows-msvc",
}
_MACOS = "14.0"
_DOWNLOADED = "3.12"
_ALSO = {
    "linux-x86_64": ("manylinux_2_28_x86_64", "manylinux2014_x86_64"),
    "linux-aarch64": ("manylinux_2_28_aarch64", "manylinux2014_aarch64"),
    "macos-x86_64": ("macosx_14_0_x86_64",),
    "macos-arm64": ("macosx_14_0_arm64",),
    "windows-x86_64": (),
}
"""The oldest systems that all dependencies run on, which are newer than ours."""


class Library(NamedTuple):
    """What a library of loops says of itself.

    Attributes
    ----------
    machine
        As its format numbers it.
    exports
        The names that others find.
    needs
        The libraries that it loads.
    faults
        What else is wrong with it.
    """

    machine: object
    exports: frozenset[str]
    needs: tuple[str, ...]
    faults: tuple[str, ...] = ()


class Target(Protocol):
    """What ``hatch_build.py`` says of a target."""

    tag: str
    suffix: str


def main() -> None:
    """Make and check; the exit code is 1 where something is wrong."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--no-index", action="store_true", help="ask no package index for the dependencies")
    parser.add_argument("--download", action="store_true", help="fetch the dependencies too: 100 MB a system")
    parser.add_argument("--check-only", action="store_true", help="check the wheels that are there")
    asked = parser.parse_args()
    targets = _targets()
    if not asked.check_only:
        make(asked.folder, targets)
    faults = [fault for name in targets for fault in check(asked.folder, name, targets, has_index=not asked.no_index)]
    if asked.download:
        faults += [fault for name, target in targets.items() for fault in _of_download(asked.folder, name, target)]
    faults += _of_program("twine", "check", "--strict", *map(str, sorted(asked.folder.glob("*"))))
    for fault in faults:
        print(f"FAULT {fault}")
    print(f"{len(targets)} wheels, {len(faults)} faults")
    sys.exit(bool(faults))


def make(folder: Path, targets: Mapping[str, Target]) -> None:
    """Make the wheel of each target, and the source distribution."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob(f"{PACKAGE}-*"):
        old.unlink()
    build = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder.resolve())]
    subprocess.run([*build, "--sdist", str(REPOSITORY)], check=True)
    for name in targets:
        subprocess.run([*build, "--wheel", str(REPOSITORY)], check=True, env={**os.environ, "GARAGE2USD_TARGET": name})


def check(folder: Path, name: str, targets: Mapping[str, Target], *, has_index: bool) -> Iterator[str]:
    """Yield what is wrong with the wheel of a target."""
    target = targets[name]
    wheels = list(folder.glob(f"{PACKAGE}-*-py3-none-{target.tag}.whl"))
    if len(wheels) != 1:
        yield f"{name}: {len(wheels)} wheels with the tag {target.tag}"
        return
    (wheel,) = wheels
    with zipfile.ZipFile(wheel) as archive:
        libraries = [entry for entry in archive.namelist() if Path(entry).suffix in _SYSTEM_LIBRARIES]
        if libraries != [f"{PACKAGE}/native/loops{target.suffix}"]:
            yield f"{name}: its libraries are {libraries}"
            return
        data = archive.read(libraries[0])
    yield from (f"{name}: {fault}" for fault in _of_library(name, data, target.suffix))
    yield from _of_program("check_wheel_contents", "--no-config", str(wheel))
    if name.startswith("linux"):
        yield from _of_program("auditwheel", "show", str(wheel), expected=target.tag)
    print(f"{name}: {wheel.name}, {wheel.stat().st_size:,} bytes, library {len(data):,} bytes")
    if has_index:
        for python in PYTHONS:
            yield from _of_dependencies(name, python)


def _of_library(name: str, data: bytes, suffix: str) -> Iterator[str]:
    """Yield what is wrong with the library of a target."""
    try:
        library = _READERS[suffix](data)
    except Exception as error:  # noqa: BLE001 - another format than the name says
        yield f"its library is not of the format {suffix} ({error})"
        return
    if library.machine != _MACHINES[name]:
        yield f"its library is for the machine {library.machine}, not {_MACHINES[name]}"
    if different := library.exports ^ _exports():
        yield f"its library has too many names, or too few: {sorted(different)}"
    for needed in library.needs:
        if not _SYSTEM_LIBRARIES[suffix].fullmatch(needed):
            yield f"its library needs {needed}"
    yield from library.faults


def _of_dependencies(name: str, python: str) -> Iterator[str]:
    """Yield what has no wheels for a system and a Python, of all dependencies and of their own."""
    packages, said = _resolved(name, python, EXTRAS)
    if said:
        yield f"{name}, Python {python}: {said}"
    _, said = _resolved(name, python, [_SCENARIOS])
    is_known = name in _WITHOUT_SCENARIOS or python in _WITHOUT_SCENARIOS
    if bool(said) != is_known:
        yield f"{name}, Python {python}: OpenSCENARIO's packages have {said or 'wheels now, so tell users'}"
    print(f"{name}, Python {python}: {packages} packages, {'no ' if said else ''}wheels for OpenSCENARIO")


def _resolved(name: str, python: str, extras: Sequence[str]) -> tuple[int, str]:
    """Resolve extras for a system and a Python from wheels alone: how many packages, and what stands against it."""
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    needed = project["dependencies"] + [line for extra in extras for line in project["optional-dependencies"][extra]]
    with tempfile.TemporaryDirectory() as folder:
        asked = Path(folder, "asked.in")
        asked.write_text("\n".join(needed) + "\n", encoding="utf-8", newline="\n")
        run = subprocess.run(
            [
                *(sys.executable, "-m", "uv", "pip", "compile", "--quiet", "--no-header", "--no-annotate"),
                *("--only-binary", ":all:", "--python-platform", _UV_PLATFORMS[name], "--python-version", python),
                str(asked),
            ],
            env={**os.environ, "MACOSX_DEPLOYMENT_TARGET": _MACOS},
            capture_output=True,
            text=True,
            encoding="utf-8",
            check=False,
        )
    return len(run.stdout.splitlines()), " ".join(run.stderr.split()) if run.returncode else ""


def _of_download(folder: Path, name: str, target: Target) -> list[str]:
    """Fetch a wheel's dependencies for its system, as its users' pip does."""
    (wheel,) = folder.glob(f"{PACKAGE}-*-py3-none-{target.tag}.whl")
    platforms = [target.tag, *_ALSO[name]]
    with tempfile.TemporaryDirectory() as packages:
        return _of_program(
            *("pip", "download", "--quiet", "--disable-pip-version-check", "--only-binary", ":all:"),
            *("--python-version", _DOWNLOADED, "--dest", packages),
            *(word for platform in platforms for word in ("--platform", platform)),
            str(wheel),
        )


def _of_program(module: str, *arguments: str, expected: str | None = None) -> list[str]:
    """Run a judge; what it says where it refuses, or does not say what is expected."""
    run = subprocess.run(
        [sys.executable, "-m", module, *arguments], capture_output=True, text=True, encoding="utf-8", check=False
    )
    said = f"{run.stdout}\n{run.stderr}"
    if run.returncode == 0 and (expected is None or expected in said):
        return []
    return [f"{module} {' '.join(arguments)}: {' '.join(said.split())}"]


def _of_elf(data: bytes) -> Library:
    elf = ELFFile(io.BytesIO(data))
    exports = {
        symbol.name
        for symbol in elf.get_section_by_name(".dynsym").iter_symbols()
        if symbol["st_shndx"] != "SHN_UNDEF" and symbol["st_info"]["bind"] == "STB_GLOBAL"
    }
    dynamic = elf.get_section_by_name(".dynamic")
    needs = tuple(tag.needed for tag in dynamic.iter_tags() if tag.entry.d_tag == "DT_NEEDED")
    versions = {
        aux.name
        for section in elf.iter_sections()
        if isinstance(section, GNUVerNeedSection)
        for _, auxiliaries in section.iter_versions()
        for aux in auxiliaries
    }
    newer = [
        version
        for version in sorted(versions)
        if (found := re.fullmatch(r"GLIBC_(\d+)\.(\d+)(\.\d+)?", version)) and (int(found[1]), int(found[2])) > _GLIBC
    ]
    return Library(elf["e_machine"], frozenset(exports), needs, tuple(f"needs {version}" for version in newer))


def _of_macho(data: bytes) -> Library:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "loops.dylib")
        path.write_bytes(data)
        macho = MachO(str(path))
        (header,) = macho.headers
        table = SymbolTable(macho, header)
        defined = {name.decode() for symbol, name in table.nlists if symbol.n_type == _DEFINED_OUTSIDE}
    needs = tuple(
        content.rstrip(b"\0").decode() for command, _, content in header.commands if command.cmd == LC_LOAD_DYLIB
    )
    is_signed = any(command.cmd == LC_CODE_SIGNATURE for command, _, _ in header.commands)
    is_of_arm = header.header.cputype == _MACHINES["macos-arm64"]
    faults = ("is not signed, and Apple's processors run nothing unsigned",) if is_of_arm and not is_signed else ()
    exports = frozenset(name.removeprefix("_") for name in defined) - _OF_LINKER
    return Library(header.header.cputype, exports, needs, faults)


def _of_pe(data: bytes) -> Library:
    portable = pefile.PE(data=data)
    exports = {symbol.name.decode() for symbol in portable.DIRECTORY_ENTRY_EXPORT.symbols}
    needs = tuple(entry.dll.decode() for entry in portable.DIRECTORY_ENTRY_IMPORT)
    return Library(portable.FILE_HEADER.Machine, frozenset(exports), needs)


_READERS: dict[str, Callable[[bytes], Library]] = {".so": _of_elf, ".dylib": _of_macho, ".dll": _of_pe}


def _exports() -> frozenset[str]:
    """The functions that C gives to Python, and the digest of the sources."""
    native = REPOSITORY / PACKAGE / "native"
    text = "\n".join(path.read_text(encoding="utf-8") for path in sorted(native.glob("*.[ch]")))
    return frozenset(re.findall(r"^FROM_PYTHON\s+\w+ \*?(\w+)\(", text, flags=re.MULTILINE)) | {"sources_digest"}


def _targets() -> dict[str, Target]:
    """The targets of ``hatch_build.py``, which belongs to no package."""
    spec = importlib.util.spec_from_file_location("hatch_build", REPOSITORY / "hatch_build.py")
    if spec is None or spec.loader is None:
        sys.exit("hatch_build.py cannot be loaded")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return dict(module.TARGETS)


if __name__ == "__main__":
    main()

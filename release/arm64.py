"""Compare garages made on emulated 64-bit Arm Linux with those of this machine: ``release/arm64.py DIST FOLDER``.

Takes the wheel for Arm that ``make wheels`` puts into DIST. FOLDER gets Debian's Python 3.11 for Arm, and the wheels
for Arm of the packages of this Python in the same versions. ``qemu-aarch64-static``, of ``qemu-user-static``, runs
``benchmarks/digests.py`` there on ten garages. Plan, layout, report, stage, exports, findings, proofs and a drive are
compared with those of this machine. So are the files and words of the commands ``build``, ``check``, ``drive``,
``export`` and ``plan`` for a small garage, and the digests of ``garage2usd doctor``. Names of garages in
``benchmarks/digests.py`` after FOLDER take the place of the ten. Run it with the repository's
``.venv/bin/python``, which must be 3.11; one core takes 20 minutes. The exit code is 1 where something differs.
"""
# ruff: noqa: S603 - package managers and the emulator are run

import argparse
import hashlib
import importlib.metadata
import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent
GARAGES = ("plain_1", "angled_contour_2", "two_portals_3", "uk_1", "given_loop", "uniform")
SAMPLES = ("paper_7x9", "hand_drawn", "dimensioned", "looks")
COMMANDS = (
    ("build", "small.toml", "-o", "garage.usdz"),
    ("check", "garage.usdz"),
    ("drive", "garage.usdz", "-o", "drive.json"),
    ("export", "garage.usdz", "-o", "garage.xodr", "-o", "garage.osm", "-o", "garage.glb", "-o", "garage.yaml"),
    ("plan", "garage.usdz", "-o", "plan.svg"),
)
_SMALL = "seed = 1\n[site]\nwidth_cells = 5\nheight_cells = 5\n"
_OF_MACHINE = {".usdz"}
"""Suffixes of files that hold .usdc, in which OpenUSD orders tables otherwise on other machines."""
_DEBIAN = (
    *("python3.11-minimal", "libpython3.11-stdlib", "libc6", "libstdc++6", "libgomp1", "zlib1g", "libffi8"),
    *("libexpat1", "libssl3", "libuuid1"),
)
_NEEDED = ("distributed", "jinja2", "matplotlib", "pyarrow", "pyproj", "trimesh")
"""Of extras, the packages of which there is a wheel for Arm."""
_PLATFORMS = ("manylinux2014_aarch64", *(f"manylinux_2_{minor}_aarch64" for minor in (17, 24, 26, 27, 28, 31, 34)))
_TIMES = re.compile(r"^ *seconds .*$", re.MULTILINE)
_DIGESTS = re.compile(r"plan \w+, stage \w+, ways \w+, \d+ of \d+ stalls driven")


def main() -> None:
    """Fetch what is missing, run and compare."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("dist", type=Path, help="the folder of the wheels")
    parser.add_argument("folder", type=Path, help="where the Arm Linux goes")
    parser.add_argument("names", nargs="*", help="garages that are compared; left out, ten")
    asked = parser.parse_args()
    folder = asked.folder.resolve()
    if sys.version_info[:2] != (3, 11) or shutil.which("qemu-aarch64-static") is None:
        sys.exit("run with Python 3.11, and install qemu-user-static")
    if not (folder / "root").exists():
        fetch_system(folder)
    if not (folder / "packages").exists():
        fetch_packages(folder)
    (wheel,) = asked.dist.glob("garage2usd-*_aarch64.whl")
    shutil.rmtree(folder / "site", ignore_errors=True)
    for each in [*sorted((folder / "packages").glob("*.whl")), wheel]:
        zipfile.ZipFile(each).extractall(folder / "site")
    here = {**os.environ, "PYTHONPATH": str(REPOSITORY)}
    root = folder / "root"
    there = {**os.environ, "PYTHONPATH": str(folder / "site"), "PYTHONHOME": str(root / "usr")}
    emulated = ["qemu-aarch64-static", "-L", str(root), str(root / "usr/bin/python3.11")]
    made = [
        commands([sys.executable], here, folder / "commands-x86-64"),
        commands(emulated, there, folder / "commands-arm64"),
    ]
    changed = sorted(name for name in {*made[0], *made[1]} if made[0].get(name) != made[1].get(name))
    differs = bool(changed)
    print(f"commands: {len(made[0])} outputs, {', '.join(changed) or 'same'}", flush=True)
    digests = [str(REPOSITORY / "benchmarks/digests.py"), "--portable", "--file", str(folder / "x86-64.json")]
    names = asked.names or [*GARAGES, *(str(REPOSITORY / f"samples/{name}.toml") for name in SAMPLES)]
    subprocess.run([sys.executable, *digests, "--write", *names], env=here, cwd=folder, check=True)
    differs |= subprocess.run([*emulated, *digests, *names], env=there, cwd=folder, check=False).returncode != 0
    doctor = ["-m", "garage2usd", "doctor"]
    told = [_doctor([sys.executable, *doctor], here, folder), _doctor([*emulated, *doctor], there, folder)]
    differs |= told[0] != told[1] or len(told[0]) < 3  # noqa: PLR2004 - its three garages
    print("doctor:", "differs" if told[0] != told[1] else "same", *told[1], sep="\n  ")
    sys.exit(differs)


def fetch_system(folder: Path) -> None:
    """Unpack Debian's Python for Arm and the libraries that it needs."""
    state = folder / "apt"
    for name in ("state/lists/partial", "cache/archives/partial"):
        (state / name).mkdir(parents=True, exist_ok=True)
    (state / "status").touch()
    settings = {
        "APT::Architecture": "arm64",
        "APT::Architectures": "arm64",
        "Debug::NoLocking": "1",
        "Dir::State": state / "state",
        "Dir::State::status": state / "status",
        "Dir::Cache": state / "cache",
    }
    apt = ["apt-get", *(word for name, value in settings.items() for word in ("-o", f"{name}={value}"))]
    subprocess.run([*apt, "update"], check=True)
    subprocess.run([*apt, "install", "-y", "--download-only", "--no-install-recommends", *_DEBIAN], check=True)
    for package in sorted((state / "cache/archives").glob("*.deb")):
        subprocess.run([shutil.which("dpkg") or "dpkg", "-x", str(package), str(folder / "root")], check=True)


def fetch_packages(folder: Path) -> None:
    """Download the wheels for Arm of what this Python has, in the same versions."""
    limits = folder / "constraints.txt"
    installed = {each.name: each.version for each in importlib.metadata.distributions() if each.name != "garage2usd"}
    limits.write_text("".join(f"{name}=={version}\n" for name, version in sorted(installed.items())), encoding="utf-8")
    needed = [line for line in importlib.metadata.requires("garage2usd") or () if "extra ==" not in line]
    subprocess.run(
        [
            *(sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check"),
            *("--only-binary", ":all:", "--python-version", "3.11", "--implementation", "cp"),
            *(word for platform in _PLATFORMS for word in ("--platform", platform)),
            *("--dest", str(folder / "packages"), "--constraint", str(limits), *needed, *_NEEDED),
        ],
        check=True,
    )


def commands(python: Sequence[str], environment: dict[str, str], folder: Path) -> dict[str, str]:
    """Run `COMMANDS` in a new folder: exit code and output of each, and the digest of each file."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "small.toml").write_text(_SMALL, encoding="utf-8", newline="\n")
    made = {}
    for command in COMMANDS:
        run = subprocess.run(
            [*python, "-m", "garage2usd", *command],
            env=environment,
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
        )
        made[command[0]] = f"exit code {run.returncode}, {_TIMES.sub('', run.stdout)}"
    for path in sorted(path for path in folder.rglob("*") if path.is_file() and path.suffix not in _OF_MACHINE):
        data = path.read_bytes()
        if path.name.endswith("_report.json"):
            data = json.dumps({key: each for key, each in json.loads(data).items() if key != "seconds"}).encode()
        made[path.name] = hashlib.sha256(data).hexdigest()
    return made


def _doctor(command: Sequence[str], environment: dict[str, str], folder: Path) -> list[str]:
    """Run ``garage2usd doctor``; the digests of its garages, without times."""
    run = subprocess.run(command, env=environment, cwd=folder, capture_output=True, text=True, check=False)
    return _DIGESTS.findall(run.stdout) or [run.stdout + run.stderr]


if __name__ == "__main__":
    main()

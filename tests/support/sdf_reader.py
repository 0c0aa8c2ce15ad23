"""Worlds of SDF as libsdformat reads them, by a program that is compiled for it."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

_SOURCE = Path(__file__).with_name("sdf_world.cc")


def _module():
    """Name of libsdformat among the modules of pkg-config; empty without it."""
    if shutil.which("pkg-config") is None or shutil.which("g++") is None:
        return ""
    listed = subprocess.run(["pkg-config", "--list-all"], capture_output=True, text=True, check=True).stdout
    found = [name for name in re.findall(r"^(sdformat\d+)\s", listed, re.MULTILINE) if int(name[8:]) >= 12]
    return max(found, key=lambda name: int(name[8:]), default="")


SDFORMAT = _module()


def compiled(folder):
    """The program, compiled in a folder."""
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", SDFORMAT], capture_output=True, text=True, check=True)
    program = folder / "sdf_world"
    command = ["g++", "-O0", "-std=c++17", str(_SOURCE), "-o", str(program), *flags.stdout.split()]
    subprocess.run(command, check=True, timeout=300)
    return program


def read_world(program, path):
    """Entries of a world by kind and name, with the matrix of each to the world, in which models are placed."""
    run = subprocess.run([str(program), str(path)], capture_output=True, text=True, check=False, timeout=300)
    assert (run.returncode, run.stderr) == (0, ""), run.stderr[:2000]
    found, models = {}, {}
    for entry in map(json.loads, run.stdout.splitlines()):
        if "move" in entry:
            entry["matrix"] = models.get(entry.get("model"), np.eye(4)) @ _matrix(entry)
        if entry["kind"] == "model":
            models[entry["name"]] = entry["matrix"]
        key = (entry["model"], entry["name"]) if entry["kind"] == "visual" else entry["name"]
        if entry["kind"] == "collision" and key.startswith("Ground_"):  # one of each level
            key = f"{entry['model']}/{key}"
        assert key not in found.setdefault(entry["kind"], {}), key
        found[entry["kind"]][key] = entry
    return found


def _matrix(entry):
    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_quat(entry["turn"]).as_matrix()
    matrix[:3, 3] = entry["move"]
    return matrix

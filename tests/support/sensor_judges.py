"""Programs of others that judge what sensors record, in an environment of their own: Open3D, nuscenes-devkit, mcap."""

import os
import subprocess
from pathlib import Path

import numpy as np

PYTHON = Path(os.environ.get("GARAGE2USD_SENSOR_JUDGES", Path(__file__).parents[2] / ".venv/sensor_judges/bin/python"))
CLIENTS = Path(__file__).parents[1] / "clients"
HAS_SENSOR_JUDGES = PYTHON.is_file()


def run_judge(script, *arguments, folder):
    """What one of the programs beside the tests of clients prints."""
    inherited = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    run = subprocess.run(
        [str(PYTHON), str(CLIENTS / script), *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=600,
        cwd=folder,
        env=inherited,
        check=False,
    )
    assert run.returncode == 0, run.stdout[-2000:] + run.stderr[-2000:]
    return run.stdout


def open3d_cast(vertices, triangles, origins, directions, folder):
    """Range, infinite for none, and triangle of what Open3D's rays meet first."""
    given, found = folder / "open3d_in.npz", folder / "open3d_out.npz"
    np.savez(given, vertices=vertices, triangles=triangles, origins=origins, directions=directions)
    run_judge("open3d_rays.py", given, found, folder=folder)
    with np.load(found) as answer:
        return answer["range"], answer["triangle"]

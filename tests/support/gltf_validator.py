"""Khronos' validator of glTF, which node runs."""

import json
import os
import shutil
import subprocess
from pathlib import Path

VALIDATOR_VERSION = "2.0.0-dev.3.10"
_SCRIPT = """
const validator = require(process.argv[1]);
const data = new Uint8Array(require("fs").readFileSync(process.argv[2]));
validator.validateBytes(data, { maxIssues: 100 }).then((report) => console.log(JSON.stringify(report)));
"""
_ENVIRONMENT = Path(__file__).parents[2] / ".venv"


def find_node():
    """Node on the path or in the environment, or None."""
    return shutil.which("node") or shutil.which("node", path=str(_ENVIRONMENT / "bin"))


def find_validator():
    """The validator's folder: where environment.sh installs it, or GLTF_VALIDATOR_FOLDER; None if it is not there."""
    default = _ENVIRONMENT / "node" / "node_modules" / "gltf-validator"
    folder = Path(os.environ.get("GLTF_VALIDATOR_FOLDER", default))
    return folder if (folder / "package.json").is_file() else None


def validated(path):
    """The validator's report of a file."""
    command = [find_node(), "-e", _SCRIPT, str(find_validator()), str(path)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True, timeout=300).stdout)

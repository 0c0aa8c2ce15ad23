"""What the README shows runs as it stands there."""

import re
import signal
import subprocess
import sys

import pytest
from sample_files import REPOSITORY

from garage2usd.config import config_from_mapping

README = (REPOSITORY / "README.md").read_text()


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.DOTALL)


@pytest.mark.parametrize("code", blocks("python"))
def test_python_blocks_run(code, tmp_path):
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    assert run.stdout


@pytest.mark.parametrize("text", blocks("toml"))
def test_toml_blocks_are_configurations(text):
    import tomllib

    from garage2usd.pipeline import generate

    assert generate(config_from_mapping(tomllib.loads(text))).layout.stalls


def test_shell_blocks_run(tmp_path):
    commands = [line.split("#")[0].strip() for block in blocks("sh") for line in block.splitlines()]
    calls = [line.split()[1:] for line in commands if line.startswith("garage2usd")]
    builds = [arguments for arguments in calls if arguments[0] == "build"]
    views = [arguments for arguments in calls if arguments[0] == "view"]
    assert (len(builds), len(views), len(calls)) == (3, 1, 4)
    (tmp_path / "samples").symlink_to(REPOSITORY / "samples")
    for arguments in builds:
        subprocess.run([sys.executable, "-m", "garage2usd", *arguments], cwd=tmp_path, check=True, capture_output=True)
    for arguments in views:
        command = [sys.executable, "-u", "-m", "garage2usd", *arguments, "--no-browser"]
        with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True) as server:
            assert "http://127.0.0.1:" in server.stdout.readline()
            assert "objects of" in server.stdout.readline()
            server.terminate()
        assert server.returncode == 128 + signal.SIGTERM
    assert (tmp_path / "garage.usdz").exists()
    assert (tmp_path / "garages" / "g7.usdc").exists()
    assert (tmp_path / "out" / "hand_drawn.usda").exists()


def test_pictures_are_there():
    for picture in re.findall(r"!\[.*?\]\((.*?)\)", README):
        assert (REPOSITORY / picture).stat().st_size > 100_000

"""The compiler runs once for a user: what it made is kept and loaded."""

import os
import subprocess
import sys


def test_a_second_run_compiles_nothing(tmp_path):
    config = tmp_path / "garage.toml"
    config.write_text("[site]\nwidth_cells = 16\nheight_cells = 12\n[plan]\nepisodes = 20\n")
    cache = tmp_path / "cache"

    def run(seed):
        command = [sys.executable, "-m", "garage2usd", "build", str(config), "-o", str(tmp_path / f"{seed}.usda")]
        environment = {**os.environ, "NUMBA_CACHE_DIR": str(cache)}
        subprocess.run([*command, "--seed", str(seed)], env=environment, check=True, capture_output=True, timeout=600)
        return {path.relative_to(cache): path.stat().st_mtime_ns for path in cache.rglob("*") if path.is_file()}

    first, second = run(1), run(2)
    assert len(first) > 10
    assert second == first

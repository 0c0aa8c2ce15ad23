import os
import stat

import pytest

from garage2usd.errors import OutputError
from garage2usd.output import check_writable, publish, staging_folder


def make(staging, name, text):
    path = staging / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def test_files_and_folders_replace_what_was_there(tmp_path):
    for round_ in ("old", "new"):
        with staging_folder() as staging:
            make(staging, f"assets/{round_}.txt", round_)
            publish([staging / "assets", make(staging, "stage.txt", round_)], tmp_path / "a" / "b")
    assert sorted(path.name for path in (tmp_path / "a" / "b").rglob("*")) == ["assets", "new.txt", "stage.txt"]
    assert (tmp_path / "a" / "b" / "stage.txt").read_text() == "new"
    assert not staging.exists()


def test_a_failed_write_leaves_what_was_there(tmp_path):
    (tmp_path / "stage.txt").write_text("old")
    with staging_folder() as staging, pytest.raises(OutputError) as caught:
        publish([make(staging, "first.txt", "new"), staging / "missing.txt"], tmp_path)
    assert "missing.txt" in str(caught.value)
    assert [path.name for path in tmp_path.iterdir()] == ["stage.txt"]
    assert (tmp_path / "stage.txt").read_text() == "old"


def test_folders_made_for_a_failed_write_go_again(tmp_path):
    with staging_folder() as staging, pytest.raises(OutputError):
        publish([staging / "missing.txt"], tmp_path / "x" / "y")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_a_file_is_refused(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError):
        check_writable(tmp_path / "file" / "deeper")


@pytest.mark.skipif(os.geteuid() == 0 and not os.path.exists("/proc/version"), reason="no read-only place is known")
def test_a_folder_without_permission_is_refused(tmp_path):
    folder = "/proc/garage2usd" if os.geteuid() == 0 else str(tmp_path / "closed")
    if os.geteuid() != 0:
        os.mkdir(folder, stat.S_IRUSR | stat.S_IXUSR)
    from pathlib import Path

    with pytest.raises(OutputError):
        check_writable(Path(folder))

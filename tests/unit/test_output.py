import os
import stat
from concurrent.futures import ThreadPoolExecutor

import pytest

from garage2usd.errors import OutputError
from garage2usd.output import check_writable, only_run, publish, staging_folder, store


def make(staging, name, text):
    path = staging / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def test_two_runs_do_not_work_in_one_folder(tmp_path):
    with only_run(tmp_path):
        with pytest.raises(OutputError, match="another run is at work"), only_run(tmp_path):
            pass
        assert [path.name for path in tmp_path.iterdir()] == [".garage2usd-lock.bin"]
    assert not list(tmp_path.iterdir())
    with only_run(tmp_path):
        pass


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


def test_what_is_stored_is_written_once_and_again_only_where_it_is_damaged(tmp_path):
    path = tmp_path / "a" / "b.bin"
    store(path, b"whole")
    first = path.stat()
    store(path, b"whole")
    assert path.stat().st_ino == first.st_ino
    for damage in (b"", b"who", b"whale"):
        path.write_bytes(damage)
        store(path, b"whole")
        assert path.read_bytes() == b"whole"
    assert list(path.parent.iterdir()) == [path]
    assert path.stat().st_mode == first.st_mode == make(tmp_path, "other.txt", "").stat().st_mode


def test_nobody_sees_a_stored_file_half_written(tmp_path):
    path, data = tmp_path / "large.bin", bytes(range(256)) * 20_000
    seen = set()
    with ThreadPoolExecutor(5) as threads:
        for _ in range(20):
            path.unlink(missing_ok=True)
            writers = [threads.submit(store, path, data) for _ in range(4)]
            while not all(writer.done() for writer in writers):
                if path.exists():
                    seen.add(path.read_bytes() == data)
            for writer in writers:
                writer.result()
            assert list(tmp_path.iterdir()) == [path]
    assert seen == {True}


def test_what_cannot_be_stored_leaves_nothing(tmp_path):
    (tmp_path / "taken").mkdir()
    (tmp_path / "file").write_text("")
    for path in (tmp_path / "taken", tmp_path / "file" / "below"):
        with pytest.raises(OutputError):
            store(path, b"data")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "taken"]

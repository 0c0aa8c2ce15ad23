import os
import re
import resource
import stat
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from garage2usd.common.errors import ConfigError, OutputError
from garage2usd.common.output import check_file, check_writable, only_run, publish, publish_at, staging_folder, store


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


@pytest.mark.parametrize("has_links", [True, False])
def test_places_before_one_that_fails_are_put_back(has_links, tmp_path, monkeypatch):
    if not has_links:
        monkeypatch.setattr(os, "link", refuse)
    out = tmp_path / "out"
    for name in ("1.txt", "2.txt", "assets/a.txt"):
        make(out, name, "old")
    (out / "target.txt").write_text("old")
    (out / "3.txt").symlink_to("target.txt")
    with staging_folder() as staging:
        items = [make(staging, name, "new") for name in ("1.txt", "0.txt", "3.txt")]
        items += [make(staging, "assets/b.txt", "new").parent, make(staging, "2.txt", "new")]
        for function in ("replace", "rename"):
            monkeypatch.setattr(os, function, refusing(getattr(os, function), out / "2.txt"))
        with pytest.raises(OutputError, match=r"2\.txt"):
            publish(items, out)
    found = {path.relative_to(out).as_posix(): path.read_text() for path in out.rglob("*") if path.is_file()}
    assert found == dict.fromkeys(("1.txt", "2.txt", "3.txt", "assets/a.txt", "target.txt"), "old")
    assert (out / "3.txt").is_symlink()


def test_a_file_does_not_take_the_place_of_a_folder(tmp_path):
    make(tmp_path, "stage.txt/inner.txt", "old")
    with staging_folder() as staging, pytest.raises(OutputError, match=r"stage\.txt"):
        publish([make(staging, "first.txt", "new"), make(staging, "stage.txt", "new")], tmp_path)
    assert [path.name for path in tmp_path.rglob("*")] == ["stage.txt", "inner.txt"]


def test_what_cannot_be_put_back_is_named(tmp_path, monkeypatch):
    for name in ("1.txt", "2.txt"):
        make(tmp_path, name, "old")
    with staging_folder() as staging:
        items = [make(staging, name, "new") for name in ("1.txt", "2.txt")]
        replace = os.replace
        held = refusing(replace, tmp_path / "2.txt")
        monkeypatch.setattr(os, "replace", lambda old, new: refuse() if "-old-" in str(old) else held(old, new))
        with pytest.raises(OutputError, match=r"what \S+1.txt was is \S+-old-1.txt") as caught:
            publish(items, tmp_path)
    kept = re.search(r"was is (\S+-old-1.txt)", str(caught.value))[1]
    assert Path(kept).read_text() == "old"


def refuse(*_arguments, **_named):
    raise PermissionError(13, "Permission denied")


def refusing(move, held):
    """A function that moves files, except to and from one that another program holds open."""
    return lambda source, place: refuse() if held in {Path(source), Path(place)} else move(source, place)


def test_a_place_that_is_named_twice_gets_the_last(tmp_path):
    with staging_folder() as staging:
        publish_at({make(staging, name, name): tmp_path / "out.txt" for name in ("1", "2")})
    assert [path.read_text() for path in tmp_path.iterdir()] == ["2"]


def test_a_failed_write_leaves_what_was_there(tmp_path):
    (tmp_path / "stage.txt").write_text("old")
    with staging_folder() as staging, pytest.raises(OutputError) as caught:
        publish([make(staging, "first.txt", "new"), staging / "missing.txt"], tmp_path)
    assert "missing.txt" in str(caught.value)
    assert [path.name for path in tmp_path.iterdir()] == ["stage.txt"]
    assert (tmp_path / "stage.txt").read_text() == "old"


@pytest.mark.parametrize("name", ["a.bin", "assets", "assets/inner"])
def test_what_a_disk_does_not_take_is_named_by_its_place(tmp_path, name):
    with staging_folder() as staging:
        items = [make(staging, "first.txt", "new"), staging / name.partition("/")[0]]
        make(staging, name if name == "a.bin" else f"{name}/large.bin", "x" * 200_000)
        error = in_a_copy_with_little_room(lambda: publish(items, tmp_path / "out"))
    place = tmp_path / "out" / name if name == "a.bin" else tmp_path / "out" / name / "large.bin"
    assert error == f"{place}: File too large"
    assert list(tmp_path.iterdir()) == []


def draft(path, data):
    with staging_folder(path) as staging:
        (staging / "draft.bin").write_bytes(data)


@pytest.mark.parametrize("write", [store, draft])
def test_what_is_not_in_its_place_yet_has_the_name_of_its_place(tmp_path, write):
    error = in_a_copy_with_little_room(lambda: write(tmp_path / "a.bin", b"x" * 200_000))
    assert error.startswith(f"{tmp_path / 'a.bin'}: File too large")
    assert ".garage2usd-" not in error
    assert list(tmp_path.iterdir()) == []


def in_a_copy_with_little_room(work):
    """What an error says in a process that may write files of 100 kB."""
    reader, writer = os.pipe()
    if os.fork() == 0:
        resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
        try:
            work()
        except OutputError as error:
            os.write(writer, str(error).encode())
        os._exit(0)
    os.close(writer)
    os.wait()
    with os.fdopen(reader) as said:
        return said.read()


def test_a_folder_where_a_file_goes_and_names_that_are_too_long_are_refused(tmp_path):
    (tmp_path / "a_b.json").mkdir()
    check_file(tmp_path / "a", with_it=[tmp_path / "a_c.json"])
    for path, beside in ((tmp_path / "a_b.json", []), (tmp_path / "a", [tmp_path / "a_b.json"])):
        with pytest.raises(ConfigError, match=r"a_b\.json'; allowed: a path at which no folder stands"):
            check_file(path, with_it=beside)
    for name in ("n" * 300, "\ud800"):
        with pytest.raises(ConfigError, match="a file name "):
            check_file(tmp_path / name)


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

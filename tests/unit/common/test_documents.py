import codecs
import os

import pytest

from garage2usd.common.documents import read_json, read_text, read_toml
from garage2usd.common.errors import ConfigError


def refused(read, path, **options):
    with pytest.raises(ConfigError) as caught:
        read(path, field="FILE", **options)
    assert caught.value.field == "FILE"
    return str(caught.value)


def test_text_comes_whole(tmp_path):
    (tmp_path / "a.txt").write_text("Stellplätze\n", encoding="utf-8")
    assert read_text(tmp_path / "a.txt", field="FILE") == "Stellplätze\n"


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-be"])
def test_a_byte_order_mark_is_left_out(tmp_path, encoding):
    mark = codecs.BOM_UTF16_BE if encoding == "utf-16-be" else b""
    for name, text in (
        ("a.toml", 'seed = 7\nname = "Stellplätze"\n'),
        ("a.json", '{"seed": 7, "name": "Stellplätze"}'),
    ):
        (tmp_path / name).write_bytes(mark + text.encode(encoding))
        assert read_text(tmp_path / name, field="FILE") == text
    expected = {"seed": 7, "name": "Stellplätze"}
    assert read_toml(tmp_path / "a.toml", field="FILE") == expected
    assert read_json(tmp_path / "a.json", field="FILE", max_bytes=1000) == expected


def test_a_pipe_would_never_end_and_is_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    assert "a regular file" in refused(read_text, tmp_path / "pipe")
    assert "a regular file" in refused(read_text, tmp_path)


def test_no_more_than_the_limit_is_read(tmp_path):
    with (tmp_path / "large").open("wb") as file:
        file.truncate(2**40)  # a terabyte of nothing
    assert "at most 100 bytes" in refused(read_text, tmp_path / "large", max_bytes=100)


def test_other_encodings_and_missing_files_are_named(tmp_path):
    (tmp_path / "latin").write_bytes("Stellplätze".encode("latin-1"))
    assert "UTF-8 text" in refused(read_text, tmp_path / "latin")
    assert "No such file" in refused(read_text, tmp_path / "nothing")
    assert "a readable file" in refused(read_text, tmp_path / "null\0byte")


@pytest.mark.parametrize("text", ["NaN", "[Infinity]", "[" * 100_000, "{", '{"a": 1} 2', "9" * 10_000])
def test_json_is_json(tmp_path, text):
    (tmp_path / "a.json").write_text(text)
    assert "JSON (" in refused(read_json, tmp_path / "a.json", max_bytes=10**6)


@pytest.mark.parametrize("text", ["a = ", "a = " + "[" * 100_000, "a = 1\na = 2", "a = " + "9" * 10_000])
def test_toml_is_toml(tmp_path, text):
    (tmp_path / "a.toml").write_text(text)
    assert "TOML (" in refused(read_toml, tmp_path / "a.toml")

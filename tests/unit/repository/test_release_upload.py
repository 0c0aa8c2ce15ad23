"""A release is uploaded file by file, and goes on after a failure; the index is a small one that this test serves."""

import hashlib
import importlib.util
import json
import re
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest
from support.sample_files import REPOSITORY

NAMES = ("garage2usd-0.1.0-py3-none-macosx_11_0_arm64.whl", "garage2usd-0.1.0-py3-none-win_amd64.whl")
SOURCE = "garage2usd-0.1.0.tar.gz"

_SPEC = importlib.util.spec_from_file_location("release_upload", REPOSITORY / "release/upload.py")
release_upload = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(release_upload)


class Index:
    """An index's files by name, served in one form of the simple API; `refused` names are not taken."""

    def __init__(self, kind):
        self.kind, self.files, self.refused, self.attempts = kind, {}, set(), []
        index = self

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self):
                if not index.files:
                    self.send_error(404)
                    return
                self.send_response(200)
                self.send_header("Content-Type", index.kind)
                self.end_headers()
                self.wfile.write(index.page().encode())

            def log_message(self, *_arguments):
                pass

        self.server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.address = f"http://127.0.0.1:{self.server.server_port}/simple/"

    def page(self):
        digests = {name: hashlib.sha256(data).hexdigest() for name, data in self.files.items()}
        if self.kind.endswith("json"):
            files = [{"filename": name, "hashes": {"sha256": digest}} for name, digest in digests.items()]
            return json.dumps({"files": files})
        links = (f'<a href="../../files/{name}#sha256={digest}">{name}</a>' for name, digest in digests.items())
        return f"<!DOCTYPE html><html><body>{''.join(links)}</body></html>"

    def upload(self, path):
        self.attempts.append(path.name)
        if path.name in self.refused:
            return "503 Service Unavailable"
        self.files[path.name] = path.read_bytes()
        return ""


@pytest.fixture(params=["application/vnd.pypi.simple.v1+json", "text/html"])
def index(request):
    made = Index(request.param)
    yield made
    made.server.shutdown()
    made.server.server_close()


@pytest.fixture
def files(tmp_path):
    for name in (*NAMES, SOURCE):
        (tmp_path / name).write_bytes(name.encode())
    return [tmp_path / name for name in (*NAMES, SOURCE)]


def publish(files, index):
    return release_upload.publish(files, index.address, index.upload, wait_s=0.0)


def test_all_files_are_uploaded_once(files, index, capsys):
    assert publish(files, index) == 0
    assert publish(files, index) == 0
    assert index.attempts == [path.name for path in files]
    assert capsys.readouterr().out.count("3 of 3 files are published") == 2


def test_a_failure_is_told_and_the_next_run_goes_on(files, index, capsys):
    index.refused = {NAMES[0]}
    assert publish(files, index) == 1
    told = capsys.readouterr().out
    assert index.attempts == [NAMES[0]] * 3 + [NAMES[1]]
    assert f"{NAMES[0]}: NOT PUBLISHED (503 Service Unavailable)" in told
    assert f"{NAMES[1]}: published now" in told
    assert re.search(rf"{re.escape(SOURCE)}: NOT PUBLISHED \(waits until all wheels", told)
    assert "1 of 3 files are published" in told
    index.refused, index.attempts = set(), []
    assert publish(files, index) == 0
    assert index.attempts == [NAMES[0], SOURCE]


def test_a_file_with_other_content_stops_the_run(files, index, capsys):
    index.files = {NAMES[1]: b"older"}
    assert publish(files, index) == 1
    assert not index.attempts
    assert f"{NAMES[1]}: PUBLISHED WITH OTHER CONTENT" in capsys.readouterr().out


def test_status_uploads_nothing(files, index, capsys):
    index.files = {NAMES[0]: NAMES[0].encode()}
    assert release_upload.main([str(files[0].parent), index.address, "--status"]) == 1
    told = capsys.readouterr().out
    assert f"{NAMES[0]}: published" in told
    assert f"{NAMES[1]}: NOT PUBLISHED (not asked for)" in told


def test_an_index_that_does_not_answer_is_named(files, capsys):
    assert release_upload.main([str(files[0].parent), "http://127.0.0.1:9/simple"]) == 1
    assert "http://127.0.0.1:9/simple does not answer" in capsys.readouterr().out


def test_a_folder_without_a_release_is_refused(tmp_path, capsys):
    with pytest.raises(SystemExit):
        release_upload.main([str(tmp_path), "http://127.0.0.1:9/simple"])
    assert "has no files of garage2usd" in capsys.readouterr().err

"""The viewer's server: this machine alone, fixed paths alone, and a clean end."""

import http.client
import os
import pty
import re
import signal
import socket
import subprocess
import sys
import threading
from types import SimpleNamespace

import pytest
from click.testing import CliRunner
from PIL import Image
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade
from support.signals import heed_all

from garage2usd.cli import main
from garage2usd.common.errors import OutputError
from garage2usd.reading.files import open_stage
from garage2usd.view.viewer import ViewerServer, read_scene


@pytest.fixture
def stage(tmp_path):
    """A cube with a texture that is an image and another with one that is not."""
    Image.new("RGB", (2, 2), (10, 20, 30)).save(tmp_path / "good.png")
    (tmp_path / "secret.txt").write_text("root:x:0:0")
    path = tmp_path / "cubes.usda"
    usd = Usd.Stage.CreateNew(str(path))
    for number, file in enumerate(["good.png", "secret.txt"]):
        cube = UsdGeom.Cube.Define(usd, f"/World/Cube_{number}")
        UsdGeom.XformCommonAPI(cube).SetTranslate(Gf.Vec3d(3 * number, 0, 0))
        material = UsdShade.Material.Define(usd, f"/World/Look_{number}")
        shader = UsdShade.Shader.Define(usd, f"/World/Look_{number}/Surface")
        shader.CreateIdAttr("UsdPreviewSurface")
        reader = UsdShade.Shader.Define(usd, f"/World/Look_{number}/Reader")
        reader.CreateIdAttr("UsdUVTexture")
        reader.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(Sdf.AssetPath(f"./{file}"))
        output = reader.CreateOutput("rgb", Sdf.ValueTypeNames.Float3)
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).ConnectToSource(output)
        material.CreateSurfaceOutput().ConnectToSource(shader.CreateOutput("surface", Sdf.ValueTypeNames.Token))
        UsdShade.MaterialBindingAPI.Apply(cube.GetPrim()).Bind(material)
    usd.Save()
    return path


def ask(server, path, *, method="GET", host=None):
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=10)
    connection.putrequest(method, path, skip_host=host is not None)
    if host is not None:
        connection.putheader("Host", host)
    connection.endheaders()
    answer = connection.getresponse()
    found = SimpleNamespace(status=answer.status, body=answer.read(), headers=answer.headers)
    connection.close()
    return found


@pytest.fixture
def server(stage):
    with ViewerServer() as running:
        running.show(read_scene(open_stage(stage), stage))
        yield running


def test_the_page_comes_with_its_types_and_a_policy_that_lets_nothing_else_in(server):
    page = ask(server, "/")
    assert page.status == 200
    assert page.headers["Content-Type"] == "text/html; charset=utf-8"
    policy = page.headers["Content-Security-Policy"]
    assert "default-src 'none'" in policy
    assert "unsafe-inline" not in policy
    assert "'unsafe-eval'" not in policy
    named = re.findall(rb'(?:src|href)="\./([^"]+)"', page.body)
    assert sorted(named) == [b"index.css", b"viewer.js"]
    assert b"http" not in page.body
    assert ask(server, "/viewer.js").headers["Content-Type"] == "text/javascript"
    assert ask(server, "/index.css").headers["Content-Type"] == "text/css"
    assert ask(server, "/scene.bin").body[:4] == b"G2UV"
    head = ask(server, "/scene.bin", method="HEAD")
    assert head.body == b""
    assert int(head.headers["Content-Length"]) == len(ask(server, "/scene.bin").body)


@pytest.mark.parametrize(
    "path",
    [
        "/../../../etc/passwd",
        "/%2e%2e/%2e%2e/etc/passwd",
        "//etc/passwd",
        "/page/../server.py",
        "/textures/../cubes.usda",
        "/textures/1",  # no image
        "/textures/2",
        "/textures/-1",
        "/textures/9999999999999999999999",
        "/textures/00000000001",
        "/textures/%D9%A0",
        "/cubes.usda",
        "/secret.txt",
    ],
)
def test_no_path_reaches_another_file(server, path):
    answer = ask(server, path)
    assert answer.status == 404
    assert b"root:" not in answer.body


def test_textures_go_by_number(server):
    answer = ask(server, "/textures/0")
    assert (answer.status, answer.headers["Content-Type"]) == (200, "image/png")
    assert answer.headers["X-Content-Type-Options"] == "nosniff"


@pytest.mark.parametrize("host", ["evil.example", "evil.example:80", "127.0.0.1", "localhost:1", ""])
def test_a_foreign_name_that_points_here_reads_nothing(server, host):
    answer = ask(server, "/scene.bin", host=host)
    assert answer.status == 421
    assert b"G2UV" not in answer.body
    assert ask(server, "/scene.bin", host=f"localhost:{server.port}").status == 200


def test_nothing_can_be_written(server):
    assert ask(server, "/scene.bin", method="POST").status == 501
    assert ask(server, "/scene.bin", method="PUT").status == 501


def test_only_this_machine_is_listened_to(server):
    assert server._server.server_address[0] == "127.0.0.1"


def test_who_asks_early_waits_for_the_stage(stage):
    with ViewerServer() as server:
        answers = []
        waiting = threading.Thread(target=lambda: answers.append(ask(server, "/scene.bin").status))
        waiting.start()
        assert ask(server, "/").status == 200
        assert answers == []
        server.show(read_scene(open_stage(stage), stage))
        waiting.join(10)
        assert answers == [200]


def test_a_port_that_is_taken_is_named():
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(OutputError, match=f"127.0.0.1:{port}: cannot listen here"):
            ViewerServer(port)


@pytest.mark.parametrize(("stop", "code"), [(signal.SIGTERM, 143), (signal.SIGHUP, 129), (signal.SIGINT, 0)])
def test_a_signal_ends_it_and_frees_the_port(stage, stop, code):
    command = [sys.executable, "-m", "garage2usd", "view", str(stage), "--no-browser"]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
        start_new_session=True,
        preexec_fn=heed_all,
    ) as process:
        port = int(re.search(r"http://127\.0\.0\.1:(\d+)/", process.stdout.readline())[1])
        assert "2 objects of 1 classes" in process.stdout.readline()
        if stop is signal.SIGINT:  # a terminal sends it to all of the group
            os.killpg(process.pid, stop)
        else:
            process.send_signal(stop)
        _, said = process.communicate(timeout=20)
    assert process.returncode == code
    assert "Traceback" not in said
    with socket.socket() as again:
        again.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        again.bind(("127.0.0.1", port))


def test_it_ends_when_its_terminal_closes(stage):
    control, terminal = pty.openpty()
    take_terminal = "os.setsid(); fcntl.ioctl(0, termios.TIOCSCTTY, 0); os.execv(sys.argv[1], sys.argv[1:])"
    code = f"import fcntl, os, sys, termios; {take_terminal}"
    view = [sys.executable, "-m", "garage2usd", "view", str(stage), "--no-browser"]
    with subprocess.Popen(
        [sys.executable, "-c", code, *view],
        stdin=terminal,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=heed_all,
    ) as process:
        os.close(terminal)
        assert "http://" in process.stdout.readline()
        os.close(control)
        process.communicate(timeout=20)
    assert process.returncode == 128 + signal.SIGHUP


def test_what_is_ignored_does_not_end_it(stage):
    """As a shell has it that starts commands in the background, and ``nohup``."""
    command = [sys.executable, "-m", "garage2usd", "view", str(stage), "--no-browser"]
    code = "import os, signal, sys; [signal.signal(each, signal.SIG_IGN) for each in (signal.SIGINT, signal.SIGHUP)]"
    with subprocess.Popen(
        [sys.executable, "-c", f"{code}; os.execv(sys.argv[1], sys.argv[1:])", *command],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
        start_new_session=True,
    ) as process:
        process.stdout.readline()
        process.stdout.readline()
        os.killpg(process.pid, signal.SIGINT)
        process.send_signal(signal.SIGHUP)
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(1)
        process.terminate()
        assert process.wait(20) == 143


def test_what_is_no_stage_ends_in_one_line(tmp_path):
    result = CliRunner().invoke(main, ["view", str(tmp_path / "nothing.usda"), "--no-browser"])
    assert result.exit_code == 1
    assert result.output == f"Error: {tmp_path / 'nothing.usda'}: No such file or directory\n"

import os
import signal
import subprocess
import sys
import time

import pytest
from support.signals import heed_all

START = "import os, signal, sys, time\nfrom garage2usd.cli.process import supervise\n"


def supervised(body, **options):
    """The end of a process that supervises a command with this body."""
    code = f"{START}def command():\n    {body}\nsupervise(command, name='check')\n"
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, **options)


@pytest.mark.parametrize(("body", "code"), [("pass", 0), ("sys.exit(2)", 2), ("sys.exit(1)", 1), ("os._exit(7)", 7)])
def test_it_ends_as_the_command_ends(body, code):
    assert supervised(body).returncode == code


@pytest.mark.parametrize("crash", [signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS])
def test_a_crash_is_an_error_in_one_line(crash):
    ended = supervised(f"os.kill(os.getpid(), {int(crash)})")
    assert ended.returncode == 1
    assert ended.stderr.startswith("Error: check crashed (")
    assert ended.stderr.count("\n") == 1


def test_memory_is_limited():
    ended = supervised("bytearray(2**40)")
    assert "MemoryError" in ended.stderr


def test_time_is_limited_where_it_is_asked_for_and_lifted_where_not():
    body = "from garage2usd.common.limits import allow_seconds, lift; allow_seconds(0.1); {}sum(range(10**10))"
    ended = supervised(body.format(""))
    assert (ended.returncode, ended.stderr.count("\n")) == (1, 1)
    assert "does not seem to end" in ended.stderr
    lifted = body.format("lift(); ").replace("10**10", "10**6")
    assert supervised(lifted).returncode == 0


def test_limits_hold_only_where_they_are_enforced():
    code = "import resource; from garage2usd.common import limits; before = resource.getrlimit(resource.RLIMIT_CPU)\n"
    code += "limits.allow_seconds(1); assert resource.getrlimit(resource.RLIMIT_CPU) == before"
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize(("asked", "code"), [(signal.SIGTERM, 143), (signal.SIGHUP, 129), (signal.SIGINT, 130)])
def test_the_command_gets_the_signals_that_ask_for_an_end(asked, code):
    body = "signal.signal(signal.SIGINT, signal.SIG_DFL); print('up', flush=True); time.sleep(60)"
    process = subprocess.Popen(
        [sys.executable, "-c", f"{START}def command():\n    {body}\nsupervise(command, name='view')\n"],
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=heed_all,
    )
    assert process.stdout.readline() == "up\n"
    process.send_signal(asked)
    assert process.wait(20) == code
    process.stdout.close()


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells a process of its parent's death")
def test_a_killed_supervisor_takes_its_command_along():
    body = "print(os.getpid(), flush=True); time.sleep(60)"
    code = f"{START}def command():\n    {body}\nsupervise(command, name='view')\n"
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    command = int(process.stdout.readline())
    process.kill()
    process.wait()
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline:
        try:
            os.kill(command, 0)
        except ProcessLookupError:
            break
        time.sleep(0.05)
    else:
        pytest.fail("the command goes on alone")
    process.stdout.close()


def test_stages_that_compose_without_end_are_refused(tmp_path):
    text = "#usda 1.0\n"
    for level in range(30):
        children = "".join(f'def "k{index}" (\nreferences = </L{level + 1}>\n) {{\n}}\n' for index in range(4))
        text += f'def "L{level}" {{\n{children}}}\n'
    (tmp_path / "doubling.usda").write_text(text)
    command = [sys.executable, "-m", "garage2usd", "check", tmp_path / "doubling.usda"]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 1
    assert "Error: check takes too long" in ended.stderr
    assert "Traceback" not in ended.stderr

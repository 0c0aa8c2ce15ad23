"""Copies of a process: each does its task, all give what one after the other gives, and threads forbid them."""

import gc
import subprocess
import sys

import pytest

from garage2usd.common.processes import without_collector

TASKS = """
import os, threading
from functools import partial
from garage2usd.common.processes import run_in_forks
own = os.getpid()
here = [number for number in range({tasks})]
def task(number):
    if number in {failing}:
        raise ValueError(f"task {{number}}")
    return here[number] ** 2, os.getpid() == own
{before}
try:
    print(*run_in_forks([partial(task, number) for number in here], {workers}))
except ValueError as error:
    print(error)
"""
A_THREAD = "threading.Thread(target=threading.Event().wait, daemon=True).start()"


def said(*, tasks=4, workers=2, failing=(), before=""):
    code = TASKS.format(tasks=tasks, workers=workers, failing=failing, before=before)
    return subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, check=True, text=True).stdout.strip()


def squares(count, *, is_here):
    return " ".join(str((number**2, is_here)) for number in range(count))


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="processes are copied on Linux only")
@pytest.mark.parametrize("workers", [2, 3, 9])
def test_copies_do_the_tasks_and_give_them_in_order(workers):
    assert said(workers=workers) == squares(4, is_here=False)


@pytest.mark.parametrize(
    "alone", [{"workers": 1}, {"tasks": 1}, {"before": A_THREAD}], ids=["one worker", "one task", "a second thread"]
)
def test_without_copies_the_tasks_are_done_here(alone):
    assert said(**alone) == squares(alone.get("tasks", 4), is_here=True)


def test_no_tasks_give_nothing():
    assert not said(tasks=0)


def test_what_is_left_when_a_copy_crashes_is_done_here():
    crash = "def task(number): return number if number != 2 or os.getpid() == own else os.abort()"
    assert said(before=crash) == "0 1 2 3"


@pytest.mark.parametrize("workers", [1, 3])
def test_the_error_of_the_first_task_that_fails_is_raised(workers):
    assert said(failing=(1, 3), workers=workers) == "task 1"


@pytest.mark.parametrize("is_enabled", [True, False])
def test_the_collector_is_as_it_was_after_an_error_too(is_enabled):
    before = gc.isenabled()
    (gc.enable if is_enabled else gc.disable)()
    try:
        with without_collector():
            assert not gc.isenabled()
        assert gc.isenabled() == is_enabled
        with pytest.raises(ValueError, match="within"), without_collector():
            raise ValueError("within")
        assert gc.isenabled() == is_enabled
    finally:
        (gc.enable if before else gc.disable)()

"""Shared stages, and the rule that in CI a skipped test is a failed one."""

import gc
import os
import pickle
import signal
from itertools import chain

import pytest
from filelock import FileLock
from support.durations import outdated, processor_time_s, read_durations, write_durations
from support.soak import PARTS, chosen

import garage2usd
from garage2usd.common.limits import ONE_THREAD

for variable, value in ONE_THREAD.items():
    os.environ.setdefault(variable, value)  # before USD is loaded; workers inherit it


def pytest_addoption(parser):
    parser.addoption("--write-pictures", action="store_true", help="replace the stored pictures by what is drawn now")
    parser.addoption("--write-durations", action="store_true", help="note how long each file took, for `make check`")
    parser.addoption("--soak", action="store_true", help="run the wide tests, and only those")
    parser.addoption("--part", type=int, choices=range(PARTS), help="with --soak: which eighth of them; by default all")


def pytest_configure():
    # a shell that runs the tests in the background has SIGINT ignored, which children that tests interrupt inherit
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config, items):
    soak, part = config.getoption("--soak"), config.getoption("--part")
    if part is not None and not soak:
        raise pytest.UsageError("--part is for --soak")
    items[:], left = chosen(items, soak=soak, part=part, durations=read_durations())
    if left:
        config.hook.pytest_deselected(items=left)


def pytest_collection_finish():
    # what is loaded by now stays, so the collector need not look through it again and again
    gc.collect()
    gc.freeze()


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_setup(item):
    item.processor_time_begin_s = processor_time_s()
    return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    report = yield
    if call.when == "teardown":
        report.user_properties.append(("processor_time_s", processor_time_s() - item.processor_time_begin_s))
    if os.environ.get("CI") and report.skipped and not hasattr(report, "wasxfail"):
        report.outcome = "failed"
        report.longrepr = f"skipped in CI: {report.longrepr}"
    return report


def pytest_terminal_summary(terminalreporter):
    config, soak = terminalreporter.config, terminalreporter.config.getoption("--soak")
    reports = [
        part for part in chain.from_iterable(terminalreporter.stats.values()) if isinstance(part, pytest.TestReport)
    ]
    for key, lines in chain.from_iterable(report.user_properties for report in reports if report.when == "call"):
        for line in lines if key == "older" else ():
            terminalreporter.line(line)
    if config.getoption("--write-durations"):
        write_durations(reports, soak=soak)
    elif soak:
        for key, noted_s, measured_s in outdated(reports, soak=soak):
            terminalreporter.line(f"tests/durations.json is off by more than half: {key} {noted_s} -> {measured_s} s")


@pytest.fixture(scope="session")
def builds(tmp_path_factory):
    """Build a sample in a format and perhaps another form than its own, once for all workers."""
    made = {}
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent  # of all workers
    folder /= "builds"
    folder.mkdir(exist_ok=True)

    def build(sample, extension, form=None):
        key = sample.stem, extension, form
        if key not in made:
            place = folder / "_".join(filter(None, key))
            result = place.with_suffix(".pickle")
            with FileLock(place.with_suffix(".lock")):
                if not result.exists():
                    config = garage2usd.load_config(sample)
                    if form is not None:
                        stage = {**config.stage.model_dump(exclude_unset=True), "form": form}
                        config = garage2usd.GarageConfig(**{**config.model_dump(exclude_unset=True), "stage": stage})
                    place.mkdir()
                    result.write_bytes(pickle.dumps(garage2usd.build(config, place / f"{sample.stem}.{extension}")))
            made[key] = pickle.loads(result.read_bytes())  # noqa: S301 - our own
        return made[key]

    return build


@pytest.fixture(scope="session")
def write_pictures(pytestconfig):
    """Whether the stored pictures are replaced before they are compared."""
    return pytestconfig.getoption("--write-pictures")

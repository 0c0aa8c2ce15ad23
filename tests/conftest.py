"""Shared stages, and the rule that in CI a skipped test is a failed one."""

import os

import pytest

import garage2usd


def pytest_addoption(parser):
    parser.addoption("--write-pictures", action="store_true", help="replace the stored pictures by what is drawn now")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    report = yield
    if os.environ.get("CI") and report.skipped and not hasattr(report, "wasxfail"):
        report.outcome = "failed"
        report.longrepr = f"skipped in CI: {report.longrepr}"
    return report


@pytest.fixture(scope="session")
def builds(tmp_path_factory):
    """Build a sample in a format, once in each worker."""
    made = {}

    def build(sample, extension):
        key = sample.stem, extension
        if key not in made:
            folder = tmp_path_factory.mktemp(f"{sample.stem}_{extension}")
            made[key] = garage2usd.build(garage2usd.load_config(sample), folder / f"{sample.stem}.{extension}")
        return made[key]

    return build


@pytest.fixture(scope="session")
def write_pictures(pytestconfig):
    """Whether the stored pictures are replaced before they are compared."""
    return pytestconfig.getoption("--write-pictures")

"""asam-qc-openscenarioxml, ASAM's checker of scenarios, which is installed beside the other judges."""

import os
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from support.sample_files import REPOSITORY

CHECKER = Path(os.environ.get("GARAGE2USD_QC_OPENSCENARIO", REPOSITORY / ".venv/judges/bin/qc_openscenario"))


def needs_checker(test):
    """Mark a test as one of a client that is left out where the checker is not installed."""
    reason = "asam-qc-openscenarioxml is not installed beside the judges"
    return pytest.mark.client(pytest.mark.skipif(not CHECKER.exists(), reason=reason)(test))


def issues_of(file, folder):
    """Descriptions of the issues that the checker reports."""
    settings, result = folder / "settings.xml", folder / "result.xqar"
    settings.write_text(
        f'<?xml version="1.0" encoding="UTF-8"?><Config><Param name="InputFile" value="{file}"/>'
        f'<CheckerBundle application="xoscBundle"><Param name="resultFile" value="{result}"/></CheckerBundle></Config>'
    )
    subprocess.run([str(CHECKER), "-c", str(settings)], cwd=folder, check=True, capture_output=True, timeout=120)
    report = ET.parse(result).getroot()
    checkers = list(report.iter("Checker"))
    assert len(checkers) > 10
    return [issue.get("description") for checker in checkers for issue in checker.findall("Issue")]

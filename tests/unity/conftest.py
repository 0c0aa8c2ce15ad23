"""The C# readers, compiled once in each worker."""

import os
from pathlib import Path

import pytest
import reader


@pytest.fixture(scope="session")
def usd_dump(tmp_path_factory):
    """The running readers."""
    if reader.missing():
        pytest.skip(reader.missing())
    program = os.environ.get(reader.PROGRAM_VARIABLE) or reader.compile_program(tmp_path_factory.mktemp("usd_dump"))
    running = reader.Reader(Path(program))
    yield running
    running.close()

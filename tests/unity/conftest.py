"""The C# readers, compiled once in each worker."""

import pytest
import reader


@pytest.fixture(scope="session")
def usd_dump(tmp_path_factory):
    """The running readers."""
    if reader.missing():
        pytest.skip(reader.missing())
    running = reader.Reader(reader.compile_program(tmp_path_factory.mktemp("usd_dump")))
    yield running
    running.close()

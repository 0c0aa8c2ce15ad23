"""The C# readers, compiled once in each worker."""

import pytest
from support.unity import layer, reader


@pytest.fixture(scope="session")
def usd_dump(tmp_path_factory):
    """The running readers."""
    if reader.missing():
        pytest.skip(reader.missing())
    running = reader.Reader(reader.compile_program(tmp_path_factory.mktemp("usd_dump")))
    yield running
    running.close()


@pytest.fixture(scope="session")
def prefab_dump(tmp_path_factory):
    """The running importer on fakes of Unity's classes."""
    if reader.missing():
        pytest.skip(reader.missing())
    running = reader.Reader(layer.compile_prefab_dump(tmp_path_factory.mktemp("prefab_dump")))
    yield running
    running.close()


@pytest.fixture(scope="session")
def prefabs(prefab_dump):
    """Import a stage with settings."""

    def one(stage, **settings):
        pairs = [f"{name}={value}" for name, value in settings.items()]
        return layer.Prefab(prefab_dump.ask("prefab", stage, *pairs))

    return one

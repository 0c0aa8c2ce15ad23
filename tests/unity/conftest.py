"""The C# readers, compiled once in each worker."""

from functools import cache

import pytest
from support.small_garage import SETTINGS
from support.unity import layer, reader

from garage2usd import GarageConfig, build


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
def small_builds(tmp_path_factory):
    """Build the garage of twelve squares in a format and perhaps another form, once."""

    @cache
    def built(extension, form=None):
        stage = {**SETTINGS["stage"], **({"form": form} if form else {})}
        folder = tmp_path_factory.mktemp("small")
        return build(GarageConfig(**{**SETTINGS, "stage": stage}), folder / f"small.{extension}")

    return built


@pytest.fixture(scope="session")
def prefabs(prefab_dump):
    """Import a stage with settings."""

    def one(stage, **settings):
        pairs = [f"{name}={value}" for name, value in settings.items()]
        return layer.Prefab(prefab_dump.ask("prefab", stage, *pairs))

    return one

"""The picture of the rooms in docs/architecture.md is that of the imports."""

import importlib.util

from support.sample_files import REPOSITORY


def test_the_picture_of_the_rooms_is_drawn_from_the_imports():
    spec = importlib.util.spec_from_file_location("house", REPOSITORY / "docs/house.py")
    house = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(house)
    assert house.PICTURE.read_text(encoding="utf-8") == house.picture(), "run python docs/house.py"

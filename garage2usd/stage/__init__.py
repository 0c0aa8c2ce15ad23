"""Authoring of USD: write a garage as a stage with its assets, textures and labels."""

from garage2usd.stage.level_stage import StageFiles, StageFormat, arrangement_of, asset_folder_name, shared_folder
from garage2usd.stage.whole_stage import stages_of_levels, write_labels, write_stage

__all__ = [
    "StageFiles",
    "StageFormat",
    "arrangement_of",
    "asset_folder_name",
    "shared_folder",
    "stages_of_levels",
    "write_labels",
    "write_stage",
]

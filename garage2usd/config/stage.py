"""Settings of the stage's files."""

from enum import StrEnum
from pathlib import PurePosixPath

from pydantic import Field, ValidationInfo, field_validator

from garage2usd.common.settings import Settings

__all__ = ["AssetPlace", "StageConfig", "StageForm", "TextureQuality"]


_NESTED_FROM_SQUARES = 2000


class TextureQuality(StrEnum):
    """Resolution of the textures."""

    LOW = "low"
    """A quarter of the full width and height, 0.15 MB in all."""
    MEDIUM = "medium"
    """Half of the full width and height, 0.5 MB in all."""
    HIGH = "high"
    """The full width and height, 2 MB in all."""


class StageForm(StrEnum):
    """Composition of the stage."""

    AUTO = "auto"
    """Nested from 2000 squares on, else instanced."""
    INSTANCED = "instanced"
    """References to one asset for each shape, instanced."""
    NESTED = "nested"
    """Equal squares share a prototype too, which keeps large garages light; their objects cannot be overridden."""
    FLAT = "flat"
    """Everything in one layer without references, variants or instances, for readers without composition."""


class AssetPlace(StrEnum):
    """Location of a stage's assets, which are the same in every garage."""

    OWN = "own"
    """In a folder beside the stage that belongs to it, or inside a ``.usdz``."""
    SHARED = "shared"
    """In a folder shared by many stages."""


class StageConfig(Settings):
    """Files of the stage."""

    texture_quality: TextureQuality = TextureQuality.MEDIUM
    """Resolution of the textures: 'low', 'medium' or 'high'."""
    form: StageForm = StageForm.AUTO
    """'instanced', 'nested' for large garages, 'auto' to choose one of these by size, or 'flat' for readers without
    composition, which repeats the meshes for each object."""
    arrangements: int = Field(16, ge=1, le=100_000)
    """In the nested form, number of different arrangements of cars and other movable objects that the squares share."""
    assets: AssetPlace = AssetPlace.OWN
    """'own', or 'shared' for a folder of assets and textures that the ``.usda`` and ``.usdc`` files of many garages
    refer to."""
    asset_folder: str = Field("../assets", min_length=1, max_length=200, pattern=r"^[^@:\\\x00-\x1f\x7f]+$")
    """Folder of shared assets: a path with forward slashes, relative to the stage's folder."""

    @field_validator("assets")
    @classmethod
    def _composed(cls, assets: AssetPlace, settings: ValidationInfo) -> AssetPlace:
        if assets is AssetPlace.SHARED and settings.data.get("form") is StageForm.FLAT:
            raise ValueError("'own' where stage.form is 'flat', which refers to no assets")
        return assets

    @field_validator("asset_folder")
    @classmethod
    def _relative(cls, folder: str) -> str:
        path = PurePosixPath(folder)
        if path.is_absolute():
            raise ValueError("a path relative to the folder of the stage")
        return str(path)

    def is_nested(self, squares: int) -> bool:
        """True if equal squares share a prototype in a garage of `squares` squares."""
        return self.form is StageForm.NESTED or (self.form is StageForm.AUTO and squares >= _NESTED_FROM_SQUARES)

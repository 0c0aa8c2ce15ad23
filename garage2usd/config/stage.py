"""Settings of the stage's files."""

from enum import StrEnum
from pathlib import PurePosixPath

from pydantic import Field, ValidationInfo, field_validator

from garage2usd.common.settings import Settings

__all__ = ["AssetPlace", "StageConfig", "StageForm", "TextureQuality"]


_NESTED_FROM_SQUARES = 2000


class TextureQuality(StrEnum):
    """How fine the textures are."""

    LOW = "low"
    """A quarter of the full width and height, 0.15 MB in all."""
    MEDIUM = "medium"
    """Half of the full width and height, 0.5 MB in all."""
    HIGH = "high"
    """As they were baked, 2 MB in all."""


class StageForm(StrEnum):
    """How the stage is put together."""

    AUTO = "auto"
    """Nested from 2000 squares on, instanced below."""
    INSTANCED = "instanced"
    """References to one asset for each shape, instanced."""
    NESTED = "nested"
    """Equal squares share a prototype as well, so that large garages stay light; no opinions on objects in a square."""
    FLAT = "flat"
    """Everything in one layer without references, variants or instances, for readers that do not compose."""


class AssetPlace(StrEnum):
    """Where the assets of a stage are, which are the same in every garage."""

    OWN = "own"
    """In a folder of the stage's own beside it, or in a ``.usdz``."""
    SHARED = "shared"
    """In a folder that many stages share."""


class StageConfig(Settings):
    """The stage's files."""

    texture_quality: TextureQuality = TextureQuality.MEDIUM
    """'low', 'medium' or 'high': the budget for textures."""
    form: StageForm = StageForm.AUTO
    """'instanced', 'nested' for large garages, 'auto' for one of these by size, or 'flat' for readers without
    composition: meshes are repeated for each object."""
    arrangements: int = Field(16, ge=1, le=100_000)
    """In the nested form: how many different draws of cars and the like the squares share."""
    assets: AssetPlace = AssetPlace.OWN
    """'own', or 'shared' for one folder of assets and textures that the ``.usda`` and ``.usdc`` of many garages refer
    to."""
    asset_folder: str = Field("../assets", min_length=1, max_length=200, pattern=r"^[^@:\\\x00-\x1f\x7f]+$")
    """Where shared assets are: a path with slashes, relative to the folder of the stage."""

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
        """Whether equal squares share a prototype in a garage of so many squares."""
        return self.form is StageForm.NESTED or (self.form is StageForm.AUTO and squares >= _NESTED_FROM_SQUARES)

"""Settings of the stage's files."""

from enum import StrEnum

from pydantic import Field

from garage2usd.settings import Settings

__all__ = ["StageConfig", "StageForm", "TextureQuality"]


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


class StageConfig(Settings):
    """The stage's files."""

    texture_quality: TextureQuality = TextureQuality.MEDIUM
    """'low', 'medium' or 'high': the budget for textures."""
    form: StageForm = StageForm.AUTO
    """'instanced', 'nested' for large garages, 'auto' for one of these by size, or 'flat' for readers without
    composition: meshes are repeated for each object."""
    arrangements: int = Field(16, ge=1, le=100_000)
    """In the nested form: how many different draws of cars and the like the squares share."""

    def is_nested(self, squares: int) -> bool:
        """Whether equal squares share a prototype in a garage of so many squares."""
        return self.form is StageForm.NESTED or (self.form is StageForm.AUTO and squares >= _NESTED_FROM_SQUARES)

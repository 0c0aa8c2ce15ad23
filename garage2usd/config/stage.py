"""Settings of the stage's files."""

from enum import StrEnum

from garage2usd.config.base import Settings

__all__ = ["StageConfig", "StageForm", "TextureQuality"]


class TextureQuality(StrEnum):
    """How fine the textures are."""

    LOW = "low"
    """A quarter of the full width and height."""
    MEDIUM = "medium"
    """Half of the full width and height."""
    HIGH = "high"
    """As they were baked."""


class StageForm(StrEnum):
    """How the stage is put together."""

    INSTANCED = "instanced"
    """References to one asset for each shape, instanced."""
    FLAT = "flat"
    """Everything in one layer without references, variants or instances, for readers that do not compose."""


class StageConfig(Settings):
    """The stage's files."""

    texture_quality: TextureQuality = TextureQuality.HIGH
    """'low', 'medium' or 'high': the budget for textures."""
    form: StageForm = StageForm.INSTANCED
    """'instanced', or 'flat' for readers without composition: meshes are repeated for each object."""

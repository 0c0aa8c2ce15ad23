"""Edits of a survey that is traced over a picture: parts that are added, altered and removed, and the outline."""

from abc import abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, TypeAdapter

from garage2usd.common.settings import validated
from garage2usd.drafts.draft import Edit, told_edit
from garage2usd.drafts.toml_page import TomlPage
from garage2usd.survey.toml_survey import DrawnGarage, Place

NEW = "# A garage traced over a picture with `garage2usd draw`, for `garage2usd import`: metres, x right, z down.\n"
"""The survey that a page without one begins with."""
Part = Literal["stalls", "runs", "lanes", "columns", "portals", "solids"]


def is_survey(text: str, settings: Mapping[str, Any]) -> bool:
    """Return True for the text of a survey, and False for a configuration."""
    names = set(DrawnGarage.model_fields) - {"stalls"}  # a table in a configuration
    return text.startswith(NEW) or not names.isdisjoint(settings) or isinstance(settings.get("stalls"), list)


def survey_in(settings: Mapping[str, Any], _: Path) -> DrawnGarage:
    """Validate a survey, raising `ConfigError`."""
    return validated(DrawnGarage, settings)


class SurveyEdit(Edit[DrawnGarage]):
    """An edit of a survey."""

    @abstractmethod
    def apply(self, page: TomlPage) -> None:
        """Change the survey's document; raises `ConfigError` where the edit has no place in it."""

    def applied(self, text: str, config: DrawnGarage) -> str:  # noqa: ARG002 - the base class's
        """Apply the edit to a survey's text and return the new text."""
        page = TomlPage(text)
        self.apply(page)
        return page.text()


class Add(SurveyEdit):
    """Add a part."""

    kind: Literal["add"]
    part: Part
    value: dict[str, Any]
    """Its keys, as `garage2usd.survey.toml_survey` has them."""

    def apply(self, page: TomlPage) -> None:
        """Append the part."""
        page.add(self.part, self.value)


class Alter(SurveyEdit):
    """Set keys of a part, or take them out."""

    kind: Literal["alter"]
    part: Part
    at: int
    """Its place in the file, from 0."""
    value: dict[str, Any]
    """Keys to set; those with none are taken out."""

    def apply(self, page: TomlPage) -> None:
        """Change the part."""
        page.alter(self.part, self.at, self.value)


class Remove(SurveyEdit):
    """Remove a part."""

    kind: Literal["remove"]
    part: Part
    at: int
    """Its place in the file, from 0."""

    def apply(self, page: TomlPage) -> None:
        """Take the part out."""
        page.take(self.part, self.at)


class Outline(SurveyEdit):
    """Draw the outline, or let it follow from the parts."""

    kind: Literal["outline"]
    points: tuple[Place, ...] | None
    """(x, z) of its corners."""

    def apply(self, page: TomlPage) -> None:
        """Write the outline."""
        page.put("outline", None if self.points is None else [list(point) for point in self.points])


AnySurveyEdit = Annotated[Add | Alter | Remove | Outline, Field(discriminator="kind")]
_ADAPTER: TypeAdapter[AnySurveyEdit] = TypeAdapter(AnySurveyEdit)


def survey_edit_of(message: Any) -> SurveyEdit:  # noqa: ANN401 - what JSON holds
    """Read an edit; raises `ConfigError` for anything else."""
    return told_edit(_ADAPTER, message)

"""Opening of files at a desk: configurations of garages on squares, and surveys; both are TOML."""

import tomllib
from typing import Any

from garage2usd.common.errors import ConfigError, Garage2UsdError
from garage2usd.drafts.desk import Desk, Told, file_beside
from garage2usd.drafts.draft_file import SUFFIX, UNSAVED, DraftFile
from garage2usd.drafts.garage_desk import GarageDesk
from garage2usd.drafts.survey_desk import SurveyDesk
from garage2usd.drafts.survey_edits import is_survey

_MOST_FILES = 500


def desk_of(file: DraftFile, *, is_new_survey: bool = False) -> Desk[Any]:
    """Return the desk for what a file holds, or for the unsaved work beside it; for nothing, that of a new drawing.

    Raises
    ------
    ConfigError
        If the file is neither a configuration nor a survey, or a configuration where a survey was asked for.
    """
    text = file.kept() if file.saved is None else file.saved
    if text is None:
        return SurveyDesk(file) if is_new_survey else GarageDesk(file)
    try:
        settings = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise ConfigError(file.path.name, "text", f"TOML ({error})") from None
    if is_survey(text, settings):
        return SurveyDesk(file)
    if is_new_survey:
        raise ConfigError("CONFIG", file.path.name, "a survey or a new file, to trace a picture")
    return GarageDesk(file)


def files_beside(file: DraftFile) -> list[str]:
    """Name the TOML files of the folder of a file, also those of which there is unsaved work only."""
    folder = file.path.parent
    kept = {path.name.removeprefix(".").removesuffix(UNSAVED) for path in folder.glob(f".*{SUFFIX}{UNSAVED}")}
    return sorted(kept | {path.name for path in folder.glob(f"*{SUFFIX}") if path.is_file()})[:_MOST_FILES]


def opened_beside(desk: Desk[Any], message: Told) -> Desk[Any]:
    """Open another file of the folder, or a text from elsewhere as a new one; unsaved work stays beside its file.

    Parameters
    ----------
    desk
        The desk that stands open.
    message
        ``name`` of the file; with ``text``, what a new file of about this name is to begin with; with ``survey``, a new
        survey.

    Raises
    ------
    ConfigError, OutputError
        If the file cannot be opened, or stands open on another page; the desk stays open then.
    """
    file = file_beside(desk.file, message.get("name"))
    text, is_new_survey = message.get("text"), bool(message.get("survey"))
    if text is None and not is_new_survey:
        if file.saved is None and file.kept() is None:
            raise ConfigError("name", file.path.name, "a file of this folder")
        if file.path == desk.file.path:
            raise ConfigError("name", file.path.name, "another file than the one that is open")
    else:
        file = DraftFile.new(file.path.parent, file.path.stem)
    if text is not None:
        file.saved = str(text)  # read as if it lay there, then a new one
    try:
        found = desk_of(file, is_new_survey=is_new_survey)
    except Garage2UsdError as error:
        raise ConfigError(file.path.name, "text", str(error).splitlines()[0]) from None
    if text is not None:
        file.saved = None
    found.draft.number = desk.draft.number + 1  # another window sees that it has changed
    found.hold()
    return found

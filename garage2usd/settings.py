"""What all models of files share."""

from pydantic import BaseModel, ConfigDict, ValidationError

from garage2usd.errors import ConfigError

__all__ = ["Record", "Settings", "first_fault"]


class Settings(BaseModel):
    """A frozen group of values that users write; refuses unknown keys, NaN and infinity."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, use_attribute_docstrings=True, validate_default=True
    )


class Record(BaseModel):
    """A frozen part of a file that garage2usd writes and reads again; keys of other versions are left aside."""

    model_config = ConfigDict(frozen=True, allow_inf_nan=False)


def first_fault(error: ValidationError) -> str:
    """The first thing that is wrong with a file: the key and, where it has one, its value and what is allowed."""
    fault = error.errors(include_url=False)[0]
    place = ".".join(map(str, fault["loc"]))
    said = fault["msg"].removeprefix("Value error, ").removeprefix("Input should be ")
    if not place:
        return said
    return f"{place}: {said}" if fault["type"] == "missing" else str(ConfigError(place, fault["input"], said))

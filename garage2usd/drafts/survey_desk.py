"""The desk of a survey that is traced over a picture, and the garage that `garage2usd import` makes of it."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from garage2usd.common.errors import Garage2UsdError
from garage2usd.drafts.desk import Desk, Told
from garage2usd.drafts.draft import Draft
from garage2usd.drafts.draft_file import SUFFIX, DraftFile
from garage2usd.drafts.survey_edits import NEW, survey_edit_of, survey_in
from garage2usd.garage import Point
from garage2usd.imports import import_layout, unplaced_parts
from garage2usd.survey.toml_survey import DrawnGarage


class SurveyDesk(Desk[DrawnGarage]):
    """A survey that is traced.

    Parameters
    ----------
    file
        Its file.

    Raises
    ------
    ConfigError
        If the file is not a survey.
    """

    page = "trace.html"

    def __init__(self, file: DraftFile) -> None:
        super().__init__(file, Draft(NEW if file.saved is None else file.saved, file.path.parent, survey_in))

    def _drawing(self) -> Callable[[], Told]:
        drawing = self.draft.config
        return lambda: {
            "drawing": drawing.model_dump(mode="json", exclude_unset=True),
            "stalls": [{"name": name, "corners": corners} for name, corners in _stalls(drawing)],
        }

    def _edit(self, edit: Any, stroke: str) -> None:  # noqa: ANN401 - what JSON holds
        self.draft.edit(survey_edit_of(edit), stroke=stroke)

    def findings(self) -> Told:
        """Make a garage of the survey, as `import` does, and tell which parts it lacks, and why."""
        number, corners_of = self.draft.number, dict(_stalls(self.draft.config))
        try:
            told = self.build({})
        except Garage2UsdError as error:
            return {"number": number, "findings": [_finding("error", str(error).splitlines()[0])], "stalls": 0}
        findings = [
            _finding("warning", f"{name}: {reason}", corners_of.get(name, ())) for name, reason in told["unplaced"]
        ]
        findings += [_finding("info", remark) for remark in told["remarks"]]
        return {"number": number, "findings": findings, "stalls": told["stalls"]}

    def _writer(self) -> Callable[[Path], tuple[Path, Told]]:
        text = self.draft.text

        def write(place: Path) -> tuple[Path, Told]:
            source = place.with_suffix(SUFFIX)
            source.write_text(text, encoding="utf-8", newline="")
            made = import_layout(source, place.with_suffix(".usdc"), proves=False)
            told = {"stalls": made.garage.parking_stalls, "remarks": made.remarks}
            return made.stage, {**told, "unplaced": unplaced_parts(made.garage)}

        return write


def _stalls(drawing: DrawnGarage) -> Iterator[tuple[str, tuple[Point, ...]]]:
    """Yield the name and the corners of each stall, named as `import` names them."""
    for index, stall in enumerate(drawing.stalls):
        yield stall.id or f"stalls.{index}", stall.quad()
    for index, run in enumerate(drawing.runs):
        for place, quad in enumerate(run.quads()):
            yield f"{run.id or f'runs.{index}'}.{place}", quad


def _finding(severity: str, message: str, corners: tuple[Point, ...] = ()) -> Told:
    at = [sum(ways) / len(corners) for ways in zip(*corners, strict=True)] if corners else None
    return {"severity": severity, "rule": "import", "message": message, "place": "", "at": at}

"""The desk of a garage on squares: a configuration, its plan, lanes that are planned for it, and its stage."""

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from garage2usd.common.errors import ConfigError, Garage2UsdError
from garage2usd.config import (
    ClutterConfig,
    GarageConfig,
    LookConfig,
    MapsConfig,
    ParkingConfig,
    StageConfig,
    config_in,
)
from garage2usd.drafts import settings_told
from garage2usd.drafts.desk import Desk, Told
from garage2usd.drafts.draft import NEW, Draft
from garage2usd.drafts.draft_file import DraftFile
from garage2usd.drafts.edits import edit_of
from garage2usd.drafts.sketch import checked, has_lanes, sketch_of
from garage2usd.garage_model import Garage
from garage2usd.pipeline import generate
from garage2usd.stage import write_stage

_OF_NO_PLAN: dict[str, Any] = {
    "look": LookConfig(),
    "parking": ParkingConfig(),
    "clutter": ClutterConfig(),
    "stage": StageConfig(),
    "maps": MapsConfig(),
}
"""Settings that no lane depends on."""
_LEAST_WAIT_S = 0.2


class _Stopped(Exception):  # noqa: N818 - no error
    """Learning was stopped by the user."""


class GarageDesk(Desk[GarageConfig]):
    """A garage on squares that is drawn.

    Parameters
    ----------
    file
        Its file.

    Raises
    ------
    ConfigError
        If the file is not a configuration, or its squares cannot be drawn.
    """

    page = "draw.html"
    told = (*Desk.told, "controls", "progress")
    done = (*Desk.done, "learn", "stop", "adopt")

    def __init__(self, file: DraftFile) -> None:
        super().__init__(file, Draft(NEW if file.saved is None else file.saved, file.path.parent, config_in))
        self._planned: tuple[str, Garage] | None = None
        self._work: Told = {"step": "", "done": 0, "total": 0, "error": "", "seconds": 0.0}
        self._worker: threading.Thread | None = None
        self._is_stopped = False

    def _drawing(self) -> Callable[[], Told]:
        config, planned = self.draft.config, self._garage()
        told = {
            "levels": config.building.levels,
            "place": None if config.building.place is None else config.building.place.model_dump(mode="json"),
            "given_sides": [side is not None for side in (config.bay.row_depths_m, config.bay.column_widths_m)],
            "runs": [run.model_dump(mode="json") for run in config.stalls.runs],
            "values": settings_told.values(config),
            "given": settings_told.given(config),
            "drawn_look": bool(config.look.axes),
            "has_lanes": has_lanes(config),
            "is_working": self._is_working,
        }

        def sketched() -> Told:
            began = time.perf_counter()
            return {**told, "sketch": sketch_of(config, planned), "seconds": round(time.perf_counter() - began, 4)}

        return sketched

    @staticmethod
    def controls() -> Told:
        """Tell the settings that have controls."""
        return {"controls": settings_told.controls(), "colours": settings_told.colours()}

    def findings(self) -> Told:
        """Lay the garage out and check it with all objects."""
        with self._lock:
            number, config, planned = self.draft.number, self.draft.config, self._garage()
        return {"number": number, **checked(config, planned)}

    def _edit(self, edit: Any, stroke: str) -> None:  # noqa: ANN401 - what JSON holds
        self.draft.edit(edit_of(edit), stroke=stroke)

    def learn(self, _: Told) -> Told:
        """Begin to plan the lanes."""
        with self._lock:
            if not self._is_working:
                self._is_stopped = False
                self._work = {"step": "lanes", "done": 0, "total": 0, "error": "", "seconds": 0.0}
                self._worker = threading.Thread(target=self._learn, args=(self.draft.config,), daemon=True)
                self._worker.start()
        return self.progress()

    def stop(self, _: Told) -> Told:
        """Stop the planning of lanes."""
        self._is_stopped = True
        return self.progress()

    def progress(self) -> Told:
        """Tell how far the planning of lanes is."""
        if self._worker is not None:
            self._worker.join(_LEAST_WAIT_S)
        return {**self._work, "is_working": self._is_working}

    def adopt(self, _: Told) -> Told:
        """Keep the planned lanes as drawn ones."""

        def change() -> None:
            garage = self._garage()
            if garage is None or len(garage.levels) > 1:
                raise ConfigError("site.structure", "no plan of one level", "lanes that were planned for one level")
            rows = str(garage.levels[0].plan.structure).splitlines()
            self.draft.edit(edit_of({"kind": "adopt", "rows": rows}))

        return self._changed(change)

    def _writer(self) -> Callable[[Path], tuple[Path, Told]]:
        config, planned = self.draft.config, self._garage()
        if planned is None and not has_lanes(config):
            raise ConfigError("site.structure", "no lanes", "lanes, drawn or planned; plan them first")

        def write(place: Path) -> tuple[Path, Told]:
            garage = generate(config, plan=None if planned is None else [level.plan for level in planned.levels])
            return write_stage(garage, place.with_suffix(".usdc")).stage, {"stalls": garage.parking_stalls}

        return write

    def _view_name(self) -> str:
        return f"{self.draft.number}{'' if self._garage() is None else '-planned'}"

    def close(self) -> None:
        """Stop all work and let the file go; unsaved work stays beside it."""
        self._is_stopped = True
        super().close()

    @property
    def _is_working(self) -> bool:
        return self._worker is not None and self._worker.is_alive()

    def _garage(self) -> Garage | None:
        """Return the garage that was planned for the present drawing."""
        if self._planned is None or self._planned[0] != _key(self.draft.config):
            return None
        return self._planned[1]

    def _learn(self, config: GarageConfig) -> None:
        began = time.perf_counter()

        def told(step: str, done: int, total: int) -> None:
            if self._is_stopped:
                raise _Stopped
            self._work = {**self._work, "step": step, "done": done, "total": total}
            self._work["seconds"] = round(time.perf_counter() - began, 2)

        try:
            garage = generate(config, progress=told)
        except _Stopped:
            self._work = {**self._work, "error": "stopped"}
        except Garage2UsdError as error:
            self._work = {**self._work, "error": str(error).splitlines()[0]}
        else:
            self._planned = (_key(config), garage)
            self._work["seconds"] = round(time.perf_counter() - began, 2)


def _key(config: GarageConfig) -> str:
    """Digest of the settings that lanes depend on."""
    return config.model_copy(update=_OF_NO_PLAN).digest()

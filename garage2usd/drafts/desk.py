"""The desk at which a garage is drawn: its draft and file, lanes planned for it, and its stage for the 3D view."""

import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from garage2usd.common.errors import ConfigError, Garage2UsdError, OutputError
from garage2usd.config import ClutterConfig, GarageConfig, LookConfig, MapsConfig, ParkingConfig, StageConfig
from garage2usd.drafts import settings_told
from garage2usd.drafts.draft import NEW, Draft
from garage2usd.drafts.draft_file import SUFFIX, DraftFile
from garage2usd.drafts.edits import edit_of
from garage2usd.drafts.sketch import Told, checked, has_lanes, sketch_of
from garage2usd.garage_model import Garage
from garage2usd.pipeline import generate
from garage2usd.reading.files import open_stage
from garage2usd.stage import write_stage
from garage2usd.view.viewer import Looks, ShownScene, read_scene

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


class RefusalError(Garage2UsdError):
    """A message that does not fit the drawing as it is now: of an older version, or over changes of the file."""


class Desk:
    """A drawing, in the hands of one or several windows of a browser.

    Parameters
    ----------
    file
        Its file.

    Raises
    ------
    ConfigError
        If the file is not a configuration, or its squares cannot be drawn.
    """

    def __init__(self, file: DraftFile) -> None:
        self._lock = threading.RLock()
        self._file = file
        self.draft = Draft(NEW if file.saved is None else file.saved, file.path.parent)
        self._kept = file.kept()
        self._planned: tuple[str, Garage] | None = None
        self._work: Told = {"step": "", "done": 0, "total": 0, "error": "", "seconds": 0.0}
        self._worker: threading.Thread | None = None
        self._is_stopped = False
        self._views: dict[str, ShownScene] = {}
        self._stalls: dict[str, int] = {}
        self._at_build = threading.Lock()

    # what the page is told

    def state(self) -> Told:
        """Tell all that the page shows."""
        with self._lock:
            draft, planned = self.draft, self._garage()
            number, config = draft.number, draft.config
            told = {
                "number": number,
                "name": self._file.path.name,
                "folder": str(self._file.path.parent),
                "is_new": self._file.saved is None,
                "is_saved": draft.text == self._file.saved,
                "can_undo": draft.can_undo,
                "can_redo": draft.can_redo,
                "kept": self._kept is not None,
                "levels": config.building.levels,
                "place": None if config.building.place is None else config.building.place.model_dump(mode="json"),
                "given_sides": [side is not None for side in (config.bay.row_depths_m, config.bay.column_widths_m)],
                "runs": [run.model_dump(mode="json") for run in config.stalls.runs],
                "values": settings_told.values(config),
                "given": settings_told.given(config),
                "drawn_look": bool(config.look.axes),
                "has_lanes": has_lanes(config),
                "is_working": self._is_working,
                "view": self._view_name(),
            }
        began = time.perf_counter()
        return {**told, "sketch": sketch_of(config, planned), "seconds": round(time.perf_counter() - began, 4)}

    @staticmethod
    def controls() -> Told:
        """Tell the settings that have controls."""
        return {"controls": settings_told.controls(), "colours": settings_told.colours()}

    def changed_outside(self) -> Told:
        """Tell whether the file is no longer as it was read, and the number of the version, for other windows."""
        return {"changed": self._file.has_changed, "number": self.draft.number}

    def findings(self) -> Told:
        """Lay the garage out and check it with all objects."""
        with self._lock:
            number, config, planned = self.draft.number, self.draft.config, self._garage()
        return {"number": number, **checked(config, planned)}

    # what the page does

    def edit(self, message: Told) -> Told:
        """Apply an edit of the version that the page has."""

        def change() -> None:
            if message.get("number") != self.draft.number:
                raise RefusalError("the drawing was changed in another window; it is shown as it is now")
            self.draft.edit(edit_of(message.get("edit")), stroke=str(message.get("stroke", "")))

        return self._changed(change)

    def undo(self, _: Told) -> Told:
        """Undo an edit."""
        return self._changed(self.draft.undo)

    def redo(self, _: Told) -> Told:
        """Redo an edit."""
        return self._changed(self.draft.redo)

    def restore(self, message: Told) -> Told:
        """Take the work that an earlier page left unsaved, or discard it."""

        def change() -> None:
            if self._kept is not None and message.get("take"):
                self.draft.replace(self._kept)
            self._kept = None

        return self._changed(change)

    def reload(self, _: Told) -> Told:
        """Take the file as others changed it; what was drawn can be brought back by undo."""

        def change() -> None:
            file = DraftFile(self._file.path)
            if file.saved is not None:
                self.draft.replace(file.saved)
            self._file.saved = file.saved

        return self._changed(change)

    def save(self, message: Told) -> Told:
        """Save the drawing, under another name of the same folder if one is given."""
        with self._lock:
            name = str(message.get("name") or self._file.path.name)
            if name != Path(name).name or not name.endswith(SUFFIX) or name == SUFFIX:
                raise ConfigError("name", name, f"a file name in this folder that ends in {SUFFIX}")
            file = self._file if name == self._file.path.name else DraftFile(self._file.path.with_name(name))
            if file is not self._file and file.saved is not None and not message.get("over"):
                raise RefusalError(f"{name} is there already")
            if file is self._file and file.has_changed and not message.get("over"):
                raise RefusalError(f"{name} has changed since it was read here")
            file.save(self.draft.text, over_changes=True)
            if file is not self._file:
                self._file.discard()
                self._file = file
            self._kept = None
        return self.state()

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

    def build(self, _: Told) -> Told:
        """Build the garage for the 3D view, once; tells the name of the view, and its number of stalls."""
        with self._at_build:
            with self._lock:
                config, planned, name = self.draft.config, self._garage(), self._view_name()
                if planned is None and not has_lanes(config):
                    raise ConfigError("site.structure", "no lanes", "lanes, drawn or planned; plan them first")
                shown = self.view(name)
            plans = None if planned is None else [level.plan for level in planned.levels]
            try:
                if shown is not None and not shown.is_ready:
                    garage = generate(config, plan=plans)
                    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
                        place = Path(folder, f"{self._file.path.stem}.usdc")
                        written = write_stage(garage, place).stage
                        shown.show(read_scene(open_stage(written), written, Looks()))
                    self._stalls[name] = garage.parking_stalls
            except Garage2UsdError:
                self._drop_views(but=0)
                raise
            return {"view": name, "stalls": self._stalls[name]}

    def view(self, name: str) -> ShownScene | None:
        """Return a 3D view by its name; that of the present drawing also before it is built, and waits for that."""
        with self._lock:
            if name not in self._views and name == self._view_name():
                self._drop_views(but=1)  # the one before may stand open
                self._views[name] = ShownScene()
            return self._views.get(name)

    def _view_name(self) -> str:
        return f"{self.draft.number}{'' if self._garage() is None else '-planned'}"

    def _drop_views(self, *, but: int) -> None:
        for name in list(self._views)[: len(self._views) - but]:
            self._views.pop(name).release()

    def close(self) -> None:
        """Stop all work; unsaved work stays beside the file."""
        self._is_stopped = True
        self._drop_views(but=0)

    # how

    @property
    def _is_working(self) -> bool:
        return self._worker is not None and self._worker.is_alive()

    def _changed(self, change: Callable[[], None]) -> Told:
        with self._lock:
            change()
            if self._kept is None:  # else the work of before would be lost before anybody was asked
                try:
                    self._file.keep(self.draft.text)
                except OutputError as error:
                    return {**self.state(), "warning": str(error)}
        return self.state()

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

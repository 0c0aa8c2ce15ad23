"""Render devices, a processor or a GPU of Cycles or few rays, and the time that pictures take on them."""

import json
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

from garage2usd.common.errors import ConfigError, RenderError
from garage2usd.common.package import PICTURES
from garage2usd.render.blender_process import BLENDER_MODULE, Blender, modules_of

_SCRIPT = Path(__file__).with_name("blender_devices.py")
_PATIENCE_S = 120.0
_CPU, _RAYS = "CPU", "RAYS"
_TRACES_SHADERS = "OPTIX"
"""The only kind of GPU on which Cycles runs OSL shaders, which the lenses of rigs are."""
_BUDGET_S, _BUDGET_CORES = 120.0, 2
_LEAST, _MOST, _RAYS_SAMPLES = 2, 64, 4
_SCENE_S = 11.0
"""Seconds in which one core reads the stage and Blender reads the scene."""
_SAMPLE_S, _FINISH_S, _DATA_S = 33.0, 40.0, 12.0
"""Seconds of a core for a million pixels: of one sample, of the denoiser, and of all pictures other than colour."""
_MILLION = 1e6


class Device(StrEnum):
    """Choice of the render device."""

    AUTO = "auto"
    """A GPU if Cycles finds one that can render all views, otherwise the processor."""
    CPU = "cpu"
    GPU = "gpu"
    RAYS = "rays"
    """The processor without Blender, by few rays (`garage2usd.render.quick_light`): quicker, and less exact."""


@dataclass(frozen=True)
class ComputeDevice:
    """A render device of Cycles.

    Attributes
    ----------
    kind
        Kind of the device in Cycles: ``CPU``, ``OPTIX``, ``CUDA``, ``HIP``, ``METAL`` or ``ONEAPI``; ``RAYS`` without
        Cycles.
    name
        Name of the device, and of further devices of its kind, which render as well.
    blender
        The Blender that renders on the device.
    """

    kind: str
    name: str
    blender: Blender = BLENDER_MODULE

    @property
    def words(self) -> str:
        """The device in words."""
        if self.kind == _RAYS:
            return "the CPU without Blender"
        return "the CPU" if self.kind == _CPU else f"the GPU {self.name} ({self.kind})"

    @property
    def is_by_rays(self) -> bool:
        """True if no Blender draws."""
        return self.kind == _RAYS


CPU = ComputeDevice(_CPU, "")
"""The processor, which is always available."""
RAYS = ComputeDevice(_RAYS, "")
"""The processor without Blender."""


def modules_for(device: Device, blender: Blender) -> tuple[str, ...]:
    """Return the names of the Python modules that rendering on a device requires."""
    return ("embreex", *PICTURES) if device is Device.RAYS else modules_of(blender)


def check_birds_eye_device(device: Device) -> None:
    """Check before the work that a device draws bird's-eye views.

    Raises
    ------
    ConfigError
        If it draws by rays, which do not see through ceilings.
    """
    if device is Device.RAYS:
        raise ConfigError("device", str(device), "cpu or gpu for bird's-eye views, which see through ceilings")


def find_device(asked: Device, *, has_rays: bool, blender: Blender = BLENDER_MODULE) -> ComputeDevice:
    """Find the device to render colour on.

    Parameters
    ----------
    asked
        The requested device.
    has_rays
        True if a lens is an OSL shader, as those of rigs are.
    blender
        The Blender that renders.

    Raises
    ------
    ConfigError
        If a GPU is requested and none can render the views.
    RenderError
        If Blender fails to list its devices.
    """
    if asked is Device.RAYS:
        return RAYS
    processor = replace(CPU, blender=blender)
    if asked is Device.CPU:
        return processor
    found = _devices(blender)
    usable = {kind: names for kind, names in found.items() if kind == _TRACES_SHADERS or not has_rays}
    gpu = next(
        (ComputeDevice(kind, ", ".join(names), blender) for kind, names in usable.items() if names and kind != _CPU),
        None,
    )
    if gpu is not None:
        return gpu
    if asked is Device.GPU:
        names = ", ".join(f"{name} ({kind})" for kind, each in found.items() for name in each) or "nothing"
        what = f"a GPU with {_TRACES_SHADERS}, which lenses of rigs need" if has_rays else "a GPU"
        raise ConfigError("device", str(asked), f"auto or cpu where Cycles does not find {what}; it finds {names}")
    return processor


def _devices(blender: Blender = BLENDER_MODULE) -> dict[str, list[str]]:
    """Query the names of Cycles' devices by kind."""
    try:
        asked = subprocess.run(  # noqa: S603 - our own script
            blender.command(_SCRIPT),
            capture_output=True,
            text=True,
            encoding="utf-8",
            errors="replace",
            timeout=_PATIENCE_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise RenderError(1, "Cycles does not say which devices there are") from None
    lines = [line for line in asked.stdout.splitlines() if line.strip()]
    # an installed Blender prints a farewell after the answer
    told = [line for line in lines if line.startswith("{")]
    if asked.returncode != 0 or not told:
        raise RenderError(asked.returncode, " | ".join([*lines, *asked.stderr.splitlines()][-3:]))
    devices: dict[str, list[str]] = json.loads(told[-1])
    return devices


def default_samples(sizes_px: Iterable[tuple[int, int]], device: ComputeDevice = CPU) -> int:
    """Return the number of samples with which two cores draw colour pictures of some sizes in two minutes.

    At least 2, which the denoiser makes smooth, though many pictures take longer; at most 64. Without Blender always 4.
    """
    if device.is_by_rays:
        return _RAYS_SAMPLES
    pixels = _pixels(sizes_px)
    left_s = (_BUDGET_S - _SCENE_S) * _BUDGET_CORES - (_FINISH_S + _DATA_S) * pixels / _MILLION
    return min(_MOST, max(_LEAST, int(left_s / (_SAMPLE_S * max(pixels, 1) / _MILLION))))


def drawing_s(
    colours_px: Iterable[tuple[int, int]], data_px: Iterable[tuple[int, int]], *, samples: int, cores: int
) -> float:
    """Estimate the seconds in which processors draw colour pictures and all others of some sizes."""
    colour, data = _pixels(colours_px), _pixels(data_px)
    work_s = (colour * (samples * _SAMPLE_S + _FINISH_S) + data * _DATA_S) / _MILLION
    return _SCENE_S + work_s / cores


def _pixels(sizes_px: Iterable[tuple[int, int]]) -> int:
    return sum(width * height for width, height in sizes_px)

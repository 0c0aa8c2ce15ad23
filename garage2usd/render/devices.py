"""Render devices for the colour picture: the processor, or a GPU supported by Cycles."""

import json
import subprocess
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

from garage2usd.common.errors import ConfigError, RenderError
from garage2usd.render.blender_process import BLENDER_MODULE, Blender

__all__ = ["CPU", "ComputeDevice", "Device", "find_device"]

_SCRIPT = Path(__file__).with_name("blender_devices.py")
_PATIENCE_S = 120.0
_CPU = "CPU"
_TRACES_SHADERS = "OPTIX"
"""The only kind of GPU on which Cycles runs OSL shaders, which the lenses of rigs are."""


class Device(StrEnum):
    """Choice of the render device."""

    AUTO = "auto"
    """A GPU if Cycles finds one that can render all views, otherwise the processor."""
    CPU = "cpu"
    GPU = "gpu"


@dataclass(frozen=True)
class ComputeDevice:
    """A render device of Cycles.

    Attributes
    ----------
    kind
        Kind of the device in Cycles: ``CPU``, ``OPTIX``, ``CUDA``, ``HIP``, ``METAL`` or ``ONEAPI``.
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
        return "the CPU" if self.kind == _CPU else f"the GPU {self.name} ({self.kind})"


CPU = ComputeDevice(_CPU, "")
"""The processor, which is always available."""


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
    # an installed program says goodbye after it
    told = [line for line in lines if line.startswith("{")]
    if asked.returncode != 0 or not told:
        raise RenderError(asked.returncode, " | ".join([*lines, *asked.stderr.splitlines()][-3:]))
    devices: dict[str, list[str]] = json.loads(told[-1])
    return devices

"""The device that colour is drawn on: the processor, or a GPU that Cycles can use."""

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
"""The only kind of GPU on which Cycles runs the shaders that lenses of rigs are."""


class Device(StrEnum):
    """What is asked for."""

    AUTO = "auto"
    """A GPU where Cycles finds one that can draw all views, else the processor."""
    CPU = "cpu"
    GPU = "gpu"


@dataclass(frozen=True)
class ComputeDevice:
    """A device of Cycles.

    Attributes
    ----------
    kind
        As Cycles has it: ``CPU``, ``OPTIX``, ``CUDA``, ``HIP``, ``METAL`` or ``ONEAPI``.
    name
        Its name, and those of others of its kind, which draw as well.
    blender
        The Blender that draws on it.
    """

    kind: str
    name: str
    blender: Blender = BLENDER_MODULE

    @property
    def words(self) -> str:
        """Which one it is."""
        return "the CPU" if self.kind == _CPU else f"the GPU {self.name} ({self.kind})"


CPU = ComputeDevice(_CPU, "")
"""The processor, which is there without asking."""


def find_device(asked: Device, *, has_rays: bool, blender: Blender = BLENDER_MODULE) -> ComputeDevice:
    """The device to draw colour on.

    Parameters
    ----------
    asked
        What is asked for.
    has_rays
        Whether a lens is a shader, as those of rigs are.
    blender
        The Blender that draws.

    Raises
    ------
    ConfigError
        If a GPU is asked for and there is none that can draw.
    RenderError
        If Blender does not say what there is.
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
    """Names of the devices of each kind that Cycles knows."""
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

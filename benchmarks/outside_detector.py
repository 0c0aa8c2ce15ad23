"""SPFCN (arXiv 2003.11337), which others trained on photographs alone, as a detector of the corners of strips.

Its layers are told by the weights that its authors publish; nothing of their code is needed. Needs torch, see
``outside_requirements.txt``.
"""

import pickle
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from average_precision import Detections
from framed_strips import corners_in_strip, framed
from strips import Strip
from torch.nn import functional

from garage2usd.common.errors import ConfigError
from garage2usd.common.progress import Progress, silent

__all__ = ["OutsideDetector", "read_detector"]

_LAYERS = 12
_DOWN = range(1, 6)
"""Layers that halve the picture; what they get is added to what as many of the last layers get, doubled."""
_UP = range(7, 12)
_DILATED = 6
_AT_ONCE = 16


@dataclass(frozen=True, eq=False)
class OutsideDetector:
    """The network of the light SPFCN.

    Attributes
    ----------
    weights
        Tensors by their names: of each layer a convolution, and what normalises and scales its channels.
    """

    weights: dict[str, torch.Tensor]

    def detect(self, strips: Sequence[Strip], progress: Progress = silent) -> list[Detections]:
        """The corners that it finds in strips; their number so far is told."""
        found: list[Detections] = []
        for first in range(0, len(strips), _AT_ONCE):
            progress("detect", first, len(strips))
            frames = torch.from_numpy(np.stack([framed(strip) for strip in strips[first : first + _AT_ONCE]]))
            found += [corners_in_strip(confidence) for confidence in self.confidence(frames).numpy()]
        progress("detect", len(strips), len(strips))
        return found

    @torch.inference_mode()
    def confidence(self, frames: torch.Tensor) -> torch.Tensor:
        """That of a corner at each pixel of frames; shapes (n, rows, columns), rows and columns multiples of 32."""
        x, finer = frames[:, None], []
        for number in range(_LAYERS):
            layer = f"_conv_trunk.{number}."
            if number in _DOWN:
                finer.append(x)
            elif number in _UP:
                x = functional.interpolate(x, scale_factor=2.0) + finer.pop()
            kernel, dilation = self.weights[f"{layer}_conv.weight"], 2 if number == _DILATED else 1
            stride, padding = 2 if number in _DOWN else 1, kernel.shape[-1] // 2 * dilation
            x = functional.conv2d(x, kernel, stride=stride, padding=padding, dilation=dilation)
            if number < _LAYERS - 1:
                of = ("running_mean", "running_var", "weight", "bias")
                x = functional.relu(functional.batch_norm(x, *(self.weights[f"{layer}_bn.{each}"] for each in of)))
        # the other two channels are the lines of slots
        return x[:, 0].sigmoid()


def read_detector(path: Path) -> OutsideDetector:
    """The network of a file of weights; of the file nothing is run.

    Raises
    ------
    ConfigError
        If the file is missing or has other weights.
    """
    allowed = "SPFCN_Light/stable_parameter_0914.pkl of the repository SPFCN-ParkingSlotDetection"
    try:
        weights = torch.load(path, map_location="cpu", weights_only=True)
        detector = OutsideDetector(weights)
        detector.confidence(torch.zeros((1, 32, 32)))
    except (
        OSError,
        pickle.UnpicklingError,
        EOFError,
        LookupError,
        TypeError,
        AttributeError,
        RuntimeError,
        ValueError,
    ):
        raise ConfigError("weights", str(path), allowed) from None
    return detector

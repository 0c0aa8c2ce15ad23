"""A small network that finds slots in strips, as pairs of directional marking points, and ground that is free.

The layers of `corner_network` give each cell of 4 x 4 pixels the confidence that a marking point is in it, the point's
place, direction and shape (see `slot_pairs`), whether a car stands in the slot whose entry has its middle there, and
whether the ground is free. Needs jax, flax and optax, see ``real_requirements.txt``.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import jax
import jax.numpy as jnp
import numpy as np
import optax
from corner_network import FIRST_LOGIT, Training, answers, features, fitted, focal_loss
from flax import linen as nn
from numpy.typing import NDArray
from slot_maps import CHANNELS, FREE, OCCUPIED, SlotMaps, logistic, moved, points_in, shares_occupied, slot_maps
from slot_measures import Understood
from slot_pairs import paired
from strip_changes import changed_and_moved
from strip_labels import StripLabels
from strips import SIZE_PX, Strip

from garage2usd.common.progress import Progress, silent

__all__ = ["SlotNetwork", "train_slots"]

_OFFSET_WEIGHT, _DIRECTION_WEIGHT, _OPENS_WEIGHT, _OCCUPIED_WEIGHT, _FREE_WEIGHT = 0.5, 2.0, 1.0, 1.0, 2.0
_TOLERANCE = 0.1
"""By which entries may be shorter or longer than those that are learnt from."""


class _Layers(nn.Module):
    """Answers of `slot_maps.CHANNELS` channels, float32, shape (n, rows / 4, columns / 4, channels)."""

    @nn.compact
    def __call__(self, x: jax.Array) -> jax.Array:
        first = np.zeros(CHANNELS, dtype=np.float32)
        first[0] = FIRST_LOGIT
        return nn.Conv(CHANNELS, (1, 1), bias_init=lambda *_: jnp.asarray(first))(features(x))


@dataclass(frozen=True, eq=False)
class SlotNetwork:
    """A network that has learnt.

    Attributes
    ----------
    parameters
        Of its layers.
    lengths_px
        The shortest and the longest entry that it takes for one.
    """

    parameters: optax.Params
    lengths_px: tuple[float, float]

    def understand(self, strips: Sequence[Strip]) -> list[Understood]:
        """What it finds in strips."""
        found = []
        for answer in answers(_Layers(), self.parameters, strips):
            points = points_in(answer)
            slots = paired(points, self.lengths_px)
            free = logistic(cv2.resize(answer[..., FREE], SIZE_PX, interpolation=cv2.INTER_LINEAR))
            found.append(Understood(points, slots, shares_occupied(answer, slots), free))
        return found


def train_slots(
    strips: Sequence[tuple[Strip, StripLabels]], training: Training, seed: int, progress: Progress = silent
) -> SlotNetwork:
    """Train a network on strips and their labels, as `corner_network.train` does."""
    random = np.random.default_rng(seed)
    pixels = np.stack([strip.pixels for strip, _ in strips])

    def batch() -> tuple[NDArray[np.float32], dict[str, NDArray[np.float32]]]:
        chosen = random.integers(len(pixels), size=training.batch)
        x, matrices = changed_and_moved(pixels[chosen], random)
        labels = [moved(strips[number][1], matrix) for number, matrix in zip(chosen, matrices, strict=True)]
        return x, SlotMaps.stacked([slot_maps(each) for each in labels]).arrays()

    entries = np.concatenate([labels.corners_px[:, 1] - labels.corners_px[:, 0] for _, labels in strips])
    lengths = np.hypot(*entries.T)
    limits = float(lengths.min() * (1 - _TOLERANCE)), float(lengths.max() * (1 + _TOLERANCE))
    return SlotNetwork(fitted(_Layers(), _loss, batch, training, seed, progress), limits)


def _loss(answer: jax.Array, truth: dict[str, jax.Array]) -> jax.Array:
    """The focal loss of points, and what is asked of the cells of points, of slots and of all ground."""
    points = focal_loss(answer[..., 0], truth["heat"], 1 - truth["hidden"])
    offset = optax.huber_loss(answer[..., 1:3], truth["point"][..., :2]).sum(axis=-1)
    direction = ((answer[..., 3:5] - truth["point"][..., 2:4]) ** 2).sum(axis=-1)
    opens = _entropy(answer[..., 5:7], truth["point"][..., 4:]).sum(axis=-1)
    at_point = _OFFSET_WEIGHT * offset + _DIRECTION_WEIGHT * direction + _OPENS_WEIGHT * opens
    occupied = _mean(_entropy(answer[..., OCCUPIED], truth["occupied"]), truth["is_slot"])
    free = _mean(_entropy(answer[..., FREE], truth["free"]), truth["is_known"])
    return points + _mean(at_point, truth["is_point"]) + _OCCUPIED_WEIGHT * occupied + _FREE_WEIGHT * free


def _entropy(logits: jax.Array, truth: jax.Array) -> jax.Array:
    return optax.sigmoid_binary_cross_entropy(logits, truth)


def _mean(values: jax.Array, weight: jax.Array) -> jax.Array:
    return (values * weight).sum() / (weight.sum() + 1.0)

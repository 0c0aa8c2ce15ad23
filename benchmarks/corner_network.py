"""A small network that finds the entry corners of slots in strips: a map with a peak where a corner is.

Eight convolutions, which go down to an eighth of the picture and up to a quarter, learn by the focal loss of CenterNet
(arXiv 1904.07850). Needs jax, flax and optax, see ``real_requirements.txt``.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import jax
import jax.numpy as jnp
import numpy as np
import optax
from average_precision import Detections
from corner_maps import peaks
from flax import linen as nn
from numpy.typing import NDArray
from strip_changes import changed
from strips import SIZE_PX, Strip

from garage2usd.common.progress import Progress, silent

__all__ = [
    "FIRST_LOGIT",
    "CornerNetwork",
    "Training",
    "answers",
    "features",
    "fitted",
    "focal_loss",
    "train",
]

FIRST_LOGIT = -3.0
"""Of all cells before anything is learnt: corners are few."""
_AT_ONCE = 32
_TOLD_STEPS = 250
Truth = TypeVar("Truth")


@dataclass(frozen=True)
class Training:
    """How a network is trained, whatever it learns from.

    Attributes
    ----------
    steps, batch
        How many steps of how many pictures.
    rate
        Of learning at first; it falls to 0 as a cosine does.
    """

    steps: int = 1000
    batch: int = 12
    rate: float = 2e-3


class _Layers(nn.Module):
    """Logits of the map, float32, shape (n, rows / 4, columns / 4), of pictures, shape (n, rows, columns, 3)."""

    @nn.compact
    def __call__(self, x: jax.Array) -> jax.Array:
        x = features(x)
        return nn.Conv(1, (1, 1), bias_init=nn.initializers.constant(FIRST_LOGIT))(x)[..., 0]


def features(x: jax.Array) -> jax.Array:
    """48 features of each cell, shape (n, rows / 4, columns / 4, 48), in layers of the module that calls it."""
    x = _norm(x)
    x = _block(x, 16, strides=2)
    x = _block(x, 32, strides=2)
    fine = _block(x, 48)
    x = _block(fine, 64, strides=2)
    x = _block(x, 64, dilation=2)
    x = _block(x, 48, dilation=4)
    return _block(fine + jax.image.resize(x, fine.shape, "nearest"), 48)


def _block(x: jax.Array, channels: int, *, strides: int = 1, dilation: int = 1) -> jax.Array:
    convolution = nn.Conv(
        channels, (3, 3), strides=strides, kernel_dilation=dilation, kernel_init=nn.initializers.he_normal()
    )
    return nn.relu(_norm(convolution(x)))


def _norm(x: jax.Array) -> jax.Array:
    """Each channel of each picture, so that exposure and colour of the light count for less."""
    return nn.InstanceNorm(use_bias=False, use_scale=False, epsilon=1e-5)(x)


@dataclass(frozen=True, eq=False)
class CornerNetwork:
    """A network that has learnt.

    Attributes
    ----------
    parameters
        Of its layers.
    """

    parameters: optax.Params

    def detect(self, strips: Sequence[Strip]) -> list[Detections]:
        """The corners that it finds in strips."""
        return [peaks(np.asarray(nn.sigmoid(logits))) for logits in answers(_Layers(), self.parameters, strips)]


def answers(layers: nn.Module, parameters: optax.Params, strips: Sequence[Strip]) -> Iterator[NDArray[np.float32]]:
    """What layers answer to each strip."""
    for first in range(0, len(strips), _AT_ONCE):
        some = np.stack([strip.pixels for strip in strips[first : first + _AT_ONCE]])
        filled = np.concatenate([some, np.zeros((_AT_ONCE - len(some), *some.shape[1:]), some.dtype)])
        yield from np.asarray(_answer(layers, parameters, filled))[: len(some)]


def train(strips: Sequence[Strip], training: Training, seed: int, progress: Progress = silent) -> CornerNetwork:
    """Train a network on strips; the same strips, training and seed give the same network on the same processor.

    Parameters
    ----------
    strips
        What it learns from: the corners that are seen in them.
    training
        How.
    seed
        Of its start and of the order of pictures and their changes.
    progress
        Called with the number of steps that are done.
    """
    random = np.random.default_rng(seed)
    pixels = np.stack([strip.pixels for strip in strips])

    def batch() -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        chosen = random.integers(len(pixels), size=training.batch)
        return changed(pixels[chosen], [strips[each].seen_px for each in chosen], random)

    return CornerNetwork(fitted(_Layers(), focal_loss, batch, training, seed, progress))


def fitted(
    layers: nn.Module,
    loss: Callable[[jax.Array, Truth], jax.Array],
    batch: Callable[[], tuple[NDArray[np.float32], Truth]],
    training: Training,
    seed: int,
    progress: Progress,
) -> optax.Params:
    """The parameters of layers after a training.

    Parameters
    ----------
    layers
        Of the network.
    loss
        What is to become small, of the network's answer and the truth.
    batch
        Gives pictures, shape (n, 300, 96, 3), and the truth about them, arrays or a tree of them.
    training, seed, progress
        As `train` has them.
    """
    optimiser = optax.adam(optax.cosine_decay_schedule(training.rate, training.steps))
    parameters = layers.init(jax.random.PRNGKey(seed), jnp.zeros((1, *SIZE_PX[::-1], 3)))
    state = optimiser.init(parameters)

    @jax.jit
    def step(
        parameters: optax.Params, state: optax.OptState, x: jax.Array, truth: Truth
    ) -> tuple[optax.Params, optax.OptState]:
        gradient = jax.grad(lambda parameters: loss(layers.apply(parameters, x), truth))(parameters)
        update, state = optimiser.update(gradient, state, parameters)
        return optax.apply_updates(parameters, update), state

    for number in range(training.steps):
        if number % _TOLD_STEPS == 0:
            progress("train", number, training.steps)
        parameters, state = step(parameters, state, *batch())
    progress("train", training.steps, training.steps)
    return parameters


def focal_loss(logits: jax.Array, heat: jax.Array, weight: jax.Array | float = 1.0) -> jax.Array:
    """CenterNet's focal loss for each point of maps of them, of any shape; `weight` is that of each cell."""
    confidence = nn.sigmoid(logits)
    at_point = heat == 1
    gained = (1 - confidence) ** 2 * nn.log_sigmoid(logits)
    spared = (1 - heat) ** 4 * confidence**2 * nn.log_sigmoid(-logits)
    return -(weight * jnp.where(at_point, gained, spared)).sum() / (at_point.sum() + 1.0)


@partial(jax.jit, static_argnums=0)
def _answer(layers: nn.Module, parameters: optax.Params, pixels: jax.Array) -> jax.Array:
    return layers.apply(parameters, pixels.astype(jnp.float32) / 255)

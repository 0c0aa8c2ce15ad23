"""A small network that finds the entry corners of slots in strips: a map with a peak where a corner is.

Eight convolutions, which go down to an eighth of the picture and up to a quarter, learn by the focal loss of CenterNet
(arXiv 1904.07850). Needs jax, flax and optax, see ``real_requirements.txt``.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import jax
import jax.numpy as jnp
import numpy as np
import optax
from average_precision import Detections
from corner_maps import peaks
from flax import linen as nn
from strip_changes import changed
from strips import Strip

from garage2usd.common.progress import Progress, silent

__all__ = ["CornerNetwork", "Training", "train"]

_FIRST_LOGIT = -3.0
"""Of all cells before anything is learnt: corners are few."""
_AT_ONCE = 32
_TOLD_STEPS = 250


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
        x = _norm(x)
        x = _block(x, 16, strides=2)
        x = _block(x, 32, strides=2)
        fine = _block(x, 48)
        x = _block(fine, 64, strides=2)
        x = _block(x, 64, dilation=2)
        x = _block(x, 48, dilation=4)
        x = _block(fine + jax.image.resize(x, fine.shape, "nearest"), 48)
        return nn.Conv(1, (1, 1), bias_init=nn.initializers.constant(_FIRST_LOGIT))(x)[..., 0]


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
        found = []
        for first in range(0, len(strips), _AT_ONCE):
            some = np.stack([strip.pixels for strip in strips[first : first + _AT_ONCE]])
            filled = np.concatenate([some, np.zeros((_AT_ONCE - len(some), *some.shape[1:]), some.dtype)])
            found += [peaks(heat) for heat in np.asarray(_confidence(self.parameters, filled))[: len(some)]]
        return found


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
    optimiser = optax.adam(optax.cosine_decay_schedule(training.rate, training.steps))
    parameters = _Layers().init(jax.random.PRNGKey(seed), jnp.zeros((1, *pixels.shape[1:])))
    state = optimiser.init(parameters)

    @jax.jit
    def step(
        parameters: optax.Params, state: optax.OptState, x: jax.Array, y: jax.Array
    ) -> tuple[optax.Params, optax.OptState]:
        gradient = jax.grad(_loss)(parameters, x, y)
        update, state = optimiser.update(gradient, state, parameters)
        return optax.apply_updates(parameters, update), state

    for number in range(training.steps):
        if number % _TOLD_STEPS == 0:
            progress("train", number, training.steps)
        chosen = random.integers(len(pixels), size=training.batch)
        parameters, state = step(
            parameters, state, *changed(pixels[chosen], [strips[each].seen_px for each in chosen], random)
        )
    progress("train", training.steps, training.steps)
    return CornerNetwork(parameters)


def _loss(parameters: optax.Params, x: jax.Array, y: jax.Array) -> jax.Array:
    """CenterNet's focal loss for each corner."""
    logits = _Layers().apply(parameters, x)
    confidence = nn.sigmoid(logits)
    at_corner = y == 1
    gained = (1 - confidence) ** 2 * nn.log_sigmoid(logits)
    spared = (1 - y) ** 4 * confidence**2 * nn.log_sigmoid(-logits)
    return -jnp.where(at_corner, gained, spared).sum() / (at_corner.sum() + 1.0)


@jax.jit
def _confidence(parameters: optax.Params, pixels: jax.Array) -> jax.Array:
    return nn.sigmoid(_Layers().apply(parameters, pixels.astype(jnp.float32) / 255))

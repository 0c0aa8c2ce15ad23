"""Lamps in the places of tube lights: form, colour temperature, dead lamps and emergency lighting."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.randomness import Step, named_generator
from garage2usd.config.look import LampKind, LightsLook
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.placement import Placement, of_spec
from garage2usd.objects.lamp import LampSpec

__all__ = ["TUBE", "installed_lamps", "ramp_lamps"]

TUBE = LampSpec(length_m=1.5, width_m=0.12)
"""Tube light without a luminance; the places of lamps are independent of their form."""
_FORMS = {
    LampKind.TUBES: TUBE,
    LampKind.PANELS: LampSpec(length_m=0.595, width_m=0.595, drop_m=0.064, form=LampKind.PANELS),
    LampKind.ROUND: LampSpec(length_m=0.4, width_m=0.4, drop_m=0.105, form=LampKind.ROUND),
}
_EMERGENCY_OF = 8
"""One lamp in this many has a battery."""
_STEPS = (-1.463, -0.599, 0.0, 0.599, 1.463)
"""Medians of the quintiles of a normal distribution, scaled to a standard deviation of 1."""
_LEAST_K = 1700.0
_DEAD, _TEMPERATURE = range(2)


def installed_lamps(
    tubes: Sequence[Placement], lights: LightsLook, draws: SquareDraws, *, seed: int
) -> tuple[Placement, ...]:
    """Replace the tube lights over squares by the lamps of the look.

    Parameters
    ----------
    tubes
        Tube lights in reading order, those of a square in sequence.
    lights
        Form, colour and share of dead lamps.
    draws
        Random numbers of each square. Lamps in equal places of squares with equal numbers are equal, except for the
        emergency lighting.
    seed
        Seed of the garage.
    """
    numbers = draws.of_part(Step.LOOK, "lights.lamps", 1 + max(map(_index_on_square, tubes), default=0), 2)
    rows = [numbers[tube.square][_index_on_square(tube)] for tube in tubes if tube.square is not None]
    return _lamps(tubes, lights, np.array(rows).reshape(-1, 2), named_generator(seed, Step.LOOK, "lights.emergency"))


def ramp_lamps(
    tubes: Sequence[Placement], lights: LightsLook, luminance_nit: float, *, seed: int
) -> tuple[Placement, ...]:
    """Give the tube lights over ramps the luminance of those over squares; return none if that is 0."""
    if not luminance_nit:
        return ()
    generator = named_generator(seed, Step.LOOK, "lights.ramps")
    numbers = generator.random((len(tubes), 2))
    return tuple(
        lamp if spec.is_dead else replace(lamp, spec=replace(spec, luminance_nit=luminance_nit))
        for lamp, spec in of_spec(_lamps(tubes, lights, numbers, generator), LampSpec)
    )


def _lamps(
    tubes: Iterable[Placement], lights: LightsLook, numbers: NDArray[np.float64], emergency: np.random.Generator
) -> tuple[Placement, ...]:
    """Return the lamps by two random numbers each: dead or not, and colour temperature."""
    is_dead = numbers[:, _DEAD] < lights.dead_share
    if lights.emergency_only:
        is_dead |= ~_with_battery(len(numbers), emergency)
    step = (numbers[:, _TEMPERATURE] * len(_STEPS)).astype(int)
    kelvin = np.maximum(np.round(lights.temperature_k + lights.spread_k * np.array(_STEPS)[step]), _LEAST_K)
    if not lights.spread_k:
        kelvin = np.full(len(numbers), lights.temperature_k)
    usual = _FORMS[lights.lamps]
    return tuple(
        replace(tube, spec=replace(usual, temperature_k=temperature_k, is_dead=dead))
        for tube, temperature_k, dead in zip(tubes, kelvin.tolist(), is_dead.tolist(), strict=True)
    )


def _with_battery(count: int, generator: np.random.Generator) -> NDArray[np.bool_]:
    """Choose one random lamp of every eight consecutive ones for battery supply; bool, shape (count,)."""
    starts = np.arange(0, count, _EMERGENCY_OF)
    chosen = np.zeros(count, dtype=bool)
    chosen[starts + generator.integers(np.minimum(_EMERGENCY_OF, count - starts))] = True
    return chosen


def _index_on_square(tube: Placement) -> int:
    """Return the index of a lamp on its square, from 0."""
    return int(tube.name.rpartition("_")[2]) - 1

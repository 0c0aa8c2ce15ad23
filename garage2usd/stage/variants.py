"""Variant sets of a garage: parked cars, lights, and what hangs overhead."""

from collections.abc import Mapping
from typing import NamedTuple

from garage2usd.objects import KINDS
from garage2usd.objects.kind import VariantSet

__all__ = [
    "BLOCKED_BY",
    "OCCUPIED",
    "OCCUPIED_STALL",
    "POWER_SET",
    "SWITCHES",
    "Switch",
    "VariantTexts",
    "occupied_text",
    "variant_texts",
]

POWER_SET = "power"
"""Variant set of every light's asset: ``on`` or ``off``."""
OCCUPIED = "garage:stall:occupied"
"""Attribute of a stall: whether a car stands in it."""
BLOCKED_BY = "garage:stall:blockedBy"
"""Attribute of a stall: id of the stall of the misparked car that blocks it."""
OCCUPIED_STALL = "OccupiedStall"
"""Name of the class of all stalls that a car stands in as long as cars are shown."""


class Switch(NamedTuple):
    """What a variant set of the garage does to objects.

    Attributes
    ----------
    variant_set
        Its name.
    usual, other
        Its choices; the first is how a garage is without a choice.
    metadata, attribute
        What the second choice says of each object, as USDA text.
    class_name
        Name of the class of all objects that follow it.
    """

    variant_set: str
    usual: str
    other: str
    metadata: str
    attribute: str
    class_name: str


_SWITCHES = {
    VariantSet.OCCUPANCY: Switch("occupancy", "parked", "empty", "active = false\n", "", "Car"),
    VariantSet.LIGHTS: Switch("lights", "on", "off", f'variants = {{\nstring {POWER_SET} = "off"\n}}\n', "", "Light"),
    VariantSet.CEILING: Switch("ceiling", "shown", "hidden", "", 'token visibility = "invisible"\n', "Overhead"),
}
SWITCHES: Mapping[str, Switch] = {
    kind.name: switch for variant_set, switch in _SWITCHES.items() for kind in KINDS if kind.follows is variant_set
}
"""Which variant set each kind of object follows; the others follow none."""


class VariantTexts(NamedTuple):
    """USDA text of the variant sets of one prim: what stands in its metadata and in its body."""

    metadata: str
    body: str


def variant_texts(
    classes: str, *, outlines: tuple[str, ...], stalls: int, are_blocked: bool, selected: bool
) -> VariantTexts:
    """The variant sets ``occupancy`` (parked, empty), ``lights`` (on, off) and ``ceiling`` (shown, hidden).

    Parameters
    ----------
    classes
        Name of the child that holds the class of each.
    outlines
        Names of the prims from the child on that lead to the outlines of all stalls, and how many these are.
    are_blocked
        Whether some stalls are blocked, which they are not without cars.
    selected
        Whether the first choice of each is selected. It says nothing of the objects, so that none is the same; but
        each prim below takes longer to compose, which of tens of thousands is a fifth of the time to open them.
    """
    switches = _SWITCHES.values()
    bodies = []
    for switch in switches:
        usual, other, beside = "", _over(switch.class_name, switch.metadata, switch.attribute), ""
        if switch.variant_set == VariantSet.OCCUPANCY:
            usual = _over(classes, "", _over(OCCUPIED_STALL, "", occupied_text(is_occupied=True)))
            other += _over(OCCUPIED_STALL, "", occupied_text(is_occupied=False))
            beside = f"custom int[] {OCCUPIED} = [{', '.join('0' * stalls)}]\n"
            beside += f"custom token[] {BLOCKED_BY} = []\n" if are_blocked else ""
            for name in reversed(outlines):
                beside = _over(name, "", beside)
        choices = f'"{switch.usual}" {{\n{usual}}}\n"{switch.other}" {{\n{_over(classes, "", other)}{beside}}}\n'
        bodies.append(f'variantSet "{switch.variant_set}" = {{\n{choices}}}\n')
    names = ", ".join(f'"{switch.variant_set}"' for switch in switches)
    metadata = f"prepend variantSets = [{names}]\n"
    if selected:
        selections = "".join(f'string {switch.variant_set} = "{switch.usual}"\n' for switch in switches)
        metadata = f"variants = {{\n{selections}}}\n{metadata}"
    return VariantTexts(metadata, "".join(bodies))


def occupied_text(*, is_occupied: bool) -> str:
    """Whether a car stands in a stall, as an attribute of its prim."""
    return f"custom bool {OCCUPIED} = {str(is_occupied).lower()}\n"


def _over(name: str, metadata: str, body: str) -> str:
    return f'over "{name}" (\n{metadata})\n{{\n{body}}}\n'

"""Rules of swept paths: the design car drives into each stall and out of it without a collision."""

from collections.abc import Iterator
from weakref import WeakKeyDictionary

from garage2usd.as_built.driven_ground import CAR_HEIGHT_M, driven_garage, rounded
from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks import aisle, clearance, feasibility, stall
from garage2usd.checks.rule import Miss, RuleBook
from garage2usd.common.progress import Progress, silent
from garage2usd.driving import DesignCar, Limits, StallProof, prove_garage
from garage2usd.garage import Stall, StallUse
from garage2usd.profiles import Length, Profile, Severity

BOOK = RuleBook()
_Proofs = tuple[tuple[Stall, StallProof], ...]
_PROVEN: WeakKeyDictionary[BuiltLevel, tuple[Profile, _Proofs]] = WeakKeyDictionary()
"""Cache of each garage's last swept-path proofs, which two rules share."""
_NAMED = 3
_EXPLAINED = 10
"""Number of stalls without a path for which a single cause is sought, at one or two seconds each."""


@BOOK.rule("swept-path", asks="the design car drives into each stall and out again while all others are taken")
def _swept(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    """Yield stalls without a collision-free path, apart from stalls and objects that other rules report."""
    for at, proof in prove(level, profile):
        if not (proof.is_proven or proof.is_undecided):
            required = None if proof.clearance_m is None else Limits().margin_m
            yield Miss(proof.stall, rounded(at.centre), _message(proof), proof.clearance_m, required)


@BOOK.rule(
    "swept-path-undecided",
    asks="the search for the ways of each stall ends with ways, or because there are none",
    severity=Severity.WARNING,
)
def _undecided(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    for at, proof in prove(level, profile):
        if not proof.is_proven and proof.is_undecided:
            yield Miss(proof.stall, rounded(at.centre), _message(proof))


@BOOK.rule("motorcycle-path", asks="ways into stalls for motorcycles are proven", severity=Severity.INFO)
def _motorcycles(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    """Yield one finding that names the stalls for motorcycles: no design motorcycle exists to prove them with."""
    found = [stall for stall in level.stalls if stall.use is StallUse.MOTORCYCLE]
    if found:
        named = ", ".join(stall.name for stall in found[:_NAMED]) + (", ..." if len(found) > _NAMED else "")
        message = f"no way is proven into the {len(found)} stalls for motorcycles, as no motorcycle is driven: {named}"
        yield Miss(found[0].name, rounded(found[0].centre), message)


def prove(level: BuiltLevel, profile: Profile, progress: Progress = silent) -> _Proofs:
    """Return the swept-path proofs of the stalls that no other rule reports; the last ones of each level are kept."""
    of_profile, proofs = _PROVEN.get(level, (None, ()))
    if of_profile is not profile:
        proofs = _proven(level, profile, progress)
        _PROVEN[level] = profile, proofs
    return proofs


def _proven(level: BuiltLevel, profile: Profile, progress: Progress) -> _Proofs:
    lanes = level.lanes
    has_way = lanes.joined_portals("entrance") and lanes.joined_portals("exit")
    if not (has_way and level.has_whole_graph and level.things):
        return ()
    faults = _reported(level, profile)
    places = {fault.place for fault in faults}
    missed = {node for edge in lanes.edges if lanes.edge_name(edge) in places for node in (edge.start, edge.end)}
    height_m = _amount(profile.design_car_height, CAR_HEIGHT_M)
    things = {name for fault in faults for name in fault.things}
    driven = driven_garage(level, height_m=height_m, left_out=things)
    asked = [at for at in driven.stalls if at.name not in places and at.access not in missed]
    car = design_car(profile)
    proofs = prove_garage(
        driven, asked, car=car, with_all_taken_only=True, most_explained=_EXPLAINED, progress=progress
    )
    return tuple(zip(asked, proofs, strict=True))


def design_car(profile: Profile) -> DesignCar:
    """Return the design car of a profile, with its axles in proportion to those of the default car.

    Raises
    ------
    ConfigError
        If no car of that size has so small a turning circle.
    """
    usual = DesignCar()
    length_m, width_m = profile.car_length_m, profile.car_width_m
    return DesignCar(
        length_m=length_m,
        width_m=width_m,
        wheelbase_m=usual.wheelbase_m * (length_m / usual.length_m),
        rear_overhang_m=usual.rear_overhang_m * (length_m / usual.length_m),
        track_m=usual.track_m * (width_m / usual.width_m),
        turning_radius_m=_amount(profile.turning_radius, usual.turning_radius_m),
    )


def _reported(level: BuiltLevel, profile: Profile) -> list[Miss]:
    """Return the errors that the rules of stalls, aisles, clearances and routes report."""
    faults = []
    for rule in (rule for module in (stall, aisle, clearance, feasibility) for rule in module.BOOK.rules):
        if rule.applies(profile) and rule.severity_in(profile, level) is Severity.ERROR:
            faults += rule.find(level, profile)
    return faults


def _message(proof: StallProof) -> str:
    if not (proof.touched or proof.is_undecided):
        return "no lane beside the stall is driven to from an entrance and on to an exit without turning round"
    named = ", ".join(proof.touched[:_NAMED]) or "nothing"
    how = "in the way" if proof.is_single_cause else "it touches"
    if proof.is_undecided:
        return f"the search for ways ended at its bound, while all other stalls are taken; {how}: {named}"
    return f"a car does not get into the stall and out again while all others are taken; {how}: {named}"


def _amount(clause: Length | None, usual: float) -> float:
    return usual if clause is None else clause.amount

"""Shapes of every kind of object, by a name for each case."""

import string
from dataclasses import replace
from functools import cache

from garage2usd.assets.lettering import OWN_FONT
from garage2usd.assets.poses import POSES
from garage2usd.config.look import ColumnSection, Dirt, Guard
from garage2usd.config.vehicles import CAR_BODIES, DRIVEN_BODIES, PAINTS, VehicleClass
from garage2usd.garage.path_line import PathLine
from garage2usd.garage.ramp_lines import CoilLine
from garage2usd.objects.bag import BagSort, BagSpec
from garage2usd.objects.barrier import BarrierSpec
from garage2usd.objects.beam import BeamNodeSpec, BeamSpec
from garage2usd.objects.bicycle import BicycleSpec
from garage2usd.objects.cable_tray import CableTraySpec
from garage2usd.objects.car import CarSpec, OpenCarSpec, car_spec
from garage2usd.objects.cardboard_box import BoxSpec
from garage2usd.objects.ceiling import CeilingSpec, OpenCeilingSpec
from garage2usd.objects.charger import ChargerSpec
from garage2usd.objects.coil import CoilSpec, CrossingSpec
from garage2usd.objects.column import Board, ColumnSpec
from garage2usd.objects.cone import ConeSpec
from garage2usd.objects.drain import DrainSpec
from garage2usd.objects.duct import DuctSpec
from garage2usd.objects.exit_sign import ExitSignSpec, Turn
from garage2usd.objects.fire_extinguisher import FireExtinguisherSpec
from garage2usd.objects.fire_shutter import FireShutterSpec
from garage2usd.objects.flight import FlightSpec
from garage2usd.objects.floor import FloorSpec
from garage2usd.objects.floor_stain import DirtSpec, PuddleSpec, StainMark, StainSpec, TyreMarkSpec
from garage2usd.objects.hydrant_cabinet import HydrantCabinetSpec
from garage2usd.objects.lamp import LampSpec
from garage2usd.objects.lane_sign import LaneSignSpec, LaneSignText
from garage2usd.objects.level_plate import LevelPlateSpec
from garage2usd.objects.level_sign import Heading, LevelSignSpec
from garage2usd.objects.mirror import MirrorSpec
from garage2usd.objects.motorbike import MotorbikeSpec
from garage2usd.objects.no_parking_sign import NoParkingSignSpec
from garage2usd.objects.number_plate import NumberPlateSpec, OpenPlateSpec, OwnPlateSpec
from garage2usd.objects.obstacle import ObstacleSpec
from garage2usd.objects.pallet import PalletSpec
from garage2usd.objects.panel import Marking, Paint, Surface
from garage2usd.objects.path_ramp import PathRampSpec
from garage2usd.objects.person import PEOPLE, PersonSpec
from garage2usd.objects.portal import PortalSpec
from garage2usd.objects.pram import PramSpec
from garage2usd.objects.ramp import RampSpec
from garage2usd.objects.sky import SkySpec
from garage2usd.objects.speed_bump import SpeedBumpSpec
from garage2usd.objects.sprinkler import SprinklerSpec
from garage2usd.objects.stall import StallSpec
from garage2usd.objects.stall_number import (
    FontNumberSpec,
    NumberFrameSpec,
    NumberSpec,
    WallFontNumberSpec,
    WallNumberSpec,
)
from garage2usd.objects.trolley import TrolleySpec
from garage2usd.objects.wall import WallPostSpec, WallSpec
from garage2usd.objects.waste_bin import BIN_COLOURS, BinSpec
from garage2usd.objects.wheel_stop import WheelStopSpec
from garage2usd.objects.zone_plate import ColumnPlatesSpec, ZonePlateSpec
from support.foreign_cars import own_car
from support.soak import soak_but

MARKINGS = (
    Marking(((-4.05, -1.0), (-4.05, -0.88), (4.05, -0.88), (4.05, -1.0)), Surface.PAINT_YELLOW, Paint.LANE_LINE),
    Marking(((0.0, 0.0), (1.0, 1.0), (0.2, 2.0)), Surface.PAINT_WHITE, Paint.HATCHING),
    Marking(((0.2, 2.0), (1.0, 1.0), (2.0, 2.0)), Surface.PAINT_WHITE, Paint.HATCHING),
)
OPENING = ((-3.0, -3.25), (-3.0, -2.0), (-1.0, -2.0), (-1.0, -3.25))
PATH = PathLine(((0.0, 0.0), (26.0, 0.0)), 3.3)
COIL = CoilLine(4.05, 4.05, 8.8, 4.2)
RISE = ((0.3, 0.0), (0.8, 0.0), (4.4, 0.27), (24.1, 3.23), (27.7, 3.5), (30.2, 3.5))

ROUND, RECTANGULAR = ColumnSection.ROUND, ColumnSection.RECTANGULAR
CABINET = Board(0, -0.28, 0.3, 0.85, 1.71)

SPECS = {
    "floor": FloorSpec(8.1, 6.5, Surface.LANE, MARKINGS, (OPENING,)),
    "stall": StallSpec(2.5, 5.3, Surface.STALL),
    "wall": WallSpec(8.1, 3.2, 0.3),
    "wall_dado": WallSpec(8.1, 3.2, 0.3, dado_m=0.7, has_stripe=False),
    "wall_plain": WallSpec(8.1, 3.2, 0.3, dado_m=0.0, has_stripe=False),
    "post": WallPostSpec(0.3, 3.2),
    "entrance": PortalSpec(8.1, 3.2, 0.3, door_width_m=6.0, door_height_m=2.6, is_entrance=True),
    "exit": PortalSpec(5.4, 3.0, 0.3, door_width_m=4.2, door_height_m=2.4, is_entrance=False),
    "open_door": PortalSpec(8.1, 3.2, 0.3, door_width_m=6.0, door_height_m=2.6, is_entrance=True, is_open=True),
    "ramp": RampSpec(
        width_m=6.2,
        wall_m=0.3,
        threshold_width_m=5.84,
        profile=RISE,
        cover_end_m=9.3,
        cover_height_m=3.2,
        wall_top_m=4.8,
    ),
    "flight": FlightSpec(
        6.0, ((0.0, 0.0), (0.3, 0.0), (3.9, 0.27), (24.3, 3.33), (27.9, 3.6), (28.2, 3.6)), slab_m=0.25
    ),
    "coil": CoilSpec(COIL, COIL.profile(3.6, 3.6, foot_first=True), 1, 0.25, 0.2, 3.35, 7.2),
    "top_coil": CoilSpec(COIL, COIL.profile(3.6, 3.6, foot_first=False), -1, 0.25, 0.2, 6.8, 6.8),
    "path_ramp": PathRampSpec(
        PATH,
        ((0.0, 0.0), (5.0, 0.5), (PATH.length_m - 5.0, 3.1), (PATH.length_m, 3.6)),
        1,
        0.25,
        0.2,
        6.8,
        6.8,
        open_m=0.0,
        ceiling_m=6.8,
        walls=(True, True),
        has_head_wall=True,
    ),
    "coil_crossing": CrossingSpec(6.45, 6.45, 0.25),
    "ramp_plain": RampSpec(6.2, 0.3, 5.84, RISE, 9.3, 3.2, 4.8, dado_m=0.0, has_stripe=False),
    "sky": SkySpec(width_m=6.8, start_m=9.3, end_m=30.21, ground_m=3.45, low_m=4.8, high_m=7.8),
    "raised_barrier": BarrierSpec(arm_m=6.1, is_raised=True, elbow_m=2.75),
    "closed_barrier": BarrierSpec(arm_m=6.1, is_raised=False, elbow_m=2.75),
    "obstacle": ObstacleSpec(8.1, 5.4, 3.2),
    "block": ObstacleSpec(8.1, 5.4, 3.2, has_door=False),
    "obstacle_dado": ObstacleSpec(8.1, 5.4, 3.2, dado_m=1.6),
    "block_plain": ObstacleSpec(8.1, 5.4, 3.2, has_door=False, dado_m=0.0),
    "column": ColumnSpec(0.6, 3.2),
    **{f"column_{guard}": ColumnSpec(0.6, 3.2, guard=guard, guard_height_m=0.8) for guard in Guard},
    "column_all_guard": ColumnSpec(0.6, 2.2, guard=Guard.RED_WHITE, guard_height_m=2.0, head_m=0.4),
    "column_round": ColumnSpec(0.6, 3.2, ROUND, guard=Guard.BLUE_YELLOW, head_m=0.4, boards=(CABINET,)),
    "column_round_bare": ColumnSpec(0.45, 3.2, ROUND, guard=Guard.NONE),
    "column_round_rubber": ColumnSpec(0.6, 3.2, ROUND, guard=Guard.RUBBER, guard_height_m=1.0),
    "column_rectangular": ColumnSpec(0.6, 3.2, RECTANGULAR, head_m=0.4, boards=(CABINET._replace(side=3),)),
    "column_rectangular_rubber": ColumnSpec(0.6, 3.2, RECTANGULAR, is_long_along_x=True, guard=Guard.RUBBER),
    "ceiling": CeilingSpec(8.1, 8.1, 0.25),
    "ceiling_of_a_lower_level": CeilingSpec(8.1, 8.1, 0.4, bears_floor=True),
    "ceiling_with_an_opening": OpenCeilingSpec(8.1, 8.1, 0.4, openings=(((-1.0, -2.0), (3.0, -2.0), (3.0, 2.0)),)),
    "tube": LampSpec(1.5, 0.12, drop_m=0.115, luminance_nit=4000.0),
    "beam": BeamSpec(7.5, 0.4, 0.4),
    "node": BeamNodeSpec(((-0.3, -0.2, 0.3, 0.2), (-0.2, 0.2, 0.2, 0.3)), 0.4),
    "duct": DuctSpec(8.1, 0.8, 0.35, hanger_m=0.15, hangers_at_m=(-3.0, 3.0)),
    "branch": DuctSpec(0.65, 0.8, 0.35, hanger_m=0.15, hangers_at_m=(0.1,)),
    "round_duct": DuctSpec(8.1, 0.8, 0.3, hanger_m=0.15, hangers_at_m=(-3.0, 3.0), is_round=True),
    "round_branch": DuctSpec(0.65, 0.8, 0.3, hanger_m=0.15, hangers_at_m=(0.1,), is_round=True, joint=-1),
    "tray": CableTraySpec(8.1, 0.3, 0.06, 0.5, rods_at_m=(-2.0, 2.0)),
    "cone": ConeSpec(),
    "bump": SpeedBumpSpec(7.2),
    "stop": WheelStopSpec(1.65),
    "stops": WheelStopSpec(1.65, gap_m=0.65),
    "sign": NoParkingSignSpec(),
    "sprinkler": SprinklerSpec(8.1, 0.03, 0.075, rods_at_m=(-2.0, 1.0), heads_at_m=(-2.0, 2.0)),
    "pipe": SprinklerSpec(0.7, 0.03, 0.075, rods_at_m=(0.1,), heads_at_m=()),
    **{f"level_sign_{heading}": LevelSignSpec("U2", heading, 0.58, 0.4) for heading in (*Heading, None)},
    "level_sign_way_out": LevelSignSpec("U1", Heading.UP, 0.58, 0.4, is_way_out=True),
    "fire_shutter": FireShutterSpec(6.0, 3.2, 2.78, 0.3),
    "level_plate": LevelPlateSpec("U2"),
    **{f"lane_sign_{text}": LaneSignSpec(text, 0.58, 0.4) for text in LaneSignText},
    **{f"exit_sign_{turn}": ExitSignSpec(turn, 0.58, 0.2) for turn in Turn},
    "mirror": MirrorSpec(0.25, arm_m=0.12),
    "charger": ChargerSpec(),
    "hydrant_cabinet": HydrantCabinetSpec(),
    "fire_extinguisher": FireExtinguisherSpec(),
    "oil": StainSpec(StainMark.OIL, 2, 0.9, 0.7),
    "wear": StainSpec(StainMark.WEAR_T, 0, 8.1, 6.5),
    "seam": StainSpec(StainMark.SEAM, 3, 1.0, 4.0),
    "repair": StainSpec(StainMark.REPAIR, 1, 1.1, 2.2),
    **{f"dirt_{dirt}": DirtSpec(StainMark.WEAR_STRAIGHT, 1, 8.1, 6.5, dirt) for dirt in (Dirt.FAINT, Dirt.FILTHY)},
    **{f"puddle_{variant}": PuddleSpec(variant, 2.2, 1.4) for variant in range(12)},
    "gully": DrainSpec(0.3, 0.3),
    "channel": DrainSpec(0.15, 8.1),
    **{f"tyres_{turn}": TyreMarkSpec(1, 4.6, turn) for turn in (-1.2, 0.0, 1.2)},
    **{f"number_{digits}": NumberSpec(digits, 0.45) for digits in [*"0123456789", "07", "88", "A1", "-"]},
    "number_frame": NumberFrameSpec(1.2, 0.7),
    "wall_number": WallNumberSpec("07", 0.3),
    "lettered_number": NumberSpec("Жg", 0.45),
    "font_number": FontNumberSpec("Ä2", 0.45, OWN_FONT),
    "wall_font_number": WallFontNumberSpec("07", 0.3, OWN_FONT),
    **{
        f"plate_{text}": ZonePlateSpec(text, 0.528)
        for text in [*(f"{letter}1" for letter in string.ascii_uppercase if letter not in "IO"), "B7", "K12"]
    },
    "column_plates": ColumnPlatesSpec(("A1", "B1", "", "K12"), 0.6),
    "column_plates_bent": ColumnPlatesSpec(("A1", "B1", "", "K12"), 0.6, (0.3,) * 4, is_round=True),
    "column_plates_near": ColumnPlatesSpec(("A1", "B1", "", "K12"), 0.6, (0.3, 0.21, 0.3, 0.21)),
    "number_plate": NumberPlateSpec("saloon", "K47 M92"),
    "own_car": car_spec(own_car(), PAINTS[0]),
    "own_van": car_spec(replace(own_car(), semantic_class=VehicleClass.VAN), PAINTS[0]),
    "own_truck": car_spec(replace(own_car(), semantic_class=VehicleClass.TRUCK), PAINTS[0]),
    "own_plate": OwnPlateSpec(own_car().name, "K47 M92", car=own_car().measures),
    **{f"bin_{colour}": BinSpec(colour) for colour in BIN_COLOURS},
    "bicycle": BicycleSpec("red"),
    "motorbike": MotorbikeSpec("blue"),
    "scooter": MotorbikeSpec("white", is_scooter=True),
    **{f"trolleys_{count}": TrolleySpec(count) for count in (1, 3)},
    "pram": PramSpec("grey"),
    **{f"bag_{sort}": BagSpec(sort) for sort in BagSort},
    **{f"person_{number}": PersonSpec(number) for number in range(len(PEOPLE))},
    **{f"person_{pose}": PersonSpec(number, pose) for number, pose in enumerate(POSES, start=4) if pose != "standing"},
    "box": BoxSpec(0.6, 0.33, 0.4),
    **{f"pallets_{count}": PalletSpec(count) for count in (1, 5)},
    "pallets_upright": PalletSpec(2, is_upright=True),
    **{f"car_{body.name}": CarSpec(body.name, PAINTS[0]) for body in CAR_BODIES},
    **{
        f"open_{body}": OpenCarSpec(body, PAINTS[0])
        for body in ("hatchback", "saloon", "suv", "fastback", "roadster", "off_roader", "estate")
    },
    "open_steered": OpenCarSpec("coupe", PAINTS[0], -20.0, is_dusty=True, is_lit=True),
    "open_plate": OpenPlateSpec("saloon", "K47 M92"),
    "steered_left": CarSpec("saloon", PAINTS[0], 20.0),
    "steered_right": CarSpec("full_size_pickup", PAINTS[0], -20.0),
    "lit": CarSpec("small_suv", PAINTS[0], is_lit=True),
    "dusty": CarSpec("small_suv", PAINTS[0], is_dusty=True),
}
"""One shape at least of each class of `garage2usd.objects.Spec`."""

_WIDE = {f"car_{body.name}" for body in CAR_BODIES if body not in DRIVEN_BODIES} - {"car_roadster"}
"""Cases of bodies for `make soak`: six that drive and one with a soft top have all parts that bodies have."""
KEPT = [case for case in SPECS if case not in _WIDE]
CASES = soak_but(KEPT, SPECS)
"""The names of all cases for ``parametrize``."""


@cache
def asset_of_case(case):
    """The meshes of a case, made once in a process, not those that are made ahead."""
    return SPECS[case].asset()

"""Gymnasium environments: ``garage2usd/Lanes-v0`` plans lanes, ``garage2usd/Parking-v0`` drives a car into a stall.

Importing this package registers both. It requires the extra ``gymnasium``.
``gymnasium.make("garage2usd.environment:garage2usd/Parking-v0", source=...)`` imports the package itself.
"""

from garage2usd.common.package import of_extra

with of_extra("garage2usd.environment"):
    import gymnasium

from garage2usd.environment.garage_tasks import GarageTasks
from garage2usd.environment.lanes import LanesEnvironment
from garage2usd.environment.parking import ParkingEnvironment, ParkingVectorEnvironment
from garage2usd.environment.published_scenes import dragon_lake_tasks, parkbench_tasks, tpcap_tasks
from garage2usd.environment.reference import reference_actions, reference_path, searched_way
from garage2usd.environment.task import ParkingTask

__all__ = [
    "ENVIRONMENT_ID",
    "PARKING_ID",
    "GarageTasks",
    "LanesEnvironment",
    "ParkingEnvironment",
    "ParkingTask",
    "ParkingVectorEnvironment",
    "dragon_lake_tasks",
    "parkbench_tasks",
    "reference_actions",
    "reference_path",
    "searched_way",
    "tpcap_tasks",
]

ENVIRONMENT_ID, PARKING_ID = "garage2usd/Lanes-v0", "garage2usd/Parking-v0"

if ENVIRONMENT_ID not in gymnasium.registry:
    gymnasium.register(ENVIRONMENT_ID, entry_point="garage2usd.environment:LanesEnvironment")
    gymnasium.register(
        PARKING_ID,
        entry_point="garage2usd.environment:ParkingEnvironment",
        vector_entry_point="garage2usd.environment:ParkingVectorEnvironment",
    )

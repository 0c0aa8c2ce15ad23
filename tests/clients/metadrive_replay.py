"""Run by a test with the Python of MetaDrive: check a scenario, replay it, and write down where its agents are.

Arguments: the scenario, whose name begins with ``sd_`` and which is alone in its folder; steps; the JSON file to write.
Nothing is drawn, so that MetaDrive's models and pictures, which it downloads when it begins, are not needed.
"""

import json
import pickle
import sys
from pathlib import Path

import numpy as np
from metadrive.engine.base_engine import BaseEngine
from metadrive.envs.scenario_env import ScenarioEnv
from metadrive.policy.replay_policy import ReplayEgoCarPolicy
from metadrive.scenario import ScenarioDescription

source, steps, output = Path(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3])
scenario = pickle.loads(source.read_bytes())  # noqa: S301 - our own
ScenarioDescription.sanity_check(scenario, check_self_type=True, valid_check=True)
summary = ScenarioDescription.get_number_summary(ScenarioDescription(scenario))
BaseEngine.try_pull_asset = staticmethod(lambda: None)
sensors = {name: {"num_lasers": 0, "distance": 0} for name in ("lidar", "side_detector", "lane_line_detector")}
env = ScenarioEnv(
    {
        "data_directory": str(source.parent),
        "num_scenarios": 1,
        "agent_policy": ReplayEgoCarPolicy,
        "force_reuse_object_name": True,
        "vehicle_config": sensors,
        "log_level": 40,
    }
)
env.reset(seed=0)
origin = env.engine.data_manager.current_scenario["metadata"].get("old_origin_in_current_coordinate", np.zeros(2))
lanes = [len(block.block_network.graph) for block in env.engine.current_map.blocks]
rows = []
for _ in range(steps):
    env.step([0, 0])
    found = {
        name: [*(np.asarray(one.position)[:2] - origin), one.heading_theta]
        for name, one in env.engine.get_objects().items()
    }
    sdc = env.agent
    found[scenario["metadata"]["sdc_id"]] = [*(np.asarray(sdc.position)[:2] - origin), sdc.heading_theta]
    rows.append({name: [float(value) for value in row] for name, row in found.items()})
env.close()
types = {
    key: {str(name): int(count) for name, count in value.items()}
    for key, value in summary.items()
    if isinstance(value, dict)
}
output.write_text(json.dumps({"rows": rows, "lanes": lanes, "types": types}))

"""Launch files of ROS 2, run with stand-ins for its packages."""

import runpy
import sys
from types import ModuleType, SimpleNamespace

_MEMBERS = {
    "ament_index_python": {},
    "ament_index_python.packages": {"get_package_share_directory": lambda name: f"/opt/ros/share/{name}"},
    "launch": {"LaunchDescription": list},
    "launch.actions": {
        "DeclareLaunchArgument": lambda name, default_value: (name, default_value),
        "ExecuteProcess": dict,
        "IncludeLaunchDescription": lambda source, launch_arguments: {"source": source, **dict(launch_arguments)},
        "OpaqueFunction": lambda function: function,
    },
    "launch.conditions": {"IfCondition": lambda value: value},
    "launch.launch_description_sources": {"PythonLaunchDescriptionSource": str},
    "launch.substitutions": {"LaunchConfiguration": lambda name: f"${name}"},
    "launch_ros": {},
    "launch_ros.actions": {"Node": dict},
}


def launched(path):
    """Arguments of a launch file with their defaults, and its actions."""
    modules = {}
    for name, members in _MEMBERS.items():
        modules[name] = ModuleType(name)
        modules[name].__dict__.update(members)
    kept = {name: sys.modules.get(name) for name in modules}
    sys.modules.update(modules)
    try:
        actions = runpy.run_path(str(path))["generate_launch_description"]()
    finally:
        for name, module in kept.items():
            sys.modules.pop(name)
            if module is not None:
                sys.modules[name] = module
    arguments = dict(action for action in actions if isinstance(action, tuple))
    return arguments, [action for action in actions if not isinstance(action, tuple)]


def run(function, arguments, **given):
    """What an opaque function starts with arguments."""
    return function(SimpleNamespace(launch_configurations=arguments | given))

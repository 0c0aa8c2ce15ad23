"""Run by a test in a process of its own: import a layer of traffic into Blender, and write down the soles of people."""

import sys

import bpy
import numpy as np


def agent_of(item):
    """The name of the agent that an object is a part of: its ancestor below the scope of agents."""
    while item.parent and item.parent.name.partition(".")[0] != "Traffic":
        item = item.parent
    return item.name


def main(stage, output, spans):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=stage, import_visible_only=False)
    shoes = {agent_of(item): item for item in bpy.data.objects if item.name.partition(".")[0] == "Shoes"}
    found = {name: [] for name in spans}
    last = max(end for _, end in spans.values())
    for frame in range(min(start for start, _ in spans.values()), last + 1):
        own = [name for name, (start, end) in spans.items() if start <= frame <= end]
        if not own:
            continue
        bpy.context.scene.frame_set(frame)
        graph = bpy.context.evaluated_depsgraph_get()
        for name in own:
            item = shoes[name].evaluated_get(graph)
            mesh = item.to_mesh()
            points = np.empty(3 * len(mesh.vertices), np.float32)
            mesh.vertices.foreach_get("co", points)
            world = np.array(item.matrix_world)
            moved = points.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
            # Blender's Z-up world as the Y-up stage
            found[name].append(np.stack([moved[:, 0], moved[:, 2], -moved[:, 1]], axis=1))
            item.to_mesh_clear()
    np.savez(output, **{name: np.array(points) for name, points in found.items()})


if __name__ == "__main__":
    arguments = sys.argv[3:]
    people = zip(arguments[::3], arguments[1::3], arguments[2::3], strict=True)
    main(sys.argv[1], sys.argv[2], {name: (int(start), int(end)) for name, start, end in people})

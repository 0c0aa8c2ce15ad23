"""Run by tests in a process of its own: load stages' colliders into newton and say what they are and where.

Takes the path of a stage a line, and answers with JSON in a line. Newton's schemas must be registered before anything
else reads a stage.
"""

import json
import os
import sys

answers = os.fdopen(os.dup(sys.stdout.fileno()), "w")
os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # where newton greets

import newton  # noqa: E402 - it greets as it is imported


def colliders(stage):
    builder = newton.ModelBuilder(up_axis=newton.Axis.Y)
    builder.add_usd(stage, load_visual_shapes=False, load_static_visual_shapes=False)
    shapes = []
    for index, label in enumerate(builder.shape_label):
        entry = {
            "path": label,
            "type": newton.GeoType(builder.shape_type[index]).name,
            "place": [float(value) for value in builder.shape_transform[index]][:3],
            "size": [2 * float(value) for value in builder.shape_scale[index]],
            "collides": bool(builder.shape_flags[index] & newton.ShapeFlags.COLLIDE_SHAPES),
        }
        source = builder.shape_source[index]
        if source is not None:
            entry["scale"] = [float(value) for value in builder.shape_scale[index]]
            entry["low"], entry["high"] = source.vertices.min(axis=0).tolist(), source.vertices.max(axis=0).tolist()
        shapes.append(entry)
    masses_kg = dict(zip(builder.body_label, map(float, builder.body_mass), strict=True))
    return {"version": newton.__version__, "bodies": builder.body_count, "masses_kg": masses_kg, "shapes": shapes}


for line in sys.stdin:
    json.dump(colliders(line.rstrip("\n")), answers)
    print(file=answers, flush=True)

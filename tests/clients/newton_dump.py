"""Run by a test in a process of its own: load a stage's colliders into newton and write down what they are and where.

Newton's schemas must be registered before anything else reads a stage.
"""

import json
import sys

import newton


def main(stage, output):
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
    with open(output, "w") as file:
        json.dump({"version": newton.__version__, "bodies": builder.body_count, "shapes": shapes}, file)


main(sys.argv[-2], sys.argv[-1])

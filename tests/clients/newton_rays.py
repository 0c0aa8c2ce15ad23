"""Run by tests in a process of its own: cast rays at the colliders that newton finds below a prim of a stage.

``python newton_rays.py STAGE PRIM RAYS.npz DISTANCES.npy``; the rays are ``origins`` and unit ``directions``, both of
shape (n, 3), and the distances infinite where a ray meets nothing.
"""

import sys

import newton
import numpy as np
import trimesh
import warp as wp

FAR_M = 1000.0


@wp.kernel
def cast(
    mesh: wp.uint64,
    origins: wp.array(dtype=wp.vec3),
    directions: wp.array(dtype=wp.vec3),
    far: wp.array(dtype=float),
):
    ray = wp.tid()
    hit = wp.mesh_query_ray(mesh, origins[ray], directions[ray], FAR_M)
    if hit.result:
        far[ray] = wp.min(far[ray], hit.t)


def main(stage, prim, rays, output):
    wp.set_device("cpu")
    builder = newton.ModelBuilder(up_axis=newton.Axis.Y)
    builder.add_usd(stage, root_path=prim, load_visual_shapes=False, load_static_visual_shapes=False)
    given = np.load(rays)
    origins, directions = (
        wp.array(given[name].astype(np.float32), dtype=wp.vec3) for name in ("origins", "directions")
    )
    far = wp.array(np.full(len(given["origins"]), np.inf, dtype=np.float32), dtype=float)
    for index in range(builder.shape_count):
        kind = newton.GeoType(builder.shape_type[index])
        if kind == newton.GeoType.BOX:
            box = trimesh.creation.box(2 * np.array(builder.shape_scale[index]))
            vertices, indices = box.vertices, box.faces.ravel()
        else:
            assert kind == newton.GeoType.MESH, builder.shape_label[index]
            vertices, indices = builder.shape_source[index].vertices, builder.shape_source[index].indices
        turn = wp.transform(*builder.shape_transform[index])
        points = np.array([wp.transform_point(turn, wp.vec3(*point)) for point in vertices.tolist()])
        mesh = wp.Mesh(wp.array(points.astype(np.float32), dtype=wp.vec3), wp.array(indices, dtype=int))
        wp.launch(cast, dim=len(given["origins"]), inputs=[mesh.id, origins, directions, far])
    np.save(output, far.numpy())


if __name__ == "__main__":
    main(*sys.argv[1:])

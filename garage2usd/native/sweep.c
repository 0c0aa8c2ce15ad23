/* Whether a rectangle that drives a short arc or straight keeps off convex shapes: never optimistic.
 *
 * The ground swept between two poses lies within the convex hull of the two footprints, but for how far an arc bulges
 * over its chord. The distance between that hull and a convex shape is at least the gap between them along any axis;
 * the axes tried are the normals of the shape's edges, of both footprints' edges and of the ways of the four corners.
 * What bulges is taken off the gap. So the clearance is a lower bound, and what is said to be clear is clear. */
#include "driving.h"

#define SHORTEST 1e-9

/* Write the four corners of the footprint of a pose; `body` is nose, tail and half the width. */
void corners_at(double x, double z, double yaw, const double *body, Spot *corners)
{
    double sine = sin(yaw), cosine = cos(yaw);
    for (int corner = 0; corner < CORNERS; corner++) {
        double ahead = corner < 2 ? body[0] : -body[1];
        double left = corner == 0 || corner == 3 ? body[2] : -body[2];
        corners[corner].x = x - sine * ahead - cosine * left;
        corners[corner].z = z - cosine * ahead + sine * left;
    }
}

/* What lies within reach of any of the corners of two footprints. */
Box box_around(const Spot *corners, double reach)
{
    Box box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (int corner = 0; corner < BOTH; corner++) {
        box.left = lesser(box.left, corners[corner].x);
        box.right = greater(box.right, corners[corner].x);
        box.low = lesser(box.low, corners[corner].z);
        box.high = greater(box.high, corners[corner].z);
    }
    return (Box){box.left - reach, box.low - reach, box.right + reach, box.high + reach};
}

/* How far the way of any point of the body lies off its chord, at most, on an arc of the rear axle's middle. */
double bulge(double radius, double turn, const double *body)
{
    double reach = hypot(radius + body[2], greater(body[0], body[1]));
    return reach * (1.0 - cos(turn / 2));
}

/* Least and most of some corners along an axis. */
static void extent(const Spot *corners, int64_t count, Spot axis, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (int64_t corner = 0; corner < count; corner++) {
        double along = corners[corner].x * axis.x + corners[corner].z * axis.z;
        *low = lesser(*low, along);
        *high = greater(*high, along);
    }
}

/* From one corner to another. */
static Spot between(const Spot *corners, int64_t one, int64_t other)
{
    return (Spot){corners[one].x - corners[other].x, corners[one].z - corners[other].z};
}

/* Least distance, or less, between the hull of two footprints and a convex shape.
 *
 * `corners` are those of both footprints, in the same order. Those of the shape are in order, the last perhaps repeated.
 * Where a gap is as wide as `enough`, no wider one is looked for. */
double clearance(const Spot *corners, const Scene *scene, int64_t number, double enough)
{
    int64_t count = scene->shapes.rows;
    const Spot *shape = (const Spot *)scene->shapes.at + number * count;
    double widest = -INFINITY;
    for (int64_t side = 0; side < 8 + count; side++) {
        Spot axis;
        if (side < 2) /* the edges of the first footprint */
            axis = between(corners, side, side + 1);
        else if (side < 4) /* of the second */
            axis = between(corners, side + 2, side + 3);
        else if (side < 4 + count)
            axis = between(shape, side - 4, (side - 3) % count);
        else
            axis = between(corners, side - 4 - count, side - count);
        double length = hypot(axis.x, axis.z);
        if (length < SHORTEST)
            continue;
        axis = (Spot){-axis.z / length, axis.x / length};
        double low, high, shape_low, shape_high;
        extent(corners, BOTH, axis, &low, &high);
        extent(shape, count, axis, &shape_low, &shape_high);
        widest = greater(greater(widest, shape_low - high), low - shape_high);
        if (widest >= enough)
            break;
    }
    return widest;
}

/* Mark the shapes that a car that stands comes nearer to than a margin; `pose` is x, z and yaw. */
FROM_PYTHON
void mark_touched(const Scene *scene, const double *pose, double margin, bool *is_touched)
{
    Spot corners[BOTH];
    corners_at(pose[0], pose[1], pose[2], scene->body.at, corners);
    corners_at(pose[0], pose[1], pose[2], scene->body.at, corners + CORNERS);
    for (int64_t number = 0; number < scene->shapes.layers; number++)
        is_touched[number] = clearance(corners, scene, number, margin) < margin;
}

/* Least distance, or less, to any shape along poses (x, z, yaw); `most` where all is farther. */
FROM_PYTHON
double least_along(const Scene *scene, const double *poses, int64_t steps, const double *bulges, double most)
{
    Spot corners[BOTH];
    double least = most;
    for (int64_t step = 0; step < steps; step++) {
        for (int end = 0; end < 2; end++) {
            const double *pose = poses + (step + end) * 3;
            corners_at(pose[0], pose[1], pose[2], scene->body.at, corners + CORNERS * end);
        }
        double reach = least + bulges[step];
        Box box = box_around(corners, reach);
        for (int64_t number = 0; number < scene->shapes.layers; number++)
            if (!is_beyond(scene, number, &box))
                least = lesser(least, clearance(corners, scene, number, reach) - bulges[step]);
    }
    return least;
}

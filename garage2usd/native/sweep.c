/* Whether a rectangle that drives a short arc or straight keeps off convex shapes: never optimistic.
 *
 * The ground swept between two poses lies within the convex hull of the two footprints, but for how far an arc bulges
 * over its chord. The distance between that hull and a convex shape is at least the gap between them along any axis;
 * the axes tried are the normals of the shape's edges, of both footprints' edges and of the ways of the four corners.
 * What bulges is taken off the gap. So the clearance is a lower bound, and what is said to be clear is clear. */
#include "driving.h"

#define SHORTEST 1e-9

/* Write the four corners of the footprint of a pose, from corner `first` of a hull on; `body` is nose, tail and half
 * the width. */
void put_footprint(Hull *hull, int64_t first, double x, double z, Heading heading, const double *body)
{
    for (int corner = 0; corner < CORNERS; corner++) {
        double ahead = corner < 2 ? body[0] : -body[1];
        double left = corner == 0 || corner == 3 ? body[2] : -body[2];
        hull->corners[first + corner].x = x - heading.sine * ahead - heading.cosine * left;
        hull->corners[first + corner].z = z - heading.cosine * ahead + heading.sine * left;
    }
    hull->known = 0;
}

/* What lies within reach of any of the corners of a hull. */
Box box_around(const Hull *hull, double reach)
{
    Box box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (int corner = 0; corner < BOTH; corner++) {
        box.left = lesser(box.left, hull->corners[corner].x);
        box.right = greater(box.right, hull->corners[corner].x);
        box.low = lesser(box.low, hull->corners[corner].z);
        box.high = greater(box.high, hull->corners[corner].z);
    }
    return (Box){box.left - reach, box.low - reach, box.right + reach, box.high + reach};
}

/* How far the way of any point of the body lies off its chord, at most, on an arc of the rear axle's middle. */
double bulge(double radius, double turn, const double *body)
{
    double reach = same_hypot(radius + body[2], greater(body[0], body[1]));
    return reach * (1.0 - same_cos(turn / 2));
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

/* The axis across an edge, if that has a length. */
static Axis across(const Hull *hull, Spot edge)
{
    Axis axis = {.has_length = false};
    double length = same_hypot(edge.x, edge.z);
    if (length < SHORTEST)
        return axis;
    axis.has_length = true;
    axis.along = (Spot){-edge.z / length, edge.x / length};
    extent(hull->corners, BOTH, axis.along, &axis.low, &axis.high);
    return axis;
}

/* One of the axes across the edges of a hull: two of the first footprint's, two of the second's, the corners' ways. */
static const Axis *own_axis(Hull *hull, int64_t number)
{
    for (; hull->known <= number; hull->known++) {
        int64_t side = hull->known;
        int64_t corner = side < 2 ? side : side < 4 ? side + 2 : side - 4;
        hull->axes[side] = across(hull, between(hull->corners, corner, side < 4 ? corner + 1 : corner + CORNERS));
    }
    return &hull->axes[number];
}

/* Least distance, or less, between the hull of two footprints and a convex shape.
 *
 * The footprints' corners are in the same order. Those of the shape are in order, the last perhaps repeated. Where a
 * gap is as wide as `enough`, no wider one is looked for. */
double clearance(Hull *hull, const Scene *scene, int64_t number, double enough)
{
    int64_t count = scene->shapes.rows;
    const Spot *shape = (const Spot *)scene->shapes.at + number * count;
    double widest = -INFINITY;
    for (int64_t side = 0; side < 8 + count; side++) {
        Axis axis;
        if (side < 4)
            axis = *own_axis(hull, side);
        else if (side < 4 + count)
            axis = across(hull, between(shape, side - 4, (side - 3) % count));
        else
            axis = *own_axis(hull, side - count);
        if (!axis.has_length)
            continue;
        double low, high;
        extent(shape, count, axis.along, &low, &high);
        widest = greater(greater(widest, low - axis.high), axis.low - high);
        if (widest >= enough)
            break;
    }
    return widest;
}

/* Mark the shapes that a car that stands comes nearer to than a margin; `pose` is x, z and yaw. */
FROM_PYTHON
void mark_touched(const Scene *scene, const double *pose, double margin, bool *is_touched)
{
    Hull hull;
    Heading heading = heading_of(pose[2]);
    put_footprint(&hull, 0, pose[0], pose[1], heading, scene->body.at);
    put_footprint(&hull, CORNERS, pose[0], pose[1], heading, scene->body.at);
    for (int64_t number = 0; number < scene->shapes.layers; number++)
        is_touched[number] = clearance(&hull, scene, number, margin) < margin;
}

/* Least distance, or less, to any shape along poses (x, z, yaw); `most` where all is farther. */
FROM_PYTHON
double least_along(const Scene *scene, const double *poses, int64_t steps, const double *bulges, double most)
{
    Hull hull;
    double least = most;
    for (int64_t step = 0; step < steps; step++) {
        for (int end = 0; end < 2; end++) {
            const double *pose = poses + (step + end) * 3;
            put_footprint(&hull, CORNERS * end, pose[0], pose[1], heading_of(pose[2]), scene->body.at);
        }
        double reach = least + bulges[step];
        Box box = box_around(&hull, reach);
        for (int64_t number = 0; number < scene->shapes.layers; number++)
            if (!is_beyond(scene, number, &box))
                least = lesser(least, clearance(&hull, scene, number, reach) - bulges[step]);
    }
    return least;
}

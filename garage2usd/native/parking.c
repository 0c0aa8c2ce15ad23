/* Cars that learn to park, many at once and each in its own scene: motion, contact, LiDAR and occupancy. */
#include "driving.h"

#define CLEAR_M 1e-12
#define FLAT 1e-9

static const double PI = 3.141592653589793;

/* garage2usd.environment.simulation.Lot */
typedef struct {
    DoubleTable poses;
    DoubleTable bodies;
    DoubleCube pieces;
    DoubleCube boxes;
    Int64Row counts;
    DoubleTable goals;
    DoubleCube moving;
    DoubleTable sizes;
    Int64Row ticks;
} Lot;

/* Corners of the rectangle of an agent at a time; false while it is absent, as after the last tick. */
static bool agent_at(const Lot *lot, int64_t car, int64_t agent, int64_t tick, Spot *corners)
{
    const double *pose = lot->moving.at + (car * lot->moving.rows + tick) * lot->moving.columns + agent * 3;
    if (tick >= lot->moving.rows || isnan(pose[0]))
        return false;
    double length = IN(lot->sizes, car, agent * 2) / 2, width = IN(lot->sizes, car, agent * 2 + 1) / 2;
    double body[3] = {length, length, width};
    Hull hull;
    put_footprint(&hull, 0, pose[0], pose[1], heading_of(pose[2]), body);
    for (int corner = 0; corner < CORNERS; corner++)
        corners[corner] = hull.corners[corner];
    return true;
}

/* Number of the pieces and agents around a car; corners of one of them, false while it is absent. */
static int64_t count_around(const Lot *lot, int64_t car) { return AT(lot->counts, car) + lot->sizes.columns / 2; }

static bool quad_around(const Lot *lot, int64_t car, int64_t number, Spot *corners)
{
    int64_t count = AT(lot->counts, car);
    if (number >= count)
        return agent_at(lot, car, number - count, AT(lot->ticks, car), corners);
    const Spot *quad = (const Spot *)(lot->pieces.at + (car * lot->pieces.rows + number) * lot->pieces.columns);
    for (int corner = 0; corner < CORNERS; corner++)
        corners[corner] = quad[corner];
    return true;
}

static bool is_touching(const Lot *lot, int64_t car, const double *pose, int64_t tick)
{
    Hull hull;
    Heading heading = heading_of(pose[2]);
    const double *body = &IN(lot->bodies, car, 0);
    put_footprint(&hull, 0, pose[0], pose[1], heading, body);
    put_footprint(&hull, CORNERS, pose[0], pose[1], heading, body);
    Box box = box_around(&hull, 0.0);
    int64_t rows = lot->pieces.rows;
    Scene scene = {{lot->pieces.at + car * rows * 8, rows, CORNERS, 2}, {lot->boxes.at + car * rows * 4, rows, 4},
                   {lot->bodies.at + car * 3, 3}};
    for (int64_t number = 0; number < AT(lot->counts, car); number++)
        if (!is_beyond(&scene, number, &box) && clearance(&hull, &scene, number, CLEAR_M) < CLEAR_M)
            return true;
    Spot corners[CORNERS];
    Scene agent = {{&corners[0].x, 1, CORNERS, 2}, {lot->boxes.at, 0, 4}, {lot->bodies.at + car * 3, 3}};
    for (int64_t number = 0; number < lot->sizes.columns / 2; number++)
        if (agent_at(lot, car, number, tick, corners) && clearance(&hull, &agent, 0, CLEAR_M) < CLEAR_M)
            return true;
    return false;
}

/* Mark the cars that touch something where they are. */
FROM_PYTHON
void mark_touching(const Lot *lot, bool *is_crashed)
{
    for (int64_t car = 0; car < lot->poses.rows; car++)
        is_crashed[car] = is_touching(lot, car, &IN(lot->poses, car, 0), AT(lot->ticks, car));
}

/* Drive cars for some ticks by a constant acceleration and curvature each, on exact arcs; a car that touches something
 * stays there. `orders` has both of each car, `most` is the greatest speed. */
FROM_PYTHON
void drive_cars(const Lot *lot, const double *orders, const bool *is_driven, double tick_s, int64_t ticks, double most,
                bool *is_crashed)
{
    for (int64_t car = 0; car < lot->poses.rows; car++) {
        is_crashed[car] = false;
        if (!is_driven[car])
            continue;
        double *pose = &IN(lot->poses, car, 0), acceleration = orders[car * 2], curvature = orders[car * 2 + 1];
        for (int64_t tick = 0; tick < ticks && !is_crashed[car]; tick++) {
            double speed = lesser(greater(pose[3] + acceleration * tick_s, -most), most);
            double length = (pose[3] + speed) / 2 * tick_s, half = length * curvature / 2;
            /* the chord of an arc is shorter by sin(half) / half */
            double chord = fabs(half) < 1e-4 ? length * (1.0 - half * half / 6) : length * same_sin(half) / half;
            Heading way = heading_of(pose[2] + half);
            pose[0] -= way.sine * chord;
            pose[1] -= way.cosine * chord;
            pose[2] += 2 * half;
            pose[3] = speed;
            AT(lot->ticks, car)++;
            is_crashed[car] = is_touching(lot, car, pose, AT(lot->ticks, car));
        }
    }
}

/* Corners in the frame of a car's middle, ahead and to the left. */
static void put_into_frame(const Lot *lot, int64_t car, Spot *corners)
{
    const double *pose = &IN(lot->poses, car, 0), *body = &IN(lot->bodies, car, 0);
    Heading heading = heading_of(pose[2]);
    double middle = (body[0] - body[1]) / 2;
    for (int corner = 0; corner < CORNERS; corner++) {
        double x = corners[corner].x - pose[0], z = corners[corner].z - pose[1];
        corners[corner].x = -heading.sine * x - heading.cosine * z - middle;
        corners[corner].z = -heading.cosine * x + heading.sine * z;
    }
}

/* The ray from the origin at a direction to the edges of a quad, if nearer than `nearest`. */
static double hit_at(const Spot *corners, Spot ray, double nearest)
{
    double along[CORNERS], aside[CORNERS];
    for (int corner = 0; corner < CORNERS; corner++) {
        along[corner] = ray.x * corners[corner].x + ray.z * corners[corner].z;
        aside[corner] = ray.x * corners[corner].z - ray.z * corners[corner].x;
    }
    for (int one = 0; one < CORNERS; one++) {
        int other = (one + 1) % CORNERS;
        if ((aside[one] > 0 && aside[other] > 0) || (aside[one] < 0 && aside[other] < 0))
            continue;
        double apart = aside[other] - aside[one];
        double far = fabs(apart) < FLAT ? lesser(along[one], along[other])
                                        : (along[one] * aside[other] - along[other] * aside[one]) / apart;
        if (far >= 0 && far < nearest)
            nearest = far;
    }
    return nearest;
}

/* Distances from the middle of each car to edges along rays: the first ahead, the others to the left of it in turn. */
FROM_PYTHON
void scan_around(const Lot *lot, int64_t rays, double range, double *ranges)
{
    double turn = 2 * PI / (double)rays;
    for (int64_t car = 0; car < lot->poses.rows; car++) {
        double *own = ranges + car * rays;
        for (int64_t ray = 0; ray < rays; ray++)
            own[ray] = range;
        for (int64_t number = 0; number < count_around(lot, car); number++) {
            Spot quad[CORNERS];
            if (!quad_around(lot, car, number, quad))
                continue;
            put_into_frame(lot, car, quad);
            Box box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
            for (int corner = 0; corner < CORNERS; corner++) {
                box.left = lesser(box.left, quad[corner].x), box.right = greater(box.right, quad[corner].x);
                box.low = lesser(box.low, quad[corner].z), box.high = greater(box.high, quad[corner].z);
            }
            if (box.left > range || box.right < -range || box.low > range || box.high < -range)
                continue;
            /* only rays between the quad's corners, and one more at either side, can hit it */
            double first = same_atan2(quad[0].z, quad[0].x), low = 0.0, high = 0.0;
            for (int corner = 1; corner < CORNERS; corner++) {
                double turned = same_atan2(quad[0].x * quad[corner].z - quad[0].z * quad[corner].x,
                                           quad[0].x * quad[corner].x + quad[0].z * quad[corner].z);
                low = lesser(low, turned), high = greater(high, turned);
            }
            int64_t from = (int64_t)floor((first + low) / turn) - 1, to = (int64_t)ceil((first + high) / turn) + 1;
            if (high - low > PI - 1e-6 || to - from >= rays)
                from = 0, to = rays - 1;
            for (int64_t at = from; at <= to; at++) {
                int64_t ray = ((at % rays) + rays) % rays;
                Heading way = heading_of(turn * (double)ray);
                own[ray] = hit_at(quad, (Spot){way.cosine, way.sine}, own[ray]);
            }
        }
    }
}

/* Mark the cells that a quad meets. Corners are in cells, down and to the right of the grid's front left corner. */
static void fill(const Spot *corners, int64_t side, int8_t *cells)
{
    Spot low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY}, normals[CORNERS];
    double least[CORNERS], most[CORNERS];
    for (int one = 0; one < CORNERS; one++) {
        const Spot *a = &corners[one], *b = &corners[(one + 1) % CORNERS];
        low = (Spot){lesser(low.x, a->x), lesser(low.z, a->z)};
        high = (Spot){greater(high.x, a->x), greater(high.z, a->z)};
        normals[one] = (Spot){b->z - a->z, a->x - b->x};
        double reach = (fabs(normals[one].x) + fabs(normals[one].z)) / 2;
        least[one] = INFINITY, most[one] = -INFINITY;
        for (int corner = 0; corner < CORNERS; corner++) {
            double along = corners[corner].x * normals[one].x + corners[corner].z * normals[one].z;
            least[one] = lesser(least[one], along - reach), most[one] = greater(most[one], along + reach);
        }
    }
    int64_t top = (int64_t)greater(floor(low.x), 0.0), bottom = (int64_t)lesser(floor(high.x), (double)side - 1);
    int64_t left = (int64_t)greater(floor(low.z), 0.0), right = (int64_t)lesser(floor(high.z), (double)side - 1);
    for (int64_t row = top; row <= bottom; row++)
        for (int64_t column = left; column <= right; column++) {
            bool meets = true;
            for (int one = 0; one < CORNERS && meets; one++) {
                double along = ((double)row + 0.5) * normals[one].x + ((double)column + 0.5) * normals[one].z;
                meets = along >= least[one] && along <= most[one];
            }
            if (meets)
                cells[row * side + column] = -1;
        }
}

/* Fill two square grids around each car, ahead up: of obstacles, and of the goal. All cells must be 0. */
FROM_PYTHON
void fill_around(const Lot *lot, int64_t side, double cell, int8_t *cells)
{
    for (int64_t car = 0; car < lot->poses.rows; car++) {
        int64_t count = count_around(lot, car);
        for (int64_t number = 0; number <= count; number++) {
            Spot quad[CORNERS];
            bool is_goal = number == count;
            if (is_goal)
                for (int corner = 0; corner < CORNERS; corner++)
                    quad[corner] = ((const Spot *)&IN(lot->goals, car, 0))[corner];
            else if (!quad_around(lot, car, number, quad))
                continue;
            put_into_frame(lot, car, quad);
            for (int corner = 0; corner < CORNERS; corner++)
                quad[corner] = (Spot){(double)side / 2 - quad[corner].x / cell, (double)side / 2 - quad[corner].z / cell};
            fill(quad, side, cells + (car * 2 + is_goal) * side * side);
        }
    }
}

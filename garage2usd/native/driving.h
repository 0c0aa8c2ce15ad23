/* What the compiled search for ways takes from Python, and the geometry of a car that drives short steps. */
#ifndef GARAGE2USD_DRIVING_H
#define GARAGE2USD_DRIVING_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "elementary.h"

/* A point of the floor. */
typedef struct { double x, z; } Spot;

/* A rectangle along the axes: least x and z, and most x and z. */
typedef struct { double left, low, right, high; } Box;

/* A turn about the vertical axis with its sine and cosine. */
typedef struct { double yaw, sine, cosine; } Heading;

/* The middle of a rear axle on the floor, and the heading. */
typedef struct { double x, z, yaw; } Pose;

/* A way of Reeds and Shepp: the steering of each piece (1 to the left, -1, 0) and its metres, negative in reverse. */
enum { MOST_PIECES = 5, MOST_WORDS = 64 };
typedef struct {
    int64_t count;
    int8_t steering[MOST_PIECES];
    double length[MOST_PIECES];
} Word;

/* Squares of the floor from least x and z on, as many one way as the other, with their side, and how far each is from a
 * goal: -1 where it is shut, INFINITY where no way leads. */
typedef struct {
    double *far;
    int64_t side;
    double left, low, square;
} Guide;

/* An axis, and how far a hull goes along it. */
typedef struct {
    bool has_length;
    Spot along;
    double low, high;
} Axis;

/* Corners of a car's footprints: of one pose, and of a step from one pose to another. */
enum { CORNERS = 4, BOTH = 8 };

/* The hull of two footprints: its corners, and the axes across its edges, as many of them as were asked for. */
typedef struct {
    Spot corners[BOTH];
    int64_t known;
    Axis axes[8];
} Hull;

/* garage2usd.driving.obstacles.Scene */
typedef struct {
    DoubleCube shapes;
    DoubleTable boxes;
    DoubleRow body;
} Scene;

static inline double lesser(double one, double other) { return other < one ? other : one; }
static inline double greater(double one, double other) { return other > one ? other : one; }

static inline Heading heading_of(double yaw)
{
    Heading heading = {.yaw = yaw};
    same_sin_cos(yaw, &heading.sine, &heading.cosine);
    return heading;
}

/* sweep.c */
void put_footprint(Hull *hull, int64_t first, double x, double z, Heading heading, const double *body);
Box box_around(const Hull *hull, double reach);
FROM_PYTHON
double bulge(double radius, double turn, const double *body);
double clearance(Hull *hull, const Scene *scene, int64_t number, double enough);

/* reeds_shepp.c */
int64_t reeds_shepp(Pose from, Pose to, double radius, Word *words);

/* guide.c */
bool make_guide(Guide *guide, const Scene *scene, Pose start, const DoubleTable *goals, double reach, double margin);
double guided_way(const Guide *guide, double x, double z);

/* Whether a shape's box is out of another. */
static inline bool is_beyond(const Scene *scene, int64_t number, const Box *box)
{
    const double *own = scene->boxes.at + number * 4;
    return own[0] > box->right || own[2] < box->left || own[1] > box->high || own[3] < box->low;
}

#endif

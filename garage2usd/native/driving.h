/* What the compiled search for ways takes from Python, and the geometry of a car that drives short steps. */
#ifndef GARAGE2USD_DRIVING_H
#define GARAGE2USD_DRIVING_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "arrays.h"

/* A point of the floor. */
typedef struct { double x, z; } Spot;

/* A rectangle along the axes: least x and z, and most x and z. */
typedef struct { double left, low, right, high; } Box;

/* Corners of a car's footprints: of one pose, and of a step from one pose to another. */
enum { CORNERS = 4, BOTH = 8 };

/* garage2usd.driving.sweep.Scene */
typedef struct {
    DoubleCube shapes;
    DoubleTable boxes;
    DoubleRow body;
} Scene;

static inline double lesser(double one, double other) { return other < one ? other : one; }
static inline double greater(double one, double other) { return other > one ? other : one; }

/* sweep.c */
void corners_at(double x, double z, double yaw, const double *body, Spot *corners);
Box box_around(const Spot *corners, double reach);
FROM_PYTHON
double bulge(double radius, double turn, const double *body);
double clearance(const Spot *corners, const Scene *scene, int64_t number, double enough);

/* Whether a shape's box is out of another. */
static inline bool is_beyond(const Scene *scene, int64_t number, const Box *box)
{
    const double *own = scene->boxes.at + number * 4;
    return own[0] > box->right || own[2] < box->left || own[1] > box->high || own[3] < box->low;
}

#endif

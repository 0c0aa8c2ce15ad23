/* Smooth turns: a clothoid, an arc at full lock or none, and the clothoid back, for the search of roots in
 * garage2usd.driving.turns. */
#include "elementary.h"

/* Limits of turns, and nodes and weights of Gauss's quadrature from -1 to 1, in turn. */
typedef struct {
    double curvature, sharpness;
    const double *nodes;
    int64_t count;
} Limits;

/* A displacement, or a direction, as a complex number. */
typedef struct { double re, im; } Complex;

static Complex product(Complex one, Complex other)
{
    return (Complex){one.re * other.re - one.im * other.im, one.re * other.im + one.im * other.re};
}

static Complex direction(double angle)
{
    Complex unit;
    same_sin_cos(angle, &unit.im, &unit.re);
    return unit;
}

/* Displacement of a turn from the origin, heading along the real axis; it is symmetric, so half of it is integrated. */
static Complex chord(double deflection, const Limits *limits)
{
    double size = fabs(deflection), peak = sqrt(size * limits->sharpness);
    double half_turn = 0;
    if (peak >= limits->curvature) {
        peak = limits->curvature;
        half_turn = size - peak * peak / limits->sharpness;
        half_turn = half_turn > 0 ? half_turn / 2 : 0;
    }
    if (peak == 0)
        return (Complex){0, 0};
    double half_way = peak / limits->sharpness / 2, eased = peak * peak / limits->sharpness / 2;
    Complex first_half = {0, 0};
    for (int64_t at = 0; at < limits->count; at++) {
        double way = half_way * (1 + limits->nodes[2 * at]), weight = half_way * limits->nodes[2 * at + 1];
        Complex heading = direction(limits->sharpness / 2 * (way * way));
        first_half.re += weight * heading.re;
        first_half.im += weight * heading.im;
    }
    double arc = 2 * same_sin(half_turn / 2) / peak;
    Complex onto = direction(eased + half_turn / 2), along = direction(deflection / 2);
    first_half.re += arc * onto.re;
    first_half.im += arc * onto.im;
    /* twice the projection of the first half, which bends to the left, onto the chord */
    double length = 2 * (first_half.re * along.re + first_half.im * fabs(along.im));
    return (Complex){length * along.re, length * along.im};
}

/* Write the straight between two turns, in its heading's frame: two numbers, the second 0 if the path reaches the end.
 * `x` and `y` lead from start to end in the frame of the start. */
FROM_PYTHON
void write_straight(double curvature, double sharpness, const double *nodes, int64_t count, double x, double y,
                    double first, double turned, double *straight)
{
    Limits limits = {curvature, sharpness, nodes, count};
    Complex one = chord(first, &limits), other = chord(turned - first, &limits);
    Complex ahead = product((Complex){x - one.re, y - one.im}, direction(-first));
    straight[0] = ahead.re - other.re;
    straight[1] = ahead.im - other.im;
}

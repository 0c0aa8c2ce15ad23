/* Smooth turns: a clothoid, an arc at full lock or none, and the clothoid back, for the search of roots in
 * garage2usd.driving.turns, and the points of paths. */
#include "driving.h"

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

/* Columns of the samples of a first turn: its angle, its displacement, the direction back from its end, and the
 * displacement of the second turn. */
enum { ANGLE, FIRST, ONTO = 3, LAST = 5, COLUMNS = 7 };
enum { MOST_TRIES = 200 };

/* Write the first turns of paths to (x, y), each with the straight after it; returns their number. Between two samples
 * whose misses differ in sign lies a root, found by false position (the Illinois algorithm). */
FROM_PYTHON
int64_t write_roots(double curvature, double sharpness, const double *nodes, int64_t count, double x, double y,
                    double turned, const double *samples, int64_t rows, double same, double *roots)
{
    int64_t found = 0;
    double before = 0;
    for (int64_t at = 0; at < rows; at++) {
        const double *row = samples + at * COLUMNS;
        Complex ahead = product((Complex){x - row[FIRST], y - row[FIRST + 1]}, (Complex){row[ONTO], row[ONTO + 1]});
        double miss = ahead.im - row[LAST + 1];
        if (fabs(miss) < same) {
            roots[2 * found] = row[ANGLE];
            roots[2 * found++ + 1] = ahead.re - row[LAST];
            miss = 0; /* no root between this sample and the next */
        } else if (before * miss < 0) {
            double low = row[ANGLE - COLUMNS], high = row[ANGLE], root = high, last = low, here[2] = {0, 0};
            /* NumPy's sums in the samples differ in the last bits from processor to processor */
            write_straight(curvature, sharpness, nodes, count, x, y, low, turned, here);
            double low_miss = here[1];
            write_straight(curvature, sharpness, nodes, count, x, y, high, turned, here);
            double high_miss = here[1];
            int side = 0;
            for (int tries = 0; tries < MOST_TRIES && fabs(root - last) > 1e-14; tries++) {
                last = root;
                root = (low * high_miss - high * low_miss) / (high_miss - low_miss);
                write_straight(curvature, sharpness, nodes, count, x, y, root, turned, here);
                if (here[1] == 0)
                    break;
                if (here[1] * high_miss > 0) {
                    high = root;
                    high_miss = here[1];
                    low_miss = side > 0 ? low_miss / 2 : low_miss;
                    side = 1;
                } else {
                    low = root;
                    low_miss = here[1];
                    high_miss = side < 0 ? high_miss / 2 : high_miss;
                    side = -1;
                }
            }
            roots[2 * found] = root;
            roots[2 * found++ + 1] = here[0];
        }
        before = miss;
    }
    return found;
}

/* Write the displacement (east, north) of a clothoid up to some of its length, by Gauss's quadrature. */
static Complex moved(double into, double sign, double curvature, double rate, double yaw, const double *nodes,
                     int64_t count)
{
    Complex sum = {0, 0};
    if (curvature == 0 && rate == 0) {
        sum = direction(yaw);
    } else {
        for (int64_t at = 0; at < count; at++) {
            double way = into / 2 * (1 + nodes[2 * at]), half = nodes[2 * at + 1] / 2;
            Complex heading = direction(yaw + sign * way * (curvature + rate * way / 2));
            sum.re += half * heading.re;
            sum.im += half * heading.im;
        }
    }
    /* at yaw 0 a car looks to -z, which is north */
    return (Complex){-sign * into * sum.im, sign * into * sum.re};
}

/* Write points of a path: all x, z, yaws and curvatures. `table` has length, sign, curvature and its rate for each
 * piece; a point is some metres into the piece of a number. */
FROM_PYTHON
void write_points(double x, double z, double yaw, const double *table, int64_t pieces, const double *nodes,
                  int64_t count, const int64_t *numbers, const double *intos, int64_t rows, double *starts,
                  double *points)
{
    for (int64_t piece = 0; piece < pieces; piece++) {
        const double *row = table + 4 * piece;
        Complex step = moved(row[0], row[1], row[2], row[3], yaw, nodes, count);
        starts[3 * piece] = x;
        starts[3 * piece + 1] = z;
        starts[3 * piece + 2] = yaw;
        x += step.re;
        z -= step.im;
        yaw += row[1] * row[0] * (row[2] + row[3] * row[0] / 2);
    }
    for (int64_t at = 0; at < rows; at++) {
        const double *row = table + 4 * numbers[at], *start = starts + 3 * numbers[at];
        double into = intos[at];
        Complex step = moved(into, row[1], row[2], row[3], start[2], nodes, count);
        points[at] = start[0] + step.re;
        points[rows + at] = start[1] - step.im;
        points[2 * rows + at] = start[2] + row[1] * into * (row[2] + row[3] * into / 2);
        points[3 * rows + at] = row[2] + row[3] * into;
    }
}

/* Columns of an own half of a lane: its direction, its start, the runs between which it has a middle, those between
 * which no car turns, and the offset of its line from the middle, to the right. */
enum { ALONG, HALF_START = 2, LOW = 4, HIGH, FAR, FAR_END, OWN, HALF_COLUMNS };

/* Return the metres of a path on which a car is beyond its own half of one of some lanes; those where no car turns
 * count `far_cost` times. Pieces are as for `write_points`. */
FROM_PYTHON
double over_middle_m(double x, double z, double yaw, const double *table, int64_t pieces, const double *nodes,
                     int64_t count, const double *halves, int64_t rows, double length, double width, double overhang,
                     double step, double far_cost)
{
    double over = 0;
    for (int64_t piece = 0; piece < pieces; piece++) {
        const double *row = table + 4 * piece;
        double steps = ceil(row[0] / step), part = steps > 0 ? row[0] / steps : 0;
        for (double at = 0; at < steps; at++) {
            double into = (at + 0.5) * part;
            Complex here = moved(into, row[1], row[2], row[3], yaw, nodes, count);
            Complex turned = direction(yaw + row[1] * into * (row[2] + row[3] * into / 2));
            double ahead_x = -turned.im, ahead_z = -turned.re, middle = length / 2 - overhang, worst = 0;
            double middle_x = x + here.re + ahead_x * middle, middle_z = z - here.im + ahead_z * middle;
            for (int64_t each = 0; each < rows; each++) {
                const double *half = halves + HALF_COLUMNS * each;
                double away_x = middle_x - half[HALF_START], away_z = middle_z - half[HALF_START + 1];
                double run = away_x * half[ALONG] + away_z * half[ALONG + 1];
                double aside = (away_z * half[ALONG] - away_x * half[ALONG + 1]) * (half[OWN] < 0 ? -1 : 1);
                double same = ahead_x * half[ALONG] + ahead_z * half[ALONG + 1];
                double across = sqrt(greater(1 - same * same, 0));
                if (run <= half[LOW] || run >= half[HIGH] || same <= 0 || fabs(aside) >= 2 * fabs(half[OWN]) ||
                    aside >= width / 2 * same + length / 2 * across)
                    continue;
                int is_far = run > half[FAR] && run < half[FAR_END];
                worst = greater(worst, is_far ? far_cost : 1);
            }
            over += worst * part;
        }
        Complex whole = moved(row[0], row[1], row[2], row[3], yaw, nodes, count);
        x += whole.re;
        z -= whole.im;
        yaw += row[1] * row[0] * (row[2] + row[3] * row[0] / 2);
    }
    return over;
}

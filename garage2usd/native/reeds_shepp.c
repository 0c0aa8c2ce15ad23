/* The words of Reeds and Shepp: ways between two poses by arcs at full lock and straights, in both gears, where nothing
 * stands in the way (J. A. Reeds, L. A. Shepp: Optimal paths for a car that goes both forwards and backwards, 1990,
 * section 8, whose equations are numbered here).
 *
 * Within this file lengths are in radii, x looks ahead, y to the left, and `phi` is the turn to the left. */
#include "driving.h"

#define TAU 6.283185307179586
#define QUARTER (TAU / 4)
/* What is shorter is no piece, so that words meet whose first or last letter is missing. */
#define LEAST 1e-9

/* Where a word leads, seen from its start. */
typedef struct { double x, y, phi, sine, cosine; } Aim;

/* A point in polar coordinates. */
typedef struct { double length, angle; } Polar;

/* The words found so far, and the symmetry by which the next one comes. */
typedef struct {
    Word *words;
    int64_t count;
    double gear;
    int8_t side;
    bool is_backwards;
} Words;

static Polar polar(double x, double y) { return (Polar){sqrt(x * x + y * y), same_atan2(y, x)}; }

/* An angle between half a turn to the right and half a turn to the left. */
static double within_half(double angle)
{
    while (angle > TAU / 2)
        angle -= TAU;
    while (angle < -TAU / 2)
        angle += TAU;
    return angle;
}

/* Add a word of up to five pieces; `steering` is its letters, as 1 for left, -1 for right and 0 for straight. */
static void add(Words *found, int count, const int8_t *steering, const double *lengths)
{
    Word *word = &found->words[found->count++];
    word->count = 0;
    for (int number = 0; number < count; number++) {
        int piece = found->is_backwards ? count - 1 - number : number;
        if (fabs(lengths[piece]) < LEAST)
            continue;
        word->steering[word->count] = (int8_t)(steering[piece] * found->side);
        word->length[word->count++] = lengths[piece] * found->gear;
    }
}

/* L+ S+ L+ and L+ S+ R+: equations 8.1 and 8.2. */
static void add_with_straight(Words *found, Aim to)
{
    static const int8_t same[3] = {1, 0, 1}, other[3] = {1, 0, -1};
    Polar one = polar(to.x - to.sine, to.y - 1 + to.cosine);
    double last = within_half(to.phi - one.angle);
    if (one.angle >= -LEAST && last >= -LEAST)
        add(found, 3, same, (double[]){one.angle, one.length, last});
    Polar two = polar(to.x + to.sine, to.y - 1 - to.cosine);
    if (two.length >= 2) {
        double straight = sqrt(two.length * two.length - 4);
        double first = within_half(two.angle + same_atan2(2, straight));
        last = within_half(first - to.phi);
        if (first >= -LEAST && last >= -LEAST)
            add(found, 3, other, (double[]){first, straight, last});
    }
}

/* L+ R- L+ and L+ R- L-: equation 8.3 (and 8.4, which is read backwards). */
static void add_three_arcs(Words *found, Aim to)
{
    static const int8_t letters[3] = {1, -1, 1};
    Polar at = polar(to.x - to.sine, to.y - 1 + to.cosine);
    if (at.length > 4)
        return;
    double middle = -2 * same_asin(at.length / 4);
    double first = within_half(at.angle + middle / 2 + TAU / 2);
    if (first >= -LEAST)
        add(found, 3, letters, (double[]){first, middle, within_half(to.phi - first + middle)});
}

/* First and last arc about two middle ones. */
static void outer_arcs(double u, double v, double xi, double eta, double phi, double *first, double *last)
{
    double delta = within_half(u - v);
    Heading at_u = heading_of(u), at_delta = heading_of(delta);
    double a = at_u.sine - at_delta.sine, b = at_u.cosine - at_delta.cosine - 1;
    double angle = same_atan2(eta * a - xi * b, xi * a + eta * b);
    double turns = 2 * (at_delta.cosine - same_cos(v) - at_u.cosine) + 3;
    *first = within_half(turns < 0 ? angle + TAU / 2 : angle);
    *last = within_half(*first - u + v - phi);
}

/* L+ R+ L- R- and L+ R- L- R+: equations 8.7 and 8.8. */
static void add_four_arcs(Words *found, Aim to)
{
    static const int8_t letters[4] = {1, -1, 1, -1};
    double xi = to.x + to.sine, eta = to.y - 1 - to.cosine, square = xi * xi + eta * eta, first, last;
    double rho = (2 + sqrt(square)) / 4;
    if (rho <= 1) {
        double u = same_acos(rho);
        outer_arcs(u, -u, xi, eta, to.phi, &first, &last);
        if (first >= -LEAST && last <= LEAST)
            add(found, 4, letters, (double[]){first, u, -u, last});
    }
    rho = (20 - square) / 16;
    if (rho >= 0 && rho <= 1) {
        double u = -same_acos(rho);
        outer_arcs(u, u, xi, eta, to.phi, &first, &last);
        if (first >= -LEAST && last >= -LEAST)
            add(found, 4, letters, (double[]){first, u, u, last});
    }
}

/* L+ R- S- L- and L+ R- S- R-, with a quarter turn to the right: equations 8.9 and 8.10. */
static void add_quarter(Words *found, Aim to)
{
    static const int8_t same[4] = {1, -1, 0, 1}, other[4] = {1, -1, 0, -1};
    Polar one = polar(to.x - to.sine, to.y - 1 + to.cosine);
    if (one.length >= 2) {
        double straight = sqrt(one.length * one.length - 4);
        double first = within_half(one.angle + same_atan2(straight, -2));
        double last = within_half(to.phi - QUARTER - first);
        if (first >= -LEAST && straight >= 2 - LEAST && last <= LEAST)
            add(found, 4, same, (double[]){first, -QUARTER, 2 - straight, last});
    }
    double xi = to.x + to.sine, eta = to.y - 1 - to.cosine;
    Polar two = polar(-eta, xi);
    if (two.length >= 2) {
        double last = within_half(two.angle + QUARTER - to.phi);
        if (two.angle >= -LEAST && last <= LEAST)
            add(found, 4, other, (double[]){two.angle, -QUARTER, 2 - two.length, last});
    }
}

/* L+ R- S- L- R+, with two quarter turns: equation 8.11. */
static void add_two_quarters(Words *found, Aim to)
{
    static const int8_t letters[5] = {1, -1, 0, 1, -1};
    double xi = to.x + to.sine, eta = to.y - 1 - to.cosine;
    double square = xi * xi + eta * eta;
    if (square < 4)
        return;
    double straight = 4 - sqrt(square - 4);
    if (straight > LEAST)
        return;
    double first = within_half(same_atan2((4 - straight) * xi - 2 * eta, -2 * xi + (straight - 4) * eta));
    double last = within_half(first - to.phi);
    if (first >= -LEAST && last >= -LEAST)
        add(found, 5, letters, (double[]){first, -QUARTER, straight, -QUARTER, last});
}

/* Write all words between two poses; returns how many they are, at most MOST_WORDS. */
int64_t reeds_shepp(Pose from, Pose to, double radius, Word *words)
{
    Heading start = heading_of(from.yaw), turned_by = heading_of(remainder(to.yaw - from.yaw, TAU));
    double x = to.x - from.x, z = to.z - from.z;
    double ahead = -(start.sine * x + start.cosine * z) / radius, left = (start.sine * z - start.cosine * x) / radius;
    Words found = {.words = words};
    for (int symmetry = 0; symmetry < 4; symmetry++) {
        bool is_reverse = symmetry & 1, is_mirrored = symmetry & 2;
        found.gear = is_reverse ? -1 : 1;
        found.side = is_mirrored ? -1 : 1;
        double turned = found.gear * found.side;
        Aim aim = {ahead * found.gear, left * found.side, turned_by.yaw * turned, turned_by.sine * turned, turned_by.cosine};
        found.is_backwards = false;
        add_with_straight(&found, aim);
        add_three_arcs(&found, aim);
        add_four_arcs(&found, aim);
        add_quarter(&found, aim);
        add_two_quarters(&found, aim);
        Aim back = aim;
        back.x = aim.x * aim.cosine + aim.y * aim.sine;
        back.y = aim.x * aim.sine - aim.y * aim.cosine;
        found.is_backwards = true;
        add_three_arcs(&found, back);
        add_quarter(&found, back);
    }
    for (int64_t number = 0; number < found.count; number++)
        for (int piece = 0; piece < words[number].count; piece++)
            words[number].length[piece] *= radius;
    return found.count;
}

/* Write the words between two poses (x, z, yaw) for Python: rows of five pairs of steering and metres, negative in
 * reverse. */
FROM_PYTHON
int64_t write_words(const double *from, const double *to, double radius, double *rows)
{
    Word words[MOST_WORDS];
    Pose one = {from[0], from[1], from[2]}, other = {to[0], to[1], to[2]};
    int64_t count = reeds_shepp(one, other, radius, words);
    for (int64_t number = 0; number < count; number++)
        for (int piece = 0; piece < MOST_PIECES; piece++) {
            bool is_there = piece < words[number].count;
            rows[(number * MOST_PIECES + piece) * 2] = is_there ? words[number].steering[piece] : 0;
            rows[(number * MOST_PIECES + piece) * 2 + 1] = is_there ? words[number].length[piece] : 0;
        }
    return count;
}

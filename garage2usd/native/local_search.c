/* Polish of lanes: flips of squares that raise the value, in climbing and in annealing. */
#include "planning.h"

/* One move in so many is of a side, of which there are far fewer than squares. */
#define RESIZED_EVERY 40
/* Over all lines, and more than one, as the side that pays best depends on the others. */
#define SETTLING_PASSES 2

/* What an improvement works on. */
typedef struct {
    const Ground *ground;
    Board *board;
    const Sizes *sizes;
    const PolishRoom *room;
} Polish;

/* Whether a square or the other has a lane beside it: without, no flip of them keeps the lanes joined. */
static bool beside_lane(const Polish *polish, int64_t q, int64_t p)
{
    const Int8Row cells = polish->board->cells;
    const int64_t steps[4] = STEPS_BESIDE(polish->ground->stride);
    bool beside = false;
    for (int way = 0; way < 4; way++)
        beside |= AT(cells, q + steps[way]) == LANE || AT(cells, p + steps[way]) == LANE;
    return beside;
}

/* Whether a square and the other, which may be the same, may be flipped. */
static bool may_flip(const Polish *polish, int64_t q, int64_t p)
{
    int8_t kind = AT(polish->board->cells, p);
    return (kind == FREE || kind == LANE) && beside_lane(polish, q, p);
}

/* Value of the lanes on the board less the price of the floor, in the sides that they ask for, or NO_VALUE.
 *
 * Below `enough` faults may be left out of it. */
static double worth(const Polish *polish, double enough)
{
    if (!is_sized(polish->sizes))
        return measure(polish->ground, polish->board, enough);
    sync_sides(polish->ground, polish->board, polish->sizes);
    double floor = floor_cost(polish->sizes);
    double value = measure(polish->ground, polish->board, enough + floor);
    return value == NO_VALUE ? value : value - floor;
}

/* Keep what the board has of the lanes that were measured last. */
static void remember(const Polish *polish)
{
    for (int64_t figure = 0; figure < polish->room->known.count; figure++)
        AT(polish->room->known, figure) = AT(polish->board->tally, figure);
    copy_hops(&polish->room->hops, &polish->board->hops);
}

/* Flip one square, or two side by side; what the lanes are worth then; at most NO_VALUE where it was not done.
 *
 * Below `enough` faults may be left out of it. */
static double flipped(const Polish *polish, int64_t q, int64_t p, double enough)
{
    const Ground *ground = polish->ground;
    Board *board = polish->board;
    double value;
    if (is_sized(polish->sizes)) {
        flip(board->cells.at, q, p);
        value = worth(polish, enough);
    } else {
        int64_t fate = flip_within(ground, board, polish->room->known.at, polish->room->hops.at, q, p, enough);
        if (fate == REFUSED)
            return NO_VALUE;
        if (fate == FLIPPED) {
            value = measure(ground, board, enough);
        } else {
            value = value_now(ground, board);
            if (value >= enough) {
                value -= faults_cost(ground, board);
                copy_hops(&board->hops, &polish->room->hops);
            }
        }
    }
    if (value <= NO_VALUE)
        flip(board->cells.at, q, p);
    return value;
}

/* Climb by one pass over all squares in a new order; whether the value was raised. */
static bool climb(const Polish *polish, uint64_t *random, double *value)
{
    const Int64Row order = polish->room->order;
    const int64_t steps[3] = {0, polish->ground->stride, 1};
    bool improved = false;
    for (int64_t index = polish->room->order.count - 1; index > 0; index--) {
        int64_t other = (int64_t)(next_random(random) % (uint64_t)(index + 1)), square = AT(order, index);
        AT(polish->room->order, index) = AT(order, other);
        AT(polish->room->order, other) = square;
    }
    for (int64_t index = 0; index < polish->room->order.count; index++)
        for (int way = 0; way < 3; way++) {
            int64_t q = AT(order, index), p = q + steps[way];
            if (!may_flip(polish, q, p))
                continue;
            double tried = flipped(polish, q, p, *value);
            if (tried <= NO_VALUE)
                continue;
            if (tried > *value + 1e-9) {
                *value = tried;
                improved = true;
                remember(polish);
            } else {
                flip(polish->board->cells.at, q, p);
            }
        }
    return improved;
}

/* Give a line along which no car drives another side by a random number, if that is worth `threshold`. */
static void resize_any(const Polish *polish, uint64_t draw, double threshold, double *value)
{
    const Sizes *sizes = polish->sizes;
    int64_t axis = (int64_t)((draw >> 4) & 1);
    int64_t stride = polish->ground->stride, count = axis == 0 ? polish->board->cells.count / stride : stride;
    int64_t line = (int64_t)((draw >> 8) % (uint64_t)count);
    if (!AT(sizes->is_chosen, axis) || IN(sizes->driven, axis, line) > 0)
        return;
    int64_t *side = &IN(sizes->kept_mm, axis, line), kept = *side;
    *side = AT(sizes->free_mm, (draw >> 20) % (uint64_t)sizes->free_mm.count);
    if (side_now(sizes, axis, line) == IN(sizes->actual_mm, axis, line))
        return;
    double tried = worth(polish, threshold);
    if (tried >= threshold)
        *value = tried;
    else
        *side = kept;
}

/* Keep the lanes and sides as the best met. */
static void keep_best(const Polish *polish)
{
    copy_cells(&polish->room->cells, &polish->board->cells);
    copy_sides(&polish->room->kept_mm, &polish->sizes->kept_mm);
}

/* Anneal from lanes of a value; leaves the best lanes met on the board. */
static void anneal(const Polish *polish, uint64_t *random, double value, int64_t flips, double hottest, double coldest)
{
    const Ground *ground = polish->ground;
    const int64_t steps[4] = {0, 0, 1, ground->stride};
    double best = value;
    int64_t best_faults = AT(polish->board->tally, FAULTS);
    keep_best(polish);
    double cooling = pow(coldest / hottest, 1.0 / (double)flips), heat = hottest;
    for (int64_t index = 0; index < flips; index++) {
        heat *= cooling;
        uint64_t draw = next_random(random);
        double lot = uniform(random);
        double threshold = value + heat * log(lot > 1e-300 ? lot : 1e-300);
        if (is_sized(polish->sizes) && (draw >> 40) % RESIZED_EVERY == 0) {
            resize_any(polish, draw, threshold, &value);
            continue;
        }
        int64_t q = AT(ground->squares, (draw >> 8) % (uint64_t)ground->squares.count), p = q + steps[draw & 3];
        if (!may_flip(polish, q, p))
            continue;
        double tried = flipped(polish, q, p, threshold);
        if (tried <= NO_VALUE)
            continue;
        if (tried < threshold) {
            flip(polish->board->cells.at, q, p);
            continue;
        }
        value = tried;
        remember(polish);
        int64_t faults = AT(polish->board->tally, FAULTS);
        if (faults < best_faults || (faults == best_faults && value > best + 1e-9)) {
            best = value;
            best_faults = faults;
            keep_best(polish);
        }
    }
    copy_cells(&polish->board->cells, &polish->room->cells);
    copy_sides(&polish->sizes->kept_mm, &polish->room->kept_mm);
}

/* Improve the feasible lanes in `board.cells`; leaves the best met there and returns its value.
 *
 * First every line along which no car drives gets the side that pays best. Then it climbs by at most so many passes and
 * anneals by so many flips; garage2usd.planning.polish says how. */
double improve(const Ground *ground, Board *board, const Sizes *sizes, const PolishRoom *room, uint64_t *random,
               int64_t passes, int64_t flips, double hottest, double coldest)
{
    const Polish polish = {ground, board, sizes, room};
    double value = NO_VALUE;
    if (is_sized(sizes))
        sync_sides(ground, board, sizes);
    if (!is_sized(sizes) || measure(ground, board, INFINITY) != NO_VALUE) {
        if (is_sized(sizes))
            settle(ground, board, sizes, SETTLING_PASSES);
        value = worth(&polish, -INFINITY);
        remember(&polish);
    }
    for (int64_t index = 0; index < ground->squares.count; index++)
        AT(room->order, index) = AT(ground->squares, index);
    for (int64_t pass = 0; pass < passes; pass++)
        if (!climb(&polish, random, &value))
            break;
    if (flips != 0)
        anneal(&polish, random, value, flips, hottest, coldest);
    return worth(&polish, -INFINITY);
}

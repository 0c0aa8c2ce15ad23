/* Local search over single flips, each judged by the whole plan: first-improvement hill climbing, and simulated
 * annealing (Kirkpatrick, Gelatt and Vecchi 1983) by the criterion of Metropolis et al. (1953), whose random number is
 * drawn first: a flip is taken that gains at least T log u. */
#include "planning.h"

/* One move in so many is of a side, of which there are far fewer than squares. */
#define RESIZED_EVERY 40
/* Over all lines, and more than one, as the side that pays best depends on the others. */
#define SETTLING_PASSES 2

/* The plan that is searched from. */
typedef struct {
    const Ground *ground;
    Board *board;
    const Sizes *sizes;
    const Workspace *room;
} Annealing;

/* Whether a square or the other has a lane beside it: without, no flip of them keeps the lanes joined. */
static bool beside_lane(const Annealing *search, int64_t q, int64_t p)
{
    const Int8Row cells = search->board->cells;
    const int64_t steps[4] = STEPS_BESIDE(search->ground->stride);
    bool beside = false;
    for (int way = 0; way < 4; way++)
        beside |= AT(cells, q + steps[way]) == LANE || AT(cells, p + steps[way]) == LANE;
    return beside;
}

/* Whether a square and the other, which may be the same, may be flipped. */
static bool may_flip(const Annealing *search, int64_t q, int64_t p)
{
    int8_t kind = AT(search->board->cells, p);
    return (kind == FREE || kind == LANE) && beside_lane(search, q, p);
}

/* Value of the lanes on the board less the price of the floor, in the sides that they ask for, or NO_VALUE.
 *
 * Below `enough` faults may be left out of it. */
static double worth(const Annealing *search, double enough)
{
    if (!is_sized(search->sizes))
        return measure(search->ground, search->board, enough);
    sync_sides(search->ground, search->board, search->sizes);
    double floor = floor_cost(search->sizes);
    double value = measure(search->ground, search->board, enough + floor);
    return value == NO_VALUE ? value : value - floor;
}

/* Keep what the board has of the lanes that were measured last. */
static void remember(const Annealing *search)
{
    for (int64_t figure = 0; figure < search->room->known.count; figure++)
        AT(search->room->known, figure) = AT(search->board->tally, figure);
    copy_hops(&search->room->hops, &search->board->hops);
}

/* Flip one square, or two side by side; what the lanes are worth then; at most NO_VALUE where it was not done.
 *
 * Below `enough` faults may be left out of it. */
static double flipped(const Annealing *search, int64_t q, int64_t p, double enough)
{
    const Ground *ground = search->ground;
    Board *board = search->board;
    double value;
    if (is_sized(search->sizes)) {
        flip(board->cells.at, q, p);
        value = worth(search, enough);
    } else {
        int64_t fate = flip_within(ground, board, search->room->known.at, search->room->hops.at, q, p, enough);
        if (fate == REFUSED)
            return NO_VALUE;
        if (fate == FLIPPED) {
            value = measure(ground, board, enough);
        } else {
            value = value_now(ground, board);
            if (value >= enough) {
                value -= faults_cost(ground, board);
                copy_hops(&board->hops, &search->room->hops);
            }
        }
    }
    if (value <= NO_VALUE)
        flip(board->cells.at, q, p);
    return value;
}

/* Climb by one pass over all squares in a new order; whether the value was raised. */
static bool climb(const Annealing *search, uint64_t *random, double *value)
{
    const Int64Row order = search->room->order;
    const int64_t steps[3] = {0, search->ground->stride, 1};
    bool improved = false;
    for (int64_t index = search->room->order.count - 1; index > 0; index--) {
        int64_t other = (int64_t)(next_random(random) % (uint64_t)(index + 1)), square = AT(order, index);
        AT(search->room->order, index) = AT(order, other);
        AT(search->room->order, other) = square;
    }
    for (int64_t index = 0; index < search->room->order.count; index++)
        for (int way = 0; way < 3; way++) {
            int64_t q = AT(order, index), p = q + steps[way];
            if (!may_flip(search, q, p))
                continue;
            double tried = flipped(search, q, p, *value);
            if (tried <= NO_VALUE)
                continue;
            if (tried > *value + 1e-9) {
                *value = tried;
                improved = true;
                remember(search);
            } else {
                flip(search->board->cells.at, q, p);
            }
        }
    return improved;
}

/* Give a line along which no car drives another side by a random number, if that is worth `threshold`. */
static void resize_any(const Annealing *search, uint64_t draw, double threshold, double *value)
{
    const Sizes *sizes = search->sizes;
    int64_t axis = (int64_t)((draw >> 4) & 1);
    int64_t stride = search->ground->stride, count = axis == 0 ? search->board->cells.count / stride : stride;
    int64_t line = (int64_t)((draw >> 8) % (uint64_t)count);
    if (!AT(sizes->is_chosen, axis) || IN(sizes->driven, axis, line) > 0)
        return;
    int64_t *side = &IN(sizes->kept_mm, axis, line), kept = *side;
    *side = AT(sizes->free_mm, (draw >> 20) % (uint64_t)sizes->free_mm.count);
    if (side_now(sizes, axis, line) == IN(sizes->actual_mm, axis, line))
        return;
    double tried = worth(search, threshold);
    if (tried >= threshold)
        *value = tried;
    else
        *side = kept;
}

/* Keep the lanes and sides as the best met. */
static void keep_best(const Annealing *search)
{
    copy_cells(&search->room->cells, &search->board->cells);
    copy_sides(&search->room->kept_mm, &search->sizes->kept_mm);
}

/* Anneal from lanes of a value; leaves the best lanes met on the board. */
static void anneal(const Annealing *search, uint64_t *random, double value, int64_t flips, double hottest,
                   double coldest)
{
    const Ground *ground = search->ground;
    const int64_t steps[4] = {0, 0, 1, ground->stride};
    double best = value;
    int64_t best_faults = AT(search->board->tally, FAULTS);
    keep_best(search);
    double cooling = same_pow(coldest / hottest, 1.0 / (double)flips), heat = hottest;
    for (int64_t index = 0; index < flips; index++) {
        heat *= cooling;
        uint64_t draw = next_random(random);
        double lot = uniform(random);
        double threshold = value + heat * same_log(lot > 1e-300 ? lot : 1e-300);
        if (is_sized(search->sizes) && (draw >> 40) % RESIZED_EVERY == 0) {
            resize_any(search, draw, threshold, &value);
            continue;
        }
        int64_t q = AT(ground->squares, (draw >> 8) % (uint64_t)ground->squares.count), p = q + steps[draw & 3];
        if (!may_flip(search, q, p))
            continue;
        double tried = flipped(search, q, p, threshold);
        if (tried <= NO_VALUE)
            continue;
        if (tried < threshold) {
            flip(search->board->cells.at, q, p);
            continue;
        }
        value = tried;
        remember(search);
        int64_t faults = AT(search->board->tally, FAULTS);
        if (faults < best_faults || (faults == best_faults && value > best + 1e-9)) {
            best = value;
            best_faults = faults;
            keep_best(search);
        }
    }
    copy_cells(&search->board->cells, &search->room->cells);
    copy_sides(&search->sizes->kept_mm, &search->room->kept_mm);
}

/* Improve the feasible lanes in `board.cells`; leaves the best met there and returns its value.
 *
 * First every line along which no car drives gets the side that pays best. Then it climbs by at most so many passes and
 * anneals by so many flips; garage2usd.planning.annealing says how. */
double improve(const Ground *ground, Board *board, const Sizes *sizes, const Workspace *room, uint64_t *random,
               int64_t passes, int64_t flips, double hottest, double coldest)
{
    const Annealing search = {ground, board, sizes, room};
    double value = NO_VALUE;
    if (is_sized(sizes))
        sync_sides(ground, board, sizes);
    if (!is_sized(sizes) || measure(ground, board, INFINITY) != NO_VALUE) {
        if (is_sized(sizes))
            settle(ground, board, sizes, SETTLING_PASSES);
        value = worth(&search, -INFINITY);
        remember(&search);
    }
    for (int64_t index = 0; index < ground->squares.count; index++)
        AT(room->order, index) = AT(ground->squares, index);
    for (int64_t pass = 0; pass < passes; pass++)
        if (!climb(&search, random, &value))
            break;
    if (flips != 0)
        anneal(&search, random, value, flips, hottest, coldest);
    return worth(&search, -INFINITY);
}

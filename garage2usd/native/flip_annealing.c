/* Simulated annealing (Kirkpatrick, Gelatt and Vecchi 1983) of large plans without rules, by flips of one square or
 * two.
 *
 * A flip is judged by the squares around it (delta evaluation) with the criterion of Metropolis et al. (1953),
 * and the whole plan is measured now and then. Whether lanes stay joined is read off the eight neighbours of a
 * square, as in digital topology (Kong and Rosenfeld 1989). */
#include <string.h>

#include "planning.h"

/* Neighbours of a square by edge and corner. */
#define RING 8
/* Squares measured for flips that may part the lanes, for each trial: it bounds their part of the time. */
#define WHOLE_SHARE 30

/* Whether the lanes beside a square are joined among its eight neighbours: without it they still are. */
static bool joined_around(Int8Row cells, int64_t stride, int64_t square)
{
    const int64_t ring[RING] = { -stride, -stride + 1, 1, stride + 1, stride, stride - 1, -1, -stride - 1 };
    int pieces = 0;
    for (int index = 0; index < RING; index += 2) {
        if (AT(cells, square + ring[index]) != LANE)
            continue;
        /* a lane beside begins a piece unless the lane before it on the ring leads to it */
        int before = (index + RING - 2) % RING, corner = (index + RING - 1) % RING;
        pieces += !(AT(cells, square + ring[before]) == LANE && AT(cells, square + ring[corner]) == LANE);
    }
    /* without a piece all four are joined in a circle, or there is none */
    return pieces <= 1;
}

/* Whether the portals beside a square touch a lane. */
static bool portals_hold(const Ground *ground, Int8Row cells, int64_t square)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    for (int way = 0; way < 4; way++) {
        int64_t portal = square + steps[way];
        if (AT(cells, portal) < ENTRANCE)
            continue;
        bool touched = false;
        for (int other = 0; other < 4; other++)
            touched |= AT(cells, portal + steps[other]) == LANE;
        if (!touched)
            return false;
    }
    return true;
}

/* Set `hops` of two squares beside each other, or of one, from the lanes around; whether new lanes join others. */
static bool reach(Board *board, int64_t stride, int64_t q, int64_t p)
{
    const Int8Row cells = board->cells;
    Int32Row hops = board->hops;
    const int64_t steps[4] = STEPS_BESIDE(stride), squares[3] = { q, p, q };
    AT(hops, q) = FAR;
    AT(hops, p) = FAR;
    bool joined = AT(cells, q) != LANE && AT(cells, p) != LANE;
    for (int turn = 0; turn < 3; turn++) {
        int64_t x = squares[turn];
        if (AT(cells, x) != LANE)
            continue;
        for (int way = 0; way < 4; way++) {
            int64_t y = x + steps[way];
            if (AT(cells, y) == LANE) {
                AT(hops, x) = (int32_t)least(AT(hops, x), AT(hops, y) + 1);
                joined |= y != q && y != p;
            } else if (AT(cells, y) == ENTRANCE) {
                AT(hops, x) = 1;
            }
        }
    }
    return joined;
}

/* Add what some squares hold to stalls, time and unused squares, or take it off. */
static void count_in(const Ground *ground, const Board *board, const int64_t *around, int size, int64_t sign,
                     int64_t *change)
{
    for (int index = 0; index < size; index++) {
        if (AT(board->cells, around[index]) != FREE)
            continue;
        int64_t near, count = stalls_at(ground, board, around[index], &near);
        change[STALLS] += sign * count;
        change[UNUSED] += sign * (count == 0);
        if (count > 0)
            change[TIME] += sign * count * (1 + near);
    }
}

/* Anneal the feasible lanes in `board.cells`; leaves the best measured there and returns its value.
 *
 * `best_cells` is room for as many.
 *
 * N_S and U_S change exactly; T_S is followed by the distances as of the last measurement, one every `refresh`
 * flips, by which alone the best is chosen. A flip that may part the lanes is measured whole, as long as such
 * measurements take no more than a share of the time. */
FROM_PYTHON
double anneal_flips(const Ground *ground, Board *board, int8_t *best_cells, uint64_t *random, int64_t flips,
                    double hottest, double coldest, int64_t refresh)
{
    Int8Row cells = board->cells;
    const DoubleRow weights = ground->weights;
    int64_t stride = ground->stride, squares = ground->squares.count;
    const int64_t steps[4] = STEPS_BESIDE(stride), drawn_steps[4] = { 0, 0, 1, stride };
    size_t bytes = (size_t)board->cells.count;
    double best = measure(ground, board, -INFINITY);
    memcpy(best_cells, cells.at, bytes);
    int64_t known[3]; /* stalls, time and unused squares, as in the board's tally */
    memcpy(known, board->tally.at, sizeof known);
    double cooling = same_pow(coldest / hottest, 1.0 / (double)most(1, flips)), heat = hottest;
    int64_t wholes = 0;
    bool changed = false;
    for (int64_t trial = 0; trial < flips; trial++) {
        heat *= cooling;
        if (trial % refresh == refresh - 1 && changed) {
            double measured = measure(ground, board, -INFINITY);
            memcpy(known, board->tally.at, sizeof known);
            changed = false;
            if (measured > best) {
                best = measured;
                memcpy(best_cells, cells.at, bytes);
            }
        }
        uint64_t draw = next_random(random);
        int64_t q = AT(ground->squares, (draw >> 8) % (uint64_t)squares), step = drawn_steps[draw & 3], p = q + step;
        if (AT(cells, p) != FREE && AT(cells, p) != LANE)
            continue;
        /* the squares whose stalls may change */
        int64_t around[8] = { q, q - stride, q + stride, q - 1, q + 1 };
        int size = 5;
        for (int way = 0; way < 4 && step != 0; way++)
            if (p + steps[way] != q)
                around[size++] = p + steps[way];
        int64_t change[3] = { 0, 0, 0 };
        count_in(ground, board, around, size, -1, change);
        flip(cells.at, q, p);
        /* the way to new lanes */
        bool possible = reach(board, stride, q, p);
        count_in(ground, board, around, size, 1, change);
        bool accepted = false, whole = false;
        if (possible && known[STALLS] + change[STALLS] > 0) {
            double before = AT(weights, 1) * (double)known[TIME] / (double)known[STALLS];
            double after =
                AT(weights, 1) * (double)(known[TIME] + change[TIME]) / (double)(known[STALLS] + change[STALLS]);
            double gain =
                AT(weights, 0) * (double)change[STALLS] + AT(weights, 2) * (double)change[UNUSED] + after - before;
            double lot = uniform(random), threshold = heat * same_log(lot > 1e-300 ? lot : 1e-300);
            if (gain >= threshold) {
                /* joined still? */
                bool sure = !(step != 0 && AT(cells, q) == FREE && AT(cells, p) == FREE), held = true;
                for (int turn = 0; turn < (step == 0 ? 1 : 2); turn++) {
                    int64_t x = turn == 0 ? q : p;
                    if (AT(cells, x) == FREE) {
                        sure &= joined_around(cells, stride, x);
                        held &= portals_hold(ground, cells, x);
                    }
                }
                if (held && sure) {
                    accepted = changed = true;
                    for (int figure = STALLS; figure <= UNUSED; figure++)
                        known[figure] += change[figure];
                } else if (held && gain > 0 && wholes * squares <= WHOLE_SHARE * trial) {
                    wholes++;
                    double exact = measure(ground, board, -INFINITY);
                    double now =
                        AT(weights, 0) * (double)known[STALLS] + before + AT(weights, 2) * (double)known[UNUSED];
                    if (exact > NO_VALUE && exact >= now + threshold) {
                        accepted = true;
                        memcpy(known, board->tally.at, sizeof known);
                        changed = false;
                        if (exact > best) {
                            best = exact;
                            memcpy(best_cells, cells.at, bytes);
                        }
                    } else {
                        whole = true;
                    }
                }
            }
        }
        if (accepted)
            continue;
        flip(cells.at, q, p);
        if (whole) /* the measurement took all distances with it */
            measure(ground, board, -INFINITY);
        else
            reach(board, stride, q, p);
    }
    if (measure(ground, board, -INFINITY) > best)
        memcpy(best_cells, cells.at, bytes);
    memcpy(cells.at, best_cells, bytes);
    return measure(ground, board, -INFINITY);
}

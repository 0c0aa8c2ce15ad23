/* Flips of one square or two with delta evaluation: a bound from the squares around comes before the whole plan. */
#include "planning.h"

#define ROUNDING 1e-9

/* What lanes hold: stalls, time and unused squares, as in `Board.tally`. */
typedef struct {
    int64_t stalls, time, unused;
} Held;

/* Add what two squares and those beside them hold, or take it off. */
static void count(const Ground *ground, const Board *board, const int32_t *hops, int64_t q, int64_t p, int64_t sign,
                  Held *sum)
{
    const Int8Row cells = board->cells;
    const int64_t stride = ground->stride, steps[4] = STEPS_BESIDE(stride), around[5] = {0, -stride, stride, -1, 1};
    for (int turn = 0; turn < (p == q ? 1 : 2); turn++) {
        int64_t middle = turn == 0 ? q : p, other = turn == 0 ? p : q;
        for (int place = 0; place < 5; place++) {
            int64_t x = middle + around[place];
            if (AT(cells, x) != FREE || (place != 0 && x == other))
                continue;
            int64_t edges = 0, near = FAR;
            for (int64_t way = 0; way < 4; way++) {
                int64_t beside = x + steps[way];
                if (AT(cells, beside) == LANE) {
                    edges |= 1 << way;
                    near = least(near, hops[beside]);
                }
            }
            int64_t held = IN(ground->capacity, x, edges);
            sum->stalls += sign * held;
            sum->unused += sign * (held == 0);
            if (held > 0)
                sum->time += sign * held * (1 + near);
        }
    }
}

/* Set the hops of a new lane from those beside it; by how many squares it brings one of them nearer, at most. */
static int64_t reach(const Ground *ground, const Board *board, int32_t *hops, int64_t q)
{
    const Int8Row cells = board->cells;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    if (AT(cells, q) != LANE)
        return 0;
    int64_t nearest = FAR, farthest = 0;
    for (int way = 0; way < 4; way++) {
        int64_t p = q + steps[way];
        if (AT(cells, p) == LANE) {
            nearest = least(nearest, hops[p] + 1);
            if (hops[p] < FAR)
                farthest = most(farthest, hops[p]);
        } else if (AT(cells, p) == ENTRANCE) {
            nearest = 1;
        }
    }
    hops[q] = (int32_t)nearest;
    return farthest - nearest - 1;
}

/* Blocks of two by two lanes on a square. */
static int64_t blocks_on(Int8Row cells, int64_t stride, int64_t square)
{
    const int64_t corners[4] = {square, square - 1, square - stride, square - stride - 1};
    int64_t blocks = 0;
    for (int place = 0; place < 4; place++) {
        int64_t q = corners[place];
        blocks += AT(cells, q) == LANE && AT(cells, q + 1) == LANE && AT(cells, q + stride) == LANE &&
                  AT(cells, q + stride + 1) == LANE;
    }
    return blocks;
}

/* `TALLIED` if all ways to the entrances stay as long, `REFUSED` if lanes fall apart, else `FLIPPED`: unknown. */
static int64_t ways_on(const Ground *ground, const Board *board, const int32_t *hops, int64_t q)
{
    const Int8Row cells = board->cells;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    if (AT(cells, q) == LANE)
        return TALLIED;
    int64_t fate = TALLIED, beside = 0;
    bool alone = false;
    for (int way = 0; way < 4; way++) {
        int64_t x = q + steps[way];
        if (AT(cells, x) > LANE)
            fate = FLIPPED; /* a portal may touch no lane any more */
        if (AT(cells, x) != LANE)
            continue;
        beside++;
        int64_t lanes = 0;
        bool has_parent = hops[x] <= hops[q];
        for (int onward = 0; onward < 4; onward++) {
            int64_t y = x + steps[onward];
            if (AT(cells, y) == LANE) {
                lanes++;
                has_parent |= hops[y] == hops[x] - 1;
            }
        }
        alone |= lanes == 0;
        if (!has_parent)
            fate = FLIPPED;
    }
    return alone && beside > 1 ? REFUSED : fate;
}

/* Whether new lanes on two squares, if any, have a lane beside them that was there before. */
static bool is_joined(const Ground *ground, const Board *board, int64_t q, int64_t p)
{
    const Int8Row cells = board->cells;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride), squares[2] = {q, p};
    if (AT(cells, q) != LANE && AT(cells, p) != LANE)
        return true;
    for (int place = 0; place < 2; place++) {
        if (AT(cells, squares[place]) != LANE)
            continue;
        for (int way = 0; way < 4; way++) {
            int64_t beside = squares[place] + steps[way];
            if (AT(cells, beside) == LANE && beside != q && beside != p)
                return true;
        }
    }
    return false;
}

/* Lanes beside an entrance. */
static int64_t starts(const Ground *ground, const Board *board)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t lanes = 0;
    for (int64_t index = 0; index < ground->entrances.count; index++)
        for (int way = 0; way < 4; way++)
            lanes += AT(board->cells, AT(ground->entrances, index) + steps[way]) == LANE;
    return lanes;
}

/* Flip one square, or two side by side, unless the lanes cannot be worth `enough` stalls with that.
 *
 * `known` are stalls, time and unused squares of the feasible lanes on the board, as in `Board.tally`, and `hops` their
 * hops, of which those of the flipped squares are changed; `q` and `p` are the same for one square. Returns `REFUSED`,
 * `FLIPPED`, or `TALLIED` where the lanes are feasible, `hops` hold for them, and the board's tally has their stalls,
 * time and unused squares.
 *
 * Stalls and unused squares change on and beside the flipped squares only. Cars drive no shorter way than before where
 * a lane is taken off, and where one is put on at most as much shorter as it brings those beside it nearer to the
 * entrances. So what is found around the flip is never less than what the whole is worth. */
int64_t flip_within(const Ground *ground, Board *board, const int64_t *known, int32_t *hops, int64_t q, int64_t p,
                    double enough)
{
    const Int8Row cells = board->cells;
    Held held = {known[STALLS], known[TIME], known[UNUSED]};
    count(ground, board, hops, q, p, -1, &held);
    flip(board->cells.at, q, p);
    if (AT(cells, q) == LANE)
        hops[q] = FAR;
    if (AT(cells, p) == LANE)
        hops[p] = FAR;
    int64_t shortcut = reach(ground, board, hops, q);
    shortcut = most(shortcut, reach(ground, board, hops, p));
    if (p != q)
        shortcut = most(shortcut, reach(ground, board, hops, q));
    count(ground, board, hops, q, p, 1, &held);
    if (held.stalls <= 0)
        return FLIPPED;
    const DoubleRow weights = ground->weights;
    double mean_time = (double)held.time / (double)held.stalls;
    double bound = AT(weights, 0) * (double)held.stalls + AT(weights, 1) * (mean_time - (double)most(0, shortcut)) +
                   AT(weights, 2) * (double)held.unused;
    if (ground->rules.is_asked) {
        int64_t blocks = most(blocks_on(cells, ground->stride, q), blocks_on(cells, ground->stride, p));
        bound -= ground->rules.block_cost * (double)blocks;
    }
    int64_t fate = shortcut <= 0 ? TALLIED : FLIPPED;
    if (bound < enough - ROUNDING) {
        fate = REFUSED;
    } else {
        fate = least(fate, ways_on(ground, board, hops, q));
        if (p != q)
            fate = least(fate, ways_on(ground, board, hops, p));
        if (fate == TALLIED && !is_joined(ground, board, q, p))
            fate = FLIPPED;
        if (fate == TALLIED && !(AT(cells, q) == LANE && AT(cells, p) == LANE) && starts(ground, board) > 1)
            fate = FLIPPED; /* each entrance might have lanes of its own */
    }
    if (fate == REFUSED) {
        flip(board->cells.at, q, p);
    } else if (fate == TALLIED) {
        AT(board->tally, STALLS) = held.stalls;
        AT(board->tally, TIME) = held.time;
        AT(board->tally, UNUSED) = held.unused;
    }
    return fate;
}

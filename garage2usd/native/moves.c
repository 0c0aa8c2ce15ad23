/* Proposals of annealing by labels, drawn at random: squares, connectors, paths, runs and whole lines. */
#include "trial_move.h"

/* Longest leg of a connector, share of bent ones, longest path taken out and longest run shifted: moves stay small, so
 * that each is judged in a short time. */
enum { LONGEST_LEG = 6, LONGEST_PATH = 20, LONGEST_RUN = 40 };
#define BENT_SHARE 0.3

/* Shares of the moves, each added to those before it; the rest are runs that shift. They hardly matter: the plans of
 * six sites of 20 x 30 have 1014.2 points on average with them, 1014.1 with equal shares, and 1012.0 without
 * connectors, paths, lines and runs. */
#define FLIPS 0.38
#define RELABELS 0.50
#define EXCHANGES 0.68
#define PAIRS 0.78
#define CONNECTORS 0.88
#define PATHS 0.94
#define SHIFTED_LINES 0.97

/* How often a lane that could end is driven through, and a line that shifts leaves dead ends where it was: often enough
 * that both are tried. Not measured. */
#define THROUGH_SHARE 0.3
#define ENDS_STAY_SHARE 0.3

/* A label that suits a new lane on a square, mostly. */
static int64_t new_label(const Ground *ground, const Board *board, const TrialMove *move, uint64_t *random, int64_t q)
{
    const Int8Row label = move->label;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t deepest = ground->rules.dead_end_squares;
    int64_t passing = through(board->cells, label, ground->stride, q);
    if (passing >= 2 || deepest == 0 || uniform(random) < THROUGH_SHARE)
        return THROUGH;
    if (passing == 1)
        return TIP;
    int64_t shallowest = 100;
    for (int way = 0; way < 4; way++)
        if (AT(label, q + steps[way]) > OFF)
            shallowest = least(shallowest, AT(label, q + steps[way]));
    return shallowest <= deepest ? shallowest + 1 : THROUGH;
}

/* A lane goes, or a free square beside a lane becomes one. */
static bool flip_square(const Ground *ground, const Board *board, TrialMove *move, uint64_t *random, int64_t q)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    if (AT(board->cells, q) == LANE)
        return add_square(move, q, OFF);
    bool touched = false;
    for (int way = 0; way < 4; way++)
        touched |= AT(board->cells, q + steps[way]) >= LANE;
    return touched && add_square(move, q, new_label(ground, board, move, random, q));
}

/* A lane gets another label. */
static bool relabel(const Ground *ground, const Board *board, TrialMove *move, uint64_t *random, int64_t q)
{
    if (AT(board->cells, q) != LANE)
        return false;
    int64_t fresh = 1 + below(random, ground->rules.dead_end_squares + 1);
    return fresh != AT(move->label, q) && add_square(move, q, fresh);
}

/* A lane moves to the free square beside it. */
static bool exchange(const Board *board, TrialMove *move, int64_t q, int64_t p)
{
    if (AT(board->cells, q) != LANE || AT(board->cells, p) != FREE)
        return false;
    return add_square(move, q, OFF) && add_square(move, p, AT(move->label, q));
}

/* Two lanes side by side go, or two free squares become lanes that lead on or end. */
static bool flip_pair(const Ground *ground, const Board *board, TrialMove *move, uint64_t *random, int64_t q, int64_t p)
{
    const Int8Row cells = board->cells;
    if (AT(cells, q) == LANE && AT(cells, p) == LANE)
        return add_square(move, q, OFF) && add_square(move, p, OFF);
    if (AT(cells, q) != FREE || AT(cells, p) != FREE || through(cells, move->label, ground->stride, q) == 0)
        return false;
    bool ends = ground->rules.dead_end_squares >= 2 && uniform(random) < 0.5;
    return add_square(move, q, ends ? TIP : THROUGH) && add_square(move, p, ends ? TIP + 1 : THROUGH);
}

/* Whether a square is in the move. */
static bool is_moved(const TrialMove *move, int64_t q)
{
    for (int64_t index = 0; index < AT(move->size, MOVED); index++)
        if (AT(move->moved, index) == q)
            return true;
    return false;
}

/* Have a dead end and all that hangs on it go with the move. */
static bool drop(const Ground *ground, TrialMove *move, int64_t q)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    const Int8Row label = move->label;
    if (is_moved(move, q))
        return true;
    if (!add_square(move, q, OFF))
        return false;
    for (int way = 0; way < 4; way++) {
        int64_t p = q + steps[way];
        if (AT(label, p) > AT(label, q) && !is_moved(move, p) && !add_square(move, p, OFF))
            return false;
    }
    return true;
}

/* The path between two junctions goes, but for dead ends beside these. */
static bool take_path(const Ground *ground, const Board *board, TrialMove *move, uint64_t *random, int64_t q)
{
    const Int8Row cells = board->cells, label = move->label;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    Int64Row lengths = move->lengths;
    int64_t stride = ground->stride, deepest = ground->rules.dead_end_squares;
    if (AT(label, q) != THROUGH || through(cells, label, stride, q) != 2)
        return false;
    add_square(move, q, OFF);
    AT(lengths, 0) = AT(lengths, 1) = 0;
    for (int side = 0; side < 2; side++) {
        int64_t previous = q, here = q, found = 0;
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (AT(label, p) == THROUGH || AT(cells, p) >= ENTRANCE) {
                if (found == side)
                    here = p;
                found++;
            }
        }
        while (AT(label, here) == THROUGH && through(cells, label, stride, here) == 2 && here != q &&
               AT(lengths, side) < LONGEST_PATH) {
            add_square(move, here, OFF);
            int64_t onward = here;
            for (int way = 0; way < 4; way++) {
                int64_t p = here + steps[way];
                if (p != previous && (AT(label, p) == THROUGH || AT(cells, p) >= ENTRANCE))
                    onward = p;
            }
            previous = here;
            here = onward;
            AT(lengths, side)++;
        }
        if (AT(lengths, side) >= LONGEST_PATH || here == q || AT(cells, here) >= ENTRANCE)
            return false;
    }
    int64_t last = AT(move->size, MOVED) - 1;
    for (int side = 0; side < 2; side++) {
        int64_t kept = least(below(random, deepest + 1), AT(lengths, side));
        for (int64_t place = 0; place < kept; place++)
            AT(move->fresh, (side == 1 ? last : AT(lengths, 0)) - place) = (int8_t)(place + TIP);
    }
    /* dead ends that hang on the path go with it */
    for (int64_t index = 0; index <= last; index++) {
        if (AT(move->fresh, index) != OFF)
            continue;
        for (int way = 0; way < 4; way++) {
            int64_t p = AT(move->moved, index) + steps[way];
            if (AT(label, p) > THROUGH && !drop(ground, move, p))
                return false;
        }
    }
    return true;
}

/* The step along what a step leads across. */
static int64_t step_along(int64_t stride, int64_t step) { return step == -stride || step == stride ? 1 : stride; }

/* Whether a lane has no lane or portal beside it across the direction `side`. */
static bool is_run(Int8Row cells, Int8Row label, int64_t stride, int64_t q, int64_t side)
{
    int64_t across = side == 1 ? stride : 1;
    return AT(label, q) == THROUGH && AT(cells, q - across) <= FREE && AT(cells, q + across) <= FREE;
}

/* A straight run between two junctions shifts to the side. */
static bool shift_run(const Ground *ground, const Board *board, TrialMove *move, int64_t q, int64_t step)
{
    const Int8Row cells = board->cells, label = move->label;
    int64_t stride = ground->stride, along = step_along(stride, step);
    if (!is_run(cells, label, stride, q, along))
        return false;
    int64_t first = q, last = q, length = 1;
    while (length < LONGEST_RUN && is_run(cells, label, stride, first - along, along)) {
        first -= along;
        length++;
    }
    while (length < LONGEST_RUN && is_run(cells, label, stride, last + along, along)) {
        last += along;
        length++;
    }
    if (length < 2)
        return false;
    for (int64_t place = 0; place < length; place++) {
        int64_t p = first + place * along;
        if (AT(cells, p + step) != FREE)
            return false;
        add_square(move, p, OFF);
        add_square(move, p + step, THROUGH);
    }
    return true;
}

/* Lead a new lane from one on over free squares to the next lane, straight or with one bend. */
static bool lead_on(const Ground *ground, const Board *board, TrialMove *move, uint64_t *random, int64_t start,
                    int64_t step)
{
    const Int8Row cells = board->cells;
    int64_t p = start + step, length = 0;
    int64_t turn = uniform(random) < BENT_SHARE ? 1 + below(random, LONGEST_LEG) : 0;
    while (AT(cells, p) == FREE && length <= 2 * LONGEST_LEG) {
        if (!add_square(move, p, THROUGH))
            return false;
        length++;
        if (length == turn) {
            int64_t sign = uniform(random) < 0.5 ? 1 : -1;
            step = sign * (step == -1 || step == 1 ? ground->stride : 1);
        }
        p += step;
    }
    if (length == 0 || length > 2 * LONGEST_LEG || AT(cells, p) != LANE)
        return false;
    const int64_t ends[2] = { start, p };
    for (int end = 0; end < 2; end++)
        if (AT(move->label, ends[end]) > THROUGH && !add_square(move, ends[end], THROUGH))
            return false;
    return true;
}

/* Shift all lanes of a line along which cars drive to the side, with the ends of what they join. */
static bool shift_line(const Ground *ground, const Board *board, TrialMove *move, uint64_t *random, int64_t start,
                       int64_t step)
{
    const Int8Row cells = board->cells, label = move->label;
    int64_t along = step_along(ground->stride, step);
    if (AT(label, start) != THROUGH || !(AT(label, start - along) == THROUGH || AT(label, start + along) == THROUGH))
        return false;
    bool keeps_ends = ground->rules.dead_end_squares > 0 && uniform(random) < ENDS_STAY_SHARE;
    int64_t first = start, last = start;
    while (AT(cells, first - along) == FREE || AT(cells, first - along) == LANE)
        first -= along;
    while (AT(cells, last + along) == FREE || AT(cells, last + along) == LANE)
        last += along;
    for (int64_t p = first; p != last + along; p += along) {
        if (AT(label, p) != THROUGH || !(AT(label, p - along) == THROUGH || AT(label, p + along) == THROUGH))
            continue;
        int64_t fresh = p + step, behind = p - step;
        if (AT(cells, fresh) == FREE && !add_square(move, fresh, THROUGH))
            return false;
        if (AT(cells, fresh) < FREE || AT(cells, fresh) > LANE)
            continue;
        if (AT(label, behind) == OFF && AT(cells, behind) <= FREE) {
            bool ends = AT(cells, fresh) == LANE && keeps_ends;
            if (!add_square(move, p, ends ? TIP : OFF))
                return false;
        }
    }
    return AT(move->size, MOVED) > 0;
}

/* Draw a trial move, some of them where rules are broken; false where the draw is no move. */
bool propose(const Ground *ground, const Board *board, TrialMove *move, uint64_t *random, double faulty_share)
{
    const Int8Row cells = board->cells;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    AT(move->size, MOVED) = 0;
    int64_t q = AT(ground->squares, below(random, ground->squares.count));
    int64_t step = steps[below(random, 4)];
    if (AT(move->size, FAULTY) > 0 && uniform(random) < faulty_share) {
        q = AT(move->faulty, below(random, AT(move->size, FAULTY)));
        for (int64_t left = below(random, 3); left > 0; left--) {
            q += steps[below(random, 4)];
            if (AT(cells, q) != FREE && AT(cells, q) != LANE)
                return false;
        }
    }
    double draw = uniform(random);
    if (draw < FLIPS)
        return flip_square(ground, board, move, random, q);
    if (draw < RELABELS)
        return relabel(ground, board, move, random, q);
    if (draw < EXCHANGES)
        return exchange(board, move, q, q + step);
    if (draw < PAIRS)
        return flip_pair(ground, board, move, random, q, q + step);
    if (draw < CONNECTORS)
        return AT(cells, q) == LANE && lead_on(ground, board, move, random, q, step);
    if (draw < PATHS)
        return take_path(ground, board, move, random, q);
    if (draw < SHIFTED_LINES)
        return shift_line(ground, board, move, random, q, step);
    return shift_run(ground, board, move, q, step);
}

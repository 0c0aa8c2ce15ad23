/* Labels of lanes: driven through, or so many squares deep in a dead end. Labels come from pruning (k-core
 * decomposition, Seidman 1983), and a fault is a lane whose neighbours contradict its label. */
#include "trial_move.h"

/* Label the lanes on the board: short dead ends by their depth, all else as driven through. */
void label_lanes(const Ground *ground, Board *board, TrialMove *move)
{
    const Int8Row cells = board->cells;
    const Int32Row state = board->state;
    Int8Row label = move->label;
    Int64Row queue = move->queue;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t deepest = ground->rules.dead_end_squares;
    Survey found;
    survey(ground->squares.at, ground->squares.count, ground->stride, cells.at, board->state.at, board->queue.at,
           deepest, 0, &found);
    for (int64_t q = 0; q < move->label.count; q++)
        AT(label, q) = OFF;
    for (int64_t index = 0; index < ground->squares.count; index++)
        if (AT(cells, AT(ground->squares, index)) == LANE)
            AT(label, AT(ground->squares, index)) = THROUGH;
    int64_t head = 0, tail = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        int64_t q = AT(ground->squares, index);
        if (AT(cells, q) != LANE || AT(state, q) < -deepest || AT(state, q) >= 0)
            continue;
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (AT(cells, p) >= ENTRANCE || (AT(cells, p) == LANE && (AT(state, p) >= 2 || AT(state, p) < -deepest)))
                AT(label, q) = TIP;
        }
        if (AT(label, q) == TIP)
            AT(queue, tail++) = q;
    }
    while (head < tail) {
        int64_t q = AT(queue, head++);
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (AT(cells, p) == LANE && AT(label, p) == THROUGH && AT(state, p) < 0 && AT(state, p) > AT(state, q)) {
                AT(label, p) = (int8_t)(AT(label, q) + 1);
                AT(queue, tail++) = p;
            }
        }
    }
}

/* How far a lane is from what its label says. */
int64_t fault(Int8Row cells, Int8Row label, int64_t stride, int64_t q)
{
    const int64_t steps[4] = STEPS_BESIDE(stride);
    int64_t passing = through(cells, label, stride, q);
    if (AT(label, q) == THROUGH)
        return most(0, 2 - passing);
    if (passing > 1)
        return 1; /* cars drive on through it */
    for (int way = 0; way < 4; way++) {
        int64_t p = q + steps[way];
        if ((OFF < AT(label, p) && AT(label, p) < AT(label, q)) || AT(cells, p) >= ENTRANCE)
            return 0;
    }
    return 1;
}

/* List the lanes around which rules are broken, by the last survey and the labels. */
void find_faults(const Ground *ground, const Board *board, TrialMove *move)
{
    const Int8Row cells = board->cells;
    const CirculationRules *rules = &ground->rules;
    int64_t stride = ground->stride, count = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        int64_t q = AT(ground->squares, index);
        if (AT(cells, q) != LANE)
            continue;
        if (AT(board->state, q) < -rules->dead_end_squares || is_long(board, rules->stretch_squares, q) ||
            fault(cells, move->label, stride, q) > 0 ||
            (AT(cells, q + 1) == LANE && AT(cells, q + stride) == LANE && AT(cells, q + stride + 1) == LANE))
            AT(move->faulty, count++) = q;
    }
    AT(move->size, FAULTY) = count;
}

/* The last lane of a walk from the tip of a dead end to its root, which ends one lane beyond the depth allowed. */
static int64_t towards_root(const Ground *ground, const Board *board, int64_t tip)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    const Int32Row state = board->state;
    int64_t here = tip, depth = 1;
    bool onward = true;
    while (onward && depth <= ground->rules.dead_end_squares) {
        onward = false;
        for (int way = 0; way < 4 && !onward; way++) {
            int64_t p = here + steps[way];
            if (AT(board->cells, p) == LANE && AT(state, p) < AT(state, here)) {
                here = p;
                depth++;
                onward = true;
            }
        }
    }
    return here;
}

/* Take off the tips of all dead ends that are too deep, until none is. */
void trim(const Ground *ground, Board *board)
{
    const CirculationRules *rules = &ground->rules;
    const Int32Row state = board->state;
    for (;;) {
        Survey found;
        survey(ground->squares.at, ground->squares.count, ground->stride, board->cells.at, board->state.at,
               board->queue.at, rules->dead_end_squares, rules->stretch_squares, &found);
        if (found.deep == 0)
            return;
        /* tips of the trees that have deep lanes: those from which a walk to the root meets one */
        for (int64_t index = 0; index < ground->squares.count; index++) {
            int64_t q = AT(ground->squares, index);
            if (AT(board->cells, q) == LANE && AT(state, q) == -1 &&
                AT(state, towards_root(ground, board, q)) < -rules->dead_end_squares)
                AT(board->cells, q) = FREE;
        }
    }
}

/* Labels of lanes: driven through, or so many squares deep in a dead end. */
#include "draft.h"

/* Label the lanes on the board: short dead ends by their depth, all else as driven through. */
void label_lanes(const Ground *ground, Board *board, Draft *draft)
{
    const int8_t *cells = board->cells.at;
    const int32_t *state = board->state.at;
    int8_t *label = draft->label.at;
    int64_t *queue = draft->queue.at;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t deepest = ground->rules.dead_end_squares;
    Survey found;
    survey(ground->squares.at, ground->squares.count, ground->stride, cells, board->state.at, board->queue.at, deepest,
           0, &found);
    for (int64_t q = 0; q < draft->label.count; q++)
        label[q] = OFF;
    for (int64_t index = 0; index < ground->squares.count; index++)
        if (cells[ground->squares.at[index]] == LANE)
            label[ground->squares.at[index]] = THROUGH;
    int64_t head = 0, tail = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        int64_t q = ground->squares.at[index];
        if (cells[q] != LANE || state[q] < -deepest || state[q] >= 0)
            continue;
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (cells[p] >= ENTRANCE || (cells[p] == LANE && (state[p] >= 2 || state[p] < -deepest)))
                label[q] = TIP;
        }
        if (label[q] == TIP)
            queue[tail++] = q;
    }
    while (head < tail) {
        int64_t q = queue[head++];
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (cells[p] == LANE && label[p] == THROUGH && state[p] < 0 && state[p] > state[q]) {
                label[p] = (int8_t)(label[q] + 1);
                queue[tail++] = p;
            }
        }
    }
}

/* How far a lane is from what its label says. */
int64_t fault(const int8_t *cells, const int8_t *label, int64_t stride, int64_t q)
{
    const int64_t steps[4] = STEPS_BESIDE(stride);
    int64_t passing = through(cells, label, stride, q);
    if (label[q] == THROUGH)
        return most(0, 2 - passing);
    if (passing > 1)
        return 1; /* cars drive on through it */
    for (int way = 0; way < 4; way++) {
        int64_t p = q + steps[way];
        if ((OFF < label[p] && label[p] < label[q]) || cells[p] >= ENTRANCE)
            return 0;
    }
    return 1;
}

/* List the lanes around which rules are broken, by the last survey and the labels. */
void find_faults(const Ground *ground, const Board *board, Draft *draft)
{
    const int8_t *cells = board->cells.at;
    const CirculationRules *rules = &ground->rules;
    int64_t stride = ground->stride, count = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        int64_t q = ground->squares.at[index];
        if (cells[q] != LANE)
            continue;
        if (board->state.at[q] < -rules->dead_end_squares || is_long(board, rules->stretch_squares, q) ||
            fault(cells, draft->label.at, stride, q) > 0 ||
            (cells[q + 1] == LANE && cells[q + stride] == LANE && cells[q + stride + 1] == LANE))
            draft->faulty.at[count++] = q;
    }
    draft->size.at[FAULTY] = count;
}

/* The last lane of a walk from the tip of a dead end to its root, which ends one lane beyond the depth allowed. */
static int64_t towards_root(const Ground *ground, const Board *board, int64_t tip)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    const int32_t *state = board->state.at;
    int64_t here = tip, depth = 1;
    bool onward = true;
    while (onward && depth <= ground->rules.dead_end_squares) {
        onward = false;
        for (int way = 0; way < 4 && !onward; way++) {
            int64_t p = here + steps[way];
            if (board->cells.at[p] == LANE && state[p] < state[here]) {
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
    const int32_t *state = board->state.at;
    for (;;) {
        Survey found;
        survey(ground->squares.at, ground->squares.count, ground->stride, board->cells.at, board->state.at,
               board->queue.at, rules->dead_end_squares, rules->stretch_squares, &found);
        if (found.deep == 0)
            return;
        /* tips of the trees that have deep lanes: those from which a walk to the root meets one */
        for (int64_t index = 0; index < ground->squares.count; index++) {
            int64_t q = ground->squares.at[index];
            if (board->cells.at[q] == LANE && state[q] == -1 &&
                state[towards_root(ground, board, q)] < -rules->dead_end_squares)
                board->cells.at[q] = FREE;
        }
    }
}

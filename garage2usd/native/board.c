/* A board of lanes with its score: laid square by square, or measured whole. */
#include "planning.h"

/* Take all lanes off. */
void clear(const Ground *ground, Board *board)
{
    for (int64_t q = 0; q < ground->cells.count; q++) {
        board->cells.at[q] = ground->cells.at[q];
        board->edges.at[q] = 0;
        board->hops.at[q] = FAR;
        board->near.at[q] = FAR;
    }
    int64_t *tally = board->tally.at;
    tally[STALLS] = 0;
    tally[TIME] = 0;
    tally[UNUSED] = ground->squares.count;
    tally[UNTOUCHED] = ground->portals.count;
    tally[LAID] = 0;
}

/* Make a free square a lane, beside an entrance or a lane; keeps the tally. */
void lay(const Ground *ground, Board *board, int64_t square)
{
    static const int8_t facing[4] = {2, 1, 8, 4};
    int8_t *cells = board->cells.at, *edges = board->edges.at;
    int32_t *hops = board->hops.at, *near = board->near.at;
    int64_t *queue = board->queue.at, *tally = board->tally.at;
    const int32_t *capacity = ground->capacity.at;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t stalls = capacity[square * 16 + edges[square]];
    if (stalls > 0) {
        tally[STALLS] -= stalls;
        tally[TIME] -= stalls * (1 + near[square]);
    } else {
        tally[UNUSED]--;
    }
    cells[square] = LANE;
    tally[LAID]++;
    int32_t nearest = FAR;
    for (int way = 0; way < 4; way++) {
        int64_t p = square + steps[way];
        int8_t kind = cells[p];
        if (kind == LANE) {
            if (hops[p] + 1 < nearest)
                nearest = hops[p] + 1;
        } else if (kind == FREE) {
            int64_t before = capacity[p * 16 + edges[p]];
            edges[p] |= facing[way];
            int64_t after = capacity[p * 16 + edges[p]];
            if (after > before) {
                tally[UNUSED] -= before == 0;
                tally[STALLS] += after - before;
                tally[TIME] += (after - before) * (1 + near[p]);
            }
        } else if (kind >= ENTRANCE) {
            if (kind == ENTRANCE)
                nearest = 1;
            if (near[p] == FAR) {
                near[p] = 0;
                tally[UNTOUCHED]--;
            }
        }
    }
    hops[square] = nearest;
    queue[0] = square;
    int64_t head = 0, tail = 1;
    while (head < tail) {
        int64_t q = queue[head++];
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (cells[p] == LANE) {
                if (hops[p] > hops[q] + 1) {
                    hops[p] = hops[q] + 1;
                    queue[tail++] = p;
                }
            } else if (cells[p] == FREE && near[p] > hops[q]) {
                tally[TIME] -= (int64_t)capacity[p * 16 + edges[p]] * (near[p] - hops[q]);
                near[p] = hops[q];
            }
        }
    }
}

/* Score y' of the board as its tally has it, whether or not all portals are touched. */
double value_now(const Ground *ground, const Board *board)
{
    const int64_t *tally = board->tally.at;
    const double *weights = ground->weights.at;
    if (tally[STALLS] == 0)
        return NO_VALUE;
    double mean_time = (double)tally[TIME] / (double)tally[STALLS];
    return weights[0] * (double)tally[STALLS] + weights[1] * mean_time + weights[2] * (double)tally[UNUSED];
}

/* Dead-end aisles over the ground's limit, from the tip to the next junction or portal. */
int64_t dead_ends(const Ground *ground, const int8_t *cells)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t count = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        int64_t tip = ground->squares.at[index];
        if (cells[tip] != LANE)
            continue;
        int degree = 0;
        for (int way = 0; way < 4; way++)
            degree += cells[tip + steps[way]] >= LANE;
        if (degree > 1)
            continue;
        int64_t q = tip, previous = 0, length = 0;
        for (;;) {
            int64_t onward = 0, step_on = 0;
            degree = 0;
            for (int way = 0; way < 4; way++) {
                int64_t p = q + steps[way];
                if (cells[p] >= LANE) {
                    degree++;
                    if (p != previous) {
                        onward = p;
                        step_on = steps[way];
                    }
                }
            }
            bool along_x = step_on != 0 ? step_on == 1 || step_on == -1 : previous - q == 1 || previous - q == -1;
            if (degree > 2 || (q != tip && degree == 1))
                break;
            length += ground->sides_mm.at[q * 2 + along_x];
            if (length > ground->dead_end_limit_mm) {
                count++;
                break;
            }
            if (onward == 0 || cells[onward] != LANE)
                break;
            previous = q;
            q = onward;
        }
    }
    return count;
}

/* What the faults of the circulation on the lanes in `board.cells` cost beside the score; uses `state`, `queue`. */
double faults_cost(const Ground *ground, Board *board)
{
    const CirculationRules *rules = &ground->rules;
    double cost = 0.0;
    board->tally.at[FAULTS] = 0;
    if (ground->dead_end_cost > 0)
        cost += ground->dead_end_cost * (double)dead_ends(ground, board->cells.at);
    if (rules->is_asked) {
        Survey found;
        survey(ground->squares.at, ground->squares.count, ground->stride, board->cells.at, board->state.at,
               board->queue.at, rules->dead_end_squares, rules->stretch_squares, &found);
        cost += rules->deep_cost * (double)found.deep + rules->block_cost * (double)found.blocks +
                rules->stretch_cost * (double)found.excess;
        board->tally.at[FAULTS] = found.deep + found.blocks + found.excess;
        if (rules->asks_loop && found.loops < 1) {
            cost += rules->loopless_cost;
            board->tally.at[FAULTS]++;
        }
    }
    return cost;
}

/* Set `near` to 1 on all lanes and portals that are connected to a lane, to 0 elsewhere; returns how many lanes. */
int64_t mark_network(const Ground *ground, Board *board, int64_t first)
{
    const int8_t *cells = board->cells.at;
    int32_t *reached = board->near.at;
    int64_t *queue = board->queue.at;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    for (int64_t q = 0; q < board->near.count; q++)
        reached[q] = 0;
    queue[0] = first;
    reached[first] = 1;
    int64_t head = 0, tail = 1;
    while (head < tail) {
        int64_t q = queue[head++];
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (cells[p] >= LANE && reached[p] == 0) {
                reached[p] = 1;
                if (cells[p] == LANE)
                    queue[tail++] = p;
            }
        }
    }
    return tail;
}

/* Score y' less the cost of faults of the lanes in `board.cells`, NO_VALUE if infeasible; sets hops and tally.
 *
 * A score below `enough` is returned as it is, without a look at the faults. Unlike `lay` it keeps neither `edges` nor
 * `near`. Feasible: every portal touches a lane and the lanes form one network that does not pass through portals. */
double measure(const Ground *ground, Board *board, double enough)
{
    const int8_t *cells = board->cells.at;
    int32_t *hops = board->hops.at;
    int64_t *queue = board->queue.at, *tally = board->tally.at;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    const int64_t *squares = ground->squares.at;
    tally[FAULTS] = FAR;
    for (int64_t index = 0; index < ground->portals.count; index++) {
        bool touched = false;
        for (int way = 0; way < 4; way++)
            touched |= cells[ground->portals.at[index] + steps[way]] == LANE;
        if (!touched)
            return NO_VALUE;
    }
    int64_t lanes = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        hops[squares[index]] = FAR;
        lanes += cells[squares[index]];
    }
    int64_t tail = 0;
    for (int64_t index = 0; index < ground->entrances.count; index++)
        for (int way = 0; way < 4; way++) {
            int64_t q = ground->entrances.at[index] + steps[way];
            if (cells[q] == LANE && hops[q] == FAR) {
                hops[q] = 1;
                queue[tail++] = q;
            }
        }
    int64_t starts = tail, head = 0;
    if (starts == 0)
        return NO_VALUE;
    while (head < tail) {
        int64_t q = queue[head++];
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (cells[p] == LANE && hops[p] == FAR) {
                hops[p] = hops[q] + 1;
                queue[tail++] = p;
            }
        }
    }
    if (tail != lanes)
        return NO_VALUE;
    if (starts > 1 && mark_network(ground, board, queue[0]) != lanes)
        return NO_VALUE;
    int64_t stalls = 0, time = 0, unused = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        if (cells[squares[index]] != FREE)
            continue;
        int64_t near, count = stalls_at(ground, board, squares[index], &near);
        stalls += count;
        time += count * (1 + near);
        unused += count == 0;
    }
    tally[STALLS] = stalls;
    tally[TIME] = time;
    tally[UNUSED] = unused;
    tally[UNTOUCHED] = 0;
    tally[LAID] = lanes;
    double value = value_now(ground, board);
    return value < enough ? value : value - faults_cost(ground, board);
}

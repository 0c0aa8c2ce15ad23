/* A board of lanes with its score: laid square by square, with distances relaxed by breadth-first search, or measured
 * whole. */
#include "planning.h"

/* Take all lanes off. */
void clear(const Ground *ground, Board *board)
{
    for (int64_t q = 0; q < ground->cells.count; q++) {
        AT(board->cells, q) = AT(ground->cells, q);
        AT(board->edges, q) = 0;
        AT(board->hops, q) = FAR;
        AT(board->near, q) = FAR;
    }
    Int64Row tally = board->tally;
    AT(tally, STALLS) = 0;
    AT(tally, TIME) = 0;
    AT(tally, UNUSED) = ground->squares.count;
    AT(tally, UNTOUCHED) = ground->portals.count;
    AT(tally, LAID) = 0;
}

/* Make a free square a lane, beside an entrance or a lane; keeps the tally. */
void lay(const Ground *ground, Board *board, int64_t square)
{
    static const int8_t facing[4] = {2, 1, 8, 4};
    Int8Row cells = board->cells, edges = board->edges;
    Int32Row hops = board->hops, near = board->near;
    Int64Row queue = board->queue, tally = board->tally;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t stalls = IN(ground->capacity, square, AT(edges, square));
    if (stalls > 0) {
        AT(tally, STALLS) -= stalls;
        AT(tally, TIME) -= stalls * (1 + AT(near, square));
    } else {
        AT(tally, UNUSED)--;
    }
    AT(cells, square) = LANE;
    AT(tally, LAID)++;
    int32_t nearest = FAR;
    for (int way = 0; way < 4; way++) {
        int64_t p = square + steps[way];
        int8_t kind = AT(cells, p);
        if (kind == LANE) {
            if (AT(hops, p) + 1 < nearest)
                nearest = AT(hops, p) + 1;
        } else if (kind == FREE) {
            int64_t before = IN(ground->capacity, p, AT(edges, p));
            AT(edges, p) |= facing[way];
            int64_t after = IN(ground->capacity, p, AT(edges, p));
            if (after > before) {
                AT(tally, UNUSED) -= before == 0;
                AT(tally, STALLS) += after - before;
                AT(tally, TIME) += (after - before) * (1 + AT(near, p));
            }
        } else if (kind >= ENTRANCE) {
            if (kind == ENTRANCE)
                nearest = 1;
            if (AT(near, p) == FAR) {
                AT(near, p) = 0;
                AT(tally, UNTOUCHED)--;
            }
        }
    }
    AT(hops, square) = nearest;
    AT(queue, 0) = square;
    int64_t head = 0, tail = 1;
    while (head < tail) {
        int64_t q = AT(queue, head++);
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (AT(cells, p) == LANE) {
                if (AT(hops, p) > AT(hops, q) + 1) {
                    AT(hops, p) = AT(hops, q) + 1;
                    AT(queue, tail++) = p;
                }
            } else if (AT(cells, p) == FREE && AT(near, p) > AT(hops, q)) {
                AT(tally, TIME) -= (int64_t)IN(ground->capacity, p, AT(edges, p)) * (AT(near, p) - AT(hops, q));
                AT(near, p) = AT(hops, q);
            }
        }
    }
}

/* Score y' of the board as its tally has it, whether or not all portals are touched. */
double value_now(const Ground *ground, const Board *board)
{
    const Int64Row tally = board->tally;
    const DoubleRow weights = ground->weights;
    if (AT(tally, STALLS) == 0)
        return NO_VALUE;
    double mean_time = (double)AT(tally, TIME) / (double)AT(tally, STALLS);
    return AT(weights, 0) * (double)AT(tally, STALLS) + AT(weights, 1) * mean_time +
           AT(weights, 2) * (double)AT(tally, UNUSED);
}

/* Dead-end aisles over the ground's limit, from the tip to the next junction or portal. */
int64_t dead_ends(const Ground *ground, const int8_t *cells)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t count = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        int64_t tip = AT(ground->squares, index);
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
            length += IN(ground->sides_mm, q, along_x);
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
    AT(board->tally, FAULTS) = 0;
    if (ground->dead_end_cost > 0)
        cost += ground->dead_end_cost * (double)dead_ends(ground, board->cells.at);
    if (rules->is_asked) {
        Survey found;
        survey(ground->squares.at, ground->squares.count, ground->stride, board->cells.at, board->state.at,
               board->queue.at, rules->dead_end_squares, rules->stretch_squares, &found);
        cost += rules->deep_cost * (double)found.deep + rules->block_cost * (double)found.blocks +
                rules->stretch_cost * (double)found.excess;
        AT(board->tally, FAULTS) = found.deep + found.blocks + found.excess;
        if (rules->asks_loop && found.loops < 1) {
            cost += rules->loopless_cost;
            AT(board->tally, FAULTS)++;
        }
    }
    return cost;
}

/* Set `near` to 1 on all lanes and portals that are connected to a lane, to 0 elsewhere; returns how many lanes. */
int64_t mark_network(const Ground *ground, Board *board, int64_t first)
{
    const Int8Row cells = board->cells;
    Int32Row reached = board->near;
    Int64Row queue = board->queue;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    for (int64_t q = 0; q < board->near.count; q++)
        AT(reached, q) = 0;
    AT(queue, 0) = first;
    AT(reached, first) = 1;
    int64_t head = 0, tail = 1;
    while (head < tail) {
        int64_t q = AT(queue, head++);
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (AT(cells, p) >= LANE && AT(reached, p) == 0) {
                AT(reached, p) = 1;
                if (AT(cells, p) == LANE)
                    AT(queue, tail++) = p;
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
    const Int8Row cells = board->cells;
    Int32Row hops = board->hops;
    Int64Row queue = board->queue, tally = board->tally;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    const Int64Row squares = ground->squares;
    AT(tally, FAULTS) = FAR;
    for (int64_t index = 0; index < ground->portals.count; index++) {
        bool touched = false;
        for (int way = 0; way < 4; way++)
            touched |= AT(cells, AT(ground->portals, index) + steps[way]) == LANE;
        if (!touched)
            return NO_VALUE;
    }
    int64_t lanes = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        AT(hops, AT(squares, index)) = FAR;
        lanes += AT(cells, AT(squares, index));
    }
    int64_t tail = 0;
    for (int64_t index = 0; index < ground->entrances.count; index++)
        for (int way = 0; way < 4; way++) {
            int64_t q = AT(ground->entrances, index) + steps[way];
            if (AT(cells, q) == LANE && AT(hops, q) == FAR) {
                AT(hops, q) = 1;
                AT(queue, tail++) = q;
            }
        }
    int64_t starts = tail, head = 0;
    if (starts == 0)
        return NO_VALUE;
    while (head < tail) {
        int64_t q = AT(queue, head++);
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (AT(cells, p) == LANE && AT(hops, p) == FAR) {
                AT(hops, p) = AT(hops, q) + 1;
                AT(queue, tail++) = p;
            }
        }
    }
    if (tail != lanes)
        return NO_VALUE;
    if (starts > 1 && mark_network(ground, board, AT(queue, 0)) != lanes)
        return NO_VALUE;
    int64_t stalls = 0, time = 0, unused = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        if (AT(cells, AT(squares, index)) != FREE)
            continue;
        int64_t near, count = stalls_at(ground, board, AT(squares, index), &near);
        stalls += count;
        time += count * (1 + near);
        unused += count == 0;
    }
    AT(tally, STALLS) = stalls;
    AT(tally, TIME) = time;
    AT(tally, UNUSED) = unused;
    AT(tally, UNTOUCHED) = 0;
    AT(tally, LAID) = lanes;
    double value = value_now(ground, board);
    return value < enough ? value : value - faults_cost(ground, board);
}

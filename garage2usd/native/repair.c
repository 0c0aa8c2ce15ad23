/* Repair of lanes: all portals and pieces of lanes are joined by the shortest-path heuristic for Steiner trees
 * (Takahashi and Matsuyama 1980), in which the network grows by the shortest way to the nearest piece outside it. */
#include "planning.h"

/* Whether every portal is reached from a square over squares that are free or lanes; takes `near` for marks. */
static bool reaches_all(const Ground *ground, Board *board, int64_t first)
{
    const Int8Row cells = board->cells;
    Int64Row queue = board->queue;
    Int32Row seen = board->near;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    for (int64_t q = 0; q < board->cells.count; q++)
        AT(seen, q) = 0;
    AT(queue, 0) = first;
    AT(seen, first) = 1;
    int64_t head = 0, tail = 1;
    while (head < tail) {
        int64_t q = AT(queue, head++);
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (AT(cells, p) >= FREE && AT(seen, p) == 0) {
                AT(seen, p) = 1;
                if (AT(cells, p) <= LANE)
                    AT(queue, tail++) = p;
            }
        }
    }
    for (int64_t index = 0; index < ground->portals.count; index++)
        if (AT(seen, AT(ground->portals, index)) != 1)
            return false;
    return true;
}

/* A square beside a portal: the first lane, else a free one from which all portals are reached, or -1. */
static int64_t lane_at(const Ground *ground, Board *board, int64_t portal)
{
    const Int8Row cells = board->cells;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t free = -1;
    for (int way = 0; way < 4; way++) {
        int64_t q = portal + steps[way];
        if (AT(cells, q) == LANE)
            return q;
        if (AT(cells, q) == FREE && (free < 0 || reaches_all(ground, board, q)))
            free = q;
    }
    return free;
}

/* Lay the shortest way over free squares from the marked network to any other lane or portal. */
static bool lay_way(const Ground *ground, Board *board)
{
    Int8Row cells = board->cells;
    const Int32Row reached = board->near;
    Int32Row came = board->hops;
    Int64Row queue = board->queue;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t head = 0, tail = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        int64_t q = AT(ground->squares, index);
        AT(came, q) = -1;
        if (AT(cells, q) == LANE && AT(reached, q) == 1) {
            AT(came, q) = (int32_t)q;
            AT(queue, tail++) = q;
        }
    }
    while (head < tail) {
        int64_t q = AT(queue, head++);
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (AT(cells, p) >= LANE && AT(reached, p) == 0) {
                while (AT(cells, q) == FREE) {
                    AT(cells, q) = LANE;
                    q = AT(came, q);
                }
                return true;
            }
            if (AT(cells, p) == FREE && AT(came, p) == -1) {
                AT(came, p) = (int32_t)q;
                AT(queue, tail++) = p;
            }
        }
    }
    return false;
}

/* Connect all lanes and portals by shortest paths over free squares; false if there are none.
 *
 * Starts at the first portal; lanes that no way reaches are taken off. */
bool connect_lanes(const Ground *ground, Board *board)
{
    Int8Row cells = board->cells;
    const Int32Row reached = board->near;
    int64_t first = lane_at(ground, board, AT(ground->portals, 0));
    if (first < 0)
        return false;
    AT(cells, first) = LANE;
    do
        mark_network(ground, board, first);
    while (lay_way(ground, board));
    for (int64_t index = 0; index < ground->squares.count; index++) {
        int64_t q = AT(ground->squares, index);
        if (AT(cells, q) == LANE && AT(reached, q) == 0)
            AT(cells, q) = FREE;
    }
    for (int64_t index = 0; index < ground->portals.count; index++)
        if (AT(reached, AT(ground->portals, index)) != 1)
            return false;
    return true;
}

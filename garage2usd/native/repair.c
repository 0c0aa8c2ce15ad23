/* Repair of lanes: joining what is apart. */
#include "planning.h"

/* Whether every portal is reached from a square over squares that are free or lanes; takes `near` for marks. */
static bool reaches_all(const Ground *ground, Board *board, int64_t first)
{
    const int8_t *cells = board->cells.at;
    int64_t *queue = board->queue.at;
    int32_t *seen = board->near.at;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    for (int64_t q = 0; q < board->cells.count; q++)
        seen[q] = 0;
    queue[0] = first;
    seen[first] = 1;
    int64_t head = 0, tail = 1;
    while (head < tail) {
        int64_t q = queue[head++];
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (cells[p] >= FREE && seen[p] == 0) {
                seen[p] = 1;
                if (cells[p] <= LANE)
                    queue[tail++] = p;
            }
        }
    }
    for (int64_t index = 0; index < ground->portals.count; index++)
        if (seen[ground->portals.at[index]] != 1)
            return false;
    return true;
}

/* A square beside a portal: the first lane, else a free one from which all portals are reached, or -1. */
static int64_t lane_at(const Ground *ground, Board *board, int64_t portal)
{
    const int8_t *cells = board->cells.at;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t free = -1;
    for (int way = 0; way < 4; way++) {
        int64_t q = portal + steps[way];
        if (cells[q] == LANE)
            return q;
        if (cells[q] == FREE && (free < 0 || reaches_all(ground, board, q)))
            free = q;
    }
    return free;
}

/* Lay the shortest way over free squares from the marked network to any other lane or portal. */
static bool lay_way(const Ground *ground, Board *board)
{
    int8_t *cells = board->cells.at;
    const int32_t *reached = board->near.at;
    int32_t *came = board->hops.at;
    int64_t *queue = board->queue.at;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t head = 0, tail = 0;
    for (int64_t index = 0; index < ground->squares.count; index++) {
        int64_t q = ground->squares.at[index];
        came[q] = -1;
        if (cells[q] == LANE && reached[q] == 1) {
            came[q] = (int32_t)q;
            queue[tail++] = q;
        }
    }
    while (head < tail) {
        int64_t q = queue[head++];
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (cells[p] >= LANE && reached[p] == 0) {
                while (cells[q] == FREE) {
                    cells[q] = LANE;
                    q = came[q];
                }
                return true;
            }
            if (cells[p] == FREE && came[p] == -1) {
                came[p] = (int32_t)q;
                queue[tail++] = p;
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
    int8_t *cells = board->cells.at;
    const int32_t *reached = board->near.at;
    int64_t first = lane_at(ground, board, ground->portals.at[0]);
    if (first < 0)
        return false;
    cells[first] = LANE;
    do
        mark_network(ground, board, first);
    while (lay_way(ground, board));
    for (int64_t index = 0; index < ground->squares.count; index++) {
        int64_t q = ground->squares.at[index];
        if (cells[q] == LANE && reached[q] == 0)
            cells[q] = FREE;
    }
    for (int64_t index = 0; index < ground->portals.count; index++)
        if (reached[ground->portals.at[index]] != 1)
            return false;
    return true;
}

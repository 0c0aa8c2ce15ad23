/* Moves of simulated annealing under rules (`label_annealing.c`): a draft is one move of several squares, which is made and
 * taken back, so that only the squares around it are judged (delta evaluation). */
#include "trial_move.h"

/* Have a square in the move; false if there is no room for it. */
bool add_square(Draft *draft, int64_t q, int64_t label)
{
    int64_t *moved = &AT(draft->size, MOVED);
    if (*moved >= draft->moved.count)
        return false;
    AT(draft->moved, *moved) = q;
    AT(draft->fresh, *moved) = (int8_t)label;
    (*moved)++;
    return true;
}

/* Find the squares that a move may touch. */
void gather(Draft *draft, int64_t stride)
{
    const int64_t steps[5] = { 0, -stride, stride, -1, 1 };
    int64_t mark = ++AT(draft->marks, SQUARES_MET), size = 0;
    int64_t *stamp = draft->stamp.at + SQUARES_MET * draft->stamp.columns;
    for (int64_t index = 0; index < AT(draft->size, MOVED); index++)
        for (int way = 0; way < 5; way++) {
            int64_t q = AT(draft->moved, index) + steps[way];
            if (stamp[q] != mark) {
                stamp[q] = mark;
                AT(draft->around, size++) = q;
            }
        }
    AT(draft->size, AROUND) = size;
}

/* Make the move; new lanes get their hops from what is around. */
void apply(const Ground *ground, Board *board, Draft *draft)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    Int8Row cells = board->cells, label = draft->label;
    Int32Row hops = board->hops;
    int64_t size = AT(draft->size, MOVED);
    for (int64_t index = 0; index < size; index++) {
        int64_t q = AT(draft->moved, index);
        AT(draft->old, index) = AT(label, q);
        AT(draft->old_hops, index) = AT(hops, q);
        AT(label, q) = AT(draft->fresh, index);
        bool was_lane = AT(cells, q) == LANE;
        AT(cells, q) = AT(draft->fresh, index) > OFF ? LANE : FREE;
        if (!was_lane || AT(cells, q) == FREE)
            AT(hops, q) = FAR;
    }
    for (int turn = 0; turn < 2; turn++)
        for (int64_t place = 0; place < size; place++) {
            int64_t index = turn == 0 ? place : size - 1 - place, q = AT(draft->moved, index);
            if (AT(cells, q) != LANE || AT(draft->old, index) != OFF)
                continue;
            for (int way = 0; way < 4; way++) {
                int64_t p = q + steps[way];
                if (AT(cells, p) == LANE)
                    AT(hops, q) = (int32_t)least(AT(hops, q), AT(hops, p) + 1);
                else if (AT(cells, p) == ENTRANCE)
                    AT(hops, q) = 1;
            }
        }
}

/* Take the move back. */
void revert(Board *board, Draft *draft)
{
    for (int64_t index = AT(draft->size, MOVED) - 1; index >= 0; index--) {
        int64_t q = AT(draft->moved, index);
        AT(draft->label, q) = AT(draft->old, index);
        AT(board->hops, q) = AT(draft->old_hops, index);
        AT(board->cells, q) = AT(draft->old, index) > OFF ? LANE : FREE;
    }
}

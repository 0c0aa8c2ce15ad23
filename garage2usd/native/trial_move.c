/* A trial move of simulated annealing by labels: several squares change at once, are judged by the squares around them
 * (delta evaluation), and are taken back where the move is refused. */
#include "trial_move.h"

/* Have a square in the move; false if there is no room for it. */
bool add_square(TrialMove *move, int64_t q, int64_t label)
{
    int64_t *moved = &AT(move->size, MOVED);
    if (*moved >= move->moved.count)
        return false;
    AT(move->moved, *moved) = q;
    AT(move->fresh, *moved) = (int8_t)label;
    (*moved)++;
    return true;
}

/* Find the squares that a move may touch. */
void gather(TrialMove *move, int64_t stride)
{
    const int64_t steps[5] = { 0, -stride, stride, -1, 1 };
    int64_t mark = ++AT(move->marks, SQUARES_MET), size = 0;
    int64_t *stamp = move->stamp.at + SQUARES_MET * move->stamp.columns;
    for (int64_t index = 0; index < AT(move->size, MOVED); index++)
        for (int way = 0; way < 5; way++) {
            int64_t q = AT(move->moved, index) + steps[way];
            if (stamp[q] != mark) {
                stamp[q] = mark;
                AT(move->around, size++) = q;
            }
        }
    AT(move->size, AROUND) = size;
}

/* Make the move; new lanes get their hops from what is around. */
void apply(const Ground *ground, Board *board, TrialMove *move)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    Int8Row cells = board->cells, label = move->label;
    Int32Row hops = board->hops;
    int64_t size = AT(move->size, MOVED);
    for (int64_t index = 0; index < size; index++) {
        int64_t q = AT(move->moved, index);
        AT(move->old, index) = AT(label, q);
        AT(move->old_hops, index) = AT(hops, q);
        AT(label, q) = AT(move->fresh, index);
        bool was_lane = AT(cells, q) == LANE;
        AT(cells, q) = AT(move->fresh, index) > OFF ? LANE : FREE;
        if (!was_lane || AT(cells, q) == FREE)
            AT(hops, q) = FAR;
    }
    for (int turn = 0; turn < 2; turn++)
        for (int64_t place = 0; place < size; place++) {
            int64_t index = turn == 0 ? place : size - 1 - place, q = AT(move->moved, index);
            if (AT(cells, q) != LANE || AT(move->old, index) != OFF)
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
void revert(Board *board, TrialMove *move)
{
    for (int64_t index = AT(move->size, MOVED) - 1; index >= 0; index--) {
        int64_t q = AT(move->moved, index);
        AT(move->label, q) = AT(move->old, index);
        AT(board->hops, q) = AT(move->old_hops, index);
        AT(board->cells, q) = AT(move->old, index) > OFF ? LANE : FREE;
    }
}

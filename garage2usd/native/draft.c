/* Moves of simulated annealing under rules (`circuit.c`): a draft is one move of several squares, which is made and
 * taken back, so that only the squares around it are judged (delta evaluation). */
#include "draft.h"

/* Have a square in the move; false if there is no room for it. */
bool add_square(Draft *draft, int64_t q, int64_t label)
{
    int64_t *moved = &draft->size.at[MOVED];
    if (*moved >= draft->moved.count)
        return false;
    draft->moved.at[*moved] = q;
    draft->fresh.at[*moved] = (int8_t)label;
    (*moved)++;
    return true;
}

/* Find the squares that a move may touch. */
void gather(Draft *draft, int64_t stride)
{
    const int64_t steps[5] = { 0, -stride, stride, -1, 1 };
    int64_t mark = ++draft->marks.at[SQUARES_MET], size = 0;
    int64_t *stamp = draft->stamp.at + SQUARES_MET * draft->stamp.columns;
    for (int64_t index = 0; index < draft->size.at[MOVED]; index++)
        for (int way = 0; way < 5; way++) {
            int64_t q = draft->moved.at[index] + steps[way];
            if (stamp[q] != mark) {
                stamp[q] = mark;
                draft->around.at[size++] = q;
            }
        }
    draft->size.at[AROUND] = size;
}

/* Make the move; new lanes get their hops from what is around. */
void apply(const Ground *ground, Board *board, Draft *draft)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int8_t *cells = board->cells.at, *label = draft->label.at;
    int32_t *hops = board->hops.at;
    int64_t size = draft->size.at[MOVED];
    for (int64_t index = 0; index < size; index++) {
        int64_t q = draft->moved.at[index];
        draft->old.at[index] = label[q];
        draft->old_hops.at[index] = hops[q];
        label[q] = draft->fresh.at[index];
        bool was_lane = cells[q] == LANE;
        cells[q] = draft->fresh.at[index] > OFF ? LANE : FREE;
        if (!was_lane || cells[q] == FREE)
            hops[q] = FAR;
    }
    for (int turn = 0; turn < 2; turn++)
        for (int64_t place = 0; place < size; place++) {
            int64_t index = turn == 0 ? place : size - 1 - place, q = draft->moved.at[index];
            if (cells[q] != LANE || draft->old.at[index] != OFF)
                continue;
            for (int way = 0; way < 4; way++) {
                int64_t p = q + steps[way];
                if (cells[p] == LANE)
                    hops[q] = (int32_t)least(hops[q], hops[p] + 1);
                else if (cells[p] == ENTRANCE)
                    hops[q] = 1;
            }
        }
}

/* Take the move back. */
void revert(Board *board, Draft *draft)
{
    for (int64_t index = draft->size.at[MOVED] - 1; index >= 0; index--) {
        int64_t q = draft->moved.at[index];
        draft->label.at[q] = draft->old.at[index];
        board->hops.at[q] = draft->old_hops.at[index];
        board->cells.at[q] = draft->old.at[index] > OFF ? LANE : FREE;
    }
}

/* What the files of annealing under rules share: labels of lanes, and one move that is judged before it is made. */
#ifndef GARAGE2USD_TRIAL_MOVE_H
#define GARAGE2USD_TRIAL_MOVE_H

#include "planning.h"

/* Labels of squares: free, a lane that is driven through, the first lane of a dead end; deeper ones count on. */
enum { OFF = 0, THROUGH = 1, TIP = 2 };
/* Where `TrialMove.size` has how many squares are moved, are around, lines get another side, and squares are faulty. */
enum { MOVED = 0, AROUND = 1, LINES = 2, FAULTY = 3 };
/* Whose marks `TrialMove.marks` and `TrialMove.stamp` have where. */
enum { SQUARES_MET = 0, BLOCKS_MET = 1, SEARCHED = 2 };

/* trial_move.c */
bool add_square(TrialMove *move, int64_t q, int64_t label);
void gather(TrialMove *move, int64_t stride);
void apply(const Ground *ground, Board *board, TrialMove *move);
void revert(Board *board, TrialMove *move);

/* labels.c */
void label_lanes(const Ground *ground, Board *board, TrialMove *move);
int64_t fault(Int8Row cells, Int8Row label, int64_t stride, int64_t q);
void find_faults(const Ground *ground, const Board *board, TrialMove *move);
FROM_PYTHON
void trim(const Ground *ground, Board *board);

/* How many neighbours of a square are portals or lanes that cars drive on through. */
static inline int64_t through(Int8Row cells, Int8Row label, int64_t stride, int64_t q)
{
    const int64_t steps[4] = STEPS_BESIDE(stride);
    int64_t count = 0;
    for (int way = 0; way < 4; way++)
        count += AT(cells, q + steps[way]) >= ENTRANCE || AT(label, q + steps[way]) == THROUGH;
    return count;
}

/* Whether a square lay on a stretch that is too long at the last survey. */
static inline bool is_long(const Board *board, int64_t stretch_squares, int64_t q)
{
    return stretch_squares > 0 && AT(board->state, q) > STRETCH + stretch_squares;
}

/* moves.c */
bool propose(const Ground *ground, const Board *board, TrialMove *move, uint64_t *random, double faulty_share);

#endif

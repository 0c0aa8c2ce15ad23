/* The broken profile between squares that are decided and squares to come. */
#ifndef GARAGE2USD_BROKEN_PROFILE_H
#define GARAGE2USD_BROKEN_PROFILE_H

#include "planning.h"

#define FORBIDDEN (-1.0e18)

/* garage2usd.planning.frontier.SquareTable */
typedef struct {
    int64_t cols;
    int64_t bits;
    int64_t depth;
    Int8Row kinds;
    Int64Row portals;
    DoubleTable worth;
    int64_t asks_loop;
} SquareTable;

/* What may be chosen for a square: no lane, a lane of the core, a stub of each depth. */
static inline int64_t choices_of(const SquareTable *table) { return table->depth >= 0 ? table->depth + 2 : 2; }

/* broken_profile.c */
double step(const SquareTable *table, int64_t index, int64_t key, int64_t choice, int64_t *room, int64_t *next_key);

#endif

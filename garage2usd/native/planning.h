/* What compiled planning takes from Python: named tuples of numbers and arrays, as garage2usd.native packs them.
 *
 * The fields stand in the order of the named tuples of the same names in garage2usd.planning, whose docstrings say what
 * they hold. A whole number and a truth value are an int64_t, a number a double, an array its address and its shape.
 */
#ifndef GARAGE2USD_PLANNING_H
#define GARAGE2USD_PLANNING_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "elementary.h"

/* The paper's matrix S, and a square outside of every distance. */
enum { OBSTACLE = -1, FREE = 0, LANE = 1, ENTRANCE = 2, EXIT = 3 };
#define FAR (INT32_C(1) << 28)
#define NO_VALUE (-1.0e9)
/* Where a board's tally holds its figures. */
enum { STALLS = 0, TIME = 1, UNUSED = 2, UNTOUCHED = 3, LAID = 4, FAULTS = 5 };
/* States of `survey` above it are stretches: so much more than the squares that they have. */
#define STRETCH 4

/* garage2usd.planning.circulation.CirculationRules */
typedef struct {
    int64_t is_asked;
    int64_t dead_end_squares;
    int64_t asks_loop;
    int64_t stretch_squares;
    double deep_cost;
    double block_cost;
    double loopless_cost;
    double stretch_cost;
} CirculationRules;

/* garage2usd.planning.board.Ground */
typedef struct {
    int64_t stride;
    Int8Row cells;
    Int32Table capacity;
    Int64Table sides_mm;
    Int64Row squares;
    Int64Row entrances;
    Int64Row portals;
    DoubleRow weights;
    double dead_end_cost;
    int64_t dead_end_limit_mm;
    CirculationRules rules;
} Ground;

/* garage2usd.planning.board.Board */
typedef struct {
    Int8Row cells;
    Int8Row edges;
    Int32Row hops;
    Int32Row near;
    Int32Row state;
    Int64Row queue;
    Int64Row tally;
} Board;

/* garage2usd.planning.circulation.Survey */
typedef struct {
    int64_t deep;
    int64_t loops;
    int64_t blocks;
    int64_t excess;
} Survey;

/* garage2usd.planning.board.Archive */
typedef struct {
    DoubleRow values;
    UInt64Row keys;
    BoolTable lanes;
    Int8Table tapes;
    Int64Row starts;
    Int64Row lengths;
    Int64Row in_use;
} Archive;

/* garage2usd.config.plan.SarsaParameters */
typedef struct {
    double alpha;
    double gamma;
    double epsilon_start;
    double epsilon_min;
    double epsilon_decay;
    double epsilon_refresh;
    int64_t patience_episodes;
    double turn_back_penalty;
    double interval_penalty;
    int64_t min_run_squares;
    double wheeling_penalty;
    double loop_reward;
    double step_penalty;
    double failure_penalty;
    int64_t window_radius_squares;
    int64_t sees_distances;
    int64_t masks_actions;
    int64_t archives_prefixes;
    double revisit_rate;
    int64_t max_steps_per_square;
    int64_t starts;
} SarsaParameters;

/* garage2usd.planning.dimensions.Sizes */
typedef struct {
    BoolRow is_chosen;
    Int64Row free_mm;
    int64_t aisle_mm;
    Int64Row sides_mm;
    Int32Cube held;
    Int64Table line_of;
    Int64Table kept_mm;
    Int64Table actual_mm;
    Int64Table place;
    Int64Table driven;
    Int64Table least_mm;
    BoolRow is_floor;
    DoubleRow area_m2;
    DoubleTable hint;
    DoubleRow price;
    Int64Row change;
} Sizes;

/* garage2usd.planning.annealing.Workspace */
typedef struct {
    Int8Row cells;
    Int64Table kept_mm;
    Int64Row order;
    Int64Row known;
    Int32Row hops;
} Workspace;

/* garage2usd.planning.annealing.TrialMove */
typedef struct {
    Int8Row label;
    Int64Table stamp;
    Int64Row marks;
    Int64Row moved;
    Int64Row around;
    Int64Row queue;
    Int64Row faulty;
    Int8Row fresh;
    Int8Row old;
    Int32Row old_hops;
    Int8Row cells;
    Int32Row hops;
    Int64Table lines;
    Int64Row size;
    Int64Row lengths;
    Int64Row tally;
    Int64Row change;
} TrialMove;

static inline int64_t least(int64_t one, int64_t other) { return other < one ? other : one; }
static inline int64_t most(int64_t one, int64_t other) { return other > one ? other : one; }

static inline void copy_cells(const Int8Row *target, const Int8Row *source)
{
    memcpy(target->at, source->at, (size_t)source->count);
}

static inline void copy_hops(const Int32Row *target, const Int32Row *source)
{
    memcpy(target->at, source->at, (size_t)source->count * sizeof(int32_t));
}

/* The four steps from a square to those beside it, in the order of the bits of `Ground.capacity`: up, down, left,
 * right. */
#define STEPS_BESIDE(stride) { -(stride), (stride), -1, 1 }

/* archive.c */
FROM_PYTHON
uint64_t next_random(uint64_t *random);
void keep(Archive *archive, const int64_t *laid, int64_t lanes, double value, const int8_t *tape, int64_t steps,
          int64_t start);

/* A number from 0 to below 1. */
static inline double uniform(uint64_t *random)
{
    return (double)(next_random(random) >> 11) * (1.0 / 9007199254740992.0);
}

/* A whole number from 0 to below `count`. */
static inline int64_t below(uint64_t *random, int64_t count) { return (int64_t)(uniform(random) * (double)count); }

/* survey.c */
FROM_PYTHON
void survey(const int64_t *squares, int64_t count, int64_t stride, const int8_t *cells, int32_t *state, int64_t *queue,
            int64_t dead_end_squares, int64_t stretch_squares, Survey *found);

/* board.c */
FROM_PYTHON
void clear(const Ground *ground, Board *board);
FROM_PYTHON
void lay(const Ground *ground, Board *board, int64_t square);
FROM_PYTHON
double value_now(const Ground *ground, const Board *board);
FROM_PYTHON
double measure(const Ground *ground, Board *board, double enough);
FROM_PYTHON
int64_t dead_ends(const Ground *ground, const int8_t *cells);
double faults_cost(const Ground *ground, Board *board);
int64_t mark_network(const Ground *ground, Board *board, int64_t first);

/* Exchange lane and free square on one square, or on two if they differ; keeps no tally. */
static inline void flip(int8_t *cells, int64_t q, int64_t p)
{
    cells[q] = 1 - cells[q];
    if (p != q)
        cells[p] = 1 - cells[p];
}

/* Stalls on a free square by the lanes beside it, and the least hops of these. */
static inline int64_t stalls_at(const Ground *ground, const Board *board, int64_t square, int64_t *near)
{
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    int64_t edges = 0;
    *near = FAR;
    for (int64_t way = 0; way < 4; way++) {
        int64_t p = square + steps[way];
        if (AT(board->cells, p) == LANE) {
            edges |= 1 << way;
            *near = least(*near, AT(board->hops, p));
        }
    }
    return IN(ground->capacity, square, edges);
}

/* sizes.c */
void copy_sides(const Int64Table *target, const Int64Table *source);
FROM_PYTHON
double weigh(const Ground *ground, const Board *board, const Sizes *sizes, int64_t axis, int64_t line, int64_t side_mm);
FROM_PYTHON
void resize(const Ground *ground, const Sizes *sizes, int64_t axis, int64_t line, int64_t side_mm);
FROM_PYTHON
void sync_sides(const Ground *ground, const Board *board, const Sizes *sizes);
void foresee(const Ground *ground, const Board *board, const Sizes *sizes);
FROM_PYTHON
void settle(const Ground *ground, const Board *board, const Sizes *sizes, int64_t passes);

/* Whether any side is chosen with the plan. */
static inline bool is_sized(const Sizes *sizes) { return AT(sizes->is_chosen, 0) || AT(sizes->is_chosen, 1); }

/* Whether cars drive along X on a square, and along Z, as a sum of `ALONG_X` and `ALONG_Z`. */
enum { ALONG_X = 1, ALONG_Z = 2 };
static inline int64_t driven_ways(Int8Row cells, int64_t stride, int64_t q)
{
    int64_t ways = 0;
    if (AT(cells, q) == LANE) {
        ways |= ALONG_X * (AT(cells, q - 1) >= 1 || AT(cells, q + 1) >= 1);
        ways |= ALONG_Z * (AT(cells, q - stride) >= 1 || AT(cells, q + stride) >= 1);
    } else if (AT(cells, q) >= ENTRANCE) {
        ways |= ALONG_X * (AT(cells, q - 1) == 1 || AT(cells, q + 1) == 1);
        ways |= ALONG_Z * (AT(cells, q - stride) == 1 || AT(cells, q + stride) == 1);
    }
    return ways;
}

/* The side that a line is to have, by whether cars drive along it and whether a door is across its end. */
static inline int64_t side_now(const Sizes *sizes, int64_t axis, int64_t line)
{
    int64_t at = axis * sizes->driven.columns + line;
    int64_t side = PLACE(sizes->driven, at) > 0 ? sizes->aisle_mm : PLACE(sizes->kept_mm, at);
    return most(side, PLACE(sizes->least_mm, at));
}

/* What the floor costs, in stalls. */
static inline double floor_cost(const Sizes *sizes) { return AT(sizes->price, 0) * AT(sizes->area_m2, 0); }

/* flips.c: what became of a flip. */
enum { REFUSED = 0, FLIPPED = 1, TALLIED = 2 };
FROM_PYTHON
int64_t flip_within(const Ground *ground, Board *board, const int64_t *known, int32_t *hops, int64_t q, int64_t p,
                    double enough);

/* annealing.c */
FROM_PYTHON
double improve(const Ground *ground, Board *board, const Sizes *sizes, const Workspace *room, uint64_t *random,
               int64_t passes, int64_t flips, double hottest, double coldest);

/* repair.c: connect all lanes and portals by shortest paths over free squares; false if there are none. */
FROM_PYTHON
bool connect_lanes(const Ground *ground, Board *board);

#endif

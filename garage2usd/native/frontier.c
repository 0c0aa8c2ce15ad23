/* Frontier-based search over layouts: lane or free is decided square by square in reading order.
 *
 * A dynamic programme over the broken profile (transfer matrices, one square at a time) keeps the best value of each
 * frontier and what can follow it; an enumeration by these suffixes then meets only layouts that may win. */
#include "broken_profile.h"

/* Squares around the site, as garage2usd.planning.board.PADDING. */
#define PADDING 4

/* garage2usd.planning.frontier.Enumeration */
typedef struct {
    Int64Table ways;
    Int64Table next_keys;
    DoubleTable next_values;
    DoubleTable bounds;
    Int64Row children;
    Int64Row tried;
    Int64Row keys;
    DoubleRow values;
    Int64Table room;
    Int8Row best_cells;
    DoubleRow best;
    Int64Row counts;
} Enumeration;

/* All frontiers to which a square leads, in no order and some of them several times; returns how many. */
FROM_PYTHON
int64_t step_frontiers(const SquareTable *table, int64_t index, const int64_t *keys, const double *values,
                       int64_t count, int64_t *room, int64_t *next_keys, double *next_values)
{
    int64_t choices = choices_of(table), found = 0;
    for (int64_t row = 0; row < count; row++)
        for (int64_t choice = 0; choice < choices; choice++) {
            double gain = step(table, index, keys[row], choice, room, &next_keys[found]);
            if (gain != FORBIDDEN)
                next_values[found++] = values[row] + gain;
        }
    return found;
}

/* Each frontier once, with its best value, given an order in which keys ascend; returns how many. */
FROM_PYTHON
int64_t merge_frontiers(const int64_t *order, int64_t count, const int64_t *keys, const double *values,
                        int64_t *unique_keys, double *unique_values)
{
    int64_t size = 0;
    for (int64_t at = 0; at < count; at++) {
        int64_t row = order[at];
        if (size > 0 && unique_keys[size - 1] == keys[row]) {
            if (values[row] > unique_values[size - 1])
                unique_values[size - 1] = values[row];
        } else {
            unique_keys[size] = keys[row];
            unique_values[size++] = values[row];
        }
    }
    return size;
}

/* Where the first of some ascending keys is that is not less than a key. */
static int64_t bisect(const int64_t *keys, int64_t count, int64_t key)
{
    int64_t low = 0, high = count;
    while (low < high) {
        int64_t middle = (low + high) / 2;
        if (keys[middle] < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The most that square `index` and all after it add to each frontier before it. */
FROM_PYTHON
void follow_frontiers(const SquareTable *table, int64_t index, const int64_t *keys, int64_t count,
                      const int64_t *next_keys, const double *next_suffix, int64_t next_count, int64_t *room,
                      double *suffix)
{
    int64_t choices = choices_of(table);
    for (int64_t row = 0; row < count; row++) {
        suffix[row] = FORBIDDEN;
        for (int64_t choice = 0; choice < choices; choice++) {
            int64_t key;
            double gain = step(table, index, keys[row], choice, room, &key);
            if (gain == FORBIDDEN)
                continue;
            int64_t place = bisect(next_keys, next_count, key);
            if (place < next_count && next_keys[place] == key && next_suffix[place] > FORBIDDEN) {
                double value = gain + next_suffix[place];
                if (value > suffix[row])
                    suffix[row] = value;
            }
        }
    }
}

/* How much more time than over free squares the stalls so far take at least, given what is decided no lane.
 *
 * Squares from `first_open` on may all still be lanes. */
static double detour(const Ground *ground, Board *board, int64_t first_open, const int64_t *relaxed)
{
    const Int8Row cells = board->cells;
    Int32Row hops = board->hops;
    Int64Row queue = board->queue;
    const Int64Row squares = ground->squares;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    for (int64_t at = 0; at < ground->squares.count; at++)
        AT(hops, AT(squares, at)) = FAR;
    int64_t tail = 0;
    for (int64_t at = 0; at < ground->entrances.count; at++)
        for (int way = 0; way < 4; way++) {
            int64_t p = AT(ground->entrances, at) + steps[way];
            if (AT(hops, p) == FAR && (AT(cells, p) == LANE || (AT(cells, p) == FREE && p >= first_open))) {
                AT(hops, p) = 1;
                AT(queue, tail++) = p;
            }
        }
    for (int64_t head = 0; head < tail; head++)
        for (int way = 0; way < 4; way++) {
            int64_t q = AT(queue, head), p = q + steps[way];
            if ((AT(cells, p) == LANE || (AT(cells, p) == FREE && p >= first_open)) && AT(hops, p) == FAR) {
                AT(hops, p) = AT(hops, q) + 1;
                AT(queue, tail++) = p;
            }
        }
    double more = 0.0;
    for (int64_t at = 0; at < ground->squares.count && AT(squares, at) < first_open; at++) {
        int64_t q = AT(squares, at), edges = 0, near = FAR, free = FAR;
        if (AT(cells, q) != FREE)
            continue;
        for (int side = 0; side < 4; side++) {
            int64_t p = q + steps[side];
            if (AT(cells, p) == LANE) {
                edges |= 1 << side;
                free = least(free, relaxed[p]);
            }
            if (AT(cells, p) == LANE || (AT(cells, p) == FREE && p >= first_open))
                near = least(near, AT(hops, p));
        }
        int64_t stalls = IN(ground->capacity, q, edges);
        if (stalls > 0 && near > free)
            more += (double)(stalls * (near - free));
    }
    return more;
}

/* Sort the choices for a square that may lead to more than `best` by what they may come to. */
static void begin(const Enumeration *state, int64_t depth, const SquareTable *table, const int64_t *offsets,
                  const int64_t *keys, const double *suffixes, double best)
{
    int64_t choices = state->ways.columns, children = 0;
    int64_t *ways = state->ways.at + depth * choices, *next_keys = state->next_keys.at + depth * choices;
    double *bounds = state->bounds.at + depth * choices, *next_values = state->next_values.at + depth * choices;
    int64_t first = offsets[depth + 1], last = offsets[depth + 2];
    for (int64_t choice = 0; choice < choices; choice++) {
        int64_t key;
        double gain = step(table, depth, AT(state->keys, depth), choice, state->room.at, &key);
        if (gain == FORBIDDEN)
            continue;
        double value = AT(state->values, depth) + gain;
        double bound = value + suffixes[first + bisect(keys + first, last - first, key)];
        if (bound <= best + 1e-9)
            continue;
        int64_t slot = children++;
        for (; slot > 0 && bounds[slot - 1] < bound; slot--) {
            ways[slot] = ways[slot - 1];
            bounds[slot] = bounds[slot - 1];
            next_keys[slot] = next_keys[slot - 1];
            next_values[slot] = next_values[slot - 1];
        }
        ways[slot] = choice;
        bounds[slot] = bound;
        next_keys[slot] = key;
        next_values[slot] = value;
    }
    AT(state->children, depth) = children;
    AT(state->tried, depth) = 0;
}

/* Score the layouts whose relaxed value is above the best met so far; whether all of them are scored.
 *
 * `board` holds the layout of `state` from call to call, at first that of `ground`. It returns after so many `steps`, a
 * square decided or taken back. `offsets` say where the frontiers before each square start in `keys`, `suffixes` what
 * can follow each. `relaxed` are the hops of the squares over free squares, and `price` is what a hop of a stall costs
 * in the relaxed value. */
FROM_PYTHON
bool enumerate_layouts(const Enumeration *state, int64_t steps, const SquareTable *table, const Ground *ground,
                       Board *board, const int64_t *offsets, const int64_t *keys, const double *suffixes,
                       const int64_t *relaxed, double price)
{
    int64_t total = state->ways.rows, choices = state->ways.columns, cols = table->cols, stride = ground->stride;
    Int64Row tried = state->tried;
    int64_t border = PADDING * (stride + 1), depth = AT(state->counts, 0);
    double best = AT(state->best, 0);
    for (int64_t taken = 0; taken < steps && depth >= 0; taken++) {
        if (depth == total) {
            double value = measure(ground, board, -INFINITY);
            AT(state->counts, 1)++;
            if (value > best + 1e-9) {
                best = value;
                for (int64_t q = 0; q < board->cells.count; q++)
                    AT(state->best_cells, q) = AT(board->cells, q);
            }
            depth--;
            continue;
        }
        if (AT(tried, depth) < 0)
            begin(state, depth, table, offsets, keys, suffixes, best);
        int64_t square = border + (depth / cols) * stride + depth % cols;
        int64_t slot = AT(tried, depth), child = depth * choices + slot;
        if (slot == AT(state->children, depth) || PLACE(state->bounds, child) <= best + 1e-9) {
            AT(board->cells, square) = AT(ground->cells, square);
            AT(tried, depth) = -1;
            depth--;
            continue;
        }
        AT(tried, depth)++;
        AT(board->cells, square) = PLACE(state->ways, child) > 0 ? LANE : AT(ground->cells, square);
        if ((depth + 1) % cols == 0) {
            int64_t first_open = border + ((depth + 1) / cols) * stride + (depth + 1) % cols;
            double lost = price * detour(ground, board, first_open, relaxed);
            if (PLACE(state->bounds, child) - lost <= best + 1e-9)
                continue;
        }
        AT(state->keys, depth + 1) = PLACE(state->next_keys, child);
        AT(state->values, depth + 1) = PLACE(state->next_values, child);
        depth++;
    }
    AT(state->best, 0) = best;
    AT(state->counts, 0) = depth;
    return depth < 0;
}

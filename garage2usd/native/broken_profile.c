/* Dynamic programming over a broken profile, one square at a step: the profile, and its step by one square.
 *
 * The boundary between decided squares and squares to come keeps the pieces of lanes that reach it, as in Knuth's
 * "simpath" (The Art of Computer Programming 4A, section 7.1.4), which became frontier-based search (Kawahara,
 * Inoue, Iwashita and Minato 2017). The last square of each column stands for all decided ones: a few bits each, in
 * one number, with pieces renumbered from the first column on. Under the rules of circulation each lane is labelled:
 * core, driven on through, or stub of a depth, in a dead end so many squares from the core. */
#include "broken_profile.h"

/* Codes of a column: 0 nothing to come, 1 a portal that touches no lane yet, 2 + edges a free square, edges being the
 * sum of 1 up, 2 left, 4 right that are open, from 10 on a lane, by its piece and within a piece by its type. */
enum { PORTAL_CODE = 1, FREE_CODE = 2, LANE_CODE = 10 };
/* Columns share 60 bits of a frontier. Above them: the lanes are complete; they have a loop, or need none; the square
 * up and left of the next one is a lane in a corner that may become a block. */
#define FINISHED (INT64_C(1) << 60)
#define LOOPED (INT64_C(1) << 61)
#define CORNER (INT64_C(1) << 62)

/* Edges of a code as in `Ground.capacity`. */
static int64_t mask(int64_t edges) { return (edges & 1) | ((edges & 2) << 1) | ((edges & 4) << 1); }

static bool is_free(const SquareTable *table, int64_t index)
{
    return index < table->kinds.count && AT(table->kinds, index) == FREE;
}

static double worth(const SquareTable *table, int64_t index, int64_t edges)
{
    return IN(table->worth, index, edges);
}

/* Code of a free square of which only the lower edge is still to come; one for all that gain the same. */
static int64_t settled(const SquareTable *table, int64_t index, int64_t edges)
{
    if (!is_free(table, index + table->cols))
        return 0;
    double gain = worth(table, index, mask(edges) | 2) - worth(table, index, mask(edges));
    if (fabs(gain) < 1e-12)
        return 0;
    for (int64_t other = 0; other < edges; other++)
        if (fabs(worth(table, index, mask(other) | 2) - worth(table, index, mask(other)) - gain) < 1e-12)
            return FREE_CODE + other;
    return FREE_CODE + edges;
}

/* Types of a lane: 0, 1, 2 core that needs so many more neighbours of the core; 1 + 2 d a stub of depth d that has met
 * no lane of depth d - 1 yet, 2 + 2 d one that has; the core has depth 0. */
static int64_t types_of(const SquareTable *table) { return table->depth >= 0 ? 3 + 2 * table->depth : 1; }

static int64_t depth_of(int64_t kind) { return kind < 3 ? 0 : (kind - 1) / 2; }

/* How many more neighbours a lane needs. */
static int64_t needs(int64_t kind) { return kind < 3 ? kind : kind & 1; }

/* The type of a lane after it has met one of a depth; -1 if such may not be neighbours. */
static int64_t met(int64_t kind, int64_t depth)
{
    int64_t own = depth_of(kind);
    if (depth == own + 1)
        return kind;
    if (own == 0)
        return depth == 0 ? most(0, kind - 1) : -1;
    return depth == own - 1 && (kind & 1) ? kind + 1 : -1;
}

/* Have a new lane of a depth and one beside it meet; false if such may not be neighbours. */
static bool meet(int64_t *kind, int64_t *other, int64_t depth)
{
    int64_t own = *kind;
    *kind = met(own, depth_of(*other));
    *other = met(*other, depth);
    return *kind >= 0 && *other >= 0;
}

/* Take the code of each column and the piece of its lane, 0 if it is none, out of a frontier. */
static void unpack(const SquareTable *table, int64_t key, int64_t *codes, int64_t *pieces)
{
    int64_t types = types_of(table), full = (INT64_C(1) << table->bits) - 1;
    for (int64_t c = 0; c < table->cols; c++) {
        int64_t code = (key >> (table->bits * c)) & full, piece = 0;
        if (code >= LANE_CODE) {
            piece = 1 + (code - LANE_CODE) / types;
            code = LANE_CODE + (code - LANE_CODE) % types;
        }
        codes[c] = code;
        pieces[c] = piece;
    }
}

/* Make a frontier of codes and pieces, which are numbered by their first column. */
static int64_t packed(const SquareTable *table, const int64_t *codes, const int64_t *pieces, int64_t *names)
{
    int64_t result = 0, used = 0, types = types_of(table);
    for (int64_t name = 0; name < table->cols + 2; name++)
        names[name] = 0;
    for (int64_t c = 0; c < table->cols; c++) {
        int64_t code = codes[c], piece = pieces[c];
        if (piece > 0) {
            if (names[piece] == 0)
                names[piece] = ++used;
            code += (names[piece] - 1) * types;
        }
        result |= code << (table->bits * c);
    }
    return result;
}

/* The frontier after one more square, as `next_key`, and what it adds; FORBIDDEN if no feasible layout goes that way.
 *
 * `index` is the square, `key` the frontier before it, `choice` 0 not a lane, 1 a lane of the core, 1 + d a stub of
 * depth d. `room`, of 3 x (2 + columns) numbers, is for codes, pieces and names of pieces.
 *
 * The labels are sound where each lane of the core has two neighbours that are core or portals, and each stub of depth
 * d one neighbour of depth d - 1, no portal, and else neighbours of depth d + 1. Then pruning takes off the stubs and
 * nothing else, so that each layout that keeps R1 has exactly one labelling, and others have none. A lane that joins
 * two of the same piece closes a loop (R2); one that fills a block of two by two is forbidden (R3). */
double step(const SquareTable *table, int64_t index, int64_t key, int64_t choice, int64_t *room, int64_t *next_key)
{
    int64_t cols = table->cols, col = index % cols, depth = choice - 1;
    bool typed = table->depth >= 0, lane = choice > 0;
    const Int8Row kinds = table->kinds;
    int64_t flags = key & (FINISHED | LOOPED);
    if (lane && (AT(kinds, index) != FREE || (flags & FINISHED)))
        return FORBIDDEN;
    int64_t *codes = room, *pieces = room + cols + 2, *names = room + 2 * (cols + 2);
    unpack(table, key, codes, pieces);
    int64_t up = codes[col], up_piece = pieces[col], left = 0, left_piece = 0;
    if (col > 0) {
        left = codes[col - 1];
        left_piece = pieces[col - 1];
    }
    if (lane && typed && up_piece > 0 && left_piece > 0 && (key & CORNER))
        return FORBIDDEN;
    int64_t kind = 0;
    if (lane && typed) {
        kind = depth == 0 ? most(0, 2 - AT(table->portals, index)) : 1 + 2 * depth;
        if (depth > 0 && AT(table->portals, index) > 0)
            return FORBIDDEN;
    }
    double gain = 0.0;
    /* the square above is complete */
    if (up == PORTAL_CODE && !lane)
        return FORBIDDEN;
    if (lane && FREE_CODE <= up && up < LANE_CODE) {
        int64_t edges = mask(up - FREE_CODE);
        gain += worth(table, index - cols, edges | 2) - worth(table, index - cols, edges);
    }
    if (up_piece > 0) {
        int64_t other = up - LANE_CODE;
        if (lane && !meet(&kind, &other, depth))
            return FORBIDDEN;
        if (needs(other) > 0)
            return FORBIDDEN;
        if (!lane) {
            codes[col] = pieces[col] = 0;
            bool alone = true, others = false;
            for (int64_t c = 0; c < cols; c++) {
                alone &= pieces[c] != up_piece;
                others |= pieces[c] > 0 && pieces[c] != up_piece;
            }
            if (alone) {
                if (others || !(flags & LOOPED))
                    return FORBIDDEN;
                flags |= FINISHED;
            }
        }
    }
    /* the right edge of the square to the left is decided */
    if (left == PORTAL_CODE && lane) {
        codes[col - 1] = 0;
    } else if (left_piece > 0) {
        int64_t other = left - LANE_CODE;
        if (lane && !meet(&kind, &other, depth))
            return FORBIDDEN;
        if (needs(other) > is_free(table, index - 1 + cols))
            return FORBIDDEN;
        codes[col - 1] = LANE_CODE + other;
    } else if (left >= FREE_CODE) {
        int64_t edges = left - FREE_CODE;
        if (lane) {
            gain += worth(table, index - 1, mask(edges | 4)) - worth(table, index - 1, mask(edges));
            edges |= 4;
        }
        codes[col - 1] = settled(table, index - 1, edges);
    }
    /* this square */
    bool has_right = col < cols - 1 && AT(kinds, index + 1) == FREE;
    int64_t corner = 0;
    if (lane) {
        if (needs(kind) > has_right + is_free(table, index + cols))
            return FORBIDDEN;
        int64_t piece = cols + 1;
        if (up_piece > 0) {
            piece = up_piece;
            if (left_piece == up_piece)
                flags |= LOOPED;
            else if (left_piece > 0)
                for (int64_t c = 0; c < cols; c++)
                    if (pieces[c] == left_piece)
                        pieces[c] = up_piece;
            if (typed && has_right && pieces[col + 1] > 0)
                corner = CORNER;
        } else if (left_piece > 0) {
            piece = left_piece;
        }
        codes[col] = LANE_CODE + kind;
        pieces[col] = piece;
    } else if (AT(kinds, index) >= ENTRANCE) {
        codes[col] = up_piece > 0 || left_piece > 0 ? 0 : PORTAL_CODE;
    } else if (AT(kinds, index) == FREE) {
        int64_t edges = (up_piece > 0) + 2 * (left_piece > 0);
        gain += worth(table, index, mask(edges));
        codes[col] = has_right ? FREE_CODE + edges : settled(table, index, edges);
    } else {
        codes[col] = 0;
    }
    *next_key = flags | corner | packed(table, codes, pieces, names);
    return gain;
}

/* Whether a frontier below the last square is that of a feasible layout. */
static bool is_complete(const SquareTable *table, int64_t key)
{
    int64_t types = types_of(table);
    bool lanes = false;
    for (int64_t c = 0; c < table->cols; c++) {
        int64_t code = (key >> (table->bits * c)) & ((INT64_C(1) << table->bits) - 1);
        if (code == PORTAL_CODE || code >= LANE_CODE + types)
            return false;
        lanes |= code >= LANE_CODE;
        if (code >= LANE_CODE && needs(code - LANE_CODE) > 0)
            return false;
    }
    return (key & LOOPED) && lanes == !(key & FINISHED);
}

/* Mark the frontiers below the last square that are those of feasible layouts. */
FROM_PYTHON
void mark_complete(const SquareTable *table, const int64_t *keys, int64_t count, bool *complete)
{
    for (int64_t row = 0; row < count; row++)
        complete[row] = is_complete(table, keys[row]);
}

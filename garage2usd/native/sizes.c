/* Widths R and depths C while lanes are annealed: each line of squares takes the side that its use asks for, and lines
 * without traffic descend one by one to the side that pays best (coordinate descent). */
#include "planning.h"

#define MM2_PER_M2 1.0e6

/* Squares of a line that are one `step` after the other. */
typedef struct {
    int64_t first, step, count;
} Line;

static Line line_at(const Ground *ground, int64_t axis, int64_t line)
{
    int64_t stride = ground->stride;
    if (axis == 0)
        return (Line){line * stride, 1, stride};
    return (Line){line, stride, ground->cells.count / stride};
}

/* How many lines there are along an axis. */
static int64_t lines_along(const Ground *ground, int64_t axis)
{
    return axis == 0 ? ground->cells.count / ground->stride : ground->stride;
}

/* Where a table by axis and line has a line. */
static int64_t *at_line(const Int64Table *table, int64_t axis, int64_t line)
{
    return table->at + axis * table->columns + line;
}

/* The place of a side in `sides_mm`. */
static int64_t place_of(const Sizes *sizes, int64_t side_mm)
{
    int64_t place = 0;
    while (AT(sizes->sides_mm, place) != side_mm)
        place++;
    return place;
}

/* What a square holds by its open edges, by the places of its depth and its width. */
static const int32_t *held_by(const Sizes *sizes, int64_t depth, int64_t width)
{
    return sizes->held.at + (depth * sizes->held.rows + width) * sizes->held.columns;
}

/* Write what a square holds by its open edges into `ground.capacity`. */
static void set_capacity(const Ground *ground, const Sizes *sizes, int64_t q)
{
    int64_t depth = *at_line(&sizes->place, 0, *at_line(&sizes->line_of, 0, q));
    int64_t width = *at_line(&sizes->place, 1, *at_line(&sizes->line_of, 1, q));
    const int32_t *held = held_by(sizes, depth, width);
    for (int64_t edges = 0; edges < 16; edges++)
        IN(ground->capacity, q, edges) = held[edges];
}

/* Set `change` to what another side of a line would add; returns the floor that it would add, in m2. */
double weigh(const Ground *ground, const Board *board, const Sizes *sizes, int64_t axis, int64_t line, int64_t side_mm)
{
    const Int8Row cells = board->cells;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    Int64Row change = sizes->change;
    AT(change, STALLS) = AT(change, TIME) = AT(change, UNUSED) = 0;
    Line squares = line_at(ground, axis, line);
    int64_t across = 0, place = place_of(sizes, side_mm);
    for (int64_t index = 0; index < squares.count; index++) {
        int64_t q = squares.first + index * squares.step;
        if (!AT(sizes->is_floor, q))
            continue;
        /* the index on a line is the number of the line across */
        across += *at_line(&sizes->actual_mm, 1 - axis, index);
        if (AT(cells, q) != FREE)
            continue;
        int64_t edges = 0, near = FAR;
        for (int64_t way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (AT(cells, p) == LANE) {
                edges |= 1 << way;
                near = least(near, AT(board->hops, p));
            }
        }
        if (edges == 0)
            continue;
        int64_t before = IN(ground->capacity, q, edges);
        int64_t other = *at_line(&sizes->place, 1 - axis, index);
        int64_t after = (axis == 0 ? held_by(sizes, place, other) : held_by(sizes, other, place))[edges];
        AT(change, STALLS) += after - before;
        AT(change, TIME) += (after - before) * (1 + near);
        AT(change, UNUSED) += (after == 0) - (before == 0);
    }
    return (double)((side_mm - *at_line(&sizes->actual_mm, axis, line)) * across) / MM2_PER_M2;
}

/* Give a line another side. */
void resize(const Ground *ground, const Sizes *sizes, int64_t axis, int64_t line, int64_t side_mm)
{
    Line squares = line_at(ground, axis, line);
    int64_t *actual = at_line(&sizes->actual_mm, axis, line);
    int64_t longer = side_mm - *actual, across = 0;
    *actual = side_mm;
    *at_line(&sizes->place, axis, line) = place_of(sizes, side_mm);
    for (int64_t index = 0; index < squares.count; index++) {
        int64_t q = squares.first + index * squares.step;
        if (AT(sizes->is_floor, q)) {
            set_capacity(ground, sizes, q);
            across += *at_line(&sizes->actual_mm, 1 - axis, index);
        }
    }
    AT(sizes->area_m2, 0) += (double)(longer * across) / MM2_PER_M2;
}

/* Count where cars drive on some squares. */
static void count_driven(const Ground *ground, const Board *board, const Sizes *sizes, const Int64Row *squares)
{
    for (int64_t index = 0; index < squares->count; index++) {
        int64_t q = squares->at[index];
        if (AT(board->cells, q) < LANE)
            continue;
        int64_t ways = driven_ways(board->cells, ground->stride, q);
        *at_line(&sizes->driven, 0, *at_line(&sizes->line_of, 0, q)) += ways & ALONG_X;
        *at_line(&sizes->driven, 1, *at_line(&sizes->line_of, 1, q)) += ways >> 1;
    }
}

/* Count anew where cars drive, and give every line the side that follows. */
void sync_sides(const Ground *ground, const Board *board, const Sizes *sizes)
{
    if (!is_sized(sizes))
        return;
    for (int64_t index = 0; index < 2 * sizes->driven.columns; index++)
        PLACE(sizes->driven, index) = 0;
    count_driven(ground, board, sizes, &ground->squares);
    count_driven(ground, board, sizes, &ground->portals);
    double *area = &AT(sizes->area_m2, 0);
    bool is_new = *area == 0;
    for (int64_t axis = 0; axis < 2; axis++) {
        if (!AT(sizes->is_chosen, axis))
            continue;
        for (int64_t line = 0; line < lines_along(ground, axis); line++) {
            int64_t side = side_now(sizes, axis, line), *actual = at_line(&sizes->actual_mm, axis, line);
            if (side == *actual)
                continue;
            if (is_new) {
                *actual = side;
                *at_line(&sizes->place, axis, line) = place_of(sizes, side);
            } else {
                resize(ground, sizes, axis, line, side);
            }
        }
    }
    if (!is_new)
        return;
    for (int64_t q = ground->stride; q < board->cells.count - ground->stride; q++) {
        if (!AT(sizes->is_floor, q))
            continue;
        set_capacity(ground, sizes, q);
        int64_t depth = *at_line(&sizes->actual_mm, 0, *at_line(&sizes->line_of, 0, q));
        int64_t width = *at_line(&sizes->actual_mm, 1, *at_line(&sizes->line_of, 1, q));
        *area += (double)(depth * width) / MM2_PER_M2;
    }
}

/* Copy the sides of all lines, shape (2, lines). */
void copy_sides(const Int64Table *target, const Int64Table *source)
{
    for (int64_t index = 0; index < 2 * source->columns; index++)
        target->at[index] = source->at[index];
}

/* Set `hint`, from the hops of the board's lanes. */
void foresee(const Ground *ground, const Board *board, const Sizes *sizes)
{
    for (int64_t axis = 0; axis < 2; axis++) {
        if (!AT(sizes->is_chosen, axis))
            continue;
        for (int64_t line = 0; line < lines_along(ground, axis); line++) {
            bool is_driven = *at_line(&sizes->driven, axis, line) != 0;
            int64_t other = is_driven ? *at_line(&sizes->kept_mm, axis, line) : sizes->aisle_mm;
            other = most(other, *at_line(&sizes->least_mm, axis, line));
            double area = weigh(ground, board, sizes, axis, line, other);
            IN(sizes->hint, axis, line) =
                AT(ground->weights, 0) * (double)AT(sizes->change, STALLS) - AT(sizes->price, 0) * area;
        }
    }
}

/* Choose the side of every line without traffic, one after the other, for most stalls less the price of the floor.
 *
 * The hops of the board are to be those of its lanes. */
void settle(const Ground *ground, const Board *board, const Sizes *sizes, int64_t passes)
{
    sync_sides(ground, board, sizes);
    for (int64_t pass = 0; pass < passes; pass++)
        for (int64_t axis = 0; axis < 2; axis++) {
            if (!AT(sizes->is_chosen, axis))
                continue;
            for (int64_t line = 0; line < lines_along(ground, axis); line++) {
                if (*at_line(&sizes->driven, axis, line) > 0)
                    continue;
                int64_t *kept = at_line(&sizes->kept_mm, axis, line), chosen = *kept;
                int64_t door = *at_line(&sizes->least_mm, axis, line);
                double best = 0.0;
                for (int64_t index = 0; index < sizes->free_mm.count; index++) {
                    int64_t side = AT(sizes->free_mm, index);
                    double area = weigh(ground, board, sizes, axis, line, most(side, door));
                    double gain = (double)AT(sizes->change, STALLS) - AT(sizes->price, 0) * area;
                    if (gain > best + 1e-9) {
                        best = gain;
                        chosen = side;
                    }
                }
                *kept = chosen;
                int64_t side = side_now(sizes, axis, line);
                if (side != *at_line(&sizes->actual_mm, axis, line))
                    resize(ground, sizes, axis, line, side);
            }
        }
}

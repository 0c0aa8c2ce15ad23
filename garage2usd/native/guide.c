/* How far the middle of a rear axle is from the nearest goal round all that stands: Dijkstra over squares of the floor.
 *
 * The disc about that point that lies within the body keeps off everything, so squares whose whole ground lies nearer
 * to a shape are shut: where no square leads to a goal, no way does. */
#include <stdlib.h>

#include "driving.h"

/* Side of a square, where no more than so many lie side by side; else they are wider. */
#define SQUARE_M 0.2
#define MOST_SIDE_BY_SIDE 512
#define HALF_DIAGONAL 0.7071067811865476
#define DIAGONAL 1.4142135623730951

/* A square that is still to be spread from. */
typedef struct {
    double far;
    int64_t square;
} Reached;

/* A binary heap of such squares. */
typedef struct {
    Reached *at;
    int64_t count;
} Heap;

static void add(Heap *heap, Reached added)
{
    int64_t at = heap->count++;
    for (; at > 0 && added.far < heap->at[(at - 1) / 2].far; at = (at - 1) / 2)
        heap->at[at] = heap->at[(at - 1) / 2];
    heap->at[at] = added;
}

static Reached take(Heap *heap)
{
    Reached first = heap->at[0], last = heap->at[--heap->count];
    int64_t at = 0;
    for (int64_t below = 1; below < heap->count; below = 2 * at + 1) {
        if (below + 1 < heap->count && heap->at[below + 1].far < heap->at[below].far)
            below++;
        if (heap->at[below].far >= last.far)
            break;
        heap->at[at] = heap->at[below];
        at = below;
    }
    heap->at[at] = last;
    return first;
}

/* Distance of a point from a convex shape whose corners go round in either sense; 0 inside. */
static double distance_to(const Spot *shape, int64_t count, double x, double z)
{
    double least = INFINITY;
    bool is_left = true, is_right = true;
    for (int64_t corner = 0; corner < count; corner++) {
        Spot from = shape[corner], to = shape[(corner + 1) % count];
        double along_x = to.x - from.x, along_z = to.z - from.z, square = along_x * along_x + along_z * along_z;
        double part = square > 0 ? ((x - from.x) * along_x + (z - from.z) * along_z) / square : 0;
        part = lesser(greater(part, 0), 1);
        least = lesser(least, same_hypot(x - from.x - part * along_x, z - from.z - part * along_z));
        double side = along_x * (z - from.z) - along_z * (x - from.x);
        if (square > 0) {
            is_left = is_left && side >= 0;
            is_right = is_right && side <= 0;
        }
    }
    return is_left || is_right ? 0 : least;
}

/* The first and the last of the rows or columns whose middles lie between two places. */
static int64_t first_within(double low, double side) { return (int64_t)ceil(low / side - 0.5); }
static int64_t last_within(double high, double side) { return (int64_t)floor(high / side - 0.5); }

static void shut(Guide *guide, const Scene *scene, double radius)
{
    int64_t corners = scene->shapes.rows;
    double square = guide->square;
    for (int64_t number = 0; number < scene->shapes.layers; number++) {
        const double *box = scene->boxes.at + number * 4;
        const Spot *shape = (const Spot *)scene->shapes.at + number * corners;
        int64_t left = first_within(box[0] - radius - guide->left, square);
        int64_t right = last_within(box[2] + radius - guide->left, square);
        int64_t low = first_within(box[1] - radius - guide->low, square);
        int64_t high = last_within(box[3] + radius - guide->low, square);
        for (int64_t row = low < 0 ? 0 : low; row <= high && row < guide->side; row++)
            for (int64_t column = left < 0 ? 0 : left; column <= right && column < guide->side; column++) {
                double *far = &guide->far[row * guide->side + column];
                double x = guide->left + (column + 0.5) * square, z = guide->low + (row + 0.5) * square;
                if (*far >= 0 && distance_to(shape, corners, x, z) < radius)
                    *far = -1;
            }
    }
}

/* Spread over a square about a start from goals (heading, least x and z, most x and z); false where there is no
 * memory. */
bool make_guide(Guide *guide, const Scene *scene, Pose start, const DoubleTable *goals, double reach, double margin)
{
    double side = greater(SQUARE_M, 2 * reach / MOST_SIDE_BY_SIDE);
    guide->square = side;
    guide->side = 2 * (int64_t)ceil((reach + side) / side);
    guide->left = start.x - guide->side * side / 2;
    guide->low = start.z - guide->side * side / 2;
    int64_t count = guide->side * guide->side;
    guide->far = malloc(sizeof(double) * (size_t)count);
    Heap heap = {malloc(sizeof(Reached) * (size_t)count * 9), 0};
    if (guide->far == NULL || heap.at == NULL) {
        free(guide->far);
        free(heap.at);
        guide->far = NULL;
        return false;
    }
    for (int64_t square = 0; square < count; square++)
        guide->far[square] = INFINITY;
    const double *body = scene->body.at;
    double radius = lesser(lesser(body[0], body[1]), body[2]) + margin - side * HALF_DIAGONAL;
    if (radius > 0)
        shut(guide, scene, radius);
    for (int64_t number = 0; number < goals->rows; number++) {
        const double *goal = goals->at + number * 5;
        for (int64_t row = 0; row < guide->side; row++)
            for (int64_t column = 0; column < guide->side; column++) {
                double x = guide->left + column * side, z = guide->low + row * side;
                bool is_in = x <= goal[3] && x + side >= goal[1] && z <= goal[4] && z + side >= goal[2];
                int64_t square = row * guide->side + column;
                if (is_in && guide->far[square] > 0) {
                    guide->far[square] = 0;
                    add(&heap, (Reached){0, square});
                }
            }
    }
    while (heap.count > 0) {
        Reached from = take(&heap);
        if (from.far > guide->far[from.square])
            continue;
        int64_t row = from.square / guide->side, column = from.square % guide->side;
        for (int64_t down = -1; down <= 1; down++)
            for (int64_t right = -1; right <= 1; right++) {
                if (row + down < 0 || row + down >= guide->side || column + right < 0 || column + right >= guide->side)
                    continue;
                int64_t next = (row + down) * guide->side + column + right;
                double far = from.far + (down != 0 && right != 0 ? DIAGONAL : 1) * side;
                if (far < guide->far[next]) {
                    guide->far[next] = far;
                    add(&heap, (Reached){far, next});
                }
            }
    }
    free(heap.at);
    return true;
}

/* Way from a place to the nearest goal, INFINITY where there is none. */
double guided_way(const Guide *guide, double x, double z)
{
    int64_t column = (int64_t)floor((x - guide->left) / guide->square);
    int64_t row = (int64_t)floor((z - guide->low) / guide->square);
    if (row < 0 || column < 0 || row >= guide->side || column >= guide->side)
        return INFINITY;
    double far = guide->far[row * guide->side + column];
    return far < 0 ? INFINITY : far;
}

/* The cells of a raster that a car covers, for garage2usd.traffic.ground. */
#include "driving.h"
#include <math.h>

/* Poses of a car: (x, z, sine and cosine of the yaw) each, and up to two layers each, of which the second may repeat
 * the first. A slice has the poses from `step` times its number on, one more than `step`, so that slices share ends. */
typedef struct {
    DoubleTable poses;
    Int64Table layers;
    int64_t step;
} Slices;

/* Layers: least column and row, numbers of columns and rows, and number of the first cell, in turn; and the size of a
 * cell in metres. */
typedef struct {
    Int64Table of;
    double cell_m;
} Layers;

/* Where the cells of each slice end, and the cells. */
typedef struct {
    Int64Row ends;
    Int64Row cells;
} Found;

static bool covers(const Slices *slices, int64_t pose, double x, double z, double ahead, double behind, double half)
{
    double sine = IN(slices->poses, pose, 2), cosine = IN(slices->poses, pose, 3);
    double away_x = x - IN(slices->poses, pose, 0), away_z = z - IN(slices->poses, pose, 1);
    double forward = -sine * away_x - cosine * away_z, left = -cosine * away_x + sine * away_z;
    return forward <= ahead && forward >= -behind && fabs(left) <= half;
}

/* Write the cells whose middles a rectangle covers at some pose of a slice, ascending, and where each slice ends; the
 * rectangle reaches `ahead` and `behind` its origin and `half` aside. Returns their number; cells beyond the room that
 * `found` has are counted, not written. */
FROM_PYTHON int64_t write_cells(const Slices *slices, const Layers *layers, double ahead, double behind, double half,
                                Found *found)
{
    int64_t count = 0, step = slices->step;
    double farther = greater(ahead, behind), reach = sqrt(farther * farther + half * half);
    for (int64_t slice = 0; slice < found->ends.count; slice++) {
        int64_t first = slice * step, done = -1;
        for (;;) {
            int64_t layer = INT64_MAX; /* the next one of the slice's layers */
            for (int64_t pose = first; pose <= first + step; pose++)
                for (int64_t either = 0; either < 2; either++) {
                    int64_t own = IN(slices->layers, pose, either);
                    layer = own > done && own < layer ? own : layer;
                }
            if (layer == INT64_MAX)
                break;
            done = layer;
            double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
            for (int64_t pose = first; pose <= first + step; pose++)
                if (IN(slices->layers, pose, 0) == layer || IN(slices->layers, pose, 1) == layer)
                    for (int64_t axis = 0; axis < 2; axis++) {
                        low[axis] = lesser(low[axis], IN(slices->poses, pose, axis) - reach);
                        high[axis] = greater(high[axis], IN(slices->poses, pose, axis) + reach);
                    }
            int64_t from[2], to[2];
            for (int64_t axis = 0; axis < 2; axis++) {
                int64_t least = IN(layers->of, layer, axis), most = least + IN(layers->of, layer, 2 + axis) - 1;
                from[axis] = (int64_t)greater(floor(low[axis] / layers->cell_m), (double)least);
                to[axis] = (int64_t)lesser(ceil(high[axis] / layers->cell_m), (double)most);
            }
            for (int64_t row = from[1]; row <= to[1]; row++)
                for (int64_t col = from[0]; col <= to[0]; col++)
                    for (int64_t pose = first; pose <= first + step; pose++) {
                        bool own = IN(slices->layers, pose, 0) == layer || IN(slices->layers, pose, 1) == layer;
                        double x = (double)col * layers->cell_m, z = (double)row * layers->cell_m;
                        if (!own || !covers(slices, pose, x, z, ahead, behind, half))
                            continue;
                        if (count < found->cells.count)
                            AT(found->cells, count) =
                                IN(layers->of, layer, 4) +
                                (row - IN(layers->of, layer, 1)) * IN(layers->of, layer, 2) + col -
                                IN(layers->of, layer, 0);
                        count++;
                        break;
                    }
        }
        AT(found->ends, slice) = count;
    }
    return count;
}

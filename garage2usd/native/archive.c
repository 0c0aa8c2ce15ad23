/* The archive: the best distinct plans met, each with the way that led to it; and random numbers. */
#include "planning.h"

/* The last steps of splitmix64 (Steele, Lea and Flood 2014), in which every bit of a number comes to touch every other.
 */
static uint64_t mixed(uint64_t z)
{
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return z ^ (z >> 31);
}

/* Draw by splitmix64: the same numbers on every machine. */
uint64_t next_random(uint64_t *random)
{
    *random += UINT64_C(0x9E3779B97F4A7C15);
    return mixed(*random);
}

/* Hash of one square; a set of squares has the exclusive or of its members'. */
static uint64_t square_key(int64_t square)
{
    return mixed((uint64_t)(square + 1) * UINT64_C(0x9E3779B97F4A7C15));
}

/* Keep a plan if it is new and better than the worst kept.
 *
 * `laid` are its lanes, `tape` the actions that lead to it from `start`. */
void keep(Archive *archive, const int64_t *laid, int64_t lanes, double value, const int8_t *tape, int64_t steps,
          int64_t start)
{
    Int64Row count = archive->in_use;
    int64_t size = archive->values.count;
    DoubleRow values = archive->values;
    bool full = AT(count, 0) == size;
    if (full && value <= AT(values, AT(count, 1)))
        return;
    uint64_t key = 0;
    for (int64_t index = 0; index < lanes; index++)
        key ^= square_key(laid[index]);
    for (int64_t index = 0; index < AT(count, 0); index++)
        if (AT(archive->keys, index) == key)
            return;
    int64_t place = full ? AT(count, 1) : AT(count, 0);
    AT(count, 0) = least(AT(count, 0) + 1, size);
    AT(values, place) = value;
    AT(archive->keys, place) = key;
    bool *is_lane = archive->lanes.at + place * archive->lanes.columns;
    for (int64_t q = 0; q < archive->lanes.columns; q++)
        is_lane[q] = false;
    for (int64_t index = 0; index < lanes; index++)
        is_lane[laid[index]] = true;
    AT(archive->starts, place) = start;
    AT(archive->lengths, place) = steps;
    for (int64_t index = 0; index < steps; index++)
        IN(archive->tapes, place, index) = tape[index];
    if (AT(count, 0) == size) {
        AT(count, 1) = 0;
        for (int64_t entry = 0; entry < size; entry++)
            if (AT(values, entry) < AT(values, AT(count, 1)))
                AT(count, 1) = entry;
    }
}

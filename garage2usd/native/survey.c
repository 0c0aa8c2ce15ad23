/* The survey of circulation: dead ends by pruning (k-core decomposition, Seidman 1983), loops by the circuit rank
 * E - V + 1, blocks of two by two lanes, and stretches without a junction. */
#include "planning.h"

/* Count where lanes break the rules of circulation; garage2usd.planning.circulation says what is counted.
 *
 * A round of pruning takes off all lanes with at most one neighbour, portals being neighbours that stay (k-core
 * decomposition, Seidman 1983, for k = 2 with the portals held). Without stretches, those lanes keep the state 2. */
void survey(const int64_t *squares, int64_t count, int64_t stride, const int8_t *cells, int32_t *state, int64_t *queue,
            int64_t dead_end_squares, int64_t stretch_squares, Survey *found)
{
    const int64_t steps[4] = STEPS_BESIDE(stride);
    int64_t lanes = 0, edges = 0, blocks = 0, head = 0, tail = 0;
    for (int64_t index = 0; index < count; index++) {
        int64_t q = squares[index];
        if (cells[q] != LANE)
            continue;
        lanes++;
        bool right = cells[q + 1] == LANE, lower = cells[q + stride] == LANE;
        edges += right + lower;
        blocks += right && lower && cells[q + stride + 1] == LANE;
        int32_t neighbours = 0;
        for (int way = 0; way < 4; way++)
            neighbours += cells[q + steps[way]] >= LANE;
        state[q] = neighbours;
        if (neighbours < 2)
            queue[tail++] = q;
    }
    int64_t rounds = 0, deep = 0;
    while (head < tail) {
        rounds++;
        int64_t last = tail;
        while (head < last) {
            int64_t q = queue[head++];
            state[q] = (int32_t)-rounds;
            deep += rounds > dead_end_squares;
            for (int way = 0; way < 4; way++) {
                int64_t p = q + steps[way];
                if (cells[p] == LANE && state[p] > 1) {
                    state[p]--;
                    if (state[p] == 1)
                        queue[tail++] = p;
                }
            }
        }
    }
    int64_t excess = 0;
    if (stretch_squares > 0)
        for (int64_t index = 0; index < count; index++) {
            int64_t first = squares[index];
            if (cells[first] != LANE || state[first] != 2)
                continue;
            queue[0] = first;
            state[first] = STRETCH;
            head = 0;
            tail = 1;
            while (head < tail) {
                int64_t q = queue[head++];
                for (int way = 0; way < 4; way++) {
                    int64_t p = q + steps[way];
                    if (cells[p] == LANE && state[p] == 2) {
                        state[p] = STRETCH;
                        queue[tail++] = p;
                    }
                }
            }
            for (int64_t place = 0; place < tail; place++)
                state[queue[place]] = (int32_t)(STRETCH + tail);
            excess += most(0, tail - stretch_squares);
        }
    found->deep = deep;
    found->loops = edges - lanes + 1 - blocks;
    found->blocks = blocks;
    found->excess = excess;
}

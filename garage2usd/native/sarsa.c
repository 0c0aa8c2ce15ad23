/* Episodes of tabular Sarsa: an agent drives over the site and colours lanes. */
#include <stddef.h>

#include "planning.h"

/* Up, down, left, right, stay. */
enum { STAY = 4, ACTIONS = 5 };

/* garage2usd.planning.sarsa.Memory */
typedef struct {
    UInt64Row keys;
    FloatTable q;
    Int64Row used;
    DoubleRow course;
    UInt64Row last;
} Memory;

/* garage2usd.planning.sarsa.Room */
typedef struct {
    Int64Row moves;
    BoolRow allowed;
    Int8Row tape;
    Int64Row laid;
} SarsaRoom;

/* Row of a state, a new one if it was never met. */
static int64_t row_of(Memory *memory, uint64_t key)
{
    uint64_t *keys = memory->keys.at, mask = (uint64_t)memory->keys.count - 1;
    uint64_t place = (key ^ (key >> 32)) & mask;
    while (keys[place] != key) {
        if (keys[place] == 0) {
            keys[place] = key;
            memory->used.at[0]++;
            break;
        }
        place = (place + 1) & mask;
    }
    return (int64_t)place;
}

/* Values of the five actions in a state. */
static float *values_of(const Memory *memory, int64_t row) { return memory->q.at + row * ACTIONS; }

/* Put all that a table holds into an empty one. */
FROM_PYTHON
void carry_over(const Memory *memory, Memory *larger)
{
    for (int64_t row = 0; row < memory->keys.count; row++) {
        if (memory->keys.at[row] == 0)
            continue;
        const float *from = values_of(memory, row);
        float *to = values_of(larger, row_of(larger, memory->keys.at[row]));
        for (int action = 0; action < ACTIONS; action++)
            to[action] = from[action];
    }
}

/* Hash of the state S_t = (D, M, A_{t-1}). */
FROM_PYTHON
uint64_t observe(const Ground *ground, const Board *board, const SarsaParameters *parameters, int64_t square,
                 int64_t previous)
{
    const uint64_t prime = UINT64_C(0x9E3779B97F4A7C15);
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    const int8_t *cells = board->cells.at;
    int64_t radius = parameters->window_radius_squares;
    uint64_t key = (uint64_t)(previous + 1) << 32; /* above the squares of any row of M */
    for (int64_t row = -radius; row <= radius; row++) {
        uint64_t packed = 0;
        int64_t first = square + row * ground->stride - radius;
        for (int64_t q = first; q <= first + 2 * radius; q++)
            packed = (packed << 3) | (uint64_t)(cells[q] + 1);
        key = (key ^ packed) * prime;
        key ^= key >> 29;
    }
    if (parameters->sees_distances) {
        uint64_t packed = 0;
        for (int way = 0; way < 4; way++) {
            int64_t q = square + steps[way];
            uint64_t far = 0;
            while (cells[q] == FREE || cells[q] == LANE) {
                q += steps[way];
                far++;
            }
            packed = (packed << 12) | far;
        }
        key = (key ^ packed) * prime;
        key ^= key >> 31;
    }
    return key | 1;
}

/* An epsilon-greedy action: greedy with probability 1 - epsilon + epsilon / |A|. */
static int64_t choose(const float *values, const bool *allowed, double epsilon, uint64_t *random)
{
    int64_t count = 0;
    for (int64_t action = 0; action < ACTIONS; action++)
        count += allowed[action];
    if (uniform(random) < epsilon) {
        int64_t nth = below(random, count);
        for (int64_t action = 0; action < ACTIONS; action++)
            if (allowed[action] && nth-- == 0)
                return action;
    }
    int64_t first = (int64_t)(next_random(random) % ACTIONS), best = -1;
    double top = -INFINITY;
    for (int64_t offset = 0; offset < ACTIONS; offset++) {
        int64_t place = (first + offset) % ACTIONS;
        if (allowed[place] && values[place] > top) {
            best = place;
            top = values[place];
        }
    }
    return best;
}

/* Move the value of an action towards what it is found to be worth; in double precision until it is kept. */
static void move_towards(float *value, double alpha, double target) { *value += alpha * (target - *value); }

/* Run the episodes from `first` to below `last`, or fewer when the table fills up; returns the first that was not run,
 * and adds up in `taken` how many actions were taken.
 *
 * q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t)). `curve` takes the paper's
 * E = sum_{t=1}^{T-1} R_t of each episode, without the R_T of a failure. */
FROM_PYTHON
int64_t learn(const Ground *ground, Board *board, const SarsaParameters *parameters, Memory *memory, Archive *archive,
              SarsaRoom *room, uint64_t *random, double *curve, int64_t first, int64_t last, int64_t *taken)
{
    const SarsaParameters *p = parameters;
    const int8_t *cells = board->cells.at;
    const int64_t *moves = room->moves.at, *tally = board->tally.at;
    bool *allowed = room->allowed.at;
    int8_t *tape = room->tape.at;
    int64_t *laid = room->laid.at;
    int64_t max_steps = least(p->max_steps_per_square * ground->squares.count, room->tape.count);
    double epsilon = memory->course.at[0], unchanged = memory->course.at[1];
    int64_t episode = first;
    for (; episode < last; episode++) {
        if (2 * (memory->used.at[0] + max_steps) > memory->keys.count)
            break;
        clear(ground, board);
        int64_t start = ground->entrances.at[next_random(random) % (uint64_t)ground->entrances.count];
        int64_t position = start, run = 0, lanes = 0, step = 0, previous = STAY;
        /* go on from part of an archived episode */
        if (archive->in_use.at[0] > 0 && uniform(random) < p->revisit_rate) {
            uint64_t count = (uint64_t)archive->in_use.at[0];
            int64_t entry = (int64_t)(next_random(random) % count);
            int64_t rival = (int64_t)(next_random(random) % count);
            if (archive->values.at[rival] > archive->values.at[entry])
                entry = rival;
            start = archive->starts.at[entry];
            position = start;
            double share = uniform(random);
            step = (int64_t)(share * (double)archive->lengths.at[entry]);
            for (int64_t index = 0; index < step; index++) {
                int8_t action = archive->tapes.at[entry * archive->tapes.columns + index];
                tape[index] = action;
                position += moves[action];
                if (cells[position] == FREE) {
                    lay(ground, board, position);
                    laid[lanes++] = position;
                }
                run = action == previous ? run + 1 : 1;
                previous = action;
            }
        }
        double best_value = NO_VALUE;
        int64_t best_lanes = 0, best_step = 0;
        double earned = (double)tally[STALLS], reward = 0.0;
        float *old = NULL, *value = NULL; /* of the action before the last, and of the last */
        bool done = false;
        while (step < max_steps && !done) {
            if (p->masks_actions) {
                bool walled_in = true;
                for (int way = 0; way < 4; way++) {
                    int8_t beside = cells[position + moves[way]];
                    allowed[way] = beside == FREE || beside == LANE;
                    walled_in &= !allowed[way];
                }
                allowed[STAY] = false;
                if (walled_in)
                    break;
            }
            float *values = values_of(memory, row_of(memory, observe(ground, board, p, position, previous)));
            int64_t action = choose(values, allowed, epsilon, random);
            value = values + action;
            if (old != NULL)
                move_towards(old, p->alpha, reward + p->gamma * *value);
            int64_t target = position + moves[action];
            int8_t kind = cells[target];
            reward = -p->step_penalty;
            bool failed = false;
            if (action == STAY) {
                done = position == start;
                reward -= p->step_penalty;
            } else if (position == start && previous != STAY) {
                failed = true; /* having come back to the start, only staying is left */
            } else if (kind == FREE || kind == LANE || target == start) {
                if (previous != STAY && previous == (action ^ 1))
                    reward -= p->turn_back_penalty;
                else if (previous != STAY && previous != action && run < p->min_run_squares)
                    reward -= p->interval_penalty;
                if (kind == FREE) {
                    int64_t beside = 0;
                    for (int way = 0; way < 4; way++)
                        beside += cells[target + moves[way]] == LANE;
                    reward -= p->wheeling_penalty * (double)most(0, beside - 1);
                    reward += p->loop_reward * (beside > 1);
                    int64_t stalls = tally[STALLS];
                    lay(ground, board, target);
                    laid[lanes++] = target;
                    reward += (double)(tally[STALLS] - stalls);
                }
                run = action == previous ? run + 1 : 1;
                position = target;
            } else {
                failed = true;
            }
            ++*taken;
            if (failed) {
                move_towards(value, p->alpha, -p->failure_penalty);
                value = NULL;
                break;
            }
            tape[step++] = (int8_t)action;
            previous = action;
            earned += reward;
            old = value;
            if (p->archives_prefixes && kind == FREE && tally[UNTOUCHED] == 0) {
                double worth = value_now(ground, board);
                if (worth > best_value)
                    worth -= faults_cost(ground, board);
                if (worth > best_value) {
                    best_value = worth;
                    best_lanes = lanes;
                    best_step = step;
                }
            }
        }
        if (value != NULL)
            move_towards(value, p->alpha, reward);
        if (!p->archives_prefixes && tally[UNTOUCHED] == 0) {
            best_value = value_now(ground, board) - faults_cost(ground, board);
            best_lanes = lanes;
            best_step = step;
        }
        if (best_value > NO_VALUE)
            keep(archive, laid, best_lanes, best_value, tape, best_step, start);
        curve[episode] = earned;
        uint64_t key = 0;
        for (int64_t index = 0; index < lanes; index++)
            key ^= (uint64_t)(laid[index] * laid[index] + 1) * UINT64_C(0xBF58476D1CE4E5B9);
        unchanged = key == memory->last.at[0] ? unchanged + 1 : 0.0;
        memory->last.at[0] = key;
        epsilon *= p->epsilon_decay;
        if (epsilon < p->epsilon_min)
            epsilon = p->epsilon_min;
        if (unchanged >= (double)p->patience_episodes) {
            epsilon = p->epsilon_refresh;
            unchanged = 0.0;
        }
    }
    memory->course.at[0] = epsilon;
    memory->course.at[1] = unchanged;
    return episode;
}

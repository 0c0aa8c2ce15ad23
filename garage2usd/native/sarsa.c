/* Tabular Sarsa (Sutton and Barto, Reinforcement Learning, 2nd ed., 6.4): an agent drives over the site and colours
 * lanes. */
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
            AT(memory->used, 0)++;
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
        if (AT(memory->keys, row) == 0)
            continue;
        const float *from = values_of(memory, row);
        float *to = values_of(larger, row_of(larger, AT(memory->keys, row)));
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
    const Int8Row cells = board->cells;
    int64_t radius = parameters->window_radius_squares;
    uint64_t key = (uint64_t)(previous + 1) << 32; /* above the squares of any row of M */
    for (int64_t row = -radius; row <= radius; row++) {
        uint64_t packed = 0;
        int64_t first = square + row * ground->stride - radius;
        for (int64_t q = first; q <= first + 2 * radius; q++)
            packed = (packed << 3) | (uint64_t)(AT(cells, q) + 1);
        key = (key ^ packed) * prime;
        key ^= key >> 29;
    }
    if (parameters->sees_distances) {
        uint64_t packed = 0;
        for (int way = 0; way < 4; way++) {
            int64_t q = square + steps[way];
            uint64_t far = 0;
            while (AT(cells, q) == FREE || AT(cells, q) == LANE) {
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

/* Where the agent learns, and from what. */
typedef struct {
    const Ground *ground;
    Board *board;
    const SarsaParameters *parameters;
    Memory *memory;
    Archive *archive;
    SarsaRoom *room;
    uint64_t *random;
} Learning;

/* An episode under way. */
typedef struct {
    int64_t start;
    int64_t position;
    int64_t previous; /* A_{t-1} */
    int64_t run;      /* moves in a row in its direction */
    int64_t steps;    /* actions on the tape */
    int64_t lanes;    /* squares laid */
    double reward;    /* R_t */
    double earned;    /* E = sum_{t=1}^{T-1} R_t */
    float *value;     /* q(S_{t-1}, A_{t-1}); NULL before the first action and after a failure */
    bool is_over;
    double best_value; /* of the prefix that is archived, and its lanes and actions */
    int64_t best_lanes;
    int64_t best_steps;
} Episode;

/* Colour the square that the agent enters. */
static void colour(Learning *learning, Episode *episode)
{
    lay(learning->ground, learning->board, episode->position);
    AT(learning->room->laid, episode->lanes++) = episode->position;
}

/* Begin an episode at an entrance, or replay part of an archived one: the better of two drawn, up to a step drawn. */
static Episode replay(Learning *learning)
{
    const Archive *archive = learning->archive;
    uint64_t *random = learning->random;
    Int64Row entrances = learning->ground->entrances;
    clear(learning->ground, learning->board);
    Episode episode = {.previous = STAY, .best_value = NO_VALUE};
    episode.start = AT(entrances, (int64_t)(next_random(random) % (uint64_t)entrances.count));
    episode.position = episode.start;
    if (AT(archive->in_use, 0) > 0 && uniform(random) < learning->parameters->revisit_rate) {
        uint64_t count = (uint64_t)AT(archive->in_use, 0);
        int64_t entry = (int64_t)(next_random(random) % count);
        int64_t rival = (int64_t)(next_random(random) % count);
        if (AT(archive->values, rival) > AT(archive->values, entry))
            entry = rival;
        episode.start = AT(archive->starts, entry);
        episode.position = episode.start;
        double share = uniform(random);
        int64_t steps = (int64_t)(share * (double)AT(archive->lengths, entry));
        while (episode.steps < steps) {
            int8_t action = IN(archive->tapes, entry, episode.steps);
            AT(learning->room->tape, episode.steps++) = action;
            episode.position += AT(learning->room->moves, action);
            if (AT(learning->board->cells, episode.position) == FREE)
                colour(learning, &episode);
            episode.run = action == episode.previous ? episode.run + 1 : 1;
            episode.previous = action;
        }
    }
    episode.earned = (double)AT(learning->board->tally, STALLS);
    return episode;
}

/* Choose A_t by the policy; returns q(S_t, A_t) in the table, NULL where the agent is walled in. */
static float *act(Learning *learning, const Episode *episode, int64_t *action)
{
    const SarsaParameters *p = learning->parameters;
    BoolRow allowed = learning->room->allowed;
    if (p->masks_actions) {
        bool walled_in = true;
        for (int64_t way = 0; way < 4; way++) {
            int8_t beside = AT(learning->board->cells, episode->position + AT(learning->room->moves, way));
            AT(allowed, way) = beside == FREE || beside == LANE;
            walled_in &= !AT(allowed, way);
        }
        AT(allowed, STAY) = false;
        if (walled_in)
            return NULL;
    }
    uint64_t state = observe(learning->ground, learning->board, p, episode->position, episode->previous);
    float *values = values_of(learning->memory, row_of(learning->memory, state));
    *action = choose(values, allowed.at, AT(learning->memory->course, 0), learning->random);
    return values + *action;
}

/* Take an action: R_{t+1} and S_{t+1}; false if it fails. */
static bool reward(Learning *learning, Episode *episode, int64_t action)
{
    const SarsaParameters *p = learning->parameters;
    Int8Row cells = learning->board->cells;
    Int64Row moves = learning->room->moves, tally = learning->board->tally;
    int64_t position = episode->position, previous = episode->previous, start = episode->start;
    int64_t target = position + AT(moves, action);
    int8_t kind = AT(cells, target);
    double gained = -p->step_penalty;
    if (action == STAY) {
        episode->is_over = position == start;
        gained -= p->step_penalty;
    } else if (position == start && previous != STAY) {
        return false; /* having come back to the start, only staying is left */
    } else if (kind == FREE || kind == LANE || target == start) {
        if (previous != STAY && previous == (action ^ 1))
            gained -= p->turn_back_penalty;
        else if (previous != STAY && previous != action && episode->run < p->min_run_squares)
            gained -= p->interval_penalty;
        episode->position = target;
        if (kind == FREE) {
            int64_t beside = 0;
            for (int64_t way = 0; way < 4; way++)
                beside += AT(cells, target + AT(moves, way)) == LANE;
            gained -= p->wheeling_penalty * (double)most(0, beside - 1);
            gained += p->loop_reward * (beside > 1);
            int64_t stalls = AT(tally, STALLS);
            colour(learning, episode);
            gained += (double)(AT(tally, STALLS) - stalls);
        }
        episode->run = action == previous ? episode->run + 1 : 1;
    } else {
        return false;
    }
    AT(learning->room->tape, episode->steps++) = (int8_t)action;
    episode->previous = action;
    episode->reward = gained;
    episode->earned += gained;
    return true;
}

/* Note the plan that the agent has come to, if none on its way was better. */
static void note(Learning *learning, Episode *episode)
{
    if (AT(learning->board->tally, UNTOUCHED) > 0)
        return;
    double value = value_now(learning->ground, learning->board);
    if (value > episode->best_value)
        value -= faults_cost(learning->ground, learning->board);
    if (value > episode->best_value) {
        episode->best_value = value;
        episode->best_lanes = episode->lanes;
        episode->best_steps = episode->steps;
    }
}

/* End an episode: learn from its last action, archive its plan, and move epsilon. */
static void finish(Learning *learning, Episode *episode)
{
    const SarsaParameters *p = learning->parameters;
    Int64Row laid = learning->room->laid;
    DoubleRow course = learning->memory->course;
    if (episode->value != NULL)
        move_towards(episode->value, p->alpha, episode->reward);
    if (!p->archives_prefixes)
        note(learning, episode);
    if (episode->best_value > NO_VALUE)
        keep(learning->archive, laid.at, episode->best_lanes, episode->best_value, learning->room->tape.at,
             episode->best_steps, episode->start);
    uint64_t key = 0;
    for (int64_t index = 0; index < episode->lanes; index++)
        key ^= (uint64_t)(AT(laid, index) * AT(laid, index) + 1) * UINT64_C(0xBF58476D1CE4E5B9);
    double unchanged = key == AT(learning->memory->last, 0) ? AT(course, 1) + 1 : 0.0;
    AT(learning->memory->last, 0) = key;
    double epsilon = AT(course, 0) * p->epsilon_decay;
    if (epsilon < p->epsilon_min)
        epsilon = p->epsilon_min;
    if (unchanged >= (double)p->patience_episodes) {
        epsilon = p->epsilon_refresh;
        unchanged = 0.0;
    }
    AT(course, 0) = epsilon;
    AT(course, 1) = unchanged;
}

/* Run the episodes from `first` to below `last`, or fewer when the table fills up; returns the first that was not run,
 * and adds up in `taken` how many actions were taken.
 *
 * Sarsa: on-policy control by temporal differences (Sutton and Barto, Reinforcement Learning, 2nd ed., 6.4),
 * q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t)). `curve` takes the paper's
 * E = sum_{t=1}^{T-1} R_t of each episode, without the R_T of a failure. */
FROM_PYTHON
int64_t learn(const Ground *ground, Board *board, const SarsaParameters *parameters, Memory *memory, Archive *archive,
              SarsaRoom *room, uint64_t *random, double *curve, int64_t first, int64_t last, int64_t *taken)
{
    Learning learning = {ground, board, parameters, memory, archive, room, random};
    const SarsaParameters *p = parameters;
    int64_t max_steps = least(p->max_steps_per_square * ground->squares.count, room->tape.count), number = first;
    for (; number < last && 2 * (AT(memory->used, 0) + max_steps) <= memory->keys.count; number++) {
        Episode episode = replay(&learning);
        while (episode.steps < max_steps && !episode.is_over) {
            int64_t action, lanes = episode.lanes;
            float *value = act(&learning, &episode, &action);
            if (value == NULL)
                break;
            if (episode.value != NULL)
                move_towards(episode.value, p->alpha, episode.reward + p->gamma * *value);
            episode.value = value;
            ++*taken;
            if (!reward(&learning, &episode, action)) {
                move_towards(value, p->alpha, -p->failure_penalty);
                episode.value = NULL;
                break;
            }
            if (p->archives_prefixes && episode.lanes > lanes)
                note(&learning, &episode);
        }
        finish(&learning, &episode);
        curve[number] = episode.earned;
    }
    return number;
}

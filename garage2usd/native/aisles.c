/* Sarsa (Sutton and Barto, Reinforcement Learning, 2nd ed., 6.4) over aisles: the agent sweeps the site and decides
 * over whole aisles instead of squares. */
#include "planning.h"

/* What becomes of a run, and what tells its states apart; see garage2usd.planning.aisles. */
enum { SKIPPED = 0, WHOLE = 1, SHORTENED = 2, EVEN_PART = 3, OPTIONS = 4 };
enum { PROFILES = 9, SHARES = 2, AHEAD = 4 };
/* Of the squares of a run that has one profile all along, but for an obstacle or two. Not measured. */
#define EVEN_SHARE 0.8
/* Runs of an archived plan that one episode decides anew: some rows of stalls with their aisles. Not measured. */
#define LONGEST_PART 8

/* garage2usd.planning.aisles.Runs */
typedef struct {
    Int64Row first;
    Int64Row length;
    Int64Row ahead;
    Int64Row turned;
    Int64Cube spines;
} Runs;

/* garage2usd.planning.aisles.Room */
typedef struct {
    Int64Row states;
    Int64Row options;
    DoubleRow rewards;
    Int8Row tape;
    Int64Row profiles;
    Int64Row counts;
    Int64Row ahead;
    Int64Row laid;
} AislesRoom;

/* What lies behind a square: 0 to 3 squares or more up to a wall, or 4 to 8 for 0 to 4 squares up to a lane.
 *
 * More than four free squares count as a lane behind four. */
static int64_t profile_of(Int8Row cells, int64_t square, int64_t across)
{
    int64_t gap = 0, q = square - across;
    while (AT(cells, q) == FREE && gap < 4) {
        gap++;
        q -= across;
    }
    if (AT(cells, q) == LANE)
        return 4 + gap;
    return AT(cells, q) != FREE ? least(gap, 3) : 8;
}

/* Where a row of numbers is greatest first. */
static int64_t commonest(const int64_t *counts, int64_t length)
{
    int64_t place = 0;
    for (int64_t other = 0; other < length; other++)
        if (counts[other] > counts[place])
            place = other;
    return place;
}

/* State of a run, the same on every site, and its most frequent profile. */
static int64_t state_of(Int8Row cells, int64_t first, int64_t length, int64_t along, int64_t across,
                        AislesRoom *room, int64_t *usual)
{
    Int64Row profiles = room->profiles, counts = room->counts, ahead = room->ahead;
    for (int64_t profile = 0; profile < PROFILES; profile++)
        AT(counts, profile) = 0;
    for (int64_t far = 0; far < AHEAD; far++)
        AT(ahead, far) = 0;
    for (int64_t index = 0; index < length; index++) {
        int64_t q = first + index * along;
        AT(profiles, index) = profile_of(cells, q, across);
        AT(counts, AT(profiles, index))++;
        int64_t far = 0;
        while (far < AHEAD - 1 && AT(cells, q + (far + 1) * across) == FREE)
            far++;
        AT(ahead, far)++;
    }
    *usual = commonest(counts.at, PROFILES);
    bool even = (double)AT(counts, *usual) > EVEN_SHARE * (double)length;
    return (*usual * SHARES + even) * AHEAD + commonest(ahead.at, AHEAD);
}

/* Make all free squares of a run lanes; what the stalls and unused squares beside it gain. */
static double lay_run(const Ground *ground, Board *board, int64_t first, int64_t last, int64_t along, int64_t across)
{
    Int8Row cells = board->cells;
    const DoubleRow weights = ground->weights;
    double gain = 0.0;
    for (int sign = -1; sign <= 1; sign += 2) {
        for (int64_t q = first - along; q <= last + along; q += along)
            for (int64_t p = q - across; p <= q + across; p += across)
                if (AT(cells, p) == FREE) {
                    int64_t near, stalls = stalls_at(ground, board, p, &near);
                    gain += sign * (AT(weights, 0) * (double)stalls + (stalls == 0 ? AT(weights, 2) : 0.0));
                }
        if (sign < 0)
            for (int64_t q = first; q <= last; q += along)
                if (AT(cells, q) == FREE)
                    AT(cells, q) = LANE;
    }
    return gain;
}

/* Run the episodes from `first` to below `last`; returns how many decisions were taken.
 *
 * With `enough` plans in the archive none is valued any more, as where nothing but what is learnt is asked for.
 * `schedule` holds epsilon and alpha, each followed by its factor after an episode; both are moved on.
 * q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t)) as over squares, with options for actions:
 * what becomes of a run. Direction, and the run that joins the aisles across, take turns. The reward is the increment
 * of k_1 N_S + k_3 U_S, per square of the run. What stays apart is joined by repair. */
FROM_PYTHON
int64_t learn_aisles(const Ground *ground, Board *board, const Runs *runs, const SarsaParameters *parameters,
                     double *values, Archive *archive, AislesRoom *room, uint64_t *random, double *curve,
                     double *schedule, int64_t first, int64_t last, int64_t enough)
{
    double epsilon = schedule[0], alpha = schedule[2];
    Int64Row states = room->states, options = room->options, laid = room->laid;
    const Int64Row profiles = room->profiles;
    DoubleRow rewards = room->rewards;
    int64_t taken = 0;
    for (int64_t episode = first; episode < last; episode++) {
        clear(ground, board);
        /* most episodes decide part of an archived one anew */
        int64_t entry = -1, part_begin = 0, part_end = runs->first.count;
        if (AT(archive->in_use, 0) > 0 && uniform(random) < parameters->revisit_rate) {
            entry = below(random, AT(archive->in_use, 0));
            int64_t rival = below(random, AT(archive->in_use, 0));
            if (AT(archive->values, rival) > AT(archive->values, entry))
                entry = rival;
        }
        /* only what is decided anew is explored; whole episodes follow what is learnt on other sites */
        double explored = entry >= 0 || parameters->revisit_rate == 0 ? epsilon : 0.0;
        /* direction and the aisle across it */
        int64_t choice = entry >= 0 ? AT(archive->starts, entry) : episode % (2 * runs->spines.rows);
        int64_t direction = choice % 2, place = choice / 2;
        int64_t along = direction == 0 ? 1 : ground->stride, across = direction == 0 ? ground->stride : 1;
        double earned = 0.0;
        const int64_t *spines = runs->spines.at + (direction * runs->spines.rows + place) * runs->spines.columns;
        for (int64_t number = 0; number < runs->spines.columns && spines[number] >= 0; number++) {
            int64_t head = AT(runs->first, spines[number]);
            int64_t tip = head + (AT(runs->length, spines[number]) - 1) * across;
            earned += lay_run(ground, board, head, tip, across, along);
        }
        int64_t begin = direction == 0 ? 0 : AT(runs->turned, 0), end = AT(runs->turned, direction);
        if (entry >= 0) {
            part_begin = begin + below(random, end - begin);
            part_end = part_begin + 1 + below(random, LONGEST_PART);
        }
        for (int64_t run = begin; run < end; run++) {
            int64_t head = AT(runs->first, run), length = AT(runs->length, run), usual;
            int64_t state = state_of(board->cells, head, length, along, across, room, &usual);
            int64_t option = below(random, OPTIONS);
            if (run < part_begin || run >= part_end) {
                option = IN(archive->tapes, entry, run);
            } else if (uniform(random) >= explored) {
                for (int64_t other = 0; other < OPTIONS; other++)
                    if (values[state * OPTIONS + other] > values[state * OPTIONS + option])
                        option = other;
            }
            int64_t low = 0, high = length - 1;
            if (option == SHORTENED) {
                low = 1;
                high = length - 2;
            } else if (option == EVEN_PART) {
                int64_t best = 0, since = 0;
                high = -1;
                for (int64_t index = 0; index <= length; index++)
                    if (index == length || AT(profiles, index) != usual) {
                        if (index - since > best) {
                            best = index - since;
                            low = since;
                            high = index - 1;
                        }
                        since = index + 1;
                    }
            }
            double gain = 0.0;
            if (option != SKIPPED && low <= high)
                gain = lay_run(ground, board, head + low * along, head + high * along, along, across);
            earned += gain;
            AT(states, run) = state;
            AT(options, run) = option;
            AT(rewards, run) = gain / (double)length;
            AT(room->tape, run) = (int8_t)option;
            taken++;
        }
        /* what became of a run is felt by the run ahead of it, not by the next to be decided */
        for (int64_t run = begin; run < end; run++) {
            double target = AT(rewards, run);
            int64_t ahead = AT(runs->ahead, run);
            if (ahead >= 0)
                target += parameters->gamma * values[AT(states, ahead) * OPTIONS + AT(options, ahead)];
            double *value = values + AT(states, run) * OPTIONS + AT(options, run);
            *value += alpha * (target - *value);
        }
        curve[episode] = earned;
        if (AT(archive->in_use, 0) < enough && connect_lanes(ground, board)) {
            double value = measure(ground, board, -INFINITY);
            if (value > NO_VALUE) {
                int64_t count = 0;
                for (int64_t index = 0; index < ground->squares.count; index++)
                    if (AT(board->cells, AT(ground->squares, index)) == LANE)
                        AT(laid, count++) = AT(ground->squares, index);
                keep(archive, laid.at, count, value, room->tape.at, room->tape.count, choice);
            }
        }
        epsilon *= schedule[1];
        alpha *= schedule[3];
    }
    schedule[0] = epsilon;
    schedule[2] = alpha;
    return taken;
}

/* Simulated annealing (Kirkpatrick, Gelatt and Vecchi 1983) of large plans under the rules of circulation.
 *
 * Moves are judged by the criterion of Metropolis et al. (1953). Faults are priced, and the prices rise as the
 * temperature falls (a penalty method). Each lane carries a label: core, which pruning leaves (k-core decomposition,
 * Seidman 1983, for k = 2), or its depth in a dead end. By labels R1 and R3 are checked around a move alone (a proof
 * labelling scheme, Korman, Kutten and Peleg 2005). */
#include "trial_move.h"

/* Shares of the moves that are of a side, and that start at what is broken. */
#define RESIZED_SHARE 0.02
#define FAULTY_SHARE 0.25

/* What a fault weighs, in stalls, in the choice of the best plan: while annealing, and where faults are mended. */
#define FAULT_PRICE 30.0
#define FAULT_PRICE_AT_LAST 1.0e5

/* What is broken still at last is mended where it is, by moves that may cost stalls before they pay. */
enum { MENDING_TRIALS = 60000, MENDING_REFRESH = 2000 };
#define MENDING_HEAT 2.0
#define MENDING_FAULTY_SHARE 1.0

/* Where `TrialMove.tally` and `TrialMove.change` have the faults of labels, blocks and squares too long, after the
 * STALLS, TIME and UNUSED that a board's tally has, too. */
enum { BAD = 3, BLOCKS = 4, EXCESS = 5 };
enum { TAKEN_OFF = -1, PUT_ON = 1 };

/* The number of the row or of the column that a square lies on, by the axis. */
static int64_t line_on(int64_t stride, int64_t axis, int64_t q) { return axis == 0 ? q / stride : q % stride; }

/* Blocks of two by two lanes that touch the moved squares. */
static int64_t blocks_at(Int8Row cells, TrialMove *move, int64_t stride)
{
    int64_t mark = ++AT(move->marks, BLOCKS_MET), count = 0;
    int64_t *stamp = move->stamp.at + BLOCKS_MET * move->stamp.columns;
    const int64_t corners[4] = { 0, -1, -stride, -stride - 1 };
    for (int64_t index = 0; index < AT(move->size, MOVED); index++)
        for (int place = 0; place < 4; place++) {
            int64_t corner = AT(move->moved, index) + corners[place];
            if (stamp[corner] != mark) {
                stamp[corner] = mark;
                count += AT(cells, corner) == LANE && AT(cells, corner + 1) == LANE &&
                         AT(cells, corner + stride) == LANE && AT(cells, corner + stride + 1) == LANE;
            }
        }
    return count;
}

/* Add what the squares around a move hold, or take it off. */
static void count_around(const Ground *ground, const Board *board, TrialMove *move, int64_t sign)
{
    const Int8Row cells = board->cells;
    Int64Row change = move->change;
    for (int64_t index = 0; index < AT(move->size, AROUND); index++) {
        int64_t x = AT(move->around, index);
        if (AT(cells, x) == FREE) {
            int64_t near, count = stalls_at(ground, board, x, &near);
            AT(change, STALLS) += sign * count;
            AT(change, UNUSED) += sign * (count == 0);
            if (count > 0)
                AT(change, TIME) += sign * count * (1 + near);
        } else if (AT(cells, x) == LANE) {
            AT(change, BAD) += sign * fault(cells, move->label, ground->stride, x);
        }
    }
    AT(change, BLOCKS) += sign * blocks_at(cells, move, ground->stride);
}

/* Squares by which the stretches around a move are too long. */
static int64_t excess_around(const Ground *ground, const Board *board, TrialMove *move)
{
    const Int8Row cells = board->cells, label = move->label;
    const int64_t steps[4] = STEPS_BESIDE(ground->stride);
    Int64Row queue = move->queue;
    int64_t stride = ground->stride, excess = 0;
    int64_t mark = ++AT(move->marks, SEARCHED), *stamp = move->stamp.at + SEARCHED * move->stamp.columns;
    for (int64_t index = 0; index < AT(move->size, AROUND); index++) {
        int64_t first = AT(move->around, index);
        if (AT(label, first) != THROUGH || stamp[first] == mark || through(cells, label, stride, first) != 2)
            continue;
        stamp[first] = mark;
        AT(queue, 0) = first;
        int64_t head = 0, tail = 1;
        while (head < tail) {
            int64_t q = AT(queue, head++);
            for (int way = 0; way < 4; way++) {
                int64_t p = q + steps[way];
                if (AT(label, p) == THROUGH && stamp[p] != mark && through(cells, label, stride, p) == 2) {
                    stamp[p] = mark;
                    AT(queue, tail++) = p;
                }
            }
        }
        excess += most(0, tail - ground->rules.stretch_squares);
    }
    return excess;
}

/* Count where cars drive around a move into the lines, or take it off. */
static void drive(const Board *board, const TrialMove *move, const Sizes *sizes, int64_t stride, int64_t sign)
{
    int64_t *rows = sizes->driven.at, *columns = sizes->driven.at + sizes->driven.columns;
    for (int64_t index = 0; index < AT(move->size, AROUND); index++) {
        int64_t q = AT(move->around, index);
        if (AT(board->cells, q) < LANE)
            continue;
        int64_t ways = driven_ways(board->cells, stride, q);
        rows[q / stride] += sign * (ways & ALONG_X);
        columns[q % stride] += sign * (ways >> 1);
    }
}

/* Whether a line is to have another side than it has. */
static bool has_other_side(const Sizes *sizes, int64_t axis, int64_t line)
{
    return AT(sizes->is_chosen, axis) &&
           side_now(sizes, axis, line) != IN(sizes->actual_mm, axis, line);
}

/* Find the lines around a move that get another side by it. */
static void find_lines(const Ground *ground, TrialMove *move, const Sizes *sizes)
{
    int64_t *lines = move->lines.at, size = 0;
    for (int64_t index = 0; index < AT(move->size, AROUND); index++)
        for (int64_t axis = 0; axis < 2; axis++) {
            int64_t line = line_on(ground->stride, axis, AT(move->around, index));
            if (!has_other_side(sizes, axis, line))
                continue;
            bool is_new = true;
            for (int64_t place = 0; place < size; place++)
                is_new &= lines[place * 2] != axis || lines[place * 2 + 1] != line;
            if (is_new) {
                lines[size * 2] = axis;
                lines[size * 2 + 1] = line;
                size++;
            }
        }
    AT(move->size, LINES) = size;
}

/* Give the lines that a move touches the sides that they are to have now. */
static void resize_lines(const Ground *ground, const TrialMove *move, const Sizes *sizes)
{
    for (int64_t place = 0; place < AT(move->size, LINES); place++) {
        int64_t axis = PLACE(move->lines, place * 2), line = PLACE(move->lines, place * 2 + 1);
        resize(ground, sizes, axis, line, side_now(sizes, axis, line));
    }
}

/* Whether a square around a move lay on a stretch that is too long. */
static bool touches_long(const Board *board, const TrialMove *move, int64_t stretch_squares)
{
    for (int64_t index = 0; index < AT(move->size, AROUND); index++) {
        int64_t q = AT(move->around, index);
        if (AT(move->label, q) > OFF && is_long(board, stretch_squares, q))
            return true;
    }
    return false;
}

/* Measure the whole board into the tally of moves; its value less that of the floor, NO_VALUE if infeasible. */
static double tally_whole(const Ground *ground, Board *board, TrialMove *move, const Sizes *sizes)
{
    sync_sides(ground, board, sizes);
    double exact = measure(ground, board, -INFINITY);
    if (exact == NO_VALUE)
        return NO_VALUE;
    for (int figure = STALLS; figure <= UNUSED; figure++)
        AT(move->tally, figure) = AT(board->tally, figure);
    if (is_sized(sizes))
        foresee(ground, board, sizes);
    return exact - floor_cost(sizes);
}

/* What a move adds to the value, less the price of the faults that it adds; very little if no stall is left. */
static double gain_of(const Ground *ground, const TrialMove *move, double price, double stretch_price)
{
    const Int64Row change = move->change, tally = move->tally;
    const DoubleRow weights = ground->weights;
    int64_t stalls = AT(tally, STALLS) + AT(change, STALLS);
    if (stalls <= 0)
        return NO_VALUE;
    double gain = AT(weights, 0) * (double)AT(change, STALLS) + AT(weights, 2) * (double)AT(change, UNUSED);
    gain += AT(weights, 1) * ((double)(AT(tally, TIME) + AT(change, TIME)) / (double)stalls -
                          (double)AT(tally, TIME) / (double)most(1, AT(tally, STALLS)));
    return gain - price * (double)(AT(change, BAD) + AT(change, BLOCKS)) - stretch_price * (double)AT(change, EXCESS);
}

/* Squares by which the new lanes of a move bring a lane beside them nearer to the entrances, at most. */
static int64_t shortcut(const Board *board, const TrialMove *move, int64_t stride)
{
    const int64_t steps[4] = STEPS_BESIDE(stride);
    const Int8Row cells = board->cells;
    const Int32Row hops = board->hops;
    int64_t saved = 0;
    for (int64_t index = 0; index < AT(move->size, MOVED); index++) {
        int64_t q = AT(move->moved, index);
        if (AT(cells, q) != LANE || AT(move->old, index) != OFF || AT(hops, q) >= FAR)
            continue;
        for (int way = 0; way < 4; way++) {
            int64_t p = q + steps[way];
            if (AT(cells, p) == LANE && AT(hops, p) < FAR)
                saved = most(saved, AT(hops, p) - AT(hops, q) - 1);
        }
    }
    return saved;
}

/* More than the lines around a move are likely to gain by other sides, to leave most of them unweighed. */
static double hope_of(const Ground *ground, const TrialMove *move, const Sizes *sizes)
{
    double hope = 0.0;
    for (int64_t index = 0; index < AT(move->size, AROUND); index++)
        for (int64_t axis = 0; axis < 2; axis++) {
            int64_t line = line_on(ground->stride, axis, AT(move->around, index));
            if (!has_other_side(sizes, axis, line))
                continue;
            double hint = IN(sizes->hint, axis, line);
            /* squares around a move lie on a line more than once: what is feared counts but for one of them */
            hope += hint > 0 ? hint + 0.2 * fabs(hint) + 2.0 : (0.8 * hint + 2.0) / (double)AT(move->size, AROUND);
        }
    return hope;
}

/* Add the change of a move that is made to the tally. */
static void book(TrialMove *move)
{
    for (int figure = STALLS; figure <= UNUSED; figure++)
        AT(move->tally, figure) += AT(move->change, figure);
}

/* Make the trial move if it gains as much as the threshold. */
static bool try_move(const Ground *ground, Board *board, TrialMove *move, const Sizes *sizes, double threshold,
                     double price, double stretch_price)
{
    Int64Row change = move->change;
    int64_t stride = ground->stride;
    bool sized = is_sized(sizes);
    gather(move, stride);
    for (int64_t figure = 0; figure < move->change.count; figure++)
        AT(change, figure) = 0;
    AT(move->size, LINES) = 0;
    count_around(ground, board, move, TAKEN_OFF);
    if (touches_long(board, move, ground->rules.stretch_squares))
        AT(change, EXCESS) -= excess_around(ground, board, move);
    if (sized)
        drive(board, move, sizes, stride, TAKEN_OFF);
    apply(ground, board, move);
    count_around(ground, board, move, PUT_ON);
    if (sized)
        drive(board, move, sizes, stride, PUT_ON);
    /* most moves end here: the whole is measured only where what is around promises enough */
    double hope = sized ? hope_of(ground, move, sizes) : 0.0;
    hope -= AT(ground->weights, 1) * (double)shortcut(board, move, stride);
    if (gain_of(ground, move, price, stretch_price) + hope >= threshold) {
        if (ground->rules.stretch_squares > 0)
            AT(change, EXCESS) += excess_around(ground, board, move);
        double floor = AT(sizes->area_m2, 0);
        if (sized) {
            find_lines(ground, move, sizes);
            resize_lines(ground, move, sizes);
        }
        if (measure(ground, board, INFINITY) > NO_VALUE) {
            for (int figure = STALLS; figure <= UNUSED; figure++)
                AT(change, figure) = AT(board->tally, figure) - AT(move->tally, figure);
            double gain = gain_of(ground, move, price, stretch_price) -
                          AT(sizes->price, 0) * (AT(sizes->area_m2, 0) - floor);
            if (gain >= threshold) {
                copy_hops(&move->hops, &board->hops);
                book(move);
                return true;
            }
        }
        copy_hops(&board->hops, &move->hops);
    }
    if (sized)
        drive(board, move, sizes, stride, TAKEN_OFF);
    revert(board, move);
    if (sized) {
        drive(board, move, sizes, stride, PUT_ON);
        resize_lines(ground, move, sizes);
    }
    return false;
}

/* The least change that annealing takes at a temperature, drawn at random. */
static double threshold_at(double heat, uint64_t *random)
{
    double draw = uniform(random);
    return heat * same_log(draw > 1e-300 ? draw : 1e-300);
}

/* Give a line along which no car drives another side, if that pays. */
static void try_side(const Ground *ground, const Board *board, TrialMove *move, const Sizes *sizes, uint64_t *random,
                     double heat)
{
    int64_t axis = below(random, 2);
    int64_t line = below(random, axis == 0 ? board->cells.count / ground->stride : ground->stride);
    int64_t side = AT(sizes->free_mm, below(random, sizes->free_mm.count));
    int64_t at = axis * sizes->kept_mm.columns + line;
    if (!AT(sizes->is_chosen, axis) || PLACE(sizes->driven, at) > 0 || side == PLACE(sizes->kept_mm, at))
        return;
    int64_t fitted = most(side, PLACE(sizes->least_mm, at));
    double area = weigh(ground, board, sizes, axis, line, fitted);
    for (int64_t figure = 0; figure < move->change.count; figure++)
        AT(move->change, figure) = figure < sizes->change.count ? AT(sizes->change, figure) : 0;
    double gain = gain_of(ground, move, 0.0, 0.0) - AT(sizes->price, 0) * area;
    if (gain >= threshold_at(heat, random)) {
        PLACE(sizes->kept_mm, at) = side;
        resize(ground, sizes, axis, line, fitted);
        book(move);
    }
}

/* Label and measure the lanes on the board, and list what is broken. */
static void take_stock(const Ground *ground, Board *board, TrialMove *move, const Sizes *sizes)
{
    label_lanes(ground, board, move);
    tally_whole(ground, board, move, sizes);
    find_faults(ground, board, move);
    copy_hops(&move->hops, &board->hops);
}

/* Anneal the feasible lanes in `board.cells` under the rules; leaves the best that keeps them, returns its value.
 *
 * `heats` are the temperatures at first and at last, `prices` those of a fault and then of a square that a stretch is
 * too long, all in stalls.
 *
 * Each lane is labelled as driven through or as so many squares deep in a dead end; where every lane has what its label
 * asks for around it, pruning ends within the rounds of R1. So R1 and R3 are judged around a move, R4 along the
 * stretches that it touches. A move that seems worth it by what is around it is measured whole before it is made, as it
 * may lead cars another way far around: stalls, T_S and floor are exact. */
FROM_PYTHON
double anneal_labels(const Ground *ground, Board *board, TrialMove *move, const Sizes *sizes, Workspace *room,
                     uint64_t *random, int64_t trials, const double *heats, const double *prices, int64_t refresh)
{
    double best = NO_VALUE, fault_price = FAULT_PRICE, share = 1.0 / (double)most(1, trials);
    int64_t best_faults = 0;
    copy_cells(&room->cells, &board->cells);
    copy_sides(&room->kept_mm, &sizes->kept_mm);
    double cooling = same_pow(heats[1] / heats[0], share), heat = heats[0];
    double pricing = same_pow(prices[1] / prices[0], share), price = prices[0];
    double stretch_pricing = same_pow(prices[3] / prices[2], share), stretch_price = prices[2];
    double faulty_share = FAULTY_SHARE;
    bool sized = is_sized(sizes), changed = true;
    if (sized) {
        sync_sides(ground, board, sizes);
        measure(ground, board, -INFINITY);
        settle(ground, board, sizes, 2);
    }
    take_stock(ground, board, move, sizes);
    for (int64_t trial = 0; trial <= trials + MENDING_TRIALS; trial++) {
        if (trial == trials) {
            heat = MENDING_HEAT;
            faulty_share = MENDING_FAULTY_SHARE;
            refresh = MENDING_REFRESH;
        }
        if (trial == trials || (trial % refresh == refresh - 1 && changed)) {
            changed = false;
            copy_cells(&move->cells, &board->cells);
            if (ground->rules.is_asked)
                trim(ground, board);
            double measured = tally_whole(ground, board, move, sizes);
            int64_t faults = AT(board->tally, FAULTS);
            if (measured - fault_price * (double)faults > best - fault_price * (double)best_faults) {
                best = measured;
                best_faults = faults;
                copy_cells(&room->cells, &board->cells);
                copy_sides(&room->kept_mm, &sizes->kept_mm);
            }
            copy_cells(&board->cells, &move->cells);
            if (trial >= trials) {
                /* what is broken still is mended on the best, from its trimmed lanes */
                fault_price = FAULT_PRICE_AT_LAST;
                copy_cells(&board->cells, &room->cells);
                copy_sides(&sizes->kept_mm, &room->kept_mm);
            }
            /* moves leave labels that are sound but not what pruning says: loops of dead ends */
            take_stock(ground, board, move, sizes);
            /* beyond the last trial only to mend what is broken still */
            if (trial >= trials && best_faults == 0)
                break;
        }
        if (trial < trials) {
            heat *= cooling;
            price *= pricing;
            stretch_price *= stretch_pricing;
        }
        if (sized && uniform(random) < RESIZED_SHARE) {
            try_side(ground, board, move, sizes, random, heat);
            continue;
        }
        if (propose(ground, board, move, random, faulty_share))
            changed |= try_move(ground, board, move, sizes, threshold_at(heat, random), price, stretch_price);
    }
    copy_cells(&board->cells, &room->cells);
    copy_sides(&sizes->kept_mm, &room->kept_mm);
    return tally_whole(ground, board, move, sizes);
}

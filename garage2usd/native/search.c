/* Weighted A* over arcs at full lock and straights, from a parked pose to a lane.
 *
 * The car's place is exact; only what counts as the same place is rounded, to two thirds of a straight step and a
 * heading. Headings are whole multiples of 3 degrees (or what is asked) off the lanes' own, so that a lane's heading is
 * met exactly; a car parked askew comes onto one of them with its first arc.
 *
 * A guided search tries words of Reeds and Shepp to the goals from each place that is looked at. What is left of the
 * way is then the greater of two (D. Dolgov, S. Thrun, M. Montemerlo, J. Diebel: Path planning for autonomous vehicles
 * in unknown semi-structured environments, 2010): the cheapest word, which knows how the car turns, and the way of the
 * rear axle round all that stands, which does not. */
#include <stdlib.h>

#include "driving.h"

#define TAU 6.283185307179586
#define CELL_PER_STEP (2.0 / 3)
/* What a change of gear costs, and a turn of the steering wheel, as metres of way. */
#define GEAR_CHANGE_M 3.0
#define STEERING_M 0.3
/* Weight of the way that is left: the way found costs at most so many times the least. */
#define GREED 2.0
#define GUIDED_GREED 1.5
#define NEAR 1e-7
enum { GAVE_UP = -1, NO_MEMORY = -2 };
/* Words that are tried from a place, the cheapest first; goals that are looked to, the nearest; and steps of a word for
 * which what stands about is looked for at once. */
enum { TRIED = 3, LOOKED_TO = 2, TOGETHER = 6 };
/* Longest step of a word's straight; and how far ahead on a goal a word may aim, in radii, and what is too near to be
 * another aim. */
#define STRAIGHT_M 0.5
#define AHEAD 1.5
#define SAME_AIM_M 0.2

/* garage2usd.driving.way_search.Task */
typedef struct {
    Scene scene;
    DoubleRow start;
    DoubleTable goals;
    double radius;
    double margin;
    double reach;
    double straight_m;
    int64_t max_changes;
    int64_t max_nodes;
    int64_t headings;
    int64_t is_guided;
} Task;

/* A place that was reached: where it is, of which cell, what the way to it costs, its last step, and whether a later
 * node of the same cell costs less. */
typedef struct {
    double x, z, yaw;
    double cost, step_m;
    int64_t cell;
    int32_t parent;
    int8_t gear, steering, changes;
    bool is_beaten;
} Node;

/* A node that is still to be looked at: those of least priority first, of these the oldest. */
typedef struct {
    double priority;
    int64_t node;
} Open;

/* What the search has reached: the nodes, a heap of those to be looked at, and a table of open addressing with the node
 * of each cell, 0 where there is none, as the start is in no cell. */
typedef struct {
    Node *nodes;
    int64_t count;
    Open *open;
    int64_t open_count;
    int32_t *slots;
    int64_t mask;
    double cell_m, turn;
    /* numbers of the shapes about a place, in order */
    int32_t *near;
    int64_t near_count;
    double body_reach;
    /* of a guided search: what is left from each node, negative where only its parent's is known; the squares of the
     * floor; and the cheapest way that ends with a word, from a node */
    double *left;
    Guide guide;
    double best_cost;
    int64_t best_node;
    Word best_word;
} Room;

/* Keep the shapes that come within a reach of a place, as those that may be touched there. */
static void look_about(Room *room, const Scene *scene, double x, double z, double reach)
{
    Box box = {x - reach, z - reach, x + reach, z + reach};
    room->near_count = 0;
    for (int64_t number = 0; number < scene->shapes.layers; number++)
        if (!is_beyond(scene, number, &box))
            room->near[room->near_count++] = (int32_t)number;
}

/* Number of a shape about a place that the hull of two footprints comes nearer to than `need`; -1 if there is none. */
static int64_t first_touch(Hull *hull, const Scene *scene, const Room *room, double need)
{
    Box box = box_around(hull, need);
    for (int64_t at = 0; at < room->near_count; at++) {
        int64_t number = room->near[at];
        if (!is_beyond(scene, number, &box) && clearance(hull, scene, number, need) < need)
            return number;
    }
    return -1;
}

/* How far a heading is from that of a goal, either way round. */
static double turn_to(const double *goal, double yaw, double step)
{
    double turn = fmod(goal[0] * step - yaw, TAU);
    if (turn < 0)
        turn += TAU;
    return lesser(turn, TAU - turn);
}

/* A lower bound of the way to any goal, with no regard for what stands in it. */
static double left_of_way(const Node *at, const DoubleTable *goals, double radius, double turn)
{
    double least = INFINITY;
    for (int64_t number = 0; number < goals->rows; number++) {
        const double *goal = goals->at + number * 5;
        double beside = greater(greater(goal[1] - at->x, 0.0), at->x - goal[3]);
        double before = greater(greater(goal[2] - at->z, 0.0), at->z - goal[4]);
        least = lesser(least, greater(radius * turn_to(goal, at->yaw, turn), same_hypot(beside, before)));
    }
    return least;
}

static bool reaches(const Node *at, const DoubleTable *goals, double turn)
{
    for (int64_t number = 0; number < goals->rows; number++) {
        const double *goal = goals->at + number * 5;
        bool inside = goal[1] <= at->x && at->x <= goal[3] && goal[2] <= at->z && at->z <= goal[4];
        if (inside && turn_to(goal, at->yaw, turn) < NEAR)
            return true;
    }
    return false;
}

/* A number for a place, a heading and a gear; places lie within 4096 cells of the origin. */
static int64_t cell_of(double x, double z, int64_t heading, int64_t gear, const Room *room, int64_t headings)
{
    int64_t column = (int64_t)floor(x / room->cell_m) + 4096, row = (int64_t)floor(z / room->cell_m) + 4096;
    return ((column * 8192 + row) * headings + heading) * 2 + (gear > 0);
}

/* Number of the heading next to a yaw. */
static int64_t heading_number(double yaw, double turn, int64_t headings)
{
    int64_t number = (int64_t)rint(yaw / turn) % headings;
    return number < 0 ? number + headings : number;
}

/* Where the node of a cell is in the table, or where it would be put. */
static int32_t *slot_of(const Room *room, int64_t cell)
{
    int64_t at = (int64_t)((uint64_t)cell * UINT64_C(0x9E3779B97F4A7C1) >> 20) & room->mask;
    while (room->slots[at] != 0 && room->nodes[room->slots[at]].cell != cell)
        at = (at + 1) & room->mask;
    return &room->slots[at];
}

static bool is_before(Open one, Open other)
{
    return one.priority < other.priority || (one.priority == other.priority && one.node < other.node);
}

/* Put a node into the binary heap of those to be looked at. */
static void push(Room *room, Open added)
{
    int64_t at = room->open_count++;
    for (; at > 0 && is_before(added, room->open[(at - 1) / 2]); at = (at - 1) / 2)
        room->open[at] = room->open[(at - 1) / 2];
    room->open[at] = added;
}

/* Take the first node out of the heap. */
static int64_t pop(Room *room)
{
    int64_t first = room->open[0].node, at = 0;
    Open last = room->open[--room->open_count];
    for (int64_t below = 1; below < room->open_count; below = 2 * at + 1) {
        if (below + 1 < room->open_count && is_before(room->open[below + 1], room->open[below]))
            below++;
        if (!is_before(room->open[below], last))
            break;
        room->open[at] = room->open[below];
        at = below;
    }
    room->open[at] = last;
    return first;
}

/* Write the steps from the start to a node; returns how many they are. */
static int64_t write_steps(const Node *nodes, int64_t last, double *steps)
{
    int64_t count = 0;
    for (int64_t at = last; nodes[at].parent >= 0; at = nodes[at].parent)
        count++;
    for (int64_t row = count - 1, at = last; row >= 0; row--, at = nodes[at].parent) {
        steps[row * 3] = nodes[at].gear;
        steps[row * 3 + 1] = nodes[at].steering;
        steps[row * 3 + 2] = nodes[at].step_m;
    }
    return count;
}

/* Look from a node to all that a step leads to; false where there is no room for another node. */
static bool expand(Room *room, const Task *task, int64_t number, double full, int64_t *touched)
{
    const Node from = room->nodes[number];
    const double radius = task->radius, yaw = from.yaw, turn = room->turn;
    /* straight on, after an arc that turns to the left, and to the right */
    const Heading headings[3] = {
        heading_of(yaw),
        heading_of((floor(yaw / turn + NEAR) + 1) * turn),
        heading_of((ceil(yaw / turn - NEAR) - 1) * turn),
    };
    int64_t numbers[3];
    for (int side = 0; side < 3; side++)
        numbers[side] = heading_number(headings[side].yaw, turn, task->headings);
    Hull hull;
    put_footprint(&hull, 0, from.x, from.z, headings[0], task->scene.body.at);
    double step = greater(task->straight_m, radius * turn);
    look_about(room, &task->scene, from.x, from.z, room->body_reach + step + task->margin + full);
    for (int way = 0; way < 6; way++) {
        static const int8_t gears[6] = {-1, -1, -1, 1, 1, 1}, steerings[6] = {0, 1, -1, 0, 1, -1};
        int8_t gear = gears[way], steering = steerings[way];
        bool is_change = from.gear == -gear;
        int64_t changes = from.changes + is_change;
        if (changes > task->max_changes)
            continue;
        int side = steering == 0 ? 0 : gear * steering > 0 ? 1 : 2;
        Heading to = headings[side];
        double length, x, z, need;
        if (steering == 0) {
            length = task->straight_m;
            x = from.x - to.sine * gear * length;
            z = from.z - to.cosine * gear * length;
            need = task->margin;
        } else {
            length = radius * fabs(to.yaw - yaw);
            x = from.x + steering * radius * (to.cosine - headings[0].cosine);
            z = from.z - steering * radius * (to.sine - headings[0].sine);
            need = task->margin + full;
        }
        if (fabs(x - AT(task->start, 0)) > task->reach || fabs(z - AT(task->start, 1)) > task->reach)
            continue;
        double paid = from.cost + length;
        if (is_change)
            paid += GEAR_CHANGE_M;
        if (steering != from.steering)
            paid += STEERING_M;
        int64_t cell = cell_of(x, z, numbers[side], gear, room, task->headings);
        int32_t *slot = slot_of(room, cell);
        Node *known = *slot == 0 ? NULL : &room->nodes[*slot];
        if (known != NULL && known->cost <= paid)
            continue;
        put_footprint(&hull, CORNERS, x, z, to, task->scene.body.at);
        int64_t hit = first_touch(&hull, &task->scene, room, need);
        if (hit >= 0) {
            touched[hit]++;
            continue;
        }
        double guided = room->left == NULL ? 0 : guided_way(&room->guide, x, z);
        if (isinf(guided))
            continue;
        if (room->count == task->max_nodes)
            return false;
        if (known != NULL)
            known->is_beaten = true;
        Node *added = &room->nodes[room->count];
        *added = (Node){x, z, to.yaw, paid, length, cell, (int32_t)number, gear, steering, (int8_t)changes, false};
        double priority;
        if (room->left == NULL) {
            priority = paid + GREED * left_of_way(added, &task->goals, radius, turn);
        } else {
            double left = greater(fabs(room->left[number]) - (paid - from.cost), guided);
            room->left[room->count] = -left;
            priority = paid + GUIDED_GREED * left;
        }
        push(room, (Open){priority, room->count});
        *slot = (int32_t)room->count++;
    }
    return true;
}

/* Whether a car that is at a pose drives a word without coming nearer to a shape than the margin. */
static bool is_clear(Room *room, const Word *word, Pose at, const Task *task)
{
    const double *start = task->start.at, *body = task->scene.body.at;
    Hull hull;
    Heading heading = heading_of(at.yaw);
    for (int64_t piece = 0; piece < word->count; piece++) {
        int64_t steering = word->steering[piece];
        double length = word->length[piece], bend = steering / task->radius;
        double longest = steering == 0 ? STRAIGHT_M : task->radius * room->turn;
        int64_t count = (int64_t)ceil(fabs(length) / longest);
        double yaw = at.yaw, part = length / count;
        double need = task->margin + (steering == 0 ? 0 : bulge(task->radius, part * bend, body));
        for (int64_t number = 0; number < count; number++) {
            if (number % TOGETHER == 0)
                look_about(room, &task->scene, at.x, at.z, room->body_reach + need + TOGETHER * fabs(part));
            put_footprint(&hull, 0, at.x, at.z, heading, body);
            Heading next = heading_of(yaw + part * bend * (number + 1));
            if (steering == 0) {
                at.x -= heading.sine * part;
                at.z -= heading.cosine * part;
            } else {
                at.x += steering * task->radius * (next.cosine - heading.cosine);
                at.z -= steering * task->radius * (next.sine - heading.sine);
            }
            if (fabs(at.x - start[0]) > task->reach || fabs(at.z - start[1]) > task->reach)
                return false;
            heading = next;
            put_footprint(&hull, CORNERS, at.x, at.z, heading, body);
            if (first_touch(&hull, &task->scene, room, need) >= 0)
                return false;
        }
        at.yaw = heading.yaw;
    }
    return true;
}

/* What a word costs after a gear and a steering (0 and any at the start), and its changes of gear. */
static double cost_of(const Word *word, int gear, int steering, int64_t *changes)
{
    double cost = 0;
    for (int64_t piece = 0; piece < word->count; piece++) {
        int own = word->length[piece] > 0 ? 1 : -1;
        cost += fabs(word->length[piece]);
        if (own == -gear) {
            cost += GEAR_CHANGE_M;
            ++*changes;
        }
        if (word->steering[piece] != steering)
            cost += STEERING_M;
        gear = own;
        steering = word->steering[piece];
    }
    return cost;
}

/* The poses on a goal to aim at from a place: beside it, and some way on along the goal and back. */
static int aims_on(const double *goal, const Pose *at, double turn, double radius, Pose *aims)
{
    Heading heading = heading_of(goal[0] * turn);
    double low[2] = {goal[1], goal[2]}, high[2] = {goal[3], goal[4]};
    for (int axis = 0; axis < 2; axis++)
        if (high[axis] - low[axis] < SAME_AIM_M)
            low[axis] = high[axis] = (low[axis] + high[axis]) / 2;
    int count = 0;
    for (int along = 0; along < 3; along++) {
        double ahead = (along == 0 ? 0 : along == 1 ? AHEAD : -AHEAD) * radius;
        double x = lesser(greater(at->x - heading.sine * ahead, low[0]), high[0]);
        double z = lesser(greater(at->z - heading.cosine * ahead, low[1]), high[1]);
        bool is_new = true;
        for (int other = 0; other < count; other++)
            is_new = is_new && same_hypot(aims[other].x - x, aims[other].z - z) >= SAME_AIM_M;
        if (is_new)
            aims[count++] = (Pose){x, z, heading.yaw};
    }
    return count;
}

/* Poses on the nearest goals to aim at; returns how many they are. */
static int aims_from(const Node *node, const Task *task, double turn, Pose *aims)
{
    const double *nearest[LOOKED_TO];
    double ways[LOOKED_TO];
    int kept = 0, count = 0;
    for (int64_t number = 0; number < task->goals.rows; number++) {
        DoubleTable one = {task->goals.at + number * 5, 1, 5};
        double way = left_of_way(node, &one, task->radius, turn);
        if (kept == LOOKED_TO && way >= ways[LOOKED_TO - 1])
            continue;
        int place = kept < LOOKED_TO ? kept++ : LOOKED_TO - 1;
        for (; place > 0 && way < ways[place - 1]; place--) {
            ways[place] = ways[place - 1];
            nearest[place] = nearest[place - 1];
        }
        ways[place] = way;
        nearest[place] = one.at;
    }
    Pose at = {node->x, node->z, node->yaw};
    for (int goal = 0; goal < kept; goal++)
        count += aims_on(nearest[goal], &at, turn, task->radius, aims + count);
    return count;
}

/* Try words from a node to the goals; returns the cost of the cheapest one, whatever stands in its way. */
static double shoot(Room *room, const Task *task, int64_t number)
{
    const Node *from = &room->nodes[number];
    const Pose at = {from->x, from->z, from->yaw};
    Pose aims[LOOKED_TO * 3];
    Word words[MOST_WORDS], tried[TRIED];
    double costs[TRIED], least = INFINITY;
    int kept = 0, aim_count = aims_from(from, task, room->turn, aims);
    for (int aim = 0; aim < aim_count; aim++) {
        int64_t count = reeds_shepp(at, aims[aim], task->radius, words);
        for (int64_t word = 0; word < count; word++) {
            int64_t changes = from->changes;
            double cost = cost_of(&words[word], from->gear, from->steering, &changes);
            least = lesser(least, cost);
            if (changes > task->max_changes || (kept == TRIED && cost >= costs[TRIED - 1]))
                continue;
            int place = kept < TRIED ? kept++ : TRIED - 1;
            for (; place > 0 && cost < costs[place - 1]; place--) {
                costs[place] = costs[place - 1];
                tried[place] = tried[place - 1];
            }
            costs[place] = cost;
            tried[place] = words[word];
        }
    }
    for (int word = 0; word < kept && from->cost + costs[word] < room->best_cost; word++)
        if (is_clear(room, &tried[word], at, task)) {
            room->best_cost = from->cost + costs[word];
            room->best_node = number;
            room->best_word = tried[word];
        }
    return least;
}

/* Steps of the cheapest way with a word at its end. */
static int64_t write_best(const Room *room, double *steps)
{
    int64_t count = write_steps(room->nodes, room->best_node, steps);
    for (int64_t piece = 0; piece < room->best_word.count; piece++, count++) {
        double length = room->best_word.length[piece];
        steps[count * 3] = length > 0 ? 1 : -1;
        steps[count * 3 + 1] = room->best_word.steering[piece];
        steps[count * 3 + 2] = fabs(length);
    }
    return count;
}

/* Steps of the way found, 0 where there is none, GAVE_UP where `max_nodes` did not do. */
static int64_t look(Room *room, const Task *task, int64_t *touched, double *steps)
{
    const DoubleRow start = task->start;
    double full = bulge(task->radius, room->turn, task->scene.body.at);
    room->nodes[0] = (Node){.x = AT(start, 0), .z = AT(start, 1), .yaw = AT(start, 2), .parent = -1};
    room->count = 1;
    room->best_cost = INFINITY;
    if (room->left != NULL) {
        room->left[0] = -guided_way(&room->guide, AT(start, 0), AT(start, 1));
        if (isinf(room->left[0]))
            return 0;
    }
    push(room, (Open){0.0, 0});
    while (room->open_count > 0) {
        if (room->best_cost < INFINITY && room->best_cost <= room->open[0].priority)
            return write_best(room, steps);
        int64_t number = pop(room);
        const Node *node = &room->nodes[number];
        if (node->is_beaten)
            continue;
        if (number > 0 && reaches(node, &task->goals, room->turn))
            return write_steps(room->nodes, number, steps);
        if (room->left != NULL && (room->left[number] < 0 || number == 0)) {
            double left = greater(-room->left[number], shoot(room, task, number));
            room->left[number] = left;
            double priority = node->cost + GUIDED_GREED * left;
            if (room->open_count > 0 && priority > room->open[0].priority) {
                push(room, (Open){priority, number});
                continue;
            }
        }
        if (!expand(room, task, number, full, touched))
            return room->best_cost < INFINITY ? write_best(room, steps) : GAVE_UP;
    }
    return room->best_cost < INFINITY ? write_best(room, steps) : 0;
}

/* Look for a way of little cost from a pose to a goal.
 *
 * Returns how many steps it has, 0 where there is none, GAVE_UP where `max_nodes` did not do, NO_MEMORY; writes its
 * steps as gear (1 or -1), steering (1 to the left, -1 or 0) and metres of way. `touched` counts for each shape how
 * often it stood in the way, `places` how many were reached. */
FROM_PYTHON
int64_t find_steps(const Task *task, int64_t *touched, int64_t *places, double *steps)
{
    int64_t size = 1024;
    while (size < 2 * task->max_nodes)
        size *= 2;
    Room room = {.mask = size - 1, .cell_m = CELL_PER_STEP * task->straight_m, .turn = TAU / task->headings};
    const double *body = task->scene.body.at;
    room.body_reach = same_hypot(greater(body[0], body[1]), body[2]);
    room.nodes = malloc(sizeof(Node) * (size_t)task->max_nodes);
    room.open = malloc(sizeof(Open) * (size_t)task->max_nodes);
    room.slots = calloc((size_t)size, sizeof(int32_t));
    room.near = malloc(sizeof(int32_t) * (size_t)(task->scene.shapes.layers + 1));
    room.left = task->is_guided ? malloc(sizeof(double) * (size_t)task->max_nodes) : NULL;
    bool has_room = room.nodes != NULL && room.open != NULL && room.slots != NULL && room.near != NULL;
    if (task->is_guided && has_room) {
        Pose start = {task->start.at[0], task->start.at[1], task->start.at[2]};
        has_room = room.left != NULL &&
                   make_guide(&room.guide, &task->scene, start, &task->goals, task->reach, task->margin);
    }
    int64_t found = has_room ? look(&room, task, touched, steps) : NO_MEMORY;
    *places = room.count;
    free(room.nodes);
    free(room.open);
    free(room.slots);
    free(room.near);
    free(room.left);
    free(room.guide.far);
    return found;
}

/* Weighted A* over arcs at full lock and straights, from a parked pose to a lane.
 *
 * The car's place is exact; only what counts as the same place is rounded, to two thirds of a straight step and a
 * heading. Headings are whole multiples of 3 degrees off the lanes' own, so that a lane's heading is met exactly; a car
 * parked askew comes onto one of them with its first arc. */
#include <stdlib.h>

#include "driving.h"

#define TAU 6.283185307179586
#define HEADINGS 120
#define TURN (TAU / HEADINGS)
#define CELL_PER_STEP (2.0 / 3)
/* What a change of gear costs, and a turn of the steering wheel, as metres of way. */
#define GEAR_CHANGE_M 3.0
#define STEERING_M 0.3
/* Weight of the way that is left: the way found costs at most so many times the least. */
#define GREED 2.0
#define NEAR 1e-7
enum { GAVE_UP = -1, NO_MEMORY = -2 };

/* garage2usd.driving.search.Task */
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
    double cell_m;
} Room;

/* Number of a shape that the hull of two footprints comes nearer to than `need`; -1 if there is none. */
static int64_t first_touch(Hull *hull, const Scene *scene, double need)
{
    Box box = box_around(hull, need);
    for (int64_t number = 0; number < scene->shapes.layers; number++)
        if (!is_beyond(scene, number, &box) && clearance(hull, scene, number, need) < need)
            return number;
    return -1;
}

/* How far a heading is from that of a goal, either way round. */
static double turn_to(const double *goal, double yaw)
{
    double turn = fmod(goal[0] * TURN - yaw, TAU);
    if (turn < 0)
        turn += TAU;
    return lesser(turn, TAU - turn);
}

/* A lower bound of the way to any goal, with no regard for what stands in it. */
static double left_of_way(const Node *at, const DoubleTable *goals, double radius)
{
    double least = INFINITY;
    for (int64_t number = 0; number < goals->rows; number++) {
        const double *goal = goals->at + number * 5;
        double beside = greater(greater(goal[1] - at->x, 0.0), at->x - goal[3]);
        double before = greater(greater(goal[2] - at->z, 0.0), at->z - goal[4]);
        least = lesser(least, greater(radius * turn_to(goal, at->yaw), hypot(beside, before)));
    }
    return least;
}

static bool reaches(const Node *at, const DoubleTable *goals)
{
    for (int64_t number = 0; number < goals->rows; number++) {
        const double *goal = goals->at + number * 5;
        bool inside = goal[1] <= at->x && at->x <= goal[3] && goal[2] <= at->z && at->z <= goal[4];
        if (inside && turn_to(goal, at->yaw) < NEAR)
            return true;
    }
    return false;
}

/* A number for a place, a heading and a gear; places lie within 40 m of the origin. */
static int64_t cell_of(double x, double z, int64_t heading, int64_t gear, double cell_m)
{
    int64_t column = (int64_t)floor(x / cell_m) + 1024, row = (int64_t)floor(z / cell_m) + 1024;
    return ((column * 2048 + row) * HEADINGS + heading) * 2 + (gear > 0);
}

/* Number of the heading next to a yaw. */
static int64_t heading_number(double yaw)
{
    int64_t number = (int64_t)rint(yaw / TURN) % HEADINGS;
    return number < 0 ? number + HEADINGS : number;
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
    const double radius = task->radius, yaw = from.yaw;
    /* straight on, after an arc that turns to the left, and to the right */
    const Heading headings[3] = {
        heading_of(yaw),
        heading_of((floor(yaw / TURN + NEAR) + 1) * TURN),
        heading_of((ceil(yaw / TURN - NEAR) - 1) * TURN),
    };
    const int64_t numbers[3] = {heading_number(yaw), heading_number(headings[1].yaw), heading_number(headings[2].yaw)};
    Hull hull;
    put_footprint(&hull, 0, from.x, from.z, headings[0], task->scene.body.at);
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
        int64_t cell = cell_of(x, z, numbers[side], gear, room->cell_m);
        int32_t *slot = slot_of(room, cell);
        Node *known = *slot == 0 ? NULL : &room->nodes[*slot];
        if (known != NULL && known->cost <= paid)
            continue;
        put_footprint(&hull, CORNERS, x, z, to, task->scene.body.at);
        int64_t hit = first_touch(&hull, &task->scene, need);
        if (hit >= 0) {
            touched[hit]++;
            continue;
        }
        if (room->count == task->max_nodes)
            return false;
        if (known != NULL)
            known->is_beaten = true;
        Node *added = &room->nodes[room->count];
        *added = (Node){x, z, to.yaw, paid, length, cell, (int32_t)number, gear, steering, (int8_t)changes, false};
        push(room, (Open){paid + GREED * left_of_way(added, &task->goals, radius), room->count});
        *slot = (int32_t)room->count++;
    }
    return true;
}

/* Steps of the way found, 0 where there is none, GAVE_UP where `max_nodes` did not do. */
static int64_t look(Room *room, const Task *task, int64_t *touched, double *steps)
{
    const DoubleRow start = task->start;
    double full = bulge(task->radius, TURN, task->scene.body.at);
    room->nodes[0] = (Node){.x = AT(start, 0), .z = AT(start, 1), .yaw = AT(start, 2), .parent = -1};
    room->count = 1;
    push(room, (Open){0.0, 0});
    while (room->open_count > 0) {
        int64_t number = pop(room);
        const Node *node = &room->nodes[number];
        if (node->is_beaten)
            continue;
        if (number > 0 && reaches(node, &task->goals))
            return write_steps(room->nodes, number, steps);
        if (!expand(room, task, number, full, touched))
            return GAVE_UP;
    }
    return 0;
}

/* Look for a way of little cost from a pose to a goal.
 *
 * Returns how many steps it has, 0 where there is none, GAVE_UP where `max_nodes` did not do, NO_MEMORY; writes its
 * steps as gear (1 or -1), steering (1 to the left, -1 or 0) and metres of way. `touched` counts for each shape how
 * often it stood in the way. */
FROM_PYTHON
int64_t find_steps(const Task *task, int64_t *touched, double *steps)
{
    int64_t size = 1024;
    while (size < 2 * task->max_nodes)
        size *= 2;
    Room room = {.mask = size - 1, .cell_m = CELL_PER_STEP * task->straight_m};
    room.nodes = malloc(sizeof(Node) * (size_t)task->max_nodes);
    room.open = malloc(sizeof(Open) * (size_t)task->max_nodes);
    room.slots = calloc((size_t)size, sizeof(int32_t));
    bool has_room = room.nodes != NULL && room.open != NULL && room.slots != NULL;
    int64_t found = has_room ? look(&room, task, touched, steps) : NO_MEMORY;
    free(room.nodes);
    free(room.open);
    free(room.slots);
    return found;
}

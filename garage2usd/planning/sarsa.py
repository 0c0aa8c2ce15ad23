"""Compiled episodes of tabular Sarsa, and the archive of the best plans that they meet."""

import numba as nb
import numpy as np

from garage2usd.planning.kernel import (
    NO_VALUE,
    capacity_of,
    connect_portals,
    uniform,
    untouched_portal,
    value_of,
)

__all__ = ["learn"]

STAY = 4
_OPPOSITE = np.array([1, 0, 3, 2, -1], dtype=np.int64)


@nb.njit(cache=True)
def _archive(kind, squares, value, values, layouts, hashes, zobrist, count):
    """Keep a layout among the best, each once; returns the new count."""
    size = len(values)
    if count == size and value <= values[count - 1]:
        return count
    key = np.uint64(0)
    for index in range(len(squares)):
        if kind[squares[index]] == 1:
            key ^= zobrist[index]
    for index in range(count):
        if hashes[index] == key:
            return count
    place = min(count, size - 1)
    while place > 0 and values[place - 1] < value:
        values[place] = values[place - 1]
        hashes[place] = hashes[place - 1]
        layouts[place] = layouts[place - 1]
        place -= 1
    values[place] = value
    hashes[place] = key
    for index in range(len(squares)):
        layouts[place, index] = kind[squares[index]] == 1
    return min(count + 1, size)


@nb.njit(cache=True)
def _state_key(kind, q, previous, stride, radius, uses_distance):
    """Hash of what the agent sees: window, distances D, previous action."""
    key = np.uint64(0xCBF29CE484222325)
    prime = np.uint64(0x100000001B3)
    for dr in range(-radius, radius + 1):
        for dc in range(-radius, radius + 1):
            p = q + dr * stride + dc
            seen = kind[p] if 0 <= p < len(kind) else -1
            key = (key ^ np.uint64(seen + 2)) * prime
    if uses_distance:
        for step in (-stride, stride, -1, 1):
            p, far = q + step, 0
            while kind[p] == 1:
                p += step
                far += 1
            key = (key ^ np.uint64(far + 16)) * prime
    key = (key ^ np.uint64(previous + 8)) * prime
    key ^= key >> np.uint64(29)
    return key | np.uint64(1)


@nb.njit(cache=True)
def _slot(keys, key):
    """Row of a state in the table, or -1 when the table is full around it."""
    mask = np.uint64(len(keys) - 1)
    place = (key * np.uint64(0x9E3779B97F4A7C15)) >> np.uint64(20) & mask
    for _ in range(64):
        if keys[place] == key:
            return np.int64(place)
        if keys[place] == 0:
            keys[place] = key
            return np.int64(place)
        place = (place + np.uint64(1)) & mask
    return np.int64(-1)


@nb.njit(cache=True)
def learn(
    site_kind,
    capacity,
    stride,
    squares,
    entrances,
    portals,
    weights,
    zobrist,
    first_episode,
    last_episode,
    random,
    schedule,
    keys,
    table,
    values,
    layouts,
    hashes,
    curve,
    count,
    alpha,
    gamma,
    epsilon_min,
    epsilon_decay,
    epsilon_refresh,
    patience,
    turn_back,
    interval,
    min_run,
    wheeling,
    served_reward,
    step_penalty,
    radius,
    uses_distance,
    masks_actions,
    archives_prefixes,
    max_steps,
):
    """Run some episodes of epsilon-greedy Sarsa on tables that live on; returns the archive's count and the steps.

    ``random`` is the generator's state, ``schedule`` holds epsilon and the episodes without change; ``hashes`` has one
    entry more than ``values``, the last episode's.
    """
    kind = site_kind.copy()
    best_kind = site_kind.copy()
    distance = np.empty(len(kind), dtype=np.int32)
    queue = np.empty(len(kind), dtype=np.int64)
    moves = np.array([-stride, stride, -1, 1, 0])
    starts = np.empty(4 * len(entrances), dtype=np.int64)
    start_count = 0
    for e in entrances:
        for step in moves[:4]:
            if site_kind[e + step] == 0:
                starts[start_count] = e + step
                start_count += 1
    epsilon, unchanged, last_key, total_steps = schedule[0], schedule[1], hashes[len(hashes) - 1], 0
    allowed = np.zeros(5, dtype=np.bool_)
    for episode in range(first_episode, last_episode):
        kind[:] = site_kind
        position = starts[0]
        start = position
        kind[position] = 1
        stalls = 0
        for step in moves[:4]:
            stalls += capacity_of(position + step, kind, capacity, stride)
        previous, run, earned = STAY, 0, 0.0
        best_value, best_found = NO_VALUE, False
        last_slot, last_action, last_reward = np.int64(-1), 0, 0.0
        best_stalls = -1
        ended = False
        for _ in range(max_steps):
            total_steps += 1
            # choose
            touched = untouched_portal(kind, portals, stride) < 0
            slot = _slot(keys, _state_key(kind, position, previous, stride, radius, uses_distance))
            any_allowed = 0
            for action in range(4):
                p = position + moves[action]
                allowed[action] = not masks_actions or kind[p] == 0 or kind[p] == 1
                any_allowed += allowed[action]
            # an agent that is walled in can only stay
            allowed[STAY] = not masks_actions or any_allowed == 0 or (position == start and touched)
            if uniform(random) < epsilon or slot < 0:
                action = int(uniform(random) * 5)
                while not allowed[action]:
                    action = int(uniform(random) * 5)
            else:
                action, top, ties = -1, -np.inf, 0
                for candidate in range(5):
                    if not allowed[candidate]:
                        continue
                    q_value = table[slot, candidate]
                    if q_value > top:
                        action, top, ties = candidate, q_value, 1
                    elif q_value == top:
                        ties += 1
                        if uniform(random) * ties < 1.0:
                            action = candidate
            # Sarsa: q(S, A) += alpha (R + gamma q(S', A') - q(S, A))
            if last_slot >= 0 and slot >= 0:
                target = last_reward + gamma * table[slot, action]
                table[last_slot, last_action] += alpha * (target - table[last_slot, last_action])
            # act
            reward = -step_penalty
            if action == STAY:
                ended = position == start and touched
                if not ended:
                    reward -= step_penalty
            else:
                p = position + moves[action]
                if kind[p] != 0 and kind[p] != 1:
                    ended = True
                    reward = -turn_back - 10.0
                else:
                    if previous != STAY and _OPPOSITE[previous] == action:
                        reward -= turn_back
                    elif previous != STAY and previous != action and run < min_run:
                        reward -= interval
                    run = run + 1 if previous == action else 1
                    position = p
                    if kind[p] == 0:
                        gained, served, beside = 0, 0, 0
                        for step in moves:
                            here = capacity_of(p + step, kind, capacity, stride)
                            gained -= here
                            served -= here > 0
                            beside += step != 0 and kind[p + step] == 1
                        kind[p] = 1
                        for step in moves:
                            here = capacity_of(p + step, kind, capacity, stride)
                            gained += here
                            served += here > 0
                        stalls += gained
                        reward += gained + served_reward * served
                        if beside > 1:
                            reward -= wheeling * (beside - 1)
                        if archives_prefixes and stalls >= best_stalls - 2:
                            best_stalls = max(best_stalls, stalls)
                            if untouched_portal(kind, portals, stride) < 0:
                                value, _n, _t, _u = value_of(
                                    kind, capacity, stride, entrances, squares, weights, distance, queue
                                )
                                if value > best_value:
                                    best_value, best_found = value, True
                                    count = _archive(kind, squares, value, values, layouts, hashes, zobrist, count)
            if ended and action != STAY:
                # R_T of a failed action is learnt from, but not counted: the last unfailed state is scored
                if slot >= 0:
                    table[slot, action] += alpha * (reward - table[slot, action])
                break
            earned += reward
            if ended:
                if slot >= 0:
                    table[slot, action] += alpha * (reward - table[slot, action])
                break
            previous = action
            last_slot, last_action, last_reward = slot, action, reward
        curve[episode] = earned
        if not best_found:
            best_kind[:] = kind
            if connect_portals(best_kind, portals, stride, squares, distance, queue):
                value, _n, _t, _u = value_of(best_kind, capacity, stride, entrances, squares, weights, distance, queue)
                if value > NO_VALUE:
                    count = _archive(best_kind, squares, value, values, layouts, hashes, zobrist, count)
        epsilon = max(epsilon * epsilon_decay, epsilon_min)
        key = np.uint64(0)
        for index in range(len(squares)):
            if kind[squares[index]] == 1:
                key ^= zobrist[index]
        unchanged = unchanged + 1 if key == last_key else 0
        last_key = key
        if unchanged >= patience:
            epsilon, unchanged = epsilon_refresh, 0
    schedule[0], schedule[1] = epsilon, unchanged
    hashes[len(hashes) - 1] = last_key
    return count, total_steps

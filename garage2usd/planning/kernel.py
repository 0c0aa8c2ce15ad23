"""The compiled part of the planner: episodes of tabular Sarsa, the score, and the archive.

Squares are numbered ``(row + 1) * stride + col + 1`` on a matrix padded by one blocked square. Imported on first use,
so that nothing else pays for the compiler.
"""

import numba as nb
import numpy as np

__all__ = ["climb", "learn", "value_of"]

STAY = 4
_OPPOSITE = np.array([1, 0, 3, 2, -1], dtype=np.int64)
_NO_VALUE = -1.0e9


@nb.njit(cache=True, inline="always")
def _next_random(state):
    """splitmix64: the same numbers on every machine."""
    state[0] += np.uint64(0x9E3779B97F4A7C15)
    z = state[0]
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return z ^ (z >> np.uint64(31))


@nb.njit(cache=True, inline="always")
def _uniform(state):
    return np.float64(_next_random(state) >> np.uint64(11)) * (1.0 / 9007199254740992.0)


@nb.njit(cache=True, inline="always")
def _capacity(q, kind, capacity, stride):
    """Stalls on square q: 0 unless it is free and a lane lies beside it."""
    if kind[q] != 0:
        return 0
    up, down = kind[q - stride] == 1, kind[q + stride] == 1
    left, right = kind[q - 1] == 1, kind[q + 1] == 1
    along_x = capacity[q, 1] if up and down else (capacity[q, 0] if up or down else 0)
    along_z = capacity[q, 3] if left and right else (capacity[q, 2] if left or right else 0)
    return max(along_x, along_z)


@nb.njit(cache=True)
def value_of(kind, capacity, stride, entrances, squares, weights, distance, queue):
    """Y' of a matrix whose lanes are connected and touch every portal; (value, N_S, T_S, U_S)."""
    for q in squares:
        distance[q] = -1
    head, tail = 0, 0
    steps = (-stride, stride, -1, 1)
    for e in entrances:
        for step in steps:
            q = e + step
            if kind[q] == 1 and distance[q] < 0:
                distance[q] = 1
                queue[tail] = q
                tail += 1
    while head < tail:
        q = queue[head]
        head += 1
        for step in steps:
            p = q + step
            if kind[p] == 1 and distance[p] < 0:
                distance[p] = distance[q] + 1
                queue[tail] = p
                tail += 1
    stalls, time, unused = 0, 0, 0
    for q in squares:
        if kind[q] != 0:
            continue
        count = _capacity(q, kind, capacity, stride)
        if count == 0:
            unused += 1
            continue
        nearest = 1 << 30
        for step in steps:
            if kind[q + step] == 1:
                if distance[q + step] < 0:
                    return _NO_VALUE, 0, 0.0, 0
                nearest = min(nearest, distance[q + step])
        stalls += count
        time += count * (1 + nearest)
    if stalls == 0:
        return _NO_VALUE, 0, 0.0, unused
    mean = time / stalls
    return weights[0] * stalls + weights[1] * mean + weights[2] * unused, stalls, mean, unused


@nb.njit(cache=True, inline="always")
def _untouched(kind, portals, stride):
    """Index of the first portal beside no lane, or -1."""
    for index in range(len(portals)):
        q = portals[index]
        if kind[q - stride] != 1 and kind[q + stride] != 1 and kind[q - 1] != 1 and kind[q + 1] != 1:
            return index
    return -1


@nb.njit(cache=True)
def _connect(kind, portals, stride, squares, distance, queue):
    """Join every untouched portal to the lanes by a shortest path over free squares; False if there is none."""
    steps = (-stride, stride, -1, 1)
    while True:
        index = _untouched(kind, portals, stride)
        if index < 0:
            return True
        target = portals[index]
        tail = 0
        for q in squares:
            distance[q] = -1
        for q in squares:
            if kind[q] == 1:
                distance[q] = 0
                queue[tail] = q
                tail += 1
        head, found = 0, -1
        while head < tail and found < 0:
            q = queue[head]
            head += 1
            for step in steps:
                p = q + step
                if p == target:
                    found = q
                    break
                if kind[p] == 0 and distance[p] < 0:
                    distance[p] = distance[q] + 1
                    queue[tail] = p
                    tail += 1
        if found < 0:
            return False
        while kind[found] != 1:
            kind[found] = 1
            for step in steps:
                if kind[found + step] >= 0 and distance[found + step] == distance[found] - 1:
                    found += step
                    break


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
            stalls += _capacity(position + step, kind, capacity, stride)
        previous, run, earned = STAY, 0, 0.0
        best_value, best_found = _NO_VALUE, False
        last_slot, last_action, last_reward = np.int64(-1), 0, 0.0
        best_stalls = -1
        ended = False
        for _ in range(max_steps):
            total_steps += 1
            # choose
            touched = _untouched(kind, portals, stride) < 0
            slot = _slot(keys, _state_key(kind, position, previous, stride, radius, uses_distance))
            any_allowed = 0
            for action in range(4):
                p = position + moves[action]
                allowed[action] = not masks_actions or kind[p] == 0 or kind[p] == 1
                any_allowed += allowed[action]
            allowed[STAY] = not masks_actions or (position == start and touched)
            if _uniform(random) < epsilon or slot < 0:
                action = int(_uniform(random) * 5)
                while not allowed[action]:
                    action = int(_uniform(random) * 5)
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
                        if _uniform(random) * ties < 1.0:
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
                            here = _capacity(p + step, kind, capacity, stride)
                            gained -= here
                            served -= here > 0
                            beside += step != 0 and kind[p + step] == 1
                        kind[p] = 1
                        for step in moves:
                            here = _capacity(p + step, kind, capacity, stride)
                            gained += here
                            served += here > 0
                        stalls += gained
                        reward += gained + served_reward * served
                        if beside > 1:
                            reward -= wheeling * (beside - 1)
                        if archives_prefixes and stalls >= best_stalls - 2:
                            best_stalls = max(best_stalls, stalls)
                            if _untouched(kind, portals, stride) < 0:
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
            if _connect(best_kind, portals, stride, squares, distance, queue):
                value, _n, _t, _u = value_of(best_kind, capacity, stride, entrances, squares, weights, distance, queue)
                if value > _NO_VALUE:
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


@nb.njit(cache=True)
def _connected(kind, squares, stride, distance, queue):
    """Whether the lanes form one 4-connected piece."""
    total, first = 0, np.int64(-1)
    for q in squares:
        distance[q] = 0
        if kind[q] == 1:
            total += 1
            first = q
    if total == 0:
        return False
    queue[0] = first
    distance[first] = 1
    head, tail = 0, 1
    while head < tail:
        q = queue[head]
        head += 1
        for step in (-stride, stride, -1, 1):
            p = q + step
            if kind[p] == 1 and distance[p] == 0:
                distance[p] = 1
                queue[tail] = p
                tail += 1
    return tail == total


@nb.njit(cache=True)
def climb(kind, capacity, stride, squares, entrances, portals, weights, seed, passes):
    """Improve a feasible matrix in place by flips of one square or of a straight pair; returns its value."""
    random = np.array([seed], dtype=np.uint64)
    distance = np.empty(len(kind), dtype=np.int32)
    queue = np.empty(len(kind), dtype=np.int64)
    order = squares.copy()
    value, _n, _t, _u = value_of(kind, capacity, stride, entrances, squares, weights, distance, queue)
    steps = (0, stride, 1)
    for _ in range(passes):
        for index in range(len(order) - 1, 0, -1):
            other = int(_next_random(random) % np.uint64(index + 1))
            order[index], order[other] = order[other], order[index]
        improved = False
        for q in order:
            for step in steps:
                p = q + step
                if kind[q] != 0 and kind[q] != 1:
                    continue
                if kind[p] != 0 and kind[p] != 1:
                    continue
                kind[q] = 1 - kind[q]
                if step != 0:
                    kind[p] = 1 - kind[p]
                better = _untouched(kind, portals, stride) < 0
                if better:
                    tried, _n, _t, _u = value_of(kind, capacity, stride, entrances, squares, weights, distance, queue)
                    better = tried > value + 1e-9 and _connected(kind, squares, stride, distance, queue)
                if better:
                    value = tried
                    improved = True
                else:
                    kind[q] = 1 - kind[q]
                    if step != 0:
                        kind[p] = 1 - kind[p]
        if not improved:
            break
    return value

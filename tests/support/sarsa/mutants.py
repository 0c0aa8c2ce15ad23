"""Faults that ``mutations.py`` plants in the compiled loop: each text stands once in its module."""

from typing import NamedTuple

__all__ = ["MUTANTS", "Mutant"]


class Mutant(NamedTuple):
    """A fault: a text in a module of `garage2usd.planning`, and what takes its place."""

    name: str
    old: str
    new: str
    module: str = "sarsa"


_GAINED = """\
                    lay(ground, board, target_square)
                    laid[lanes] = target_square
                    lanes += 1
                    reward += board.tally[0] - stalls
"""
_GAINED_FIRST = """\
                    reward += board.tally[0] - stalls
                    lay(ground, board, target_square)
                    laid[lanes] = target_square
                    lanes += 1
"""
_PREFIX = "best_value, best_lanes, best_step = value, lanes, step"
_FAILED = "            if failed:\n"
_MOVED = "                run = run + 1 if action == previous else 1\n                position = target_square\n"
_REPLAYED = "                run = run + 1 if action == previous else 1\n                previous = action\n"

MUTANTS = (
    # the four penalties, and the rest of the reward
    Mutant("turn-back penalty left out", "reward -= p.turn_back_penalty", "reward -= 0.0"),
    Mutant("turn-back penalty paid out", "reward -= p.turn_back_penalty", "reward += p.turn_back_penalty"),
    Mutant("turn-back penalty for a turn aside", "previous == (action ^ 1)", "previous == (action ^ 2)"),
    Mutant("interval penalty left out", "reward -= p.interval_penalty", "reward -= 0.0"),
    Mutant("interval penalty paid out", "reward -= p.interval_penalty", "reward += p.interval_penalty"),
    Mutant("interval one square longer", "run < p.min_run_squares", "run <= p.min_run_squares"),
    Mutant("run counted from zero", _MOVED, _MOVED.replace("else 1", "else 0")),
    Mutant("run never begun anew", _MOVED, _MOVED.replace(" if action == previous else 1", "")),
    Mutant("run of a replayed tape lost", _REPLAYED, "                run, previous = 1, action\n"),
    Mutant("wheeling penalty left out", "reward -= p.wheeling_penalty * max(0, beside - 1)", "reward -= 0.0"),
    Mutant("wheeling penalty paid out", "reward -= p.wheeling_penalty", "reward += p.wheeling_penalty"),
    Mutant("wheeling penalty for the lane continued", "max(0, beside - 1)", "max(0, beside)"),
    Mutant("loop reward left out", "reward += p.loop_reward * (beside > 1)", "reward += 0.0"),
    Mutant("loop reward without a loop", "(beside > 1)", "(beside > 0)"),
    Mutant("step penalty left out", "reward = -p.step_penalty\n", "reward = 0.0\n"),
    Mutant("step penalty paid out", "reward = -p.step_penalty\n", "reward = p.step_penalty\n"),
    Mutant("step penalty of staying left out", "                reward -= p.step_penalty\n", ""),
    Mutant("failure penalty left out", "(-p.failure_penalty - memory", "(-memory"),
    Mutant("failure penalty paid out", "(-p.failure_penalty - memory", "(p.failure_penalty - memory"),
    Mutant("stalls counted before the move", _GAINED, _GAINED_FIRST),
    Mutant("stalls taken away", "reward += board.tally[0] - stalls", "reward -= board.tally[0] - stalls"),
    # what is learnt from it
    Mutant("gamma left out", "reward + p.gamma * memory", "reward + memory"),
    Mutant("alpha left out", "p.alpha * (target - memory", "(target - memory"),
    Mutant("value of the next state left out", "target = reward + p.gamma * memory.q[row, action]", "target = reward"),
    Mutant("Q-learning", "p.gamma * memory.q[row, action]", "p.gamma * memory.q[row].max()"),
    Mutant("last action not learnt from", "        if row >= 0:\n", "        if row < -1:\n"),
    Mutant("failure learnt from twice", "                row = -1\n                break\n", "                break\n"),
    Mutant("return with the failure", _FAILED, f"{_FAILED}                earned -= p.failure_penalty\n"),
    Mutant("return without the first stalls", "float(board.tally[0]), 0.0", "0.0, 0.0"),
    # where the agent may go, and when the episode ends
    Mutant("staying ends anywhere", "done = position == start", "done = True"),
    Mutant("staying never ends", "done = position == start", "done = False"),
    Mutant("drives on from its start", "elif position == start and previous != STAY:", "elif position < 0:"),
    Mutant("start closed", " or target_square == start:", ":"),
    Mutant("portals open", "elif kind == 0 or kind == 1 or target_square", "elif kind >= 0 or target_square"),
    Mutant("staying unmasked", "allowed[STAY] = False", "allowed[STAY] = True"),
    Mutant("lanes masked", "allowed[way] = kind == 0 or kind == 1", "allowed[way] = kind == 0"),
    Mutant("one action less", "while step < max_steps and", "while step < max_steps - 1 and"),
    # what it sees
    Mutant("last action unseen", "np.uint64(previous + 1)", "np.uint64(1)"),
    Mutant("window shifted", "first = square + row * stride - radius", "first = square + row * stride"),
    Mutant("distances through portals", "while cells[q] == 0 or cells[q] == 1:", "while cells[q] >= 0:"),
    Mutant("distances unseen", "if parameters.sees_distances:", "if parameters.alpha < 0:"),
    # how it chooses
    Mutant("epsilon as worded", "if uniform(random) < epsilon:", "if uniform(random) >= epsilon:"),
    Mutant("least of the values", "memory.q[row, place] > top", "-memory.q[row, place] > top"),
    Mutant("ties to the first action", "(first + offset) % ACTIONS", "offset"),
    Mutant("epsilon below its least", "max(epsilon * p.epsilon_decay, p.epsilon_min)", "epsilon * p.epsilon_decay"),
    Mutant("patience one episode longer", "unchanged >= p.patience_episodes", "unchanged > p.patience_episodes"),
    Mutant("patience never lost", "if key == memory.last[0] else 0.0", "if key == memory.last[0] else unchanged"),
    # what it keeps and goes on from
    Mutant("prefix one action short", _PREFIX, f"{_PREFIX} - 1"),
    Mutant("prefix that misses a portal", "kind == 0 and board.tally[_UNTOUCHED] == 0", "kind == 0"),
    Mutant("plan kept without the cost of its faults", ") - faults_cost(ground, board)\n", ")\n"),
    Mutant("goes on from the worse of two", "values[rival] > archive", "values[rival] < archive"),
    Mutant("goes on from the whole", "np.int64(share * archive.lengths[entry])", "archive.lengths[entry]"),
    Mutant("replays from its own entrance", "            start = archive.starts[entry]\n", ""),
    Mutant("keeps no better plan once full", "if full and value <= ", "if full or value <= ", "archive"),
    Mutant("keeps a plan twice", "if archive.keys[index] == key:", "if archive.keys[index] == 0:", "archive"),
    Mutant(
        "drops the best",
        "archive.values[entry] < archive.values[count[1]]",
        "archive.values[entry] > archive.values[count[1]]",
        "archive",
    ),
)

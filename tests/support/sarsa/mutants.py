"""Faults that ``mutations.py`` plants in the C text of learning: each text stands once in its file."""

from typing import NamedTuple

__all__ = ["MUTANTS", "Mutant"]


class Mutant(NamedTuple):
    """A fault: a text in a C file of `garage2usd.native`, and what takes its place."""

    name: str
    old: str
    new: str
    file: str = "sarsa"


_STALLS = "                    int64_t stalls = tally[STALLS];\n"
_LAID = """\
                    lay(ground, board, target);
                    laid[lanes++] = target;
"""
_GAINED = "                    reward += (double)(tally[STALLS] - stalls);\n"
_NEXT = "p->gamma * *value"
_GREATEST = "fmax(fmax(fmax(values[0], values[1]), fmax(values[2], values[3])), values[4])"
_FAILED = "            if (failed) {\n"
_MOVED = "run = action == previous ? run + 1 : 1;\n                position = target;\n"
_REPLAYED = "run = action == previous ? run + 1 : 1;\n                previous = action;\n"
_WHEELING = "reward -= p->wheeling_penalty"
_FREE_OR_LANE = "beside == FREE || beside == LANE"

MUTANTS = (
    # the four penalties, and the rest of the reward
    Mutant("turn-back penalty left out", "reward -= p->turn_back_penalty", "reward -= 0.0"),
    Mutant("turn-back penalty paid out", "reward -= p->turn_back_penalty", "reward += p->turn_back_penalty"),
    Mutant("turn-back penalty for a turn aside", "previous == (action ^ 1)", "previous == (action ^ 2)"),
    Mutant("interval penalty left out", "reward -= p->interval_penalty", "reward -= 0.0"),
    Mutant("interval penalty paid out", "reward -= p->interval_penalty", "reward += p->interval_penalty"),
    Mutant("interval one square longer", "run < p->min_run_squares", "run <= p->min_run_squares"),
    Mutant("run counted from zero", _MOVED, _MOVED.replace(": 1", ": 0")),
    Mutant("run never begun anew", _MOVED, _MOVED.replace("action == previous ? run + 1 : 1", "run + 1")),
    Mutant("run of a replayed tape lost", _REPLAYED, _REPLAYED.replace("action == previous ? run + 1 : 1", "1")),
    Mutant("wheeling penalty left out", f"{_WHEELING} * (double)most(0, beside - 1)", "reward -= 0.0"),
    Mutant("wheeling penalty paid out", _WHEELING, _WHEELING.replace("-=", "+=")),
    Mutant("wheeling penalty for the lane continued", "most(0, beside - 1)", "most(0, beside)"),
    Mutant("loop reward left out", "reward += p->loop_reward * (beside > 1)", "reward += 0.0"),
    Mutant("loop reward without a loop", "(beside > 1)", "(beside > 0)"),
    Mutant("step penalty left out", "reward = -p->step_penalty;", "reward = 0.0;"),
    Mutant("step penalty paid out", "reward = -p->step_penalty;", "reward = p->step_penalty;"),
    Mutant("step penalty of staying left out", "                reward -= p->step_penalty;\n", ""),
    Mutant("failure penalty left out", "p->alpha, -p->failure_penalty", "p->alpha, 0.0"),
    Mutant("failure penalty paid out", "p->alpha, -p->failure_penalty", "p->alpha, p->failure_penalty"),
    Mutant("stalls counted before the move", _STALLS + _LAID + _GAINED, _STALLS + _GAINED + _LAID),
    Mutant("stalls taken away", _GAINED, _GAINED.replace("+=", "-=")),
    # what is learnt from it
    Mutant("gamma left out", _NEXT, "*value"),
    Mutant("alpha left out", "move_towards(old, p->alpha,", "move_towards(old, 1.0,"),
    Mutant("value of the next state left out", f"reward + {_NEXT}", "reward"),
    Mutant("Q-learning", _NEXT, f"p->gamma * {_GREATEST}"),
    Mutant("last action not learnt from", "        if (value != NULL)\n", "        if (false)\n"),
    Mutant(
        "failure learnt from twice",
        "                value = NULL;\n                break;\n",
        "                break;\n",
    ),
    Mutant("return with the failure", _FAILED, f"{_FAILED}                earned -= p->failure_penalty;\n"),
    Mutant("return without the first stalls", "earned = (double)tally[STALLS]", "earned = 0.0"),
    Mutant("learns in single precision", "alpha * (target - *value)", "(float)alpha * ((float)target - *value)"),
    # where the agent may go, and when the episode ends
    Mutant("staying ends anywhere", "done = position == start", "done = true"),
    Mutant("staying never ends", "done = position == start", "done = false"),
    Mutant("drives on from its start", "else if (position == start && previous != STAY)", "else if (position < 0)"),
    Mutant("start closed", " || target == start)", ")"),
    Mutant("portals open", "else if (kind == FREE || kind == LANE || target", "else if (kind >= FREE || target"),
    Mutant("staying unmasked", "allowed[STAY] = false", "allowed[STAY] = true"),
    Mutant("lanes masked", f"allowed[way] = {_FREE_OR_LANE}", "allowed[way] = beside == FREE"),
    Mutant("one action less", "while (step < max_steps &&", "while (step < max_steps - 1 &&"),
    # what it sees
    Mutant("last action unseen", "(uint64_t)(previous + 1)", "(uint64_t)1"),
    Mutant("window shifted", "first = square + row * ground->stride - radius", "first = square + row * ground->stride"),
    Mutant("distances through portals", "while (cells[q] == FREE || cells[q] == LANE)", "while (cells[q] >= FREE)"),
    Mutant("distances unseen", "if (parameters->sees_distances)", "if (false)"),
    # how it chooses
    Mutant("epsilon as worded", "if (uniform(random) < epsilon)", "if (uniform(random) >= epsilon)"),
    Mutant("least of the values", "values[place] > top", "-values[place] > top"),
    Mutant("ties to the first action", "(first + offset) % ACTIONS", "offset"),
    Mutant("epsilon below its least", "if (epsilon < p->epsilon_min)", "if (false)"),
    Mutant("patience one episode longer", "unchanged >= (double)p->patience", "unchanged > (double)p->patience"),
    Mutant("patience never lost", "? unchanged + 1 : 0.0", "? unchanged + 1 : unchanged"),
    # what it keeps and goes on from
    Mutant(
        "prefix one action short", "                    best_step = step;", "                    best_step = step - 1;"
    ),
    Mutant("prefix that misses a portal", "kind == FREE && tally[UNTOUCHED] == 0", "kind == FREE"),
    Mutant("plan kept without the cost of its faults", ") - faults_cost(ground, board);", ");"),
    Mutant("goes on from the worse of two", "values.at[rival] > archive", "values.at[rival] < archive"),
    Mutant("goes on from the whole", "share * (double)archive->lengths", "(double)archive->lengths"),
    Mutant("replays from its own entrance", "            start = archive->starts.at[entry];\n", ""),
    Mutant("keeps no better plan once full", "if (full && value <= ", "if (full || value <= ", "archive"),
    Mutant("keeps a plan twice", "if (archive->keys.at[index] == key)", "if (archive->keys.at[index] == 0)", "archive"),
    Mutant("drops the best", "values[entry] < values[count[1]]", "values[entry] > values[count[1]]", "archive"),
)

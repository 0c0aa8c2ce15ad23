"""Faults that ``mutations.py`` plants in the C text of learning: each text stands once in its file."""

from typing import NamedTuple

__all__ = ["MUTANTS", "Mutant"]


class Mutant(NamedTuple):
    """A fault: a text in a C file of `garage2usd.native`, and what takes its place."""

    name: str
    old: str
    new: str
    file: str = "sarsa"


_STALLS = "            int64_t stalls = AT(tally, STALLS);\n"
_LAID = "            colour(learning, episode);\n"
_GAINED = "            gained += (double)(AT(tally, STALLS) - stalls);\n"
_NEXT = "p->gamma * *value"
_GREATEST = (
    "fmax(fmax(fmax(value[-action], value[1 - action]), fmax(value[2 - action], value[3 - action])), value[4 - action])"
)
_MOVED = "episode->run = action == previous ? episode->run + 1 : 1"
_REPLAYED = "episode.run = action == episode.previous ? episode.run + 1 : 1"
_WHEELING = "gained -= p->wheeling_penalty"
_FREE_OR_LANE = "beside == FREE || beside == LANE"

MUTANTS = (
    # the four penalties, and the rest of the reward
    Mutant("turn-back penalty left out", "gained -= p->turn_back_penalty", "gained -= 0.0"),
    Mutant("turn-back penalty paid out", "gained -= p->turn_back_penalty", "gained += p->turn_back_penalty"),
    Mutant("turn-back penalty for a turn aside", "previous == (action ^ 1)", "previous == (action ^ 2)"),
    Mutant("interval penalty left out", "gained -= p->interval_penalty", "gained -= 0.0"),
    Mutant("interval penalty paid out", "gained -= p->interval_penalty", "gained += p->interval_penalty"),
    Mutant("interval one square longer", "run < p->min_run_squares", "run <= p->min_run_squares"),
    Mutant("run counted from zero", _MOVED, _MOVED.replace(": 1", ": 0")),
    Mutant("run never begun anew", _MOVED, "episode->run = episode->run + 1"),
    Mutant("run of a replayed tape lost", _REPLAYED, "episode.run = 1"),
    Mutant("wheeling penalty left out", f"{_WHEELING} * (double)most(0, beside - 1)", "gained -= 0.0"),
    Mutant("wheeling penalty paid out", _WHEELING, _WHEELING.replace("-=", "+=")),
    Mutant("wheeling penalty for the lane continued", "most(0, beside - 1)", "most(0, beside)"),
    Mutant("loop reward left out", "gained += p->loop_reward * (beside > 1)", "gained += 0.0"),
    Mutant("loop reward without a loop", "(beside > 1)", "(beside > 0)"),
    Mutant("step penalty left out", "gained = -p->step_penalty;", "gained = 0.0;"),
    Mutant("step penalty paid out", "gained = -p->step_penalty;", "gained = p->step_penalty;"),
    Mutant("step penalty of staying left out", "        gained -= p->step_penalty;\n", ""),
    Mutant("failure penalty left out", "p->alpha, -p->failure_penalty", "p->alpha, 0.0"),
    Mutant("failure penalty paid out", "p->alpha, -p->failure_penalty", "p->alpha, p->failure_penalty"),
    Mutant("stalls counted before the move", _STALLS + _LAID + _GAINED, _STALLS + _GAINED + _LAID),
    Mutant("stalls taken away", _GAINED, _GAINED.replace("+=", "-=")),
    # what is learnt from it
    Mutant("gamma left out", _NEXT, "*value"),
    Mutant("alpha left out", "move_towards(episode.value, p->alpha,", "move_towards(episode.value, 1.0,"),
    Mutant("value of the next state left out", f"episode.reward + {_NEXT}", "episode.reward"),
    Mutant("Q-learning", _NEXT, f"p->gamma * {_GREATEST}"),
    Mutant("last action not learnt from", "    if (episode->value != NULL)\n", "    if (false)\n"),
    Mutant(
        "failure learnt from twice",
        "                episode.value = NULL;\n                break;\n",
        "                break;\n",
    ),
    Mutant(
        "return with the failure",
        "episode.value = NULL;\n",
        "episode.value = NULL;\n                episode.earned -= p->failure_penalty;\n",
    ),
    Mutant("return without the first stalls", "earned = (double)AT(learning->board->tally, STALLS)", "earned = 0.0"),
    Mutant("learns in single precision", "alpha * (target - *value)", "(float)alpha * ((float)target - *value)"),
    # where the agent may go, and when the episode ends
    Mutant("staying ends anywhere", "is_over = position == start", "is_over = true"),
    Mutant("staying never ends", "is_over = position == start", "is_over = false"),
    Mutant("drives on from its start", "else if (position == start && previous != STAY)", "else if (position < 0)"),
    Mutant("start closed", " || target == start)", ")"),
    Mutant("portals open", "else if (kind == FREE || kind == LANE || target", "else if (kind >= FREE || target"),
    Mutant("staying unmasked", "AT(allowed, STAY) = false", "AT(allowed, STAY) = true"),
    Mutant("lanes masked", f"AT(allowed, way) = {_FREE_OR_LANE}", "AT(allowed, way) = beside == FREE"),
    Mutant("one action less", "while (episode.steps < max_steps &&", "while (episode.steps < max_steps - 1 &&"),
    # what it sees
    Mutant("last action unseen", "(uint64_t)(previous + 1)", "(uint64_t)1"),
    Mutant("window shifted", "first = square + row * ground->stride - radius", "first = square + row * ground->stride"),
    Mutant(
        "distances through portals",
        "while (AT(cells, q) == FREE || AT(cells, q) == LANE)",
        "while (AT(cells, q) >= FREE)",
    ),
    Mutant("distances unseen", "if (parameters->sees_distances)", "if (false)"),
    # how it chooses
    Mutant("epsilon as worded", "if (uniform(random) < epsilon)", "if (uniform(random) >= epsilon)"),
    Mutant("least of the values", "values[place] > top", "-values[place] > top"),
    Mutant("ties to the first action", "(first + offset) % ACTIONS", "offset"),
    Mutant("epsilon below its least", "if (epsilon < p->epsilon_min)", "if (false)"),
    Mutant("patience one episode longer", "unchanged >= (double)p->patience", "unchanged > (double)p->patience"),
    Mutant("patience never lost", "? AT(course, 1) + 1 : 0.0", "? AT(course, 1) + 1 : AT(course, 1)"),
    # what it keeps and goes on from
    Mutant("prefix one action short", "best_steps = episode->steps;", "best_steps = episode->steps - 1;"),
    Mutant("prefix that misses a portal", "if (AT(learning->board->tally, UNTOUCHED) > 0)", "if (false)"),
    Mutant(
        "plan kept without the cost of its faults",
        "value -= faults_cost(learning->ground, learning->board)",
        "value -= 0.0",
    ),
    Mutant("goes on from the worse of two", "AT(archive->values, rival) > ", "AT(archive->values, rival) < "),
    Mutant("goes on from the whole", "share * (double)AT", "(double)AT"),
    Mutant("replays from its own entrance", "        episode.start = AT(archive->starts, entry);\n", ""),
    Mutant("keeps no better plan once full", "if (full && value <= ", "if (full || value <= ", "archive"),
    Mutant(
        "keeps a plan twice", "if (AT(archive->keys, index) == key)", "if (AT(archive->keys, index) == 0)", "archive"
    ),
    Mutant(
        "drops the best",
        "AT(values, entry) < AT(values, AT(count, 1))",
        "AT(values, entry) > AT(values, AT(count, 1))",
        "archive",
    ),
)

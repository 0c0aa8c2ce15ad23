"""Plant faults in the compiled Sarsa and see its property find them.

``python -m support.sarsa.mutations [--only NAME]`` in ``tests``. Each fault of ``mutants.py`` is planted alone in a
copy of the module, which then runs uncompiled on the random sites of the property. Ends with 1 if a fault survives.
"""

import argparse
import os
import sys
import time
from pathlib import Path
from types import ModuleType

os.environ["NUMBA_DISABLE_JIT"] = "1"  # nothing is compiled, so that a fault costs milliseconds

import numpy as np

import garage2usd.planning
from garage2usd.planning import sarsa
from support.sarsa.following import check_states, property_of
from support.sarsa.mutants import MUTANTS, Mutant

PLANNING = Path(garage2usd.planning.__file__).parent
EXAMPLES, CONTROL_EXAMPLES = 200, 50


def planted(mutant: Mutant) -> ModuleType:
    """The module `sarsa` with the fault in it, or in the archive that it keeps plans in."""
    text = (PLANNING / f"{mutant.module}.py").read_text(encoding="utf-8")
    assert text.count(mutant.old) == 1, f"{mutant.name}: its text is {text.count(mutant.old)} times in {mutant.module}"
    faulty = ModuleType(f"faulty_{mutant.module}")
    exec(compile(text.replace(mutant.old, mutant.new), faulty.__name__, "exec"), faulty.__dict__)
    if mutant.module == "sarsa":
        return faulty
    around = ModuleType("around")
    exec((PLANNING / "sarsa.py").read_text(encoding="utf-8"), around.__dict__)
    around.__dict__.update({name: getattr(faulty, name) for name in ("keep", "next_random", "uniform")})
    return around


def failure_of(module: ModuleType, examples: int = EXAMPLES) -> str | None:
    """How the property fails of a module; None if it holds."""
    try:
        with np.errstate(all="ignore"):  # hashes are meant to overflow
            check_states(module)
            property_of(module, number=np.float64, examples=examples)()
    except Exception as failure:
        return type(failure).__name__
    return None


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", metavar="NAME", help="plant the faults alone whose names hold this")
    only = parser.parse_args().only or ""
    assert failure_of(sarsa, CONTROL_EXAMPLES) is None, "the property fails of the module as it is"
    chosen = [mutant for mutant in MUTANTS if only in mutant.name]
    survivors = 0
    for mutant in chosen:
        start = time.perf_counter()
        failure = failure_of(planted(mutant))
        survivors += failure is None
        verdict = f"caught ({failure})" if failure else "SURVIVED"
        print(f"{mutant.name}: {verdict}, {time.perf_counter() - start:.1f} s", flush=True)
    print(f"{len(chosen) - survivors} of {len(chosen)} caught")
    sys.exit(survivors > 0)


if __name__ == "__main__":
    main()

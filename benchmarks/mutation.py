"""Which share of all mutants of the generated modules does the suite notice?

    python benchmarks/mutation.py [--every N] [--jobs N] [ROBOT]

One fixed operator list (rapidgen/proving/mutation.py); every place where an operator fits is a
mutant. `--every N` takes each N-th. Survivors are listed: each is a missing case, or the same
program in other words.
"""

import argparse
import signal
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError
from rapidgen.generate import build, make_system
from rapidgen.proving.bench import Bench, with_module
from rapidgen.proving.model import Broken
from rapidgen.proving.mutation import mutants
from rapidgen.proving.suite import CASES
from rapidgen.virtual.controller import Deadlock

PATIENCE = 120
"""s of wall clock in which a mutant must have been judged; one that hangs the driver is seen."""


class Hung(Exception):
    """The mutant makes no progress."""


def hang(*_):
    raise Hung


def judge(mutant):
    """Name of the case that notices the mutant, or an empty text."""
    signal.signal(signal.SIGALRM, hang)
    signal.alarm(PATIENCE)
    try:
        for case in CASES:
            bench = Bench(CONFIG, with_module(SYSTEM, mutant.module, mutant.text))
            try:
                case.prove(bench)
            except (Broken, Deadlock):
                return case.name
            finally:
                bench.close()
    except DiagnosticError:
        return "(not loaded)"
    except Hung:
        return "(hangs)"
    finally:
        signal.alarm(0)
    return ""


def main():
    found = [
        mutant
        for name, data in sorted({m.name: m.data for t in SYSTEM.tasks for m in t.modules}.items())
        for mutant in mutants(data, name)
    ]
    chosen = found[:: ARGUMENTS.every]
    print(f"{len(chosen)} of {len(found)} mutants")
    killed = {}
    with ProcessPoolExecutor(ARGUMENTS.jobs, mp_context=get_context("fork")) as pool:
        for mutant, by in zip(chosen, pool.map(judge, chosen), strict=True):
            own = killed.setdefault(mutant.module, [0, 0])
            own[0] += bool(by)
            own[1] += 1
            if not by:
                change = " ".join(mutant.change.split())
                print(f"  survives: {mutant.module}:{mutant.line} {change[:90]}", flush=True)
    for module, (dead, of) in killed.items():
        print(f"{module:18} {dead:4} of {of:4}")
    dead, of = (sum(pair[i] for pair in killed.values()) for i in (0, 1))
    print(f"{'all':18} {dead:4} of {of:4} = {dead / of:.1%}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("robot", nargs="?", default="irb120")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    ARGUMENTS = parser.parse_args()
    CONFIG = load_config(ARGUMENTS.robot)
    SYSTEM = make_system(CONFIG, build(CONFIG))
    main()

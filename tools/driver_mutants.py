"""Measure the share of mutants of the generated modules that the suite detects.

    python tools/driver_mutants.py [--every N] [--offset N] [--jobs N | --cluster ADDRESS]
        [--budget S] [--output FILE] [--again] [--row NAME] [--only MODULE ...] [--themes THEME ...]
        [ROBOT]

The operator list is fixed (tools/mutation/driver.py); every place in a routine that fits an
operator is a mutant, equivalent ones included. `--every N` takes each N-th, from `--offset` on. The
cases of `rapidgen test` that execute its statement judge a mutant, until one detects it or
`--budget` s of CPU are spent: a mutant not detected by then counts as a survivor.

Verdicts go to FILE (JSON lines) in order; an interrupted run continues, as long as only the
modules' build id has changed. `--cluster` uses the workers of a Dask scheduler, started in a
checkout of the same state: verdicts are the same, unless a budget ends them.
Survivors are listed by module, with their lines: each is a missing case, or an equivalent
program. `--only` limits the modules, `--themes` the cases;
tools/cell.yaml is a ROBOT with signals, tools, routines and data.
`--again` continues with the survivors of FILE, with cases that were not tried or did not exist;
`--row "pairs 3"`: under that setting of the suite instead of the default one.
"""

import argparse
import hashlib
import math
import sys
import time
from collections import Counter
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.cli.terminal import Bars
from rapidgen.config import load_config
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.verification.campaign import Campaign, Limits
from rapidgen.verification.cluster import Cluster
from rapidgen.verification.result_file import Results
from rapidgen.verification.settings import possible, settings
from rapidgen.verification.settings import rows as assumptions
from rapidgen.verification.suite import CASES
from rapidgen.verification.worker_pool import LocalPool
from tools.mutation.driver import mutants
from tools.mutation.judging import HANGS, VERDICTS, Learning, Question, grounds, verdicts


def key_of(mutant):
    """Return the same key for the same mutant, whatever the build id."""
    texts = [text for path, text in sorted(FILES.items()) if path != mutant.path]
    content = b"\0".join((mutant.path.encode(), mutant.text, *texts))
    return hashlib.sha256(content.replace(SYSTEM.build_id.encode(), b"")).hexdigest()[:20]


def hired(context):
    """Return local processes, or the workers of a cluster."""
    if ARGUMENTS.cluster is None:
        return LocalPool(context, ARGUMENTS.jobs)
    return Cluster(ARGUMENTS.cluster, context, lambda text: print(text, file=sys.stderr))


def newest(results, key):
    """Return the key and the last verdict of a mutant, or None.

    The verdict includes all cases ever tried.
    """
    verdict, last, tried = None, "", ()
    while (result := results.known(key)) is not None:
        verdict, last = VERDICTS.validate_python(result, strict=False), key
        tried += verdict.tried
        key += "+"
    return last, verdict and replace(verdict, tried=tried)


def main():
    expected = [name.casefold() for name in ARGUMENTS.only]
    chosen = [
        mutant
        for mutant in FOUND[ARGUMENTS.offset :: ARGUMENTS.every]
        if not expected or Path(mutant.path).stem.casefold() in expected
    ]
    started = time.monotonic()
    of = f"mutants of {ARGUMENTS.robot}"
    with Results(ARGUMENTS.output, of, resume=True) as results:
        known = [newest(results, key_of(mutant)) for mutant in chosen]
        left = [
            n
            for n, (_, verdict) in enumerate(known)
            if verdict is None or (ARGUMENTS.again and not verdict.by)
        ]
        print(f"{len(chosen)} of {len(FOUND)} mutants, {len(left)} to be judged", flush=True)
        rows = [verdict for _, verdict in known]
        if left:
            judge_all(chosen, known, rows, left, results)
    show(list(zip(chosen, rows, strict=True)), time.monotonic() - started)


def judge_all(chosen, known, rows, left, results):
    """Store the verdicts of the `left` mutants in `rows`."""
    row = ARGUMENTS.row
    setting = settings(CONFIG, possible(CONFIG, assumptions(2)))[row]
    cases = [case for case in CHOSEN if not (row and case.once)]
    arguments = grounds(CONFIG, SYSTEM, cases, hired, setting, f" [{row}]" if row else "")
    learning = Learning(arguments.cases)
    questions, keys = [], []
    for n in left:
        last, before = known[n]
        already = before.tried if before is not None else ()
        questions.append(Question(chosen[n], ARGUMENTS.budget, already))
        keys.append(f"{last}+" if last else key_of(chosen[n]))
    for n, verdict in enumerate(rows):
        if verdict is not None and n not in left:
            learning.learn(verdict)
    with hired(arguments) as workers, Bars() as progress:
        campaign = Campaign(workers, results, Limits(), progress)
        work = verdicts(questions, learning, keys.__getitem__)
        for n, verdict in zip(left, campaign.run(work), strict=True):
            before = rows[n].tried if rows[n] is not None else ()
            rows[n] = replace(verdict, tried=(*before, *verdict.tried))


def show(rows, seconds):
    for path in dict.fromkeys(mutant.path for mutant, _ in rows):
        own = [(m, verdict) for m, verdict in rows if m.path == path]
        noticed = sum(bool(verdict.by) for _, verdict in own)
        print(f"{path:48} {noticed:4} of {len(own):4} = {noticed / len(own):.1%}")
        lines = FILES[path].decode("latin-1").splitlines()
        for mutant, verdict in sorted(own, key=lambda row: row[0].line):
            if not verdict.by:
                reached = "" if verdict.tried else "  (no case gets there)"
                if verdict.left:
                    reached = f"  ({verdict.left} cases not tried)"
                print(f"  {mutant.line:5} {' '.join(mutant.change.split())[:70]}{reached}")
                print(f"        {lines[mutant.line - 1].strip()[:90]}")
    killers = Counter(verdict.by for _, verdict in rows if verdict.by)
    dead = sum(killers.values())
    print(f"{'all':48} {dead:4} of {len(rows):4} = {dead / len(rows):.1%}")
    spent = sum(verdict.elapsed for _, verdict in rows)
    hung = sum(n for name, n in killers.items() if name.endswith(HANGS))
    print(f"{spent:.0f} s of CPU now; {hung} hang; {seconds:.0f} s")
    print("noticed by", ", ".join(f"{name} {count}" for name, count in killers.most_common(12)))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("robot", nargs="?", default="irb120")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--offset", type=int, default=0)
    parser.add_argument("--budget", type=float, default=math.inf)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--cluster", metavar="ADDRESS")
    parser.add_argument("--output", type=Path)
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--row", default="", metavar="NAME")
    parser.add_argument("--only", nargs="*", default=(), metavar="MODULE")
    parser.add_argument("--themes", nargs="*", default=(), metavar="THEME")
    ARGUMENTS = parser.parse_args()
    CONFIG = load_config(ARGUMENTS.robot)
    SYSTEM = in_its_cell(make_system(CONFIG, build(CONFIG)), CONFIG)
    FILES = {m.path: m.data for t in SYSTEM.tasks for m in t.modules}
    FOUND = [mutant for path, data in sorted(FILES.items()) for mutant in mutants(data, path)]
    CHOSEN = [c for c in CASES if not ARGUMENTS.themes or c.group in ARGUMENTS.themes]
    main()

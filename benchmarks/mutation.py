"""Which share of all mutants of the generated modules does the suite notice?

    python benchmarks/mutation.py [--every N] [--offset N] [--jobs N] [--budget S] [--output FILE]
        [--again] [--only MODULE ...] [--themes THEME ...] [ROBOT]

One fixed operator list (tests/proving/mutation.py); every place in a routine where an operator
fits is a mutant, equivalent ones included. `--every N` takes each N-th, from `--offset` on. A
mutant is judged by the cases of `rapidgen test` that execute its statement, until one notices it
or `--budget` s of CPU are spent: what no case has noticed by then counts as a survivor.

Verdicts go to FILE (JSON lines) as they come; a run that was broken off goes on there, as long as
nothing but the modules' build id has changed. Survivors are listed by module, with their lines:
each is a missing case, or the same program in other words. `--only` looks at some modules alone,
`--themes` judges by the cases of some themes alone; benchmarks/cell.yaml is a ROBOT with signals,
tools, routines and data.
`--again` goes on with the survivors of FILE, with cases that were not tried or did not exist.
"""

import argparse
import hashlib
import json
import math
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.proving.suite import CASES
from tests.proving.judging import HANGS, Judge
from tests.proving.mutation import mutants


def key_of(mutant):
    """The same for the same mutant of the same modules, whatever their build id."""
    texts = [text for path, text in sorted(FILES.items()) if path != mutant.path]
    content = b"\0".join((mutant.path.encode(), mutant.text, *texts))
    return hashlib.sha256(content.replace(SYSTEM.build_id.encode(), b"")).hexdigest()[:20]


def judged(number, already):
    mutant = FOUND[number]
    return number, JUDGE.judge(mutant, ARGUMENTS.budget, already)


def known():
    """Verdicts of earlier runs, by key; `tried` and `seconds` are of all of them."""
    if ARGUMENTS.output is None or not ARGUMENTS.output.exists():
        return {}
    found = {}
    for line in ARGUMENTS.output.read_text(encoding="utf-8").splitlines():
        row = json.loads(line)
        JUDGE.learn(row["path"], row["line"], row["by"])
        found[row["key"]] = row
    return found


def main():
    verdicts = known()
    keys = {number: key_of(mutant) for number, mutant in enumerate(FOUND)}
    wanted = [name.casefold() for name in ARGUMENTS.only]
    chosen = [
        number
        for number in range(ARGUMENTS.offset, len(FOUND), ARGUMENTS.every)
        if not wanted or Path(FOUND[number].path).stem.casefold() in wanted
    ]
    none = {"by": "", "tried": [], "seconds": 0}
    before = {number: verdicts.get(keys[number], none) for number in chosen}
    left = [
        number
        for number in chosen
        if keys[number] not in verdicts or (ARGUMENTS.again and not before[number]["by"])
    ]
    print(f"{len(chosen)} of {len(FOUND)} mutants, {len(left)} to be judged", flush=True)
    started = time.monotonic()
    with ProcessPoolExecutor(ARGUMENTS.jobs, mp_context=get_context("fork")) as pool:
        jobs = [pool.submit(judged, number, before[number]["tried"]) for number in left]
        for done in as_completed(jobs):
            number, verdict = done.result()
            mutant = FOUND[number]
            row = {
                "key": keys[number],
                "path": mutant.path,
                "line": mutant.line,
                "change": " ".join(mutant.change.split()),
                "by": verdict.by,
                "seconds": round(before[number]["seconds"] + verdict.seconds, 3),
                "tried": [*before[number]["tried"], *verdict.tried],
                "left": verdict.left,
            }
            verdicts[row["key"]] = row
            if ARGUMENTS.output is not None:
                with ARGUMENTS.output.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(row) + "\n")
    show([verdicts[keys[number]] for number in chosen], time.monotonic() - started)


def show(rows, seconds):
    for path in dict.fromkeys(row["path"] for row in rows):
        own = [row for row in rows if row["path"] == path]
        noticed = sum(bool(row["by"]) for row in own)
        print(f"{path:48} {noticed:4} of {len(own):4} = {noticed / len(own):.1%}")
        lines = FILES[path].decode("latin-1").splitlines()
        for row in sorted(own, key=lambda row: row["line"]):
            if not row["by"]:
                reached = "" if row["tried"] else "  (no case gets there)"
                if row["left"]:
                    reached = f"  ({row['left']} cases not tried)"
                print(f"  {row['line']:5} {row['change'][:70]}{reached}")
                print(f"        {lines[row['line'] - 1].strip()[:90]}")
    dead = sum(bool(row["by"]) for row in rows)
    print(f"{'all':48} {dead:4} of {len(rows):4} = {dead / len(rows):.1%}")
    spent = sum(row["seconds"] for row in rows)
    hung = sum(row["by"].endswith(HANGS) for row in rows)
    print(f"{spent:.0f} s of CPU, {spent / len(rows):.2f} a mutant; {hung} hang; {seconds:.0f} s")
    killers = Counter(row["by"] for row in rows if row["by"])
    print("noticed by", ", ".join(f"{name} {count}" for name, count in killers.most_common(12)))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("robot", nargs="?", default="irb120")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--offset", type=int, default=0)
    parser.add_argument("--budget", type=float, default=math.inf)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--output", type=Path)
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--only", nargs="*", default=(), metavar="MODULE")
    parser.add_argument("--themes", nargs="*", default=(), metavar="THEME")
    ARGUMENTS = parser.parse_args()
    CONFIG = load_config(ARGUMENTS.robot)
    SYSTEM = in_its_cell(make_system(CONFIG, build(CONFIG)), CONFIG)
    FILES = {m.path: m.data for t in SYSTEM.tasks for m in t.modules}
    FOUND = [mutant for path, data in sorted(FILES.items()) for mutant in mutants(data, path)]
    CHOSEN = [c for c in CASES if not ARGUMENTS.themes or c.group in ARGUMENTS.themes]
    JUDGE = Judge(CONFIG, SYSTEM, CHOSEN, jobs=ARGUMENTS.jobs)
    main()

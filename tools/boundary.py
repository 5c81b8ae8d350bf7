"""Send boundary values in every message field, driver state and port.

    python tools/boundary.py [--jobs N] [--share SHARE] [--results FILE] [ROBOT]

Runs all trials of rapidgen/verification/boundary.py under three hostile settings, and a seeded
tenth of them under each row in which any two assumptions about controllers meet. FILE (JSON lines)
stores the results: the next call continues. `--share` takes a seeded share of everything. A share
takes some fields with all their values, in each state, on each port.
"""

import argparse
import random
import sys
import time
from functools import cache
from itertools import groupby
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.verification.boundary import STATES, failing, field_of, prepare, trials
from rapidgen.verification.settings import assumed, rows
from tools.campaigns import outcomes

STRICT = ("argument_error=fatal", "pack_beyond=error", "negative_mod=error")
HOSTILE = {
    # Every value error is raised, and a fatal one ends its task.
    "strict": STRICT,
    # The same with a possible task switch at each access to a PERS, on a slow controller: messages
    # meet the driver's tasks between any two statements.
    "strict, slow, switched at PERS": (*STRICT, "schedule=pers", "costs=4.0"),
    # A fast controller with random task order, otherwise with defaults.
    "fast, by lot": ("schedule=random", "costs=0.25"),
}
SETTINGS = HOSTILE | {name: texts for name, texts in rows().items() if name}
CHUNK = 600
"""Smallest number of trials in a work item, but for the last one of a state."""


@cache
def prepared(name, state):
    return prepare(CONFIG, SYSTEM, assumed(SETTINGS[name]), state)


def work():
    """Yield work items: setting, state, numbers of fields, and the number of their trials."""
    for name in SETTINGS:
        share = GIVEN.share * (1 if name in HOSTILE else 0.1)
        for state in STATES:
            fields = fields_of(state)
            chance = random.Random(f"{GIVEN.seed} {name} {state}")
            chosen, count = [], 0
            for number in sorted(chance.sample(range(len(fields)), round(share * len(fields)))):
                chosen.append(number)
                count += len(fields[number])
                if count >= CHUNK:
                    yield name, state, chosen, count
                    chosen, count = [], 0
            if chosen:
                yield name, state, chosen, count


@cache
def fields_of(state):
    """Return the trials of a state, in groups of one field and one port."""
    own = trials(CONFIG, (state,), seed=GIVEN.seed)
    return [list(group) for _, group in groupby(own, key=field_of)]


def one(_, piece):
    name, state, numbers, _ = piece
    chosen = [trial for number in numbers for trial in fields_of(state)[number]]
    return [(str(trial), why) for trial, why in failing(prepared(name, state), chosen)]


def main():
    pieces = list(work())
    # Random order of settings and states, so that frequent faults show early.
    random.Random(GIVEN.seed).shuffle(pieces)
    started, count, failed = time.monotonic(), 0, 0
    of = f"{GIVEN.robot} {SYSTEM.build_id} share {GIVEN.share} seed {GIVEN.seed}"
    numbered = {str(number): piece for number, piece in enumerate(pieces)}
    for key, result in outcomes(one, numbered, of, jobs=GIVEN.jobs, path=GIVEN.results):
        count += numbered[key][3]
        failed += len(result)
        for text, why in result[:5]:
            print(f"{numbered[key][0]}; {text}: {why}", flush=True)
        if int(key) % 20 == 0:
            seconds = time.monotonic() - started
            print(f"{count} messages, {failed} failed, {seconds:.0f} s", flush=True)
    print(
        f"{count} messages under {len(SETTINGS)} settings in {len(STATES)} states: "
        f"{failed} failed; {time.monotonic() - started:.0f} s with {GIVEN.jobs} jobs"
    )
    return bool(failed)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("robot", nargs="?", default="irb120")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--share", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--results", type=Path)
    GIVEN = parser.parse_args()
    CONFIG = load_config(GIVEN.robot)
    SYSTEM = make_system(CONFIG, build(CONFIG))
    sys.exit(main())

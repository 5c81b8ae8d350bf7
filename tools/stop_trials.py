"""Random stops: up to three operator actions, then the recovery.

    python tools/stop_trials.py [--count N] [--first SEED] [--jobs N] [--results FILE] [ROBOT]

One seed decides the state (receiving, moving, streaming, program), one to three actions 1 ms to 1 s
apart, and the pauses before recovery. Data sent before must not move the robot after a restart;
then a trajectory must be executed completely. If Start is refused or the event log asks for it, the
operator does PP to main, as docs/use/driver.md says, and the trial counts it. FILE (JSON lines)
stores the results: the next call continues.
"""

import argparse
import random
import sys
import time
from functools import cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.verification.boundary import prepare
from rapidgen.verification.raw_connection import STOP
from rapidgen.verification.settings import assumed
from rapidgen.verification.testbench import FAILURES
from rapidgen.verification.worker_pool import run_in_fork
from tools.campaigns import outcomes

STATES = ("receiving", "moving", "streaming", "program")
ACTIONS = ("e-stop", "manual", "motors-off", "stop", "power-loss", "STOP")


@cache
def prepared(state):
    return prepare(CONFIG, SYSTEM, assumed(("schedule=random",)), state)


def trial(state, seed):
    """Run a trial: failure, PP to main needed, actions."""
    chance = random.Random(f"{seed} stop trial")
    bench, links = prepared(state).bench, prepared(state).links
    bench.controller.scheduler.draw_from(seed)
    actions_done, from_main = [], False
    try:
        bench.run(chance.uniform(0, 1))
        for _ in range(chance.randrange(1, 4)):
            action = chance.choice(ACTIONS)
            wait = 10 ** chance.uniform(-3, 0)
            actions_done.append(f"{action}, {wait * 1000:.0f} ms")
            if action == "STOP":
                links[chance.choice(("motion", "control"))].at_once(STOP)
            else:
                bench.controller.perform(action)
            bench.run(wait)
        if all(text.startswith("STOP,") for text in actions_done):
            # STOP on the control port does not stop an incomplete download.
            links["motion"].at_once(STOP)
        bench.wait_until_standing(10)
        bench.run(chance.uniform(0, 2))
        from_main = recovered(bench)
        for link in links.values():
            if not link.lost:
                link.close()
        bench.run(1.5)
        bench.assert_moves_through(bench.motion(), bench.wave(4))
        bench.assert_healthy()
    except FAILURES as error:
        return [str(error), from_main, f"{state}; {'; '.join(actions_done)}"]
    return ["", from_main, f"{state}; {'; '.join(actions_done)}"]


def recovered(bench):
    """Restart as an operator does; return if it took PP to main.

    Nothing moves meanwhile.
    """
    last = bench.last_event
    bench.start_again()
    bench.assert_at_rest(3, "the program was started, and no client has asked for motion")
    events = " ".join(str(event) for event in bench.controller.log.since(last))
    running = bench.controller.task(bench.group.task).state == "running"
    if running and "PP to main" not in events and "from main" not in events:
        return False
    for action in ("stop", "pp-to-main"):
        bench.controller.perform(action)
    bench.start_again()
    bench.assert_at_rest(3, "the program was started from main, and no client has asked for motion")
    return True


def one(_, seed):
    state = STATES[seed % len(STATES)]
    prepared(state)
    return run_in_fork(lambda: trial(state, seed))


def main():
    seeds = range(GIVEN.first, GIVEN.first + GIVEN.count)
    started, failed, from_main = time.monotonic(), 0, 0
    of = f"{GIVEN.robot} {SYSTEM.build_id} stop trials"
    pieces = {str(seed): seed for seed in seeds}
    for seed, result in outcomes(one, pieces, of, jobs=GIVEN.jobs, path=GIVEN.results):
        fault, main_needed, done = result
        failed += bool(fault)
        from_main += main_needed
        if fault or main_needed:
            print(f"seed {seed}: {done}: {fault or 'took PP to main'}", flush=True)
    print(
        f"{len(seeds)} stop trials: {failed} without a way back that works, {from_main} took PP to "
        f"main; {time.monotonic() - started:.0f} s with {GIVEN.jobs} jobs"
    )
    return bool(failed)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("robot", nargs="?", default="irb120")
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--results", type=Path)
    GIVEN = parser.parse_args()
    CONFIG = load_config(GIVEN.robot)
    SYSTEM = make_system(CONFIG, build(CONFIG))
    sys.exit(main())

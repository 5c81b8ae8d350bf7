"""Run tests in processes that are stopped now and then.

Each process is stopped by itself, as on a machine without time for it: between any two
instructions, whereas `make stall-test` delays calls of sockets and threads. A test that fails then
is flaky. `make pause-test PACKAGE=viewer`.

    python tools/stall/stopped.py [--longest S] [--every S] [--seed N] COMMAND ...

Linux only: the parent of a process is read from /proc.
"""

import argparse
import os
import random
import signal
import subprocess
import sys
import time
from contextlib import suppress

LISTED = 0.25
"""s between two readings of the list of processes."""
LOOKS = 0.005


def descendants(root):
    """Return processes below `root`, at any depth."""
    children = {}
    for name in filter(str.isdigit, os.listdir("/proc")):
        with suppress(OSError):  # it has ended meanwhile
            with open(f"/proc/{name}/stat", encoding="utf-8", errors="replace") as file:
                state, parent = file.read().rpartition(")")[2].split()[:2]
            if state != "Z":
                children.setdefault(int(parent), []).append(int(name))
    result, left = [], [root]
    while left:
        below = children.get(left.pop(), [])
        result += below
        left += below
    return result


def send(process, number):
    with suppress(ProcessLookupError):
        os.kill(process, number)


def main(command, longest, every, seed):
    """Run the command and return its exit code."""
    dice = random.Random(seed)
    running = subprocess.Popen(command)
    due, stopped, processes, listed = {}, {}, [], 0.0
    try:
        while running.poll() is None:
            now = time.monotonic()
            if now > listed + LISTED:
                processes, listed = descendants(running.pid), now
            for process in [process for process, end in stopped.items() if now >= end]:
                send(process, signal.SIGCONT)
                del stopped[process]
            for process in processes:
                begin = due.setdefault(process, now + dice.expovariate(1 / every))
                if process not in stopped and now >= begin:
                    send(process, signal.SIGSTOP)
                    stopped[process] = now + dice.uniform(0.1, 1) * longest
                    due[process] = stopped[process] + dice.expovariate(1 / every)
            time.sleep(LOOKS)
    finally:  # also on an error: no process stays stopped
        for process in stopped:
            send(process, signal.SIGCONT)
    return running.returncode


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--longest", type=float, default=0.5, help="s that one is stopped at most")
    parser.add_argument("--every", type=float, default=1.5, help="s between two stops of one")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("command", nargs=argparse.REMAINDER)
    given = parser.parse_args()
    sys.exit(main(given.command, given.longest, given.every, given.seed))

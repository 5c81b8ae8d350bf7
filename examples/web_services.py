"""A controller over Robot Web Services: panel, tasks, event log.

Without an address it is `rapidgen sim --rws`, with ABB's own login, as controllers are delivered.
"""

import json
import os
import subprocess
import sys
from contextlib import contextmanager

from rapidgen.client import Controller


@contextmanager
def simulated():
    words = ["sim", "irb120", "--ports", "auto", "--rws", "1", "--rws-port", "0"]
    with subprocess.Popen(
        [sys.executable, "-m", "rapidgen.cli", *words], stdout=subprocess.PIPE, text=True
    ) as sim:
        try:
            yield json.loads(sim.stdout.readline().removeprefix("ready "))["rws"]
        finally:
            sim.terminate()


def look(address: str) -> None:
    password = os.environ.get("RAPIDGEN_PASSWORD", "robotics")
    with Controller(address, user="Default User", password=password) as controller:
        print(controller.identity())
        print(controller.panel())
        for task in controller.tasks():
            print(task.name, task.state)
        for event in controller.log(count=3):
            print(event.code, event.title)


if sys.argv[1:]:
    look(sys.argv[1])
else:
    with simulated() as address:
        look(address)

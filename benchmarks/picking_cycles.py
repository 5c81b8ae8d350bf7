"""Picking cycles of all models, with published ones.

    python benchmarks/picking_cycles.py [MODEL ...] [--draw]

The cycle is that of ABB's data sheets: 25 mm up, about 300 mm (here 305) across, 25 mm down and
back, without a load. It is programmed with linear moves at vmax, z20 and stop points at both ends,
tool down, across the robot's x axis. The fastest of some places is taken. `--draw` writes the table
into docs/rapid/motion-figures.md.
"""

import argparse
import re
from concurrent.futures import ProcessPoolExecutor
from math import hypot
from pathlib import Path

from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config, shipped_names
from rapidgen.config.model import GroupConfig
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.io import IOSystem
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.motion import MotionSystem
from rapidgen.motion.accelerations import duration_error_band
from rapidgen.motion.fault_reasons import MotionFault
from rapidgen.motion.moves import CartesianMove, MoveSpeed, Zone
from rapidgen.rapid.switches import Switches
from rapidgen.runtime.compiler.emit.access import Options
from rapidgen.runtime.compiler.link import Shared
from rapidgen.runtime.task.task import Task
from rapidgen.system.model import System, TaskSpec

PUBLISHED = {"irb120": 0.58, "irb1200": 0.42, "crb15000": 0.66, "irb910sc": 0.38}
"""s, of ABB's data sheets, with 1 kg."""
UP, ACROSS = 0.025, 0.305
VMAX = 7.0
Z20 = Zone(tcp=0.02, orientation=0.03, external=0.03, angle=0.052, linear=0.03, rotary=0.052)
DOWN = (0.0, 0.0, 1.0, 0.0)
DISTANCES = (0.35, 0.45, 0.55, 0.65, 0.75, 0.85)
HEIGHTS = (-0.2, 0.0, 0.2, 0.4, 0.6)
"""Places in shares of the length of the arm."""
PAGE = Path(__file__).parents[1] / "docs/rapid/motion-figures.md"
BEGIN, END = "<!-- drawn by benchmarks/picking_cycles.py -->\n", "<!-- the cycles are drawn -->\n"


class _Controller:
    dialect = Switches()
    options = Options()


def seconds(config: GroupConfig, x: float, z: float) -> float | None:
    """Duration of a cycle there and back; None: it does not fit there."""
    scheduler = Scheduler()
    log = EventLog(scheduler)
    io = IOSystem(scheduler, log, System("cycle", ()))
    group = MotionSystem(scheduler, [config], log, io).group(config.name)
    start = (x, -ACROSS / 2, z), DOWN
    home = tuple(min(max(0.0, j.lower), j.upper) for j in config.joints)
    postures = group.geometry().solutions(start, home)
    if not postures:
        return None
    group.jump(postures[0])
    ends = []

    def line(y: float, height: float, zone: Zone) -> CartesianMove:
        target = (x, y, z + height), DOWN
        return CartesianMove(target=target, external=home, speed=MoveSpeed(VMAX), zone=zone)

    def program() -> None:
        left, right, stop = -ACROSS / 2, ACROSS / 2, Zone(fine=True)
        try:
            for first, last in ((left, right), (right, left)):
                group.move(task, line(first, UP, Z20))
                group.move(task, line(last, UP, Z20))
                group.move(task, line(last, 0.0, stop))
        except MotionFault:
            return
        ends.append(scheduler.now / S)

    task = Task(scheduler, TaskSpec("T_ROB1"), _Controller(), Shared())  # type: ignore[arg-type]
    task.launch(program)
    scheduler.advance(stop=lambda: not task.alive)
    return ends[0] if ends else None


def fastest(model: str) -> float | None:
    """The shortest cycle of a model; None: it has no place for one."""
    config = load_config(model).groups[0]
    if Kinematics.of(config) is None:
        return None
    length = sum(hypot(*link.xyz) for link in config.chain)
    times = [seconds(config, d * length, h * length) for d in DISTANCES for h in HEIGHTS]
    return min((time for time in times if time is not None), default=None)


def row(model: str, time: float | None) -> str:
    """A line of the table."""
    measured, band = duration_error_band(load_config(model).groups[0])
    found = "no place" if time is None else f"{time:.2f} s ± {band * 100:.0f} %"
    known = f"{PUBLISHED[model]:.2f} s" if model in PUBLISHED else ""
    return f"| {model} | {found} | {'measured' if measured else 'estimated'} | {known} |"


def main() -> None:
    """Print the table, or write it into its page."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("models", nargs="*")
    parser.add_argument("--draw", action="store_true")
    given = parser.parse_args()
    models = given.models or shipped_names()
    with ProcessPoolExecutor() as pool:
        rows = list(map(row, models, pool.map(fastest, models)))
    head = "| model | simulated | accelerations | published, 1 kg |\n|---|---|---|---|\n"
    table = head + "\n".join(rows) + "\n"
    print(table)
    if given.draw:
        text = PAGE.read_text(encoding="utf-8")
        pattern = re.compile(f"{re.escape(BEGIN)}.*?{re.escape(END)}", re.S)
        drawn = f"{BEGIN}{table}{END}"
        PAGE.write_text(pattern.sub(lambda _: drawn, text), encoding="utf-8")


if __name__ == "__main__":
    main()

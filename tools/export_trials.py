"""Random programs as modules and over the driver: same path, same signals in the same order.

    python -m tools.export_trials --count 500 --seed 1

Each program goes to one virtual controller that runs the driver, and its module to another one
that runs nothing else. The largest distance between the two paths of the TCP is at most 0.01 mm.
"""

import argparse
import random
import sys
import time
from contextlib import contextmanager
from dataclasses import dataclass
from math import radians
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "client"))

from driven import driven

from rapidgen.axes import frames
from rapidgen.client import (
    InvalidProgram,
    Pose,
    Program,
    Speed,
    Trigger,
    UserTool,
    UserWorkObject,
    Zone,
)
from rapidgen.client.core.group import Group
from rapidgen.client.core.program_checks import check_program
from rapidgen.config import load_config
from rapidgen.controller.boot_targets import BootOptions, boot_modules
from rapidgen.controller.controller import VirtualController
from rapidgen.export.writer import WriterOptions
from rapidgen.system.model import ModuleFile, SignalSpec, System, TaskSpec
from rapidgen.verification.path_deviation import farthest

OVERRIDES = {
    "signals": {
        "glue": {"kind": "DO", "access": "write"},
        "level": {"kind": "GO", "access": "write"},
        "flow": {"kind": "AO", "access": "write"},
    },
    "tools": [
        {
            "name": "nozzle",
            "frame": {"position": [0, 0, 120], "orientation": [0.9659258, 0, 0.258819, 0]},
            "load": {"mass": 0.8, "centre": [0, 0, 40]},
        }
    ],
    "work_objects": [{"name": "table", "user_frame": {"position": [300, 0, 200]}}],
}
SIGNALS = (SignalSpec("glue", "DO"), SignalSpec("level", "GO", size=8), SignalSpec("flow", "AO"))
TOLERANCE = 1e-5
"""m between the two paths."""
_PERIOD = 0.001
START = (0.2, 0.1, 0.1, 0.3, 0.6, -0.2)
STYLES = ("inline", "named", "arrays")


@dataclass(frozen=True)
class Traced:
    """What a run did: TCP (m) in its order, and the changes of signals."""

    path: np.ndarray
    signals: list


def random_program(group: Group, rng: random.Random) -> Program:
    """Return a program that the robot can execute, of 3 to 12 instructions."""
    geometry = group.geometry
    program = Program(speed=rng.choice((0.1, 0.25, 0.317)), zone="z5")
    here = group.map.to_controller(START)
    number = rng.randint(3, 12)
    program.move_joints(START, zone="fine")
    tool, wobj = (
        UserTool(Pose((0.0, 0.02, 0.1)), 0.5, (0.0, 0.0, 0.05)),
        UserWorkObject(Pose((0.2, 0.1, 0.0), frames.from_rpy(0, 0, 0.3))),
    )
    chosen = (0, 0)
    while len(program) < number:
        earlier = list(program.steps), here
        kind = rng.choice(
            ("joints", "pose", "line", "line", "line", "circle", "set", "wait", "use")
        )
        options = {
            "speed": rng.choice((None, 0.1, 0.05, Speed(0.2, radians(90)), 0.4)),
            "zone": rng.choice((None, "fine", "z1", "z10", 0.003, Zone.of(0.007))),
        }
        now = geometry.frames(*chosen).pose(here)
        goal = _near(now, rng)
        triggers = []
        if rng.random() < 0.3:
            triggers = [
                Trigger.after(rng.uniform(0.001, 0.01), "glue", rng.choice((0, 1))),
                Trigger.before(rng.uniform(0.0, 0.005), "level", rng.randint(0, 255)),
                Trigger.ahead(rng.uniform(0.0, 0.05), "flow", rng.randint(0, 9)),
            ][: rng.randint(1, 3)]
        if kind == "joints":
            # Signals of a move by joints need its pose on the driver, too.
            bent = [a + rng.uniform(-0.2, 0.2) for a in group.map.to_urdf(here)]
            program.move_joints(bent, triggers=triggers, **options)
        elif kind == "pose":
            program.move_to(goal, triggers=triggers, **options)
        elif kind == "line":
            program.move_linear(goal, triggers=triggers, **options)
        elif kind == "circle":
            program.move_circular(_near(now, rng), goal, triggers=triggers, **options)
        elif kind == "set":
            program.set(*rng.choice((("glue", rng.randint(0, 1)), ("level", rng.randint(0, 255)))))
        elif kind == "wait":
            program.wait(round(rng.uniform(0.0, 0.3), 3))
        elif rng.random() < 0.5 or len(geometry.tools) > 2:
            program.use(tool=rng.choice(("", "nozzle")), work_object=rng.choice(("", "table")))
        else:
            program.use(tool=tool, work_object=wobj)
        try:
            checked = check_program(program, group, start=group.map.to_controller(START), most=1000)
        except InvalidProgram:
            program.steps[:] = earlier[0]
            program._tool = program.steps[-1].tool
            program._work_object = program.steps[-1].work_object
            continue
        here = checked.goal
        step = program.steps[-1]
        own = isinstance(step.tool, UserTool)
        if own:
            geometry = group.geometry.owning(step.tool.frame, step.work_object.user_frame)
        chosen = (2, 2) if own else (int(step.tool == "nozzle"), int(step.work_object == "table"))
    return program


def _near(pose, rng: random.Random):
    (x, y, z), q = pose
    turn = frames.from_rpy(*(rng.uniform(-0.15, 0.15) for _ in range(3)))
    moved = (
        x + rng.uniform(-0.06, 0.06),
        y + rng.uniform(-0.06, 0.06),
        z + rng.uniform(-0.05, 0.05),
    )
    return Pose(moved, frames.multiply(turn, q))


@contextmanager
def traced(controller: VirtualController):
    """Record path and signals of the block."""
    result = Traced(np.empty((0, 3)), [])
    recorder = next(iter(controller.record().values()))
    store = controller.io._store
    names = {spec.name for spec in SIGNALS}

    def noted(signal, value, **options):
        # The driver fills unused triggers with the last one: repeated values do not count.
        if signal.name in names and signal.value != value:
            result.signals.append((signal.name, value))
        store(signal, value, **options)

    controller.io._store = noted
    try:
        yield result
    finally:
        controller.io._store = store
        recorder.stop()
        joints = recorder.recording(_PERIOD, standing=False).commanded
        kinematics = recorder._group.kinematics
        # A point 100 mm in front of the flange feels its orientation, too.
        flange = [frames.transform(kinematics.forward(tuple(q)), (0.0, 0.03, 0.1)) for q in joints]
        object.__setattr__(result, "path", np.array(flange))


def run_module(module, robot, start) -> Traced:
    """Run a module alone, with the signals of the cell."""
    file = ModuleFile(module.name, module.path, module.text.encode())
    task = TaskSpec(robot.task, entry=module.routine, motion=True, modules=(file,))
    system = System(module.name, (task,), signals=SIGNALS, robotware=(6, 15))
    target = boot_modules(system, (robot,), BootOptions(start=start))
    with VirtualController.boot(target, cycle="once", autostart=False) as controller:
        with traced(controller) as result:
            controller.start_program()
            ended = controller.run(max_time=1e4)
        for task in controller.tasks.values():
            if task.fault is not None:
                raise AssertionError(f"{task.fault.title} {task.fault.arguments}\n{module.text}")
        assert ended == "finished", ended
    return result


def difference(one: Traced, other: Traced) -> float:
    """Return the largest distance between two paths, m; both ways."""
    if one.signals != other.signals:
        raise AssertionError(f"signals differ: {one.signals} {other.signals}")
    first, second = _moving(one.path), _moving(other.path)
    if len(first) == len(second) == 1:
        return float(np.linalg.norm(first - second))
    return max(farthest(first, second), farthest(second, first))


def _moving(path: np.ndarray) -> np.ndarray:
    """Return a path without its standstills."""
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    return path[np.concatenate([[True], steps > 1e-7])]


def trials(count: int, seed: int, model: str = "irb120"):
    """Yield (program, module text, m between the paths) for random programs."""
    rng = random.Random(seed)
    with driven(model, signals=SIGNALS, overrides=OVERRIDES) as (robot, controller):
        group = robot.group
        config = load_config(model, overrides=OVERRIDES)
        for number in range(count):
            program = random_program(group, rng)
            robot.move_to(START, speed=1.0)
            for spec in SIGNALS:
                controller.io.set(controller.io[spec.name], 0)
            with traced(controller) as driver:
                robot.run(program).result()
            options = WriterOptions(targets=STYLES[number % 3])
            exported = program.to_rapid(config, options=options)
            alone = run_module(exported.module, exported.group, exported.start_values)
            yield program, exported.text, difference(driver, alone)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--model", default="irb120")
    given = parser.parse_args()
    began, worst, steps, number = time.process_time(), 0.0, 0, 0
    all_trials = trials(given.count, given.seed, given.model)
    for number, (program, text, apart) in enumerate(all_trials, 1):
        steps += len(program)
        worst = max(worst, apart)
        if apart > TOLERANCE:
            print(text)
            sys.exit(f"program {number}: the paths differ by {1000 * apart:.4f} mm")
    seconds = time.process_time() - began
    print(f"{number} programs, {steps} instructions, {seconds:.0f} s of CPU")
    print(f"largest difference {1000 * worst:.5f} mm, same signals in the same order")


if __name__ == "__main__":
    main()

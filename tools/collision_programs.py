"""Collision checks of random programs in random cells, against samples every millisecond.

Each program has joint and linear moves with random corners, on one of three robots with a
description, or on one with a track and a positioner, among random boxes and spheres. A part stands
on the positioner. The proof of its planned path (samples every 4 ms and
bounds between them) is compared with distances at samples every 1 ms of the same motion: a pair is
missed if a sample is below its clearance and the proof does not report it, and false if no sample
is and the proof reports it. False reports are printed with their distance.

    python tools/collision_programs.py [PROGRAMS] [SEED]
"""

import math
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from rapidgen.collision.check import clearances
from rapidgen.collision.path import Path as JointPath
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.collisions import CollisionWatch
from rapidgen.controller.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError
from rapidgen.machine.scheduler import S

ROBOTS = {"irb120": 0.58, "irb2400": 1.5, "irb910sc": 0.55, "irb120_track": 0.58}
"""Robots with a description in robots/urdf, and their reach in m."""
URDF = Path(__file__).resolve().parents[1] / "robots" / "urdf"
_MS = S // 1000
_LIMIT = 0.05


def target(rng: np.random.Generator, robot: str) -> str:
    """Return a random jointtarget around the middle of the ranges."""
    if robot == "irb910sc":
        axes = [*rng.uniform(-90, 90, 2), rng.uniform(-150, -10), rng.uniform(-90, 90)]
        axes += [0.0, 0.0]
    else:
        axes = [*rng.uniform(-80, 80, 1), *rng.uniform(-30, 40, 2), *rng.uniform(-70, 70, 3)]
    robax = ",".join(f"{value:.2f}" for value in axes)
    extax = "9E9,9E9"
    if robot == "irb120_track":
        extax = f"{rng.uniform(400, 1600):.1f},{rng.uniform(-170, 170):.2f}"
    return f"[[{robax}],[{extax},9E9,9E9,9E9,9E9]]"


def program(rng: np.random.Generator, robot: str) -> str:
    """Return a module with 4 to 8 random moves."""
    lines = []
    for _ in range(rng.integers(4, 9)):
        zone = rng.choice(["fine", "z1", "z10", "z50", "z100"])
        speed = rng.choice(["v100", "v500", "v1500"])
        if lines and rng.random() < 0.4:
            x, y, z = rng.uniform(-80, 80, 3)
            lines.append(f"    MoveL Offs(CRobT(),{x:.1f},{y:.1f},{z:.1f}),{speed},{zone},tool0;")
        else:
            lines.append(f"    MoveAbsJ {target(rng, robot)},{speed},{zone},tool0;")
    body = "\n".join(lines)
    return f"MODULE trial\n  PROC main()\n    ConfL \\Off;\n{body}\n  ENDPROC\nENDMODULE\n"


def cell(rng: np.random.Generator, robot: str) -> str:
    """Return a cell with 6 random objects around a robot."""
    reach = 1000 * ROBOTS[robot]
    things = []
    for number in range(6):
        angle, far = rng.uniform(-math.pi, math.pi), rng.uniform(0.5, 1.0) * reach
        place = [far * math.cos(angle), far * math.sin(angle), rng.uniform(0, 0.8) * reach]
        if robot == "irb120_track":
            place[0] += rng.uniform(0, 2000)
        position = ", ".join(f"{value:.1f}" for value in place)
        size = rng.uniform(0.02, 0.2, 3) * reach
        shape = (
            f"sphere: {size[0] / 2:.1f}"
            if rng.random() < 0.3
            else f"box: [{', '.join(f'{value:.1f}' for value in size)}]"
        )
        things.append(f"  o{number}: {{{shape}, frame: {{position: [{position}]}}}}")
    if robot == "irb120_track":
        turned = f"box: [{rng.uniform(100, 600):.1f}, 60, 90], frame: {{position: [60, 0, 80]}}"
        things.append(f"  part: {{{turned}, on: STN_1}}")
    clearance = rng.choice([1, 5, 20])
    return (
        "robots:\n  T_ROB1: {model: robot.yaml}\nthings:\n"
        + "\n".join(things)
        + f"\ncollision: {{clearance: {clearance}}}\n"
    )


def trial(folder: Path, rng: np.random.Generator, counts: dict[str, float]) -> None:
    """Run one program, and compare proof and samples of every pair."""
    robot = list(ROBOTS)[rng.integers(len(ROBOTS))]
    (folder / f"{robot}.urdf").write_bytes((URDF / f"{robot}.urdf").read_bytes())
    (folder / "robot.yaml").write_text(f"model: {robot}\nurdf: {{file: {robot}.urdf}}\n")
    (folder / "cell.yaml").write_text(cell(rng, robot))
    (folder / "trial.mod").write_text(program(rng, robot))
    booted = load_target([str(folder / "trial.mod")], BootOptions(cell=str(folder / "cell.yaml")))
    assert booted.cell is not None
    with VirtualController.boot(booted, cycle="once", autostart=False) as controller:
        watch = CollisionWatch(controller, booted.collisions("error"))
        controller.start_program()
        controller.run(max_time=120)
        began = time.process_time()
        report = watch.report()
        counts["cpu"] += time.process_time() - began
        ((name, recorder),) = watch.history.recorders.items()
        times = list(range(0, controller.scheduler.now + 1, _MS))
        postures = np.array(recorder.commanded(times))
    world = watch.world
    dense = JointPath.linear(np.array(times) / S, world.values({name: postures}))
    seen = clearances(world.scene, dense, dense.times, _LIMIT)
    reported = {violation.pair: violation for violation in report.stages[0].proof.violations}
    counts["seconds"] += times[-1] / S
    for number, pair in enumerate(world.scene.pairs):
        least = float(seen.distances[:, number].min())
        counts["pairs"] += 1
        is_near = least <= pair.clearance
        counts["near"] += is_near
        if is_near and number not in reported:
            counts["missed"] += 1
            print("missed:", world.scene.names(number), f"{1000 * least:.3f} mm", robot)
        if not is_near and number in reported:
            counts["false"] += 1
            beyond = 1000 * (least - pair.clearance)
            verdict = reported[number].verdict
            print("false:", world.scene.names(number), f"{beyond:.3f} mm beyond,", verdict, robot)


def main(programs: int, seed: int) -> int:
    """Run the programs and print a summary; return 1 if a pair was missed."""
    rng = np.random.default_rng(seed)
    counts = dict.fromkeys(("pairs", "near", "missed", "false", "skipped", "seconds", "cpu"), 0.0)
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(programs):
            try:
                trial(Path(folder), rng, counts)
            except DiagnosticError as fault:
                counts["skipped"] += 1
                print("skipped:", fault)
    free = counts["pairs"] - counts["near"]
    print(
        f"{programs} programs ({counts['skipped']:.0f} skipped), {counts['seconds']:.0f} s of "
        f"motion, {counts['pairs']:.0f} pairs, {counts['near']:.0f} below their clearance: "
        f"{counts['missed']:.0f} missed, {counts['false']:.0f} of {free:.0f} false; "
        f"{counts['cpu']:.1f} s CPU for the proofs"
    )
    return 1 if counts["missed"] else 0


if __name__ == "__main__":
    arguments = [int(word) for word in sys.argv[1:3]]
    sys.exit(main(*arguments, *(500, 1)[len(arguments) :]))

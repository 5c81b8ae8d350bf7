"""Collision detection of the virtual controller, against samples every millisecond.

Programs and cells are those of tools/collision_programs.py. Each program runs once with detection
that only logs contacts, and once without. A pair that does not touch at the start is missed if a
sample touches and detection has no contact of it, and false if it has one and no sample touches.

    python tools/collision_detection.py [PROGRAMS] [SEED]
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from rapidgen.collision.check import clearances
from rapidgen.collision.path import Path as JointPath
from rapidgen.controller.boot_targets import Bootable, BootOptions, load_target
from rapidgen.controller.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError
from rapidgen.machine.scheduler import S
from tools.collision_programs import ROBOTS, URDF, cell, program

_MS = S // 1000
_LIMIT = 0.002


def target_of(folder: Path, rng: np.random.Generator) -> Bootable:
    """Write a random program and its cell, and read them."""
    robot = ("irb120", "irb2400", "irb910sc")[rng.integers(3)]
    assert robot in ROBOTS
    (folder / f"{robot}.urdf").write_bytes((URDF / f"{robot}.urdf").read_bytes())
    (folder / "robot.yaml").write_text(f"model: {robot}\nurdf: {{file: {robot}.urdf}}\n")
    (folder / "cell.yaml").write_text(cell(rng, robot))
    (folder / "trial.mod").write_text(program(rng, robot))
    return load_target([str(folder / "trial.mod")], BootOptions(cell=str(folder / "cell.yaml")))


def trial(booted: Bootable, counts: dict[str, float], lags: list[float]) -> None:
    """Run one program, and compare contacts and samples of every pair."""
    detection = booted.collisions("warn")
    with VirtualController.boot(booted, cycle="once", autostart=False) as plain:
        plain.start_program()
        began = time.process_time()
        plain.run(max_time=120)
        counts["cpu"] -= time.process_time() - began
    options = {"cycle": "once", "autostart": False, "detection": detection}
    with VirtualController.boot(booted, **options) as controller:
        ((name, recorder),) = controller.record().items()
        controller.start_program()
        began = time.process_time()
        controller.run(max_time=120)
        counts["cpu"] += time.process_time() - began
        assert controller.collisions is not None
        contacts = controller.collisions.contacts
        world = controller.collisions.world
        times = list(range(0, controller.scheduler.now + 1, _MS))
        postures = np.array(recorder.commanded(times))
    counts["seconds"] += times[-1] / S
    dense = JointPath.linear(np.array(times) / S, world.values({name: postures}))
    far = clearances(world.scene, dense, dense.times, _LIMIT).distances
    for number in range(len(world.scene.pairs)):
        own = far[:, number]
        if own[0] <= 0:
            continue
        counts["pairs"] += 1
        touching = np.flatnonzero(own <= 0)
        names = set(world.scene.names(number))
        contact = next((one for one in contacts if set(one.bodies) == names), None)
        counts["contacts"] += bool(len(touching))
        if len(touching) and contact is None:
            counts["missed"] += 1
            print("missed:", *names, f"{-1000 * own.min():.3f} mm deep")
        if contact is not None and not len(touching):
            counts["false"] += 1
            print("false:", *names, f"{1000 * own.min():.3f} mm apart")
        if contact is not None and len(touching):
            lags.append(1000 * (contact.time - times[touching[0]] / S))


def main(programs: int, seed: int) -> int:
    """Run the programs and print a summary; return 1 if a contact was missed."""
    rng = np.random.default_rng(seed)
    names = ("pairs", "contacts", "missed", "false", "skipped", "seconds", "cpu")
    counts = dict.fromkeys(names, 0.0)
    lags: list[float] = []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(programs):
            try:
                trial(target_of(Path(folder), rng), counts, lags)
            except DiagnosticError as fault:
                counts["skipped"] += 1
                print("skipped:", fault)
    print(
        f"{programs} programs ({counts['skipped']:.0f} skipped), {counts['seconds']:.0f} s of "
        f"motion: {counts['missed']:.0f} of {counts['contacts']:.0f} contacts missed, "
        f"{counts['false']:.0f} of {counts['pairs'] - counts['contacts']:.0f} pairs false; first "
        f"contact {min(lags, default=0):.2f} to {max(lags, default=0):.2f} ms after the sample's; "
        f"{1000 * counts['cpu'] / max(counts['seconds'], 1e-9):.0f} ms CPU a second of motion"
    )
    return 1 if counts["missed"] else 0


if __name__ == "__main__":
    arguments = [int(word) for word in sys.argv[1:3]]
    sys.exit(main(*arguments, *(200, 1)[len(arguments) :]))

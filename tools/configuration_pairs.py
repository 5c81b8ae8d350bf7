"""Compare the rule of configuration data with robtargets and jointtargets of public programs.

    python tools/configuration_pairs.py FOLDER ... [ROBOT=FOLDER ...]

Each FOLDER holds backups at any depth: their cfg names the robot, its base frame and its external
axes. ROBOT=FOLDER names the robot of loose modules. Nothing of them is kept here.

Two kinds of pairs are counted, for each arm family (`rapidgen.axes.configuration`):

- a robtarget of a move with known tool and work object, and the postures that reach it: the stored
  confdata must be that of one of them. Targets with [0,0,0,0], the value of programs that never set
  it, are left out;
- a robtarget and a jointtarget of one task that are the same place (1 mm, 0.5 degrees): the stored
  confdata must be that of the jointtarget.

A pair agrees if the quarters and cfx are equal; an axis within 2 degrees of the next quarter counts
as equal, because targets are rounded. It is accepted if the controller's check would let it pass,
and else differs. Targets that no posture reaches within the ranges are not pairs.
"""

import argparse
from collections import Counter
from collections.abc import Iterator
from math import degrees, pi, radians
from pathlib import Path

from rapidgen.axes import frames
from rapidgen.axes.configuration import FAMILIES, family_of
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import AxisConfiguration, Kinematics, Posture
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig
from rapidgen.controller.inference.robot import MoveTarget, move_targets
from rapidgen.controller.mechanics import mechanics
from rapidgen.diagnostics import DiagnosticError
from rapidgen.rapid import Dialect
from rapidgen.rapid.binding import TaskScope
from rapidgen.rapid.module_trees import tree_of
from rapidgen.system.backup import is_backup, read_backup
from rapidgen.system.loose_files import read_files
from rapidgen.system.model import System, TaskSpec

ROUNDED = radians(2) / (pi / 2)
"""Quarters by which a rounded target may miss its own."""
SAME_PLACE, SAME_TURN = 0.001, radians(0.5)
SUFFIXES = (".mod", ".prg", ".sys", ".modx", ".sysx")
_WIDEST = 1e8
"""Values of eax from here on are 9E9: not used."""


def systems(folder: Path, robot: str) -> Iterator[tuple[Path, System]]:
    """Iterate over the backups below a folder, or over its loose modules one by one."""
    paths = [folder, *(path for path in sorted(folder.rglob("*")))]
    for path in paths:
        loose = robot and path.is_file() and path.suffix.casefold() in SUFFIXES
        try:
            if path.is_dir() and not robot and is_backup(path):
                yield path, read_backup(path)
            elif loose:
                yield path, read_files([path])
        except DiagnosticError as error:
            print(f"not read: {path}: {error}"[:160])


def targets_of(system: System, spec: TaskSpec) -> Iterator[MoveTarget]:
    """Iterate over the targets of a task's moves that are known before execution."""
    dialect = Dialect(system.robotware, some=not system.is_robotware_known)
    task = TaskScope()
    scopes = [task.add(tree_of(module, dialect)) for module in spec.modules]
    for scope in scopes:
        yield from move_targets(scope)


class Count:
    """Pairs of all folders, each place once."""

    def __init__(self) -> None:
        self.by_family: dict[str, Counter[str]] = {family.name: Counter() for family in FAMILIES}
        self.seen: set[tuple[object, ...]] = set()
        self.differing: list[str] = []

    def add_task(self, group: GroupConfig, targets: list[MoveTarget], path: Path) -> None:
        """Count the pairs of one task."""
        kinematics = Kinematics.of(group)
        if kinematics is None:
            return
        count = self.by_family[family_of(kinematics).name]
        middle = tuple(
            (joint.lower + joint.upper) / 2 if joint.axis.startswith("rax") else 0.0
            for joint in group.joints
        )
        map_ = JointMap.of(group)
        known: list[tuple[Posture, Pose]] = []
        for target in targets:
            if target.axes:
                posture = map_.from_rapid(target.axes, target.external, middle)
                known.append((posture, kinematics.forward(posture)))
        for target in targets:
            key = group.name, target.place, target.tool, target.configuration
            if target.place is None or not any(target.configuration) or key in self.seen:
                continue
            self.seen.add(key)
            flange = frames.compose(target.place, frames.invert(target.tool))
            stored = target.configuration
            for posture, pose in known:
                if _is_same(pose, flange):
                    count[f"jointtarget {_verdict(kinematics, [posture], stored)}"] += 1
                    break
            start = map_.from_rapid((0.0,) * 6, target.external, middle)
            if kinematics.seventh >= 0:
                angle = target.external[0]
                if abs(angle) > _WIDEST:
                    continue
                reached = list(kinematics.at_arm_angle(flange, radians(angle), start))
            else:
                reached = kinematics.solutions(flange, start, stored)
            if not reached:
                count["out of reach"] += 1
                continue
            verdict = _verdict(kinematics, reached, stored)
            count[verdict] += 1
            count["branches"] += len({kinematics.configuration(p) for p in reached})
            if verdict == "differs":
                own = sorted({kinematics.configuration(p) for p in reached})[:4]
                self.differing.append(f"{path}: {target.name or 'literal'} {stored}, not {own}")


def _is_same(pose: Pose, other: Pose) -> bool:
    (place, turn), (place2, turn2) = pose, other
    near = frames.distance(place, place2) < SAME_PLACE
    return near and frames.angle_between(turn, turn2) < SAME_TURN


def _verdict(kinematics: Kinematics, reached: list[Posture], stored: AxisConfiguration) -> str:
    """Return `agrees`, `accepted` or `differs`."""
    misfits = [kinematics.misfit(posture, stored) for posture in reached]
    if any(misfit is not None and misfit <= ROUNDED for misfit in misfits):
        return "agrees"
    if any(kinematics.matches(posture, stored) for posture in reached):
        return "accepted"
    return "differs"


def main() -> None:
    """Print one line for each family, and the targets that differ."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("folders", nargs="+", metavar="[ROBOT=]FOLDER")
    parser.add_argument("--differing", type=int, default=10, help="differing targets shown")
    given = parser.parse_args()
    count = Count()
    for argument in given.folders:
        robot, _, folder = argument.rpartition("=")
        for path, system in systems(Path(folder), robot):
            try:
                groups = mechanics(system, robot)[0]
            except DiagnosticError as error:
                print(f"no robot: {path}: {error}"[:160])
                continue
            tasks = {spec.name: spec for spec in system.tasks}
            for group in groups:
                if group.task in tasks:
                    count.add_task(group, list(targets_of(system, tasks[group.task])), path)
    for name, of in count.by_family.items():
        pairs = of["agrees"] + of["accepted"] + of["differs"]
        branches = of["branches"] / pairs if pairs else 0.0
        direct = {k: n for k, n in of.items() if k.startswith("jointtarget")}
        print(
            f"{name:12} {pairs:5} pairs, {of['agrees']} agree, {of['accepted']} are accepted, "
            f"{of['differs']} differ; {branches:.1f} configurations each; "
            f"{of['out of reach']} out of reach; {direct or 'no same jointtarget'}"
        )
    print(*count.differing[: given.differing], sep="\n")
    print(f"within {degrees(ROUNDED * pi / 2):g} degrees of a quarter counts as that quarter")


if __name__ == "__main__":
    main()

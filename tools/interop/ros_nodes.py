"""Trial: the unmodified C++ nodes of ros-industrial/abb_driver.

    python -m tools.interop.ros_nodes WORKSPACE [CASE...]
    (or: make interop PROGRAM=ros_nodes FOREIGN=WORKSPACE)

WORKSPACE is a built catkin workspace (ROS 1) with abb_driver, industrial_core and control_msgs;
this project contains no part of them. rosmaster, rospy and roslaunch come from the system. Each
case boots `rapidgen sim` on an address of loopback, at the standard ports, starts the nodes, and
drives them with rospy. If the workspace has abb_driver's RAPID, each case also runs with that, for
comparison: its results are printed and not judged. Exit code 1: a case of the generated driver has
failed.
"""

import sys
import tempfile
import traceback
from pathlib import Path

from tools.interop import ros_comings, ros_commands, ros_refused
from tools.interop.abb_driver import read_system
from tools.interop.ros import Workspace, write_backup
from tools.interop.ros_case import CASES, Case, Findings
from tools.interop.ros_cell import Cell

URDF = Path(__file__).parents[2] / "robots" / "urdf"
PARTS = (ros_commands, ros_refused, ros_comings)
"""Modules with cases; each registers its own."""
ZEROS = "0,0,0,0,0,0"
"""Initial position of the generated driver's robot; the cases rely on it."""


def _try(workspace: Workspace, one: Case, target: str, options: tuple[str, ...]) -> Findings:
    result = Findings()
    urdf = URDF / f"{one.robot}.urdf"
    try:
        cell = Cell(workspace, target, *options, robot=one.robot, urdf=urdf, coupled=one.coupled)
    except AssertionError as error:
        result.must(False, str(error))
        return result
    try:
        one.run(cell, result)
    except AssertionError as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        result.must(False, f"{error} ({place.name})")
        for name, node in cell.nodes.items():
            print(name, *[line for _, line in node.lines[-6:]], sep="\n    ", file=sys.stderr)
    finally:
        cell.close()
    return result


def main(folder: Path, expected: list[str]) -> int:
    """Run the cases; return 1 if one of the generated driver failed."""
    rapid = next(folder.glob("src/**/ROS_motionServer.mod"), None)
    workspace = Workspace(folder)
    failed = []
    try:
        for name, one in CASES.items():
            if expected and name not in expected:
                continue
            print(f"## {name}: {one.title}", flush=True)
            with tempfile.TemporaryDirectory() as scratch:
                faults = Path(scratch) / "faults.yaml"
                faults.write_text(one.faults or "{}\n")
                plan = ("--faults", str(faults)) if one.faults else ()
                ours = _try(workspace, one, one.robot, (*one.options, *plan))
                print(f"rapidgen: {ours}", flush=True)
                if not all(good for good, _ in ours.lines):
                    failed.append(name)
                if rapid is not None and one.upstream:
                    backup = write_backup(read_system(rapid.parent), Path(scratch) / "abb_driver")
                    options = ("--robot", one.robot, "--start", ZEROS, *plan)
                    print(f"abb_driver: {_try(workspace, one, str(backup), options)}", flush=True)
    finally:
        workspace.close()
    print(f"failed: {', '.join(failed) or 'none'}")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2:]))

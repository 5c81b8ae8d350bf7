"""Trial: rpiRobotics/abb_motion_program_exec with its Python client.

    python -m tools.interop.motion_program_exec FOLDER

FOLDER is a checkout; the package of the same name must be installed next to rapidgen. Its examples
run unchanged: only the HTTP calls of Robot Web Services go to a stand-in (rws.py), and plots are
not drawn. The positions that its client reads must be those of the robot.
"""

import runpy
import shutil
import sys
import tempfile
from contextlib import redirect_stdout
from io import StringIO
from math import degrees
from pathlib import Path
from types import ModuleType
from unittest.mock import MagicMock, patch

import abb_motion_program_exec as mp
import abb_motion_program_exec.abb_motion_program_exec_client as client_module

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.controller.mechanics import groups_for
from rapidgen.system import read_system
from tools.interop.rws import Face


def install(folder: Path, config: str, where: Path) -> Path:
    """Install it as its manual says: modules in HOME:, configuration loaded."""
    shutil.copytree(folder / "robot/HOME", where / "HOME")
    shutil.copytree(folder / "robot" / config, where / "SYSPAR")
    return where


def controller_of(folder: Path, config: str, robot: str, scratch: str) -> VirtualController:
    """Return a controller, switched on and stopped.

    The client starts the program.
    """
    system = read_system(install(folder, config, Path(scratch)))
    groups = groups_for(system, load_config(robot).groups)
    controller = VirtualController(system, groups, clock="real", cycle="once", speed=4)
    controller.stop_program()
    controller.start()
    return controller


def example(folder: Path, name: str, robot: str) -> None:
    """Run one of its examples; compare the client's data with the robot."""
    results = []
    read = client_module.MotionProgramExecClient.read_motion_program_result_log

    def saved(self, number):
        results.append(read(self, number))
        return results[-1]

    with (
        tempfile.TemporaryDirectory() as scratch,
        controller_of(folder, "config_params", robot, scratch) as controller,
        patch.object(client_module, "RWS", lambda *_: Face(controller)),
        patch.object(
            client_module.MotionProgramExecClient, "read_motion_program_result_log", saved
        ),
        redirect_stdout(StringIO()),
    ):
        runpy.run_path(str(folder / "examples" / name))
        ends = [degrees(a) for a in controller.call(controller.motion.group("rob1").positions)]
    rows = results[0].data
    assert max(abs(a - b) for a, b in zip(rows[-1, 2:8], ends, strict=True)) < 0.01
    commands = sorted({int(row) for row in rows[:, 1]})
    took = rows[-1, 0] - rows[0, 0]
    print(f"{name}: a log of {len(rows)} rows over {took:.1f} s, commands {commands}")


def two_robots(folder: Path) -> None:
    """Run its multimove example, without base frames.

    No file contains them; joints do not need them.
    """
    programs = []
    for sign in (1, -1):
        program = mp.MotionProgram()
        program.SyncMoveOn()
        for angle in (20, -20, 10):
            target = mp.jointtarget([sign * angle, 5, 5, 0, 30, 0], [0] * 6)
            program.MoveAbsJ(target, mp.v500, mp.fine)
        program.WaitTime(0.2)
        program.SyncMoveOff()
        programs.append(program)
    with (
        tempfile.TemporaryDirectory() as scratch,
        controller_of(folder, "config_params_multimove", "irb1200", scratch) as controller,
    ):
        client = mp.MotionProgramExecClient(abb_client=Face(controller))
        rows = client.execute_multimove_motion_program(programs).data
    assert max(abs(rows[-1, 2:] - [10, 5, 5, 0, 30, 0, -10, 5, 5, 0, 30, 0])) < 0.01
    print(f"two robots: a log of {len(rows)} rows, both at their ends")


def main(folder: Path) -> None:
    """Run the trial.

    Raises AssertionError if it fails.
    """
    plots = MagicMock()
    plots.subplots.return_value = (MagicMock(), MagicMock())
    names = {"matplotlib": ModuleType("matplotlib"), "matplotlib.pyplot": plots}
    with patch.dict(sys.modules, names):
        example(folder, "example.py", "irb1200")
        example(folder, "preempt_example.py", "irb1200")
        two_robots(folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]))

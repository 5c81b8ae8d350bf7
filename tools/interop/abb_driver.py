"""Trial: unmodified RAPID modules of ros-industrial/abb_driver.

    python -m tools.interop.abb_driver FOLDER  (or: make interop PROGRAM=abb_driver FOREIGN=FOLDER)

FOLDER holds the six modules; this project contains no part of them. They boot on the virtual
controller, accept five points as bytes written by hand, and answer in bytes that are compared with
a table written by hand. Of 101 points they drop the last, a known defect.
"""

import sys
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.system.model import ModuleFile, SignalSpec, System, SystemOutput, TaskSpec
from tests.acceptance.driving import Ports, next_state, read, too_many, until
from tests.acceptance.frames import (
    FIVE_POINTS,
    JOINT_AT_LAST,
    JOINT_AT_ZERO,
    LAST_JOINTS,
    STATUS_IDLE,
    STATUS_MOVING,
    STOP,
    STOP_REPLY,
)

# Its documentation maps these virtual signals to system outputs by hand.
SIGNALS = (
    ("signalExecutionError", "Error", "", ""),
    ("signalMotionPossible", "RunchOk", "", ""),
    ("signalMotorOn", "MotOnState", "", ""),
    ("signalRobotActive", "MechUnitActive", "ROB_1", ""),
    ("signalRobotEStop", "EmStop", "", ""),
    ("signalRobotNotMoving", "MechUnitNotMoving", "ROB_1", ""),
    ("signalRosMotionTaskExecuting", "TaskExecuting", "", "T_ROB1"),
)


def read_system(folder: Path) -> System:
    """Return the three tasks as abb_driver's documentation describes them."""

    def module(name: str) -> ModuleFile:
        return ModuleFile(Path(name).stem, name, (folder / name).read_bytes(), f"HOME:/{name}")

    common = (module("ROS_common.sys"),)
    served = (*common, module("ROS_socket.sys"), module("ROS_messages.sys"))

    def server(name: str, trust: str, file: str) -> TaskSpec:
        return TaskSpec(
            name,
            "SEMISTATIC",
            trust=trust,
            mechanical_unit_group="rob1",
            modules=(*served, module(file)),
        )

    return System(
        "abb_driver",
        (
            TaskSpec(
                "T_ROB1",
                motion=True,
                mechanical_unit_group="rob1",
                modules=(*common, module("ROS_motion.mod")),
            ),
            server("T_RECV", "SysStop", "ROS_motionServer.mod"),
            server("T_STATE", "NoSafety", "ROS_stateServer.mod"),
        ),
        signals=tuple(SignalSpec(name, "DO") for name, *_ in SIGNALS),
        outputs=tuple(
            SystemOutput(status, name, unit, task) for name, status, unit, task in SIGNALS
        ),
    )


def main(folder: Path) -> None:
    """Run the trial.

    Raises AssertionError if it fails.
    """
    system = read_system(folder)
    robots = load_config("irb120").groups
    with VirtualController(system, robots, clock="real", ports="auto", speed=8) as controller:
        ports = Ports(controller)
        group = controller.motion.group("rob1")
        with ports.connect(ports.state) as state, ports.connect(ports.motion) as motion:
            until(state, JOINT_AT_ZERO, STATUS_IDLE)
            motion.sendall(b"".join(FIVE_POINTS))
            seen = until(state, JOINT_AT_LAST, STATUS_IDLE)
            assert any(status == STATUS_MOVING for _, status in seen)
            reached = controller.call(group.positions)
            assert max(abs(a - b) for a, b in zip(reached, LAST_JOINTS, strict=True)) < 1e-6
            motion.sendall(STOP)
            assert read(motion, len(STOP_REPLY)) == STOP_REPLY
            print("five points: every byte as written by hand")
    with VirtualController(system, robots, clock="real", ports="auto", speed=100) as controller:
        ports = Ports(controller)
        group = controller.motion.group("rob1")
        with ports.connect(ports.state) as state, ports.connect(ports.motion) as motion:
            until(state, JOINT_AT_ZERO, STATUS_IDLE)
            motion.sendall(too_many(101))
            while next_state(state)[1] != STATUS_MOVING:
                pass
            while next_state(state)[1] == STATUS_MOVING:
                pass
            last = controller.call(group.positions)[0]
            assert abs(last - 0.099) < 1e-5, last
            print(f"101 points: it ended at point 100 (joint 1 at {last:.4f} of 0.1 rad)")


if __name__ == "__main__":
    main(Path(sys.argv[1]))

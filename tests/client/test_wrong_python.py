"""Wrong arguments in Python: each error has a reason and a help.

They are raised before any byte is sent.
"""

import pytest

from rapidgen.client import (
    Cell,
    Controller,
    InvalidProgram,
    InvalidTarget,
    InvalidTrajectory,
    Pose,
    Program,
    Robot,
    Speed,
    Trajectory,
    Trigger,
    Zone,
    pulse,
)
from rapidgen.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError

ZEROS = [[0.0] * 6] * 2
WRONG = {
    "a number for a robot": (
        lambda: Robot(5), InvalidTarget, "the target is a text, not int", "a shipped name"),
    "an address in parts": (
        lambda: Robot("irb120", address=("127.0.0.1", 11000)),
        InvalidTarget, "the address is a text, not tuple", "HOST:MOTION,STATE"),
    "a model that is none": (
        lambda: Robot("irb121", address="h"),
        InvalidTarget, "'irb121' is no configuration", "irb120"),
    "a group that is none": (
        lambda: Robot("irb120", group="rob2"), InvalidTarget, "no motion group 'rob2'", "rob1"),
    "a number for time-outs": (
        lambda: Robot("irb120", timeouts=5),
        InvalidTarget, "time-outs are a Timeouts, not int", "Timeouts(reply=5)"),
    "joints too few for a pose": (
        lambda: Robot("irb120").pose_of([0] * 5),
        InvalidProgram, "5 joints, the robot has 6", "joint_1, joint_2"),
    "a text for a pose's joints": (
        lambda: Robot("irb120").pose_of("0,0,0,0,0,0"),
        InvalidProgram, "'0,0,0,0,0,0' are not joints", "numbers in rad"),
    "joints too many to be near": (
        lambda: Robot("irb120").joints_for(Pose((0.3, 0, 0.5)), near=[0] * 7),
        InvalidProgram, "7 joints, the robot has 6", "joint_1, joint_2"),
    "a cell of a name": (
        lambda: Cell("irb120"), InvalidTarget, "robots by name, not of str", "Cell({"),
    "a number for a controller": (
        lambda: Controller(5), DiagnosticError, "'5' is not an address", "rws://"),
    "a file where numbers belong": (
        lambda: Trajectory("p.csv", None), InvalidTrajectory, "a trajectory needs numbers", ""),
    "one value a point": (
        lambda: Trajectory([0, 1], [0, 1]), InvalidTrajectory, "of shape (2,)", "(n, joints)"),
    "more points than times": (
        lambda: Trajectory([0, 1], [[0] * 6] * 3),
        InvalidTrajectory, "do not fit", "times of shape"),
    "a name twice": (
        lambda: Trajectory([0, 1], [[0] * 2] * 2, ["a", "a"]),
        InvalidTrajectory, "there twice: a", ""),
    "too few names": (
        lambda: Trajectory([0, 1], ZEROS, ["a"]), InvalidTrajectory, "6 columns for 1", ""),
    "a file that is not there": (
        lambda: Trajectory.from_csv("x.csv"), InvalidTrajectory, "cannot read x.csv", "path"),
    "joints as a text": (
        lambda: Program().move_joints("0,0,0,0,0,0"),
        InvalidProgram, "'0,0,0,0,0,0' are not joints", "numbers in rad"),
    "joints as nothing": (
        lambda: Program().move_joints(None),
        InvalidProgram, "None are not joints", "numbers in rad"),
    "a place for a pose": (
        lambda: Program().move_linear((0.3, 0, 0.5)),
        InvalidProgram, "is not a Pose", "from_xyzw"),
    "a word for a speed": (
        lambda: Program(speed="fast"), InvalidProgram, "'fast' is not a speed", "m/s of the TCP"),
    "a word in a Speed": (
        lambda: Speed("fast"), InvalidProgram, "'fast' is not a speed", "m/s of the TCP"),
    "a word in a Zone": (
        lambda: Zone(tcp="z10"), InvalidProgram, "'z10' is not a radius", "Zone.of"),
    "a list for a zone": (
        lambda: Program(zone=[0.01]), InvalidProgram, "[0.01] is not a zone", "z10"),
    "a word for a wait": (
        lambda: Program().wait("long"), InvalidProgram, "'long' is not a time", "seconds"),
    "a word for a time-out": (
        lambda: Program().wait_for("part", timeout=None),
        InvalidProgram, "None is not a time", "seconds"),
    "a word for a limit": (
        lambda: Program().call("weld", timeout="5 s"),
        InvalidProgram, "'5 s' is not a time", "seconds"),
    "a word for a level": (
        lambda: Program().set("glue", "on"), InvalidProgram, "'on' is not a value", "0 or 1"),
    "a word for a place": (
        lambda: pulse("glue", "5 mm", 0.01), InvalidProgram, "'5 mm' is not a place", "m or s"),
    "a word for a trigger's level": (
        lambda: Trigger.after(0.1, "glue", "on"), InvalidProgram, "'on' is not a value", "0 or 1"),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_typed_wrong(case):
    call, kind, report, help_text = WRONG[case]
    with pytest.raises(kind) as caught:
        call()
    assert report in str(caught.value)
    assert help_text in " ".join(d.help for d in caught.value.diagnostics)


def test_one_file_is_no_list_of_files():
    with pytest.raises(TypeError, match=r"files are a list.*\['good.mod'\]"):
        VirtualController.from_files("good.mod")

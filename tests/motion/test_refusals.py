"""What a program sees of each of the planner's refusals: its error, or the event that stops it."""

import pytest

from rapidgen.motion import MotionSettings
from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.runtime.motion_interface import in_rapid

P = "[[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
DATA = f"CONST robtarget p := {P};\n"
HOME = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\n"
FAR = "MoveAbsJ [[166,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;"
CONCURRENT = "".join(f"MoveJ \\Conc, Offs(p,0,0,{z}), v100, fine, tool0;" for z in range(1, 7))

ERRORS = [
    ("MoveL Offs(p,900,0,0), v100, fine, tool0;", "ERR_OUTSIDE_REACH", "m"),
    (
        "SingArea \\Wrist; MoveL Offs(p,900,0,0), v100, fine, tool0;",
        "ERR_OUTSIDE_REACH",
        "",
    ),
    (FAR, "ERR_ROBLIMIT", "rax_1 (joint_1) = 166.000 deg, range -165 to 165 deg"),
    (
        "MoveL Offs(p,10,0,0), [0,500,5000,1000], fine, tool0;",
        "ERR_ARGVALERR",
        "a part of the move has speed 0",
    ),
    (CONCURRENT, "ERR_CONC_MAX", ""),
]
EVENTS = [
    (
        "MoveC Offs(p,0,30,0), Offs(p,0,20,0), v100, fine, tool0;",
        50_063,
        "Circle uncertain",
        "the three points make no circle",
    ),
    (
        "MoveC Offs(p,0,5,80), Offs(p,0,10,0), v100, fine, tool0;",
        50_063,
        "Circle uncertain",
        "more than 240 degrees in one MoveC",
    ),
    (
        "MoveL [[364.354,50,594],[0.5,0,0.866025,0],[0,0,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]],"
        " v100, fine, tool0;",
        50_080,
        "Position not compatible",
        "the way ends in configuration [0, -1, 0, 0], programmed is [0, 0, 0, 1]",
    ),
    ("RestoPath;", 194_902, "No path is stored", ""),
]


@pytest.mark.parametrize(("body", "name", "text"), ERRORS)
def test_an_error_that_a_handler_gets(rapid, body, name, text):
    program = rapid(HOME + body, DATA)
    program.run()
    fault = program.controller.task("T_ROB1").fault
    assert fault is not None
    assert fault.cause is not None
    assert fault.cause.name == name
    assert text in fault.cause.text


@pytest.mark.parametrize(("body", "event", "title", "text"), EVENTS)
def test_an_event_that_stops_the_task(rapid, body, event, title, text):
    program = rapid(HOME + body, DATA)
    program.run()
    fault = program.controller.task("T_ROB1").fault
    assert fault is not None
    assert (fault.event, fault.title) == (event, title)
    assert fault.arguments == ((text,) if text else ())


def test_a_target_outside_the_range_may_stop_the_task(rapid):
    program = rapid("WaitTime 0.1;" + FAR, DATA)
    program.controller.motion.settings = MotionSettings(range_error="fatal")
    program.run()
    fault = program.controller.task("T_ROB1").fault
    assert (fault.event, fault.title) == (50_027, "Joint out of range")


def test_a_robot_without_geometry_moves_in_joints_only(rapid):
    program = rapid("WaitTime 0.1; MoveL p, v100, fine, tool0;", DATA)
    program.group.planner.kinematics = None
    program.run()
    fault = program.controller.task("T_ROB1").fault
    assert (fault.event, fault.title) == (195_900, "No geometry")
    assert fault.arguments[0].startswith("rob1: the configuration has no chain")


@pytest.mark.parametrize("refusal", FaultReason)
def test_every_refusal_has_a_meaning_in_rapid(refusal):
    assert in_rapid(MotionFault(refusal, "one", "two"))

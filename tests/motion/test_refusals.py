"""What a program sees of each of the planner's refusals: its error, or the event that stops it."""

import pytest

from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.rapid.switches import Switches
from rapidgen.runtime.errors import errnum
from rapidgen.runtime.motion_interface import in_rapid

P = "[[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
DATA = f"CONST robtarget p := {P};\n"
SEARCHED = DATA + "PERS bool hit := FALSE;\nVAR robtarget found;\n"
HOME = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\n"
FAR = "MoveAbsJ [[166,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;"
CONCURRENT = "".join(f"MoveJ \\Conc, Offs(p,0,0,{z}), v100, fine, tool0;" for z in range(1, 7))

ERRORS = [
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


UNREACHABLE = [
    ("MoveL Offs(p,900,0,0), v100, fine, tool0;", "ERR_OUTSIDE_REACH", ("", "ROB_1")),
    ("MoveJ Offs(p,900,0,0), v100, fine, tool0;", "ERR_OUTSIDE_REACH", ("", "ROB_1")),
    (
        "MoveC Offs(p,0,30,0), Offs(p,900,0,0), v100, fine, tool0;",
        "ERR_OUTSIDE_REACH",
        ("", "ROB_1"),
    ),
    (
        "SearchL \\Stop, hit, found, Offs(p,900,0,0), v100, tool0;",
        "ERR_OUTSIDE_REACH",
        ("", "ROB_1"),
    ),
    (
        "SingArea \\Wrist; MoveL Offs(p,900,0,0), v100, fine, tool0;",
        "ERR_OUTSIDE_REACH",
        ("", "ROB_1"),
    ),
    (FAR, "ERR_ROBLIMIT", ("1", "ROB_1")),
]
"""Statements, the error that a handler could receive, and the arguments of event 50050."""
HANDLER = "ERROR TPWrite NumToStr(ERRNO, 0); TRYNEXT;\n"


@pytest.mark.parametrize(("body", "name", "arguments"), UNREACHABLE)
@pytest.mark.parametrize("handler", ["", HANDLER])
def test_a_target_out_of_reach_stops_the_tasks(rapid, body, name, arguments, handler):
    """Saved event logs of controllers with 5.61 and 6.03: E 50050 (axis, unit), I 10020, I 10125.

    A start from there was refused with 10097.
    """
    program = rapid(HOME + body + handler, SEARCHED)
    out = program.run()
    controller = program.controller
    task = controller.task("T_ROB1")
    assert out == []
    assert task.state == "error"
    assert (task.fault.event, task.fault.cause.name) == (50_050, name)
    events = [(e.type.name[0], e.code) for e in controller.log][-3:]
    assert events == [("E", 50_050), ("I", 10_020), ("I", 10_125)]
    assert [e.arguments for e in controller.log if e.code == 50_050] == [arguments]
    assert controller.start_program()
    assert [e.code for e in controller.log if e.task == "T_ROB1"].count(10_097) == 1


@pytest.mark.parametrize(("body", "name", "_arguments"), UNREACHABLE)
def test_a_switch_lets_a_handler_receive_it(rapid, body, name, _arguments):
    program = rapid(HOME + body + HANDLER, SEARCHED, dialect=Switches(unreachable_target="handler"))
    assert program.run() == [str(errnum(name))]


def test_a_function_that_cannot_compute_raises_an_error_of_its_statement(rapid):
    program = rapid(
        "j := CalcJointT(Offs(p,900,0,0), tool0);" + HANDLER, DATA + "VAR jointtarget j;\n"
    )
    assert program.run() == [str(errnum("ERR_OUTSIDE_REACH"))]


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

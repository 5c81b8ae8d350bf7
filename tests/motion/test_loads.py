"""Loads while a program runs: an undefined one stops it, one above the payload is reported."""

import pytest

from rapidgen.config import load_config
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.runner import ControllerRunner
from rapidgen.motion import MotionSettings

PAYLOAD = load_config("irb120").groups[0].max_payload
AXES = "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
P = "CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];"
HOME = f"MoveAbsJ {AXES}, v1000, fine, tool0;\n"


def load(mass):
    return f"[{mass},[0,0,50],[1,0,0,0],0,0,0]"


def data(tool=1.0, payload=1.0, total=1.0):
    """A tool, a payload and a load of both with these masses."""
    return f"""{P}
PERS tooldata tool := [TRUE,[[0,0,0],[1,0,0,0]],{load(tool)}];
PERS loaddata payload := {load(payload)};
PERS loaddata total := {load(total)};
PERS loaddata active;
PROC quiet() ENDPROC

"""


MOVES = [
    f"MoveAbsJ {AXES}, v1000, fine, tool;",
    "MoveJ p, v1000, fine, tool;",
    "MoveL p, v1000, fine, tool;",
    "MoveC Offs(p,0,10,10), Offs(p,0,20,0), v1000, fine, tool;",
    'MoveLSync p, v1000, fine, tool, "quiet";',
]
SETTINGS = ["GripLoad payload;", "SetSysData payload;", "MechUnitLoad ROB_1, 1, payload;"]


def events(program, *codes):
    return [event for event in program.controller.log if event.code in codes]


@pytest.mark.parametrize("move", MOVES)
@pytest.mark.parametrize("mass", ["-1", "-1E-6", "-1E38"])
def test_a_tool_without_a_load_stops_the_program_at_its_move(rapid, move, mass):
    program = rapid(HOME + move + 'TPWrite "moved";', data(tool=mass))
    assert program.run() == []
    _, event = events(program, 41_438)
    assert event.title == "Undefined load"
    assert any("the load of the tool has a mass of -" in text for text in event.texts)
    fault = program.controller.task("T_ROB1").fault
    assert (fault.event, fault.stack[-1].span.line) == (41_438, 12)


@pytest.mark.parametrize("setting", SETTINGS)
def test_an_undefined_load_stops_the_program_where_it_becomes_active(rapid, setting):
    program = rapid(setting + 'TPWrite "set";', data(payload=-1))
    assert program.run() == []
    _, event = events(program, 41_438)
    assert any("has a mass of -1 kg" in text for text in event.texts)


def test_a_load_of_a_move_is_undefined(rapid):
    program = rapid(HOME + "MoveL p, v1000, fine, tool \\TLoad:=total;", data(total=-2))
    program.run()
    _, event = events(program, 41_438)
    assert any("\\TLoad has a mass of -2 kg" in text for text in event.texts)


@pytest.mark.parametrize("move", MOVES[:4])
def test_a_tool_above_the_payload_is_reported_and_moves(rapid, move):
    program = rapid(HOME + move + 'TPWrite "moved";', data(tool=1200))
    assert program.run() == ["moved"]
    (event,) = events(program, 195_902)
    assert event.type.name == "WARNING"
    assert f"1200 kg is more than the {PAYLOAD:g} kg payload of irb120" in event.texts[0]
    assert (event.span.line, event.texts[1][:13]) == (12, "/Probe/main/M")


@pytest.mark.parametrize(
    ("masses", "body", "reported"),
    [
        ({}, "GripLoad payload; MoveL p, v1000, fine, tool;", []),
        ({"tool": PAYLOAD, "payload": 0}, "GripLoad payload; MoveL p, v1000, fine, tool;", []),
        ({"payload": PAYLOAD}, "GripLoad payload; MoveL p, v1000, fine, tool;", [PAYLOAD + 1]),
        ({"payload": PAYLOAD}, "SetSysData payload; MoveL p, v1000, fine, tool;", [PAYLOAD + 1]),
        ({"payload": PAYLOAD}, "GripLoad payload; GripLoad load0; MoveL p, v1000, fine, tool;", []),
        ({"total": 9}, "MoveL p, v1000, fine, tool \\TLoad:=total;", [9]),
        ({"tool": 9}, "MoveL p, v1000, fine, tool \\TLoad:=total;", []),
        ({"tool": 9, "total": 0.001}, "MoveL p, v1000, fine, tool \\TLoad:=load0;", [9]),
        ({"tool": 9}, "MoveL p, v1000, z1, tool;\n MoveJ p, v1000, fine, tool;", [9]),
        (
            {"tool": 9},
            "MoveL p, v1000, fine, tool; MoveL p, v1000, fine, tool0; MoveL p, v100, fine, tool;",
            [9, 9],
        ),
        ({"tool": 9}, "tool.tload.mass := 8; MoveL p, v1000, fine, tool;", [8]),
        ({"tool": 0}, "MoveL p, v1000, fine, tool;", []),
    ],
)
def test_what_is_carried_is_tool_and_payload_or_all_that_a_move_says(rapid, masses, body, reported):
    program = rapid(HOME + body + 'TPWrite "moved";', data(**masses))
    assert program.run() == ["moved"]
    result = [event.texts[0] for event in events(program, 195_902)]
    assert len(result) == len(reported)
    for text, mass in zip(result, reported, strict=True):
        assert f" {mass:g} kg is more than" in text


def test_a_load_is_reported_again_after_pp_to_main(rapid):
    program = rapid(HOME + "MoveL p, v1000, fine, tool;", data(tool=9))
    program.run()
    program.controller.pp_to_main()
    program.controller.start_program()
    program.run()
    assert len(events(program, 195_902)) == 2


def test_the_active_payload_can_be_read(rapid):
    body = """
    GetSysData active;
    TPWrite NumToStr(active.mass, 3);
    SetSysData payload;
    GetSysData active;
    TPWrite NumToStr(active.mass, 3);
    active := CLoad();
    TPWrite NumToStr(active.mass, 3);
    """
    assert rapid(body, data(payload=2)).run() == [
        "0.001",
        "2.000",
        "2.000",
    ]


def test_the_payload_of_a_guessed_robot_says_nothing_of_a_program(rapid):
    program = rapid(HOME + "MoveL p, v1000, fine, tool;", data(tool=9))
    program.controller.motion.is_any_robot = True
    program.run()
    assert events(program, 195_902) == []


@pytest.mark.parametrize(("robot", "count"), [("", 0), ("irb120", 1)])
def test_the_payload_of_a_robot_that_stands_in_is_not_known(tmp_path, robot, count):
    module = tmp_path / "m.mod"
    tool = f"PERS tooldata tool := [TRUE,[[0,0,0],[1,0,0,0]],{load(9)}];"
    module.write_text(
        f"MODULE m\n{tool}\nPROC main()\nMoveAbsJ {AXES}, v1000, fine, tool;\nENDPROC\nENDMODULE\n"
    )
    with ControllerRunner.boot(load_target([module], BootOptions(robot=robot))) as runner:
        runner.controller.run_for(10)
        assert sum(event.code == 195_902 for event in runner.controller.log) == count


@pytest.mark.parametrize("body", ["MoveL p, v1000, fine, tool;", "GripLoad payload;"])
def test_an_undefined_load_is_only_reported_by_choice(rapid, body):
    program = rapid(HOME + body + 'TPWrite "done";', data(tool=-1, payload=-1))
    program.controller.motion.settings = MotionSettings(undefined_load="report")
    assert program.run() == ["done"]
    assert [event.type.name for event in events(program, 41_438)] == ["WARNING"]

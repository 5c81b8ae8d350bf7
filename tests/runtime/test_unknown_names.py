"""Undeclared names are reported by the statement that needs them.

Source: [K §12].
"""

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.runtime.errors import errnum
from rapidgen.system.model import ModuleFile, System, TaskSpec


@pytest.mark.parametrize(
    ("body", "error"),
    [
        ("nowhere;", "ERR_REFUNKPRC"),
        ("n := nowhere();", "ERR_REFUNKFUN"),
        ("n := nowhere + 1;", "ERR_REFUNKDAT"),
        ("CONNECT i WITH nowhere;", "ERR_REFUNKTRP"),
    ],
)
def test_event_names_unknown_name(body, error):
    text = f"MODULE m\nVAR intnum i;\nVAR num n;\nPROC main()\n{body}\nENDPROC\nENDMODULE\n"
    task = TaskSpec("T_ROB1", modules=(ModuleFile("m", "m.mod", text.encode()),))
    with VirtualController(System("unknown", (task,)), cycle="once") as controller:
        controller.run(max_time=1)
        fault = controller.task("T_ROB1").fault
        assert fault is not None
        assert fault.arguments == (error, "nowhere")


def printed(body: str, data: str = "", remaining: str = "") -> tuple[list[str], VirtualController]:
    """Return output of a program that skips errors, and its end."""
    text = (
        f"MODULE m\n{data}\nPROC main()\n{body}\nERROR\nTPWrite ValToStr(ERRNO);\nTRYNEXT;\n"
        f"ENDPROC\n{remaining}\nENDMODULE\n"
    )
    file = ModuleFile("m", "m.mod", text.encode())
    out: list[str] = []
    controller = VirtualController(
        System("s", (TaskSpec("T_ROB1", modules=(file,)),)), cycle="once", autostart=False
    )
    with controller:
        controller.operator.subscribe(lambda _task, text: out.append(text))
        controller.start_program()
        controller.run(max_time=10)
    return out, controller


UNKNOWN = str(errnum("ERR_REFUNKDAT"))


@pytest.mark.parametrize(
    "statement",
    [
        "SetDO nowhere, 1;",
        "nowhere := 3;",
        "nowhere.x := 3;",
        "n := nowhere{3};",
        'IF nowhere{2} = "a" TPWrite "no";',
        'IF nowhere.trans.x > 2 THEN\nTPWrite "no";\nENDIF',
        "MoveL nowhere, v100, fine, nowhere2 \\WObj:=nowhere3;",
        'TPWrite ValToStr(nowhere.x + "a");',
        "WHILE nowhere.x DO\nENDWHILE",
        "FOR i FROM 1 TO nowhere{1} DO\nENDFOR",
    ],
)
def test_other_statements_of_the_routine_are_executed(statement):
    out, controller = printed(f'TPWrite "before";\n{statement}\nTPWrite "after";', "VAR num n;")
    assert out == ["before", UNKNOWN, "after"]
    assert controller.task("T_ROB1").fault is None


def test_invalid_statement_stops_task_when_executed():
    out, controller = printed('TPWrite "before";\nIF n > 9 n := "a";\nn := "b";', "VAR num n;")
    fault = controller.task("T_ROB1").fault
    assert out == ["before"]
    assert (fault.title, fault.arguments) == (
        "Statement cannot be executed",
        ("the value is string, not num",),
    )
    assert (fault.span.line, fault.span.column) == (6, 6)


DATA = """PERS pm_info info := ["a", 1, [2, 3]];
LOCAL PERS pm_info many{2} := [["b", 1, [2, 3]], ["c", 1, [2, 3]]];
VAR pm_info other;"""
USES = """PROC use(PERS pm_info p, PERS pm_info all{*}, VAR pm_info v)
TPWrite "used";
ENDPROC"""


def test_data_of_addin_types_are_passed_on():
    """[backup] RobotWare 6: pm_projectinfo is in the add-in."""
    out, controller = printed("use info, many, other;", DATA, USES)
    assert out == ["used"]
    assert [d.code for d in controller.diagnostics] == ["RG404"]


@pytest.mark.parametrize(
    "statement",
    [
        'IF info.x = 1 TPWrite "no";',
        'IF info = other TPWrite "no";',
        "TPWrite ValToStr(info);",
        "other := info;",
        "other := [1];",
    ],
)
def test_statement_using_addin_type_names_it(statement):
    out, controller = printed(f'TPWrite "before";\n{statement}', DATA, USES)
    fault = controller.task("T_ROB1").fault
    assert out == ["before"]
    assert fault.arguments[0].startswith("nothing declares pm_info, which ")


def test_data_of_unknown_size_fail_when_executed():
    """[code] ROS_motion.mod of abb_driver alone.

    MAX_TRAJ_LENGTH is in ROS_common.sys.
    """
    data = "VAR robtarget way{MAX_LENGTH};\nCONST num half := MAX_LENGTH / 2;\nVAR num n;"
    out, controller = printed('TPWrite "before";\nway{1} := CRobT();\nn := half;', data)
    fault = controller.task("T_ROB1").fault
    assert out == ["before"]
    assert fault.arguments == ("nothing declares max_length, which way needs",)
    assert [d.code for d in controller.diagnostics] == ["RG404"]


def test_missing_signal_may_have_name_of_type():
    out, _ = printed('TPWrite "before";\nWaitDI SENSOR, 1;\nTPWrite "after";')
    assert out == ["before", UNKNOWN, "after"]


@pytest.mark.parametrize("body", ["SetTmSignal n;", "n := PathLengthGet();"])
def test_option_routine_fails_when_executed(body):
    out, controller = printed(f'TPWrite "before";\n{body}', "VAR num n;")
    assert out == ["before"]
    assert [d.code for d in controller.diagnostics] == ["RG403"]
    assert "option" in controller.task("T_ROB1").fault.arguments[0]

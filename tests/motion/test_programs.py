"""RAPID motion programs on a whole controller."""

from dataclasses import replace

import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.motion import MotionSettings

P = "[[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
DATA = f"CONST robtarget p := {P};\nVAR robtarget q;\nVAR jointtarget j;\n"
HOME = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\n"


def numbers(row):
    return [float(v) for v in row[row.index("[") + 1 : row.rindex("]")].split(",")]


def test_an_impossible_configuration_stops_the_program(rapid):
    program = rapid(
        HOME + 'MoveJ f, v500, fine, tool0; TPWrite "no";',
        DATA + f"CONST robtarget f := {P.replace('[0,0,0,0]', '[2,0,0,0]')};\n",
    )
    assert program.run() == []
    assert any(event.code == 50080 for event in program.controller.log)


@pytest.mark.parametrize(("check", "message"), [("turn", ["60", "60"]), ("quarter", [])])
@pytest.mark.parametrize("move", ["MoveJ", "MoveL"])
def test_how_far_an_axis_may_be_from_its_quarter(rapid, check, message, move):
    """S4 overview 5-33: 45 degrees; public programs with cfx are further off, see the switch.

    Axis 4 is at 60 degrees where cf4 says -90 to 0; so is it where the program goes next.
    """
    program = rapid(
        "MoveAbsJ start, v1000, fine, tool0; q := CRobT(); q.robconf.cf4 := -1;"
        f'{move} q, v500, fine, tool0; j := CJointT(); TPWrite "" \\Num:=j.robax.rax_4;'
        f"q.trans.z := q.trans.z + 1; {move} q, v500, fine, tool0; j := CJointT();"
        'TPWrite "" \\Num:=Round(j.robax.rax_4);',
        DATA + "CONST jointtarget start := [[0,0,0,60,30,10],[9E9,9E9,9E9,9E9,9E9,9E9]];\n",
    )
    program.controller.motion.settings = MotionSettings(configuration_check=check)
    out = [str(round(float(v))) for v in program.run()]
    if move == "MoveL" and not message:
        assert out == ["60"]  # no way to go: nothing is checked
    else:
        assert out == message
    assert any(event.code == 50080 for event in program.controller.log) is not bool(message)


@pytest.mark.parametrize(
    ("settings", "argument", "expected"),
    [
        ("", "v100", 1.0),
        ("VelSet 50, 800;", "v200", 1.0),  # S4 datasys 2-VelSet: half of it
        ("VelSet 100, 50;", "v200", 2.0),  # the ceiling
        ("VelSet 50, 5000;", "v100\\T:=1", 2.0),  # 50 % doubles \T
        ("VelSet 100, 5;", "v100\\T:=1", 1.0),  # the ceiling does not concern \T
        ("", "v10\\V:=50", 2.0),
    ],
)
def test_speed_arguments_and_settings(rapid, settings, argument, expected):
    out = rapid(
        HOME + f"{settings} ClkStart c; MoveL Offs(p,0,100,0), {argument}, fine, tool0; ClkStop c;"
        'TPWrite "" \\Num:=ClkRead(c);',
        DATA + "VAR clock c;\n",
    ).run()
    ramp = 0.0 if "\\T" in argument else MotionSettings().ramp_time
    assert float(out[0]) == pytest.approx(expected + ramp, abs=0.05)


@pytest.mark.parametrize(
    ("settings", "ramp"),
    [("AccSet 100, 100;", 0.09), ("AccSet 100, 50;", 0.18), ("AccSet 100, 5;", 0.9)],
)
def test_acc_set_ramp_is_the_rate_at_which_acceleration_builds_up(rapid, settings, ramp):
    # S4 datasys 2-AccSet-1: percent of the normal rate; below 10 counts as 10
    cell = rapid(HOME + f"{settings} MoveL Offs(p,0,100,0), v100, fine, tool0;", DATA)
    cell.run()
    assert cell.group.motion.ramp == pytest.approx(ramp)


def test_trigg_io_sets_a_signal_at_its_place(rapid):
    # S4 datasys 2-TriggIO: distance before the end; a TRAP reads the place
    data = DATA + (
        "VAR intnum i;\nVAR triggdata near;\nVAR triggdata early;\n"
        'TRAP tell\nTPWrite "" \\Pos:=CPos(\\Tool:=tool0);\nENDTRAP\n'
    )
    out = rapid(
        HOME + "CONNECT i WITH tell; TriggInt near, 40, i; TriggInt early, 0.5\\Time, i;"
        "TriggL Offs(p,0,100,0), v50, near \\T2:=early, fine, tool0;",
        data,
    ).run()
    # 50 mm/s, 2 to 30 ms late; 0.5 s before the end are 25 mm, less half of the smoothing's 0.09 s
    assert numbers(out[0])[1] == pytest.approx(60, abs=2)
    assert numbers(out[1])[1] == pytest.approx(77.5, abs=2)


def test_a_procedure_in_the_middle_of_the_corner(rapid):
    data = DATA + 'PROC tell()\nTPWrite "" \\Pos:=CPos();\nENDPROC\n'
    out = rapid(
        HOME + 'ConfL\\Off; MoveLSync Offs(p,0,100,0), v100, z20, tool0, "tell";'
        "MoveL Offs(p,0,100,-100), v100, fine, tool0;",
        data,
    ).run()
    # the middle of the parabola is a quarter of 0.87 zones away on both sides
    assert numbers(out[0])[1:] == pytest.approx([95.6, 589.6], abs=0.5)


def test_search_finds_the_place_of_the_edge(rapid):
    # S4 datasys 2-SearchL: PersBool stands for a signal that another task sets
    data = DATA + "PERS bool hit := FALSE;\nVAR intnum i;\nTRAP touch\nhit := TRUE;\nENDTRAP\n"
    out = rapid(
        HOME + "CONNECT i WITH touch; ITimer \\Single, 0.5, i;"
        "SearchL \\PStop, hit, q, Offs(p,0,100,0), v100, tool0;"
        'TPWrite "" \\Pos:=q.trans; TPWrite "" \\Pos:=CPos();',
        data,
    ).run()
    result, stood = numbers(out[0])[1], numbers(out[1])[1]
    assert 43 < result < 54  # 50 mm, less half of the smoothing of 0.09 s
    assert result < stood < result + 7


def test_path_acc_lim_slows_the_ramps(rapid):
    times = []
    for limit in ("", "PathAccLim TRUE \\AccMax:=0.2, FALSE;"):
        out = rapid(
            HOME + f"{limit} ClkStart c; MoveL Offs(p,0,100,0), v100, fine, tool0; ClkStop c;"
            'TPWrite "" \\Num:=ClkRead(c);',
            DATA + "VAR clock c;\n",
        ).run()
        times.append(float(out[0]) - MotionSettings().ramp_time)
    assert times[1] - 1.0 == pytest.approx(0.1 / 0.2, abs=0.01)
    assert times[0] < 1.1


@pytest.mark.parametrize(("waits", "finished"), [(False, "running"), (True, "standing")])
def test_whether_stop_move_waits_is_a_switch(rapid, waits, finished):
    # S4 datasys 2-StopMove: it does not; newer manuals are not public
    data = DATA + (
        "VAR intnum i;\nVAR num before;\nTRAP halt\nStopMove;\nj := CJointT();\n"
        "before := j.robax.rax_1;\nWaitTime 0.5;\nj := CJointT();\n"
        'IF j.robax.rax_1 = before THEN\nTPWrite "standing";\nELSE\nTPWrite "running";\nENDIF\n'
        "StartMove;\nENDTRAP\n"
    )
    program = rapid(
        "CONNECT i WITH halt; ITimer \\Single, 0.4, i;"
        "MoveAbsJ [[90,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs, v1000, fine, tool0;",
        data,
    )
    program.controller.motion.settings = MotionSettings(stop_waits=waits)
    assert program.run() == [finished]


_TIMED_MOVES = (
    "ClkReset c; ClkStart c; MoveL Offs(p,0,100,0), v100\\T:=1, fine, tool0; ClkStop c;"
    'TPWrite "" \\Num:=ClkRead(c);'
    "ClkReset c; ClkStart c; MoveL p, v100\\T:=1, fine, tool0; ClkStop c;"
    'TPWrite "" \\Num:=ClkRead(c);'
)


@pytest.mark.parametrize(
    ("message", "switches", "expected"),
    [
        ("moving", {}, (1.9, 1.0)),
        ("moving", {"refresh_timed": False}, (1.0, 1.0)),
        ("moving", {"refresh_lasts": True}, (1.9, 2.0)),
        ("moving", {"refresh_timed": False, "refresh_lasts": True}, (1.0, 1.0)),
        ("standing", {}, (1.0, 1.0)),
        ("standing", {"refresh_lasts": True}, (1.0, 1.0)),
        ("standing", {"refresh_standing": True}, (2.0, 1.0)),
        ("standing", {"refresh_standing": True, "refresh_lasts": True}, (2.0, 2.0)),
    ],
)
def test_what_speed_refresh_acts_on_is_for_switches_to_tell(rapid, message, switches, expected):
    # No source says so.
    refresh = "SpeedRefresh 50;"
    if message == "moving":
        refresh = "CONNECT i WITH slower; ITimer \\Single, 0.1, i;"
    program = rapid(
        HOME + refresh + _TIMED_MOVES,
        DATA + "VAR clock c;\nVAR intnum i;\nTRAP slower\nSpeedRefresh 50;\nENDTRAP\n",
    )
    program.controller.motion.settings = replace(MotionSettings(), **switches)
    # The smoothing takes 0.09 s of real time at any override.
    assert [float(line) for line in program.run()] == pytest.approx(expected, abs=0.15)


@pytest.mark.parametrize(("timed", "expected"), [(True, 2.0), (False, 1.0)])
def test_whether_velset_stretches_a_given_time_is_a_switch(rapid, timed, expected):
    # S4 datasys 2-VelSet-1 says so; of later systems no source.
    program = rapid(HOME + "VelSet 50, 5000;" + _TIMED_MOVES, DATA + "VAR clock c;\n")
    program.controller.motion.settings = MotionSettings(velset_timed=timed)
    assert [float(line) for line in program.run()] == pytest.approx([expected] * 2, abs=0.1)


def test_speed_refresh_ends_in_the_corner_behind_its_move(rapid):
    program = rapid(
        HOME + "CONNECT i WITH slower; ITimer \\Single, 0.1, i; ClkStart c;"
        "MoveL Offs(p,0,100,0), v100\\T:=1, z1, tool0;"
        "MoveL Offs(p,0,200,0), v100\\T:=1, fine, tool0;"
        'ClkStop c; TPWrite "" \\Num:=ClkRead(c);',
        DATA + "VAR clock c;\nVAR intnum i;\nTRAP slower\nSpeedRefresh 50;\nENDTRAP\n",
    )
    assert float(program.run()[0]) == pytest.approx(2.9, abs=0.1)


def test_a_motion_task_may_have_any_name(tmp_path):
    file = tmp_path / "Probe.mod"
    body = HOME + 'j := CJointT(); TPWrite "" \\Num:=j.robax.rax_5;'
    file.write_text(f"MODULE Probe\n{DATA}PROC main()\n{body}\nENDPROC\nENDMODULE\n")
    groups = load_config("irb120").groups
    controller = VirtualController.from_files({"T_OTHER": [file]}, robots=groups, cycle="once")
    controller.run_for(5.0)
    assert list(controller.operator.rows) == ["30"]

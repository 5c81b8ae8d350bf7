"""RAPID motion programs on a whole controller."""

import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.motion import MotionSettings

P = "[[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
DATA = f"CONST robtarget p := {P};\nVAR robtarget q;\nVAR jointtarget j;\n"
HOME = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\n"


def numbers(row):
    return [float(v) for v in row[row.index("[") + 1 : row.rindex("]")].split(",")]


def test_reading_back_what_was_commanded(rapid):
    out = rapid(
        HOME + 'q := CRobT(); TPWrite "" \\Pos:=q.trans; TPWrite "" \\Orient:=q.rot;'
        'j := CJointT(); TPWrite "" \\Num:=j.robax.rax_5; TPWrite "" \\Num:=j.extax.eax_a;',
        DATA,
    ).run()
    assert out == ["[364.354,0,594]", "[0.5,0,0.866025,0]", "30", "9E+09"]


def test_moves_end_where_they_are_told(rapid):
    out = rapid(
        HOME
        + "MoveL Offs(p,10,20,30), v200, z10, tool0; MoveC Offs(p,10,30,40), Offs(p,10,40,30), "
        'v200, fine, tool0; TPWrite "" \\Pos:=CPos(); MoveJ p, v200, fine, tool0;'
        'TPWrite "" \\Pos:=CPos();',
        DATA,
    ).run()
    assert numbers(out[0]) == pytest.approx([374.354, 40, 624], abs=1e-3)
    assert numbers(out[1]) == pytest.approx([364.354, 0, 594], abs=1e-3)


def test_tool_and_work_object(rapid):
    data = DATA + (
        "PERS tooldata t := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
        'PERS wobjdata w := [FALSE,TRUE,"",[[100,0,0],[1,0,0,0]],[[0,50,0],[1,0,0,0]]];\n'
    )
    out = rapid(
        HOME + 'q := CRobT(\\Tool:=t \\WObj:=w); TPWrite "" \\Pos:=q.trans;'
        'MoveL Offs(q,0,-20,0), v200, fine, t \\WObj:=w; TPWrite "" \\Pos:=CPos();'
        'TPWrite "" \\Pos:=CPos(\\Tool:=tool0 \\WObj:=wobj0);',
        data,
    ).run()
    assert numbers(out[0]) == pytest.approx([364.354 + 86.6025 - 100, -50, 544], abs=2e-3)
    assert numbers(out[1]) == pytest.approx([350.956, -70, 544], abs=2e-3)
    assert numbers(out[2]) == pytest.approx([364.354, -20, 594], abs=2e-3)


def test_calc_joint_t_and_calc_rob_t_are_inverse(rapid):
    out = rapid(
        'j := CalcJointT(p, tool0); q := CalcRobT(j, tool0); TPWrite "" \\Pos:=q.trans;'
        'TPWrite "" \\Num:=j.robax.rax_5;',
        DATA,
    ).run()
    assert numbers(out[0]) == pytest.approx([364.354, 0, 594], abs=2e-3)
    assert float(out[1]) == pytest.approx(30, abs=1e-3)


def test_out_of_reach_is_recoverable(rapid):
    # 3HAC050917: ERR_ROBLIMIT, ERR_OUTSIDE_REACH of CalcJointT and the moves
    out = rapid(
        HOME + "MoveJ Offs(p,3000,0,0), v200, fine, tool0; j := CalcJointT(Offs(p,3000,0,0), tool0"
        '\\ErrorNumber:=n); IF n = ERR_OUTSIDE_REACH TPWrite "number";\n'
        'ERROR IF ERRNO = ERR_OUTSIDE_REACH TPWrite "handled"; TRYNEXT;',
        DATA + "VAR errnum n;\n",
    ).run()
    assert out == ["handled", "number"]


def test_configuration_is_followed_with_conf_j_on_and_ignored_off(rapid):
    """Axes 4, 5, 6 = 30, 30, 0 or -150, -30, 180: one pose, two configurations."""
    out = rapid(
        "MoveAbsJ start, v1000, fine, tool0; q := CRobT(); q.robconf := [0,-2,2,1];"
        'MoveJ q, v500, fine, tool0; j := CJointT(); TPWrite "" \\Num:=j.robax.rax_4;'
        "ConfJ\\Off; q.robconf := [0,0,0,0]; MoveJ q, v500, fine, tool0; j := CJointT();"
        'TPWrite "" \\Num:=j.robax.rax_4; ConfJ\\On; MoveJ q, v500, fine, tool0; j := CJointT();'
        'TPWrite "" \\Num:=j.robax.rax_4;',
        DATA + "CONST jointtarget start := [[0,0,0,30,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n",
    ).run()
    assert [round(float(v)) for v in out] == [-150, -150, 30]


def test_an_impossible_configuration_stops_the_program(rapid):
    program = rapid(
        HOME + 'MoveJ f, v500, fine, tool0; TPWrite "no";',
        DATA + f"CONST robtarget f := {P.replace('[0,0,0,0]', '[2,0,0,0]')};\n",
    )
    assert program.run() == []
    assert any(event.code == 50080 for event in program.controller.log)


@pytest.mark.parametrize(("check", "said"), [("turn", ["60", "60"]), ("quarter", [])])
@pytest.mark.parametrize("move", ["MoveJ", "MoveL"])
def test_how_far_an_axis_may_be_from_its_quarter(rapid, check, said, move):
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
    if move == "MoveL" and not said:
        assert out == ["60"]  # no way to go: nothing is checked
    else:
        assert out == said
    assert any(event.code == 50080 for event in program.controller.log) is not bool(said)


def test_displacement_moves_targets_but_not_move_abs_j(rapid):
    out = rapid(
        HOME
        + 'PDispSet [[0,50,0],[1,0,0,0]]; MoveL p, v200, fine, tool0; TPWrite "" \\Pos:=CPos();'
        'q := ORobT(p); TPWrite "" \\Num:=q.trans.y;' + HOME + "PDispOff;"
        'TPWrite "" \\Pos:=CPos();',
        DATA,
    ).run()
    assert numbers(out[0]) == pytest.approx([364.354, 0, 594], abs=2e-3)  # in the displaced frame
    assert float(out[1]) == pytest.approx(50)
    assert numbers(out[2]) == pytest.approx([364.354, 0, 594], abs=2e-3)


def test_p_disp_on_adds_the_way_between_two_points(rapid):
    # S4 datasys 2-PDispOn: an active displacement is added to
    out = rapid(
        HOME + "PDispOn \\ExeP:=Offs(p,0,30,0), p, tool0; PDispOn \\ExeP:=Offs(p,0,0,20), p, tool0;"
        'MoveL p, v200, fine, tool0; PDispOff; TPWrite "" \\Pos:=CPos();',
        DATA,
    ).run()
    assert numbers(out[0]) == pytest.approx([364.354, 30, 614], abs=2e-3)


@pytest.mark.parametrize(
    ("settings", "argument", "expected"),
    [
        ("", "v100", 1.0),
        ("VelSet 50, 800;", "v200", 1.0),  # S4 datasys 2-VelSet: half of it
        ("VelSet 100, 50;", "v200", 2.0),  # the ceiling
        ("VelSet 50, 5000;", "v100\\T:=1", 2.0),  # 50 % doubles \T
        ("VelSet 100, 5;", "v100\\T:=1", 1.0),  # the ceiling does not concern \T
        ("", "v10\\V:=50", 2.0),
        ("SpeedRefresh 50;", "v200", 1.0),
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
    [("AccSet 100, 100;", 0.05), ("AccSet 100, 50;", 0.1), ("AccSet 100, 5;", 0.5)],
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
    # 50 mm/s, 2 to 30 ms late; 0.5 s before the end are 25 mm
    assert numbers(out[0])[1] == pytest.approx(60, abs=2)
    assert numbers(out[1])[1] == pytest.approx(75, abs=2)


def test_a_procedure_in_the_middle_of_the_corner(rapid):
    data = DATA + 'PROC tell()\nTPWrite "" \\Pos:=CPos();\nENDPROC\n'
    out = rapid(
        HOME + 'ConfL\\Off; MoveLSync Offs(p,0,100,0), v100, z20, tool0, "tell";'
        "MoveL Offs(p,0,100,-100), v100, fine, tool0;",
        data,
    ).run()
    # the middle of the parabola is a quarter of the zone away on both sides
    assert numbers(out[0])[1:] == pytest.approx([95, 589], abs=0.5)


def test_search_finds_the_place_of_the_edge(rapid):
    # S4 datasys 2-SearchL: PersBool stands for a signal that another task sets
    data = DATA + "PERS bool hit := FALSE;\nVAR intnum i;\nTRAP touch\nhit := TRUE;\nENDTRAP\n"
    out = rapid(
        HOME + "CONNECT i WITH touch; ITimer \\Single, 0.5, i;"
        "SearchL \\PStop, hit, q, Offs(p,0,100,0), v100, tool0;"
        'TPWrite "" \\Pos:=q.trans; TPWrite "" \\Pos:=CPos();',
        data,
    ).run()
    found, stood = numbers(out[0])[1], numbers(out[1])[1]
    assert 47 < found < 54
    assert found < stood < found + 5


def test_a_search_without_hit_keeps_the_point_and_fails(rapid):
    data = DATA + "PERS bool hit := FALSE;\n"
    out = rapid(
        HOME + "q := p; SearchL \\PStop, hit, q, Offs(p,0,50,0), v200, tool0;"
        'TPWrite "" \\Num:=q.trans.y; TPWrite "" \\Pos:=CPos();\n'
        'ERROR IF ERRNO = ERR_WHLSEARCH TPWrite "none"; TRYNEXT;',
        data,
    ).run()
    assert out[:2] == ["none", "0"]
    assert numbers(out[2])[1] == pytest.approx(50, abs=1e-3)


def test_a_signal_that_is_high_at_the_start_is_an_error(rapid):
    data = DATA + "PERS bool hit := TRUE;\n"
    out = rapid(
        HOME + 'SearchL \\Stop, hit, q, Offs(p,0,50,0), v200, tool0; TPWrite "" \\Pos:=CPos();\n'
        'ERROR IF ERRNO = ERR_SIGSUPSEARCH TPWrite "high"; TRYNEXT;',
        data,
    ).run()
    assert out[0] == "high"
    assert numbers(out[1])[1] == pytest.approx(0, abs=1e-3)


def test_a_trap_leaves_the_path_and_comes_back(rapid):
    # S4 datasys StorePath: StopMove, StorePath, moves, RestoPath, StartMove
    data = DATA + (
        "VAR intnum i;\nTRAP aside\nVAR robtarget here;\nStopMove;\nStorePath;\n"
        "here := CRobT(\\Tool:=tool0);\nMoveL Offs(here,0,0,30), v200, fine, tool0;\n"
        'TPWrite "level " \\Num:=PathLevel();\nMoveL here, v200, fine, tool0;\nRestoPath;\n'
        "StartMove;\nENDTRAP\n"
    )
    out = rapid(
        HOME + "CONNECT i WITH aside; ITimer \\Single, 0.5, i;"
        "MoveL Offs(p,0,100,0), v100, fine, tool0;"
        'TPWrite "" \\Pos:=CPos(); TPWrite "level " \\Num:=PathLevel();',
        data,
    ).run()
    assert out[0] == "level 2"
    assert numbers(out[1])[1:] == pytest.approx([100, 594], abs=2e-3)
    assert out[2] == "level 1"


def test_stop_reasons_of_the_two_kinds_of_tasks(rapid):
    out = rapid(
        'StopMove; IF IsStopMoveAct(\\FromMoveTask) TPWrite "own";'
        'IF IsStopMoveAct(\\FromNonMoveTask) TPWrite "other"; StartMove;'
        'IF NOT IsStopMoveAct(\\FromMoveTask) TPWrite "free";'
    ).run()
    assert out == ["own", "free"]


def test_external_axes_of_a_track(rapid):
    out = rapid(
        "j := CJointT(); j.extax.eax_a := 300; MoveAbsJ j, v1000, fine, tool0;"
        "j.extax.eax_a := 400; MoveExtJ j, vlin100, fine; j := CJointT();"
        'TPWrite "" \\Num:=j.extax.eax_a; TPWrite "" \\Num:=j.robax.rax_1;'
        "EOffsSet [50,0,9E9,9E9,9E9,9E9]; j.extax.eax_a := 400; MoveAbsJ j, v1000, fine, tool0;"
        'EOffsOff; j := CJointT(); TPWrite "" \\Num:=j.extax.eax_a;',
        "VAR jointtarget j;\n",
        robot="irb120_track",
    ).run()
    assert [float(v) for v in out] == pytest.approx([400, 0, 450], abs=1e-3)


def test_wait_rob_waits_for_standstill(rapid):
    out = rapid(
        HOME + "MoveL Offs(p,0,50,0), v100, z10, tool0; WaitRob \\ZeroSpeed;"
        'TPWrite "" \\Pos:=CPos(); ',
        DATA,
    ).run()
    assert numbers(out[0])[1] == pytest.approx(50, abs=1e-3)


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


def test_a_circle_may_keep_its_orientation_in_the_object(rapid):
    # 3HAC050917 CirPathMode
    out = rapid(
        HOME
        + "CirPathMode \\ObjectFrame; MoveC Offs(p,0,25,25), Offs(p,0,50,0), v100, fine, tool0;"
        'q := CRobT(); TPWrite "" \\Orient:=q.rot;',
        DATA,
    ).run()
    assert numbers(out[0]) == pytest.approx([0.5, 0, 0.866025, 0], abs=1e-5)


def test_mechanical_units_and_a_deactivated_axis(rapid):
    out = rapid(
        "WHILE GetNextMechUnit(n, name \\TCPRob:=robot \\NoOfAxes:=count) DO "
        'TPWrite name + " " + ValToStr(robot) + " " + ValToStr(count); ENDWHILE '
        "j := CJointT(); j.extax.eax_a := 100; DeactUnit TRACK_1; "
        'IF NOT IsMechUnitActive(TRACK_1) TPWrite "off"; '
        'MoveAbsJ j, v1000, fine, tool0; j := CJointT(); TPWrite "" \\Num:=j.extax.eax_a;'
        "ActUnit TRACK_1; j.extax.eax_a := 100; MoveAbsJ j, v1000, fine, tool0; j := CJointT();"
        'TPWrite "" \\Num:=j.extax.eax_a;',
        "VAR jointtarget j;\nVAR num n;\nVAR string name;\nVAR bool robot;\nVAR num count;\n",
        robot="irb120_track",
    ).run()
    assert out[-3:] == ["off", "0", "100"]
    assert out[0] == "ROB_1 TRUE 6"


@pytest.mark.parametrize(("waits", "ended"), [(False, "running"), (True, "standing")])
def test_whether_stop_move_waits_is_a_switch(rapid, waits, ended):
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
    assert program.run() == [ended]


@pytest.mark.parametrize(("timed", "expected"), [(True, 2.0), (False, 1.0)])
def test_whether_speed_refresh_stretches_a_given_time_is_a_switch(rapid, timed, expected):
    # No source says so.
    program = rapid(
        HOME + "SpeedRefresh 50; ClkStart c; MoveL Offs(p,0,100,0), v100\\T:=1, fine, tool0;"
        'ClkStop c; TPWrite "" \\Num:=ClkRead(c);',
        DATA + "VAR clock c;\n",
    )
    program.controller.motion.settings = MotionSettings(refresh_timed=timed)
    assert float(program.run()[0]) == pytest.approx(expected, abs=0.15)


def test_a_motion_task_may_have_any_name(tmp_path):
    file = tmp_path / "Probe.mod"
    body = HOME + 'j := CJointT(); TPWrite "" \\Num:=j.robax.rax_5;'
    file.write_text(f"MODULE Probe\n{DATA}PROC main()\n{body}\nENDPROC\nENDMODULE\n")
    groups = load_config("irb120").groups
    controller = VirtualController.from_files({"T_OTHER": [file]}, robots=groups, cycle="once")
    controller.run_for(5.0)
    assert list(controller.operator.rows) == ["30"]

"""WorldAccLim, SpeedLim, CirPathMode, SingArea, soft servo: on whole controllers."""

from itertools import pairwise

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.machine.scheduler import S

P = "[[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
DATA = f"CONST robtarget p := {P};\nVAR robtarget q;\nVAR clock c;\n"
HOME = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\n"


def sampled(program, seconds=30.0, period=0.004):
    """Postures every 4 ms, and what the program wrote."""
    result = []
    scheduler = program.controller.scheduler

    def look():
        result.append(program.group.positions())
        scheduler.after(round(period * S), look)

    scheduler.after(0, look)
    return result, program.run(seconds)


def poses(program, path):
    return [program.group.kinematics.forward(posture) for posture in path]


def of_tcp(program, path, period=0.004):
    """Largest speed (m/s) and acceleration (m/s^2) of the flange."""
    places = np.array([pose[0] for pose in poses(program, path)])
    speeds = np.diff(places, axis=0) / period
    bends = np.diff(speeds, axis=0) / period
    return np.linalg.norm(speeds, axis=1).max(), np.linalg.norm(bends, axis=1).max()


MOVES = (
    "MoveL Offs(p,0,80,0), v1000, z20, tool0; MoveL Offs(p,0,80,60), v1000, z20, tool0;"
    "MoveC Offs(p,0,50,90), Offs(p,0,20,60), v1000, z5, tool0; MoveJ p, v1000, fine, tool0;"
)


def test_world_acc_lim_holds_on_lines_corners_circles_and_joint_moves(rapid):
    # 3HAC050917 WorldAccLim: acceleration of the tool in the world
    free, held = (
        rapid(HOME + f"{limit} WaitTime 1; {MOVES} WorldAccLim \\Off;", DATA)
        for limit in ("WorldAccLim \\Off;", "WorldAccLim \\On:=0.5;")
    )
    start = round(1.0 / 0.004)
    _, before = of_tcp(free, sampled(free)[0][start:])
    path, _ = sampled(held)
    _, after = of_tcp(held, path[start:])
    assert before > 2
    assert 0.3 < after <= 0.5 * 1.05
    assert held.controller.task("T_ROB1").state == "finished"


def test_world_acc_lim_needs_a_value(rapid):
    out = rapid(
        'WorldAccLim \\On:=0.05; ERROR IF ERRNO = ERR_ARGVALERR TPWrite "small"; TRYNEXT;', DATA
    ).run()
    assert out == ["small"]


def test_speed_limits_hold_while_the_input_is_set(rapid):
    body = (
        HOME + "SpeedLimCheckPoint 100; SpeedLimAxis ROB_1, 1, 5;"
        "MoveL Offs(p,0,80,0), v500, fine, tool0; MoveL p, v500, fine, tool0;"
        "MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;"
    )
    free = rapid(body, DATA)
    assert of_tcp(free, sampled(free)[0])[0] > 0.4
    held = rapid(body, DATA)
    held.group.speed_limited = True
    path, _ = sampled(held)
    first = next(k for k, posture in enumerate(path) if posture[4] > np.radians(30) - 1e-9)
    assert of_tcp(held, path[first:])[0] <= 0.1 * (1 + 1e-6)
    turns = np.abs(np.diff(np.array(path)[:, 0])) / 0.004
    assert turns.max() == pytest.approx(np.radians(5), rel=1e-3)


@pytest.mark.parametrize(
    ("call", "error"),
    [
        ("SpeedLimAxis ROB_1, 1, -1;", "ERR_SPEEDLIM_VALUE"),
        ("SpeedLimAxis ROB_1, 7, 10;", "ERR_AXIS_PAR"),
        ("SpeedLimCheckPoint -1;", "ERR_SPEEDLIM_VALUE"),
        ("SoftAct 7, 50;", "ERR_AXIS_PAR"),
        ("SoftAct 1, 101;", "ERR_ARGVALERR"),
        ("SoftDeact \\Ramp:=50;", "ERR_ARGVALERR"),
    ],
)
def test_values_that_no_controller_takes(rapid, call, error):
    out = rapid(f'{call} ERROR IF ERRNO = {error} TPWrite "refused"; TRYNEXT;').run()
    assert out == ["refused"]


def test_a_speed_limit_of_0_is_none(rapid):
    """tetov/compas_rcf [code] gives axes 2 and 3 of its robot a limit of 0."""
    in_use = rapid("SpeedLimAxis ROB_1, 1, 5; SpeedLimAxis ROB_1, 2, 0; SpeedLimAxis ROB_1, 1, 0;")
    in_use.run()
    assert in_use.group.modal.axis_limits == {}


def test_a_soft_servo_goes_the_same_way(rapid):
    out = rapid(
        HOME + "SoftAct 1, 90 \\Ramp:=150; SoftAct 6, 20; MoveL Offs(p,0,50,0), v200, fine, tool0;"
        'SoftDeact \\Ramp:=200; TPWrite "" \\Pos:=CPos();',
        DATA,
    ).run()
    assert "50,594" in out[0].replace("49.99", "50")


def test_the_orientation_of_the_circle_point_is_reached_on_request(rapid):
    # 3HAC050917 CirPathMode \CirPointOri
    seen = {}
    for mode in ("\\PathFrame", "\\CirPointOri"):
        program = rapid(
            HOME + f"ConfL \\Off; CirPathMode {mode};"
            "MoveC RelTool(Offs(p,0,25,25),0,0,0 \\Ry:=15), Offs(p,0,50,0), v100, fine, tool0;"
            'q := CRobT(); TPWrite "" \\Orient:=q.rot;',
            DATA,
        )
        path, out = sampled(program)
        assert len(out) == 1
        result = poses(program, path)
        via = frames.multiply(
            (0.5, 0.0, 0.866025, 0.0), frames.about((0.0, 1.0, 0.0), np.radians(15))
        )
        top = min(result, key=lambda pose: frames.distance(pose[0], (0.364354, 0.025, 0.619)))
        seen[mode] = np.degrees(frames.angle_between(top[1], frames.normalise(via)))
        turns = [frames.angle_between(a[1], b[1]) for a, b in pairwise(result)]
        assert max(turns) < np.radians(3)
    assert seen["\\CirPointOri"] < 1.0
    assert seen["\\PathFrame"] > 5.0


def test_lock_axis_4_passes_the_singularity_with_axis_4_at_rest(rapid):
    # S4 has no \LockAxis4; 3HAC050917: axis 4 at 0 or +-180 degrees
    start = "MoveAbsJ [[10,0,0,2,20,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\n"
    goal = "q := CalcRobT([[10,10,5,0,-25,0],[9E9,9E9,9E9,9E9,9E9,9E9]], tool0);\n"
    program = rapid(
        start + goal + "ConfL \\Off; SingArea \\LockAxis4; MoveL q, v100, fine, tool0;"
        'SingArea \\Off; TPWrite "" \\Pos:=q.trans; TPWrite "" \\Pos:=CPos();',
        DATA,
    )
    path, out = sampled(program)
    wanted, reached = ([float(v) for v in row.strip("[]").split(",")] for row in out)
    assert reached == pytest.approx(wanted, abs=2e-3)
    last = np.degrees(path[-1])
    assert last[3] == pytest.approx(0.0, abs=1e-6)
    assert last[4] == pytest.approx(-25, abs=0.5)
    assert np.degrees(np.abs(np.array(path)[:, 3])).max() <= 2 + 1e-6


def test_circles_by_wrist_axes_are_refused(rapid):
    program = rapid("CirPathMode \\Wrist45;", DATA)
    program.run()
    assert any("wrist axes" in str(event) for event in program.controller.log)


def test_limit_speed_is_a_system_input(rapid):
    program = rapid("WaitTime 1;", DATA)
    controller, group = program.controller, program.group
    controller.io.on_action("LimitSpeed", "")
    assert group.speed_limited
    controller.io.on_end("LimitSpeed")
    assert not group.speed_limited

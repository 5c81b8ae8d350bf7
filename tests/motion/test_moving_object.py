"""Work objects on a mechanical unit that moves (S4 datasys 1-wobjdata: ufprog, ufmec)."""

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.machine.scheduler import S
from tests.motion.cell import PLANNED

OBJECT = (
    'PERS wobjdata w := [FALSE,FALSE,"STN_1",[[9,9,9],[1,0,0,0]],[[0,-450,100],[1,0,0,0]]];\n'
    "PERS tooldata t := [TRUE,[[0,0,50],[1,0,0,0]],[1,[0,0,10],[1,0,0,0],0,0,0]];\n"
)
START = (
    "ConfJ \\Off; ConfL \\Off;\n"
    "MoveAbsJ [[90,0,0,0,45,0],[1500,0,9E9,9E9,9E9,9E9]], v1000, fine, t;\n"
)


def target(x, y, z, track, turn):
    return f"[[{x},{y},{z}],[0,0,1,0],[0,0,0,0],[{track},{turn},9E9,9E9,9E9,9E9]]"


def in_object(group, posture):
    """The TCP in the object, from the chains written out by hand."""
    turn = posture[7]
    unit = (1.5, 0.8, 0.4), frames.about((0.0, 0.0, 1.0), turn)
    placed = frames.compose(unit, ((0.0, -0.45, 0.1), frames.UNIT))
    tcp = frames.compose(group.kinematics.forward(posture), ((0.0, 0.0, 0.05), frames.UNIT))
    return frames.compose(frames.invert(placed), tcp)


def samples(program, seconds, period=0.004):
    program.controller.motion.settings = PLANNED
    result = []
    scheduler = program.controller.scheduler

    def look():
        result.append(program.group.positions())
        scheduler.after(round(period * S), look)

    scheduler.after(0, look)
    out = program.run(seconds)
    return np.array(result), out


def test_a_line_on_an_object_that_turns_and_a_robot_that_travels(rapid):
    a, b = target(0, 0, 0, 1500, 0), target(40, 30, 0, 1560, 25)
    program = rapid(
        START + f"MoveJ {a}, v500, fine, t \\WObj:=w;\n"
        f"MoveL {b}, v50, fine, t \\WObj:=w;\n"
        'TPWrite "" \\Pos:=CPos(\\Tool:=t \\WObj:=w);',
        OBJECT,
        robot="irb120_track",
    )
    path, out = samples(program, 20)
    numbers = [float(v) for v in out[0].strip("[]").split(",")]
    assert numbers == pytest.approx([40, 30, 0], abs=2e-3)
    turning = [p for p in path if 1e-6 < p[7] < np.radians(25) - 1e-6]
    assert len(turning) > 100
    places = np.array([in_object(program.group, tuple(p))[0] for p in turning])
    # On the line in the object, although object and base move.
    assert np.abs(places[:, 0] * 0.75 - places[:, 1]).max() < 1e-6
    assert np.abs(places[:, 2]).max() < 1e-6
    # Programmed speed is that of the TCP in the object (S4 datasys 1-speeddata).
    speeds = np.linalg.norm(np.diff(places, axis=0), axis=1) / 0.004
    assert np.median(speeds) == pytest.approx(0.05, rel=1e-3)


def test_the_object_stands_where_the_unit_holds_it(rapid):
    out = rapid(
        START + f"MoveJ {target(0, 0, 0, 1500, 20)}, v500, fine, t \\WObj:=w;\n"
        'TPWrite "" \\Pos:=CPos(\\Tool:=t \\WObj:=wobj0);\n',
        OBJECT,
        robot="irb120_track",
    ).run()
    x, y, z = (float(v) for v in out[0].strip("[]").split(","))
    turn = np.radians(20)
    assert (x, y) == pytest.approx((1500 + 450 * np.sin(turn), 800 - 450 * np.cos(turn)), abs=5e-3)
    assert z == pytest.approx(500, abs=5e-3)


def test_corners_on_a_moving_object_keep_to_it(rapid):
    a, b, c = target(0, 0, 0, 1500, 0), target(40, 0, 0, 1500, 10), target(40, 40, 0, 1500, 20)
    program = rapid(
        START + f"MoveJ {a}, v500, fine, t \\WObj:=w;\nMoveL {b}, v50, z10, t \\WObj:=w;\n"
        f"MoveL {c}, v50, fine, t \\WObj:=w;\n",
        OBJECT,
        robot="irb120_track",
    )
    path, _ = samples(program, 20)
    places = np.array([in_object(program.group, tuple(p))[0] for p in path if p[7] > 1e-6])
    corner = np.linalg.norm(places - [0.04, 0, 0], axis=1).min()
    assert 0.002 < corner < 0.01
    outside = places[np.linalg.norm(places - [0.04, 0, 0], axis=1) > 0.0101]
    assert np.minimum(np.abs(outside[:, 1]), np.abs(outside[:, 0] - 0.04)).max() < 1e-6


def test_calc_joint_t_on_the_object_as_wanted_and_as_it_is(rapid):
    # 3HAC050917 CalcJointT: \UseCurWObjPos takes the object's present position
    out = rapid(
        START + f"a := CalcJointT({target(0, 0, 0, 1500, 20)}, t \\WObj:=w);\n"
        f"b := CalcJointT(\\UseCurWObjPos, {target(0, 0, 0, 1500, 20)}, t \\WObj:=w);\n"
        f"c := CalcJointT({target(0, 0, 0, 1500, 0)}, t \\WObj:=w);\n"
        'TPWrite "" \\Num:=a.robax.rax_1-c.robax.rax_1;'
        'TPWrite "" \\Num:=b.robax.rax_1-c.robax.rax_1;',
        OBJECT + "VAR jointtarget a; VAR jointtarget b; VAR jointtarget c;\n",
        robot="irb120_track",
    ).run()
    assert abs(float(out[0])) > 1
    assert abs(float(out[1])) < 1e-3


@pytest.mark.parametrize(
    ("unit", "held", "reason"),
    [("TRACK_1", "FALSE", "positioners"), ("STN_1", "TRUE", "held by the robot and by")],
)
def test_what_holds_no_object_is_refused(rapid, unit, held, reason):
    data = OBJECT.replace("STN_1", unit).replace("[FALSE,FALSE", f"[{held},FALSE")
    tool = "t" if held == "FALSE" else "s"
    data += "PERS tooldata s := [FALSE,[[0,0,50],[1,0,0,0]],[1,[0,0,10],[1,0,0,0],0,0,0]];\n"
    program = rapid(
        START + f"MoveL {target(0, 0, 0, 1500, 0)}, v50, fine, {tool} \\WObj:=w;\n",
        data,
        robot="irb120_track",
    )
    program.run()
    assert any(reason in str(event) for event in program.controller.log)

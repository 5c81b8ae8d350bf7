"""World zones: rejected definitions, and reports of crossed shapes."""

from math import dist, hypot

import numpy as np
import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.runtime.motion_interface import NOT_ALLOWED
from rapidgen.system.model import EventRoutine, ModuleFile, SignalSpec, System, TaskSpec

POINTS = """
CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
VAR shapedata s;
VAR wztemporary z;
VAR wzstationary w;
VAR num n;
"""


@pytest.fixture(scope="module")
def irb120():
    return load_config("irb120")


def controller(irb120, body, hook=""):
    text = f"MODULE m\n{POINTS}\n{hook}\nPROC main()\n{body}\nENDPROC\nENDMODULE"
    task = TaskSpec("T_ROB1", motion=True, modules=(ModuleFile("m", "m.mod", text.encode()),))
    events = (EventRoutine("power", "POWER_ON", "T_ROB1"),) if hook else ()
    signals = (SignalSpec("do1", "DO"),)
    system = System("s", (task,), signals=signals, events=events)
    return VirtualController(system, irb120.groups, cycle="once")


BOX = r"WZBoxDef \Inside, s, [0,0,0], [100,100,100];"


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("WZBoxDef s, [0,0,0], [100,100,100];", r"\Inside or \Outside"),
        (r"WZBoxDef \Inside, s, [0,0,0], [100,100,9];", "shorter than 10 mm"),
        (r"WZCylDef \Inside, s, [0,0,0], 4, 100;", "too small"),
        (r"WZCylDef \Inside, s, [0,0,0], 40, 9;", "too small"),
        (r"WZSphDef \Inside, s, [0,0,0], 4;", "too small"),
        (r"WZHomeJointDef \Inside, s, start, start;", "larger than 0"),
        (r"WZLimJointDef \Inside, s, start, start;", "below that of HighJointVal"),
        (r"WZLimSup \Temp, z, s;", "not defined"),
        (BOX + "WZLimSup z, s;", r"\Temp or \Stat"),
        (BOX + r"WZLimSup \Temp, n, s;", "in a wztemporary or wzstationary: num"),
        (BOX + r"WZLimSup \Stat, w, s;", "POWER ON"),
        (BOX + r"WZDOSet \Temp, z, s, do1, 1;", r"\Inside or \Before"),
        (BOX + r"WZLimSup \Temp, z, s; WZLimSup \Temp, z, s;", "WZFree before"),
        (BOX + r"FOR i FROM 1 TO 21 DO WZLimSup \Temp, z, s; z.wz := 0; ENDFOR", "20 zones"),
        ("WZEnable z;", "not defined"),
        ("WZDisable z;", "not defined"),
    ],
)
def test_invalid_zones_are_rejected(irb120, body, reason):
    with controller(irb120, body) as cell:
        cell.run()
        fault = cell.tasks["T_ROB1"].fault
        assert fault.event == NOT_ALLOWED
        assert reason in fault.arguments[0]


def test_freeing_without_zone_has_no_effect(irb120):
    with controller(irb120, "WZFree z; WZFree z;") as cell:
        assert cell.run() == "finished"


SHAPES = {
    r"WZBoxDef \Inside, s, [0,40,0], [900,90,580];": lambda x, y, z, _: (
        0 < x < 900 and 40 < y < 90 and 0 < z < 580
    ),
    r"WZCylDef \Inside, s, [364,70,530], 30, 20;": lambda x, y, z, _: (
        hypot(x - 364, y - 70) < 30 and 530 < z < 550
    ),
    r"WZCylDef \Outside, s, [364,70,570], 30, -40;": lambda x, y, z, _: (
        not (hypot(x - 364, y - 70) < 30 and 530 < z < 570)
    ),
    r"WZSphDef \Inside, s, [364,70,570], 25;": lambda x, y, z, _: (
        dist((x, y, z), (364, 70, 570)) < 25
    ),
    r"WZLimJointDef \Outside, s, [[4,-9E9,-9E9,-9E9,-9E9,-9E9],[9E9,9E9,9E9,9E9,9E9,9E9]],"
    r" [[20,9E9,9E9,9E9,9E9,9E9],[9E9,9E9,9E9,9E9,9E9,9E9]];": lambda *place: not 4 < place[3] < 20,
}


@pytest.mark.parametrize("shape", SHAPES)
def test_zone_signal_follows_position(irb120, shape):
    """Looked at from outside every 7 ms, on lines, corners and joint moves."""
    body = f"""
    MoveAbsJ start, v1000, fine, tool0;
    {shape}
    WZDOSet \\Temp, z \\Inside, s, do1, 1;
    MoveL Offs(p,0,70,-60), v400, z20, tool0;
    MoveL Offs(p,0,140,10), v400, z20, tool0;
    MoveL Offs(p,0,140,-40), v400, fine, tool0;
    MoveJ Offs(p,0,20,-20), v1000, fine, tool0;
    MoveL Offs(p,10,20,-20), v10, fine, tool0;
    """
    inside, seen = SHAPES[shape], set()
    with controller(irb120, body) as cell:
        (group,) = cell.motion.groups.values()
        cell.run_until(lambda: len(cell.motion.zones) > 0, timeout=20)
        while cell.tasks["T_ROB1"].state == "running":
            cell.run_for(0.007)
            posture = group.commanded()
            x, y, z = np.array(group.geometry().forward(posture)[0]) * 1000
            wanted = inside(x, y, z, np.degrees(posture[0]))
            assert cell.signals["do1"] == wanted, (x, y, z)
            seen.add(wanted)
    assert seen == {True, False}


@pytest.mark.parametrize("call", ["WZDisable w;", "WZEnable w;", "WZFree w;"])
def test_a_stationary_zone_stays(irb120, call):
    hook = "PROC power()\n" + BOX + "WZLimSup \\Stat, w, s;\nENDPROC"
    with controller(irb120, call, hook) as cell:
        cell.run()
        assert "is stationary" in cell.tasks["T_ROB1"].fault.arguments[0]
        assert len(cell.motion.zones) == 1

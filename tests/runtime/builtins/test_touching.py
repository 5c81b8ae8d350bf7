"""ContactL: where the robot touches something, it stops."""

import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.system.model import ModuleFile, System, TaskSpec

TEXT = r"""
MODULE m
CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
VAR bool moving := FALSE;
PROC main()
VAR robtarget q;
MoveAbsJ start, v1000, fine, tool0;
moving := TRUE;
ContactL \DesiredTorque:=5, Offs(p,0,100,0), v100, tool0;
q := CRobT(\Tool:=tool0 \WObj:=wobj0);
TPWrite ValToStr(Round(q.trans.y));
MoveL p, v100, fine, tool0;
ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize("after", [0.3, 0.7])
def test_contact_ends_the_line(after):
    system = System(
        "s",
        (TaskSpec("T_ROB1", motion=True, modules=(ModuleFile("m", "m.mod", TEXT.encode()),)),),
    )
    with VirtualController(system, load_config("irb120").groups, cycle="once") as cell:
        task, (group,) = cell.tasks["T_ROB1"], cell.motion.groups.values()
        cell.run_until(lambda: task["m:moving"], timeout=10)
        cell.run_for(after)
        before = group.geometry().forward(group.commanded())[0][1] * 1000
        group.touch()
        assert cell.run() == "finished"
        assert before <= float(cell.operator.rows[0]) < before + 10

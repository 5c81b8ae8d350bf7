"""RobotStudio's targets for YuMi: eax_a is the arm angle, of moves as of CRobT and CalcJointT."""

import pytest

from rapidgen.config import load_config
from rapidgen.controller import VirtualController

# The home of both arms in public programs; its axes are 0, -130, 30, 0, 40, 0 and +-135.
HOME = """
  CONST robtarget home := [[-9.578368507,{s}182.609892723,198.627808149],
    [0.066010726,{s}0.842420918,-0.111214912,{s}0.523068661],[0,0,0,4],
    [{s}101.964427132,9E+09,9E+09,9E+09,9E+09,9E+09]];
"""
PROGRAM = """
MODULE Probe
{home}
  VAR robtarget p;
  VAR jointtarget j;
  PROC main()
    MoveAbsJ [[0,-110,30,0,40,10],[{s}120,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    {move}
    j := CJointT();
    TPWrite "" \\Num:=Round(j.extax.eax_a \\Dec:=2);
    p := CRobT();
    TPWrite "" \\Num:=Round(p.extax.eax_a \\Dec:=2);
    j := CalcJointT(home, tool0);
    TPWrite "" \\Num:=Round(j.extax.eax_a \\Dec:=2);
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    "move", ["MoveJ home, v1000, fine, tool0;", "MoveL home, v200, fine, tool0;"]
)
@pytest.mark.parametrize(("task", "sign"), [("T_ROB_L", ""), ("T_ROB_R", "-")])
def test_a_home_target_of_public_programs(tmp_path, move, task, sign):
    file = tmp_path / "Probe.mod"
    file.write_text(PROGRAM.format(home=HOME.format(s=sign), move=move, s=sign))
    group = next(g for g in load_config("irb14000").groups if g.task == task)
    controller = VirtualController.from_files({task: [file]}, robots=(group,), cycle="once")
    controller.run_for(30.0)
    rows = [float(row) for row in controller.operator.rows]
    side = -1 if sign else 1
    assert rows == pytest.approx([135 * side, 101.96 * side, 135 * side], abs=0.011)

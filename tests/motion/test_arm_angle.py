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


GESTURE = """
MODULE Probe
  CONST robtarget up := [[108.153567372,471.411547841,988.720364525],
    [0.699371728,0.003098049,0.006552252,-0.714721384],{configuration},
    [-132.382818416,9E+09,9E+09,9E+09,9E+09,9E+09]];
  TASK PERS tooldata hand := [TRUE,[[0,0,114.2],[1,0,0,0]],[0.24,[8,12,48],[1,0,0,0],0,0,0]];
  VAR jointtarget j;
  PROC main()
    MoveAbsJ [[0,-130,30,0,40,0],[135,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    MoveJ up, v1000, fine, hand;
    j := CJointT();
    TPWrite "" \\Num:=Round(j.robax.rax_4);
    TPWrite "" \\Num:=Round(j.extax.eax_a);
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("configuration", "reached"), [("[0,-1,0,4]", [-79, -34]), ("[0,-1,0,0]", [])]
)
def test_a_target_is_reached_in_the_posture_of_its_confdata(tmp_path, configuration, reached):
    """A gesture of a public program; with another cfx no posture has its confdata (50080)."""
    file = tmp_path / "Probe.mod"
    file.write_text(GESTURE.format(configuration=configuration))
    group = next(g for g in load_config("irb14000").groups if g.task == "T_ROB_L")
    controller = VirtualController.from_files({"T_ROB_L": [file]}, robots=(group,), cycle="once")
    controller.run_for(30.0)
    assert [float(row) for row in controller.operator.rows] == reached
    assert any(event.code == 50080 for event in controller.log) is not bool(reached)

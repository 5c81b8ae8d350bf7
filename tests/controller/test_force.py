"""Force control with described readings; an inferred cell has none."""

import pytest

from rapidgen.controller import VirtualController

CELL = """force:
  readings: [[0, 0, -5, 0, 0, 0], [1, 2, -20, 0.5, 0, 0]]
  mass: 2.5
  center: [0, 0, 60]
"""
PROGRAM = r"""MODULE presses
 VAR fcforcevector felt;
 VAR loaddata held;
 VAR num fault := 9;
 PERS tooldata pad := [TRUE,[[0,0,50],[1,0,0,0]],[1,[0,0,20],[1,0,0,0],0,0,0]];
 CONST robtarget p1 := [[374,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
 PROC main()
  held := FCLoadID(\MaxMoveAx5:=25 \MaxMoveAx6:=60 \LoadidErr:=fault);
  TPWrite NumToStr(held.mass, 1) + ValToStr(held.cog) + NumToStr(fault, 0);
  FCCalib held;
  reads;
  MoveJ p1, v500, fine, pad;
  FCPress1LStart Offs(p1,0,0,-20), v100, \Fz:=200, 50 \PosSupvDist:=150, z5, pad;
  TPWrite "force " \Bool:=FCIsForceMode();
  FCPressL Offs(p1,0,100,-20), v100, 180, z5, pad;
  FCPressEnd Offs(p1,0,100,20), v100, pad;
  TPWrite "force " \Bool:=FCIsForceMode();
  TPWrite ValToStr(CPos(\Tool:=pad));
  reads;
  reads;
 ENDPROC
 PROC reads()
  felt := FCGetForce(\Tool:=pad \ContactForce);
  TPWrite ValToStr(felt);
 ENDPROC
 PROC uncalibrated()
  reads;
 ENDPROC
 PROC on()
  FCCalib held;
  FCPressL p1, v100, 180, fine, pad;
 ENDPROC
 PROC searches()
  FCCalib held;
  FCAct pad;
  TPWrite "force " \Bool:=FCIsForceMode();
  FCDeact;
  TPWrite "force " \Bool:=FCIsForceMode();
  FCRefStart;
 ENDPROC
ENDMODULE
"""


@pytest.fixture
def boot(tmp_path):
    (tmp_path / "cell.yaml").write_text(CELL)
    (tmp_path / "press.mod").write_text(PROGRAM)

    def booted(entry, cell="cell.yaml"):
        where = str(tmp_path / cell) if cell.endswith("yaml") else cell
        return VirtualController.from_files(
            [tmp_path / "press.mod"], cell=where, entry=entry, cycle="once"
        )

    return booted


def run(controller):
    displayed: list[str] = []
    controller.operator.subscribe(lambda _task, text: displayed.append(text))
    controller.run(max_time=60)
    return displayed, controller.task("T_ROB1").fault


def test_sensor_reads_description_and_robot_follows_path(boot):
    with boot("main") as controller:
        displayed, fault = run(controller)
        assert fault is None
        assert displayed == [
            "2.5[0,0,60]0",
            "[0,0,-5,0,0,0]",
            "force TRUE",
            "force FALSE",
            "[374,100,520]",
            "[1,2,-20,0.5,0,0]",
            "[1,2,-20,0.5,0,0]",
        ]


@pytest.mark.parametrize(
    ("entry", "report"),
    [
        ("uncalibrated", "Force sensor not calibrated"),
        ("on", "No process force"),
        ("searches", "FCRefStart is not available"),
    ],
)
def test_unsupported_force_use_stops_with_reason(boot, entry, report):
    with boot(entry) as controller:
        displayed, fault = run(controller)
        assert report in fault.title
        assert displayed == (["force TRUE", "force FALSE"] if entry == "searches" else [])


def test_without_a_word_about_the_sensor_the_program_stops(boot):
    with boot("on", cell="") as controller:
        _, fault = run(controller)
        assert fault.title == "Nothing to measure"
        assert "`force:`" in fault.arguments[0]


def test_a_guessed_sensor_measures_nothing(boot):
    with boot("main", cell="infer") as controller:
        displayed, fault = run(controller)
        assert fault is None
        assert displayed[1] == "[0,0,0,0,0,0]"

"""Cameras with described results, and inferred cameras."""

import pytest

from rapidgen.controller import VirtualController
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.diagnostics import DiagnosticError

CELL = """cameras:
  Cam1:
    images:
      - - {name: Part, position: [10, 20, 0], angle: 90, type: 2, values: [7], texts: [ok]}
        - {name: Part, position: [30, 0, 0]}
      - []
    parameters: {Pattern_1.Number_Found: 2}
"""
PROGRAM = r"""MODULE cam
 VAR cameratarget t;
 VAR num found;
 PROC main()
  looks;
  looks;
  looks;
 ENDPROC
 PROC looks()
  CamReqImage Cam1;
  WHILE TRUE DO
   CamGetResult Cam1, t \MaxTime:=5;
   TPWrite t.name + ValToStr(t.cframe.trans) + NumToStr(t.val1, 0) + t.string1;
  ENDWHILE
 ERROR
  IF ERRNO = ERR_CAM_NO_MORE_DATA THEN
   CamGetParameter Cam1, "pattern_1.Number_Found" \NumVar:=found;
   TPWrite "none of " + NumToStr(found, 0);
   RETURN;
  ENDIF
 ENDPROC
 PROC changes()
  CamSetProgramMode Cam1;
  CamLoadJob Cam1, "a.job";
  TPWrite CamGetLoadedJob(Cam1);
  CamSetParameter Cam1, "Gain" \NumVal:=3;
  CamSetRunMode Cam1;
  CamGetParameter Cam1, "gain" \NumVar:=found;
  TPWrite "gain " + NumToStr(found, 0);
  CamReqImage Cam1 \AwaitComplete;
  TPWrite NumToStr(CamNumberOfResults(Cam1), 0);
  CamSetParameter Cam1, "Gain" \NumVal:=4;
 ERROR
  TPWrite "run mode";
  TRYNEXT;
 ENDPROC
ENDMODULE
"""


@pytest.fixture
def files(tmp_path):
    (tmp_path / "cell.yaml").write_text(CELL)
    (tmp_path / "cam.mod").write_text(PROGRAM)
    return tmp_path


def shown(files, **options):
    lines: list[str] = []
    result = load_target([files / "cam.mod"], BootOptions(**options))
    with VirtualController.boot(result, cycle="once") as controller:
        controller.operator.subscribe(lambda _task, line: lines.append(line))
        finished = controller.run(max_time=60)
        return lines, finished, controller.now, str(controller.task("T_ROB1").fault)


def test_images_of_description_come_in_turn(files):
    lines, finished, now, _ = shown(files, cell=files / "cell.yaml")
    part = ["Part[10,20,0]7ok", "Part[30,0,0]0"]
    assert lines == [*part, "none of 2", "none of 2", *part, "none of 2"]
    assert finished == "finished"
    assert now == pytest.approx(0.6, abs=0.1), "each image takes 0.2 s"


def test_jobs_and_parameters_are_changed_in_program_mode(files):
    lines, finished, now, _ = shown(files, cell=files / "cell.yaml", entry="changes")
    assert lines == ["a.job", "gain 3", "2", "run mode"]
    assert finished == "finished"
    assert now == pytest.approx(1.2, abs=0.1), "a job takes a second"


def test_inferred_camera_sees_one_object(files):
    lines, finished, _, _ = shown(files, cell="infer")
    assert lines == ["Cam1[0,0,0]0", "none of 0"] * 3
    assert finished == "finished"


def test_camera_without_description_stops_program(files, tmp_path):
    (files / "cell.yaml").write_text("description: nothing\n")
    lines, _, _, fault = shown(files, cell=files / "cell.yaml")
    assert lines == []
    assert "REFUNKDAT" in fault


def test_camera_with_wrong_description_is_rejected(files):
    (files / "cell.yaml").write_text("cameras:\n  Cam1:\n    images: [{name: a}]\n")
    with pytest.raises(DiagnosticError):
        shown(files, cell=files / "cell.yaml")

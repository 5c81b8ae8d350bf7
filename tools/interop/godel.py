"""Trial: ros-industrial-attic/godel, whose client puts modules into HOME.

    python -m tools.interop.godel FOLDER

FOLDER is a checkout. The trial puts two modules where godel's file suite puts its own; the program
must load, execute, unload and delete each.
"""

import sys
from math import degrees
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.controller.mechanics import groups_for
from rapidgen.system import read_files

BLEND = """MODULE mGodel_Blend
  PROC Godel_Blend()
    MoveAbsJ [[{angle},0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    TPWrite "blended {angle}";
  ENDPROC
ENDMODULE
"""


def main(folder: Path) -> None:
    """Run the trial.

    Raises AssertionError if it fails.
    """
    file = next(folder.rglob("mGodel_Main.mod"))
    system = read_files([file], entry="Godel_Main")
    groups = groups_for(system, load_config("irb2400").groups)
    with VirtualController(system, groups) as controller:
        printed: list[str] = []
        controller.operator.subscribe(lambda _, text: printed.append(text))
        controller.run_for(1)
        drop = controller.files.path("HOME:/PARTMODULES")
        drop.mkdir()
        for angle in (20, -15):
            place = drop / "mGodelBlend.mod"
            place.write_text(BLEND.format(angle=angle))
            assert controller.run_until(lambda place=place: not place.exists(), timeout=30)
            task = controller.task("T_ROB1")
            assert "mgodel_blend" not in task.rapid.program.modules, task.fault
            reached = degrees(controller.motion.group("rob1").positions()[0])
            assert abs(reached - angle) < 1e-3, reached
        assert printed == ["blended 20", "blended -15"]
    print("two modules dropped, loaded, executed, unloaded and deleted")


if __name__ == "__main__":
    main(Path(sys.argv[1]))

"""A controller with a power switch: what was asked of it before a restart is done."""

from rapidgen.controller.boot_targets import load_target
from rapidgen.controller.runner import ControllerRunner

PROGRAM = "MODULE m\n PROC main()\n  WaitTime 100;\n ENDPROC\nENDMODULE\n"


def test_posted_function_runs_before_restart(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(PROGRAM)
    done, in_use = [], []
    with ControllerRunner.boot(load_target([path]), clock="real") as cabinet:

        def restart_and_more():
            cabinet.ask_restart()
            in_use.append(cabinet.post(lambda: done.append(cabinet.restarts)))

        cabinet.on_restart.append(lambda: in_use.append(cabinet.post(lambda: done.append(-1))))
        cabinet.post(restart_and_more)
        cabinet.run(lambda: cabinet.restarts == 1)
    assert in_use == [True, False]
    assert done == [0]

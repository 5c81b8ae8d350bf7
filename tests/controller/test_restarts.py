"""Restarts of a controller run functions posted before."""

from rapidgen.controller.boot_targets import load_target
from rapidgen.controller.runner import ControllerRunner

PROGRAM = "MODULE m\n PROC main()\n  WaitTime 100;\n ENDPROC\nENDMODULE\n"


def test_posted_function_runs_before_restart(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(PROGRAM)
    done, in_use = [], []
    with ControllerRunner.boot(load_target([path]), clock="real") as runner:

        def restart_and_more():
            runner.ask_restart()
            in_use.append(runner.post(lambda: done.append(runner.restarts)))

        runner.on_restart.append(lambda: in_use.append(runner.post(lambda: done.append(-1))))
        runner.post(restart_and_more)
        runner.run(lambda: runner.restarts == 1)
    assert in_use == [True, False]
    assert done == [0]

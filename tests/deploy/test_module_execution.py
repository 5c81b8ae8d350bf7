"""`rapidgen execute` against served virtual controllers of each generation of web services."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "servers" / "rws"))

from served import make_runner

from rapidgen.client.errors import RobotError
from rapidgen.client.rws import Controller
from rapidgen.client.rws.errors import NotConfirmed
from rapidgen.deploy.online.module_execution import FOLDER, execute_module, make_execution_plan
from rapidgen.diagnostics import DiagnosticError
from rapidgen.servers.rws.server import serve_rws
from rapidgen.wire.rws.bodies import Generation

MODULE = """MODULE part
    PROC main()
        MoveAbsJ [[5,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]] \\NoEOffs, v1000, fine, tool0;
        {line}
    ENDPROC
ENDMODULE
"""


@pytest.fixture(params=list(Generation), ids=lambda g: f"rws{g.value}")
def services(request, tmp_path):
    with make_runner(tmp_path, request.param, clock="real", speed=5) as runner:
        runner.start()
        service = serve_rws(runner, request.param)
        with Controller(
            f"rws://{service.host}:{service.port}",
            password=service.password,
            fingerprint=service.host_key,
            pin_file=tmp_path / "known",
        ) as client:
            yield client
        service.close()


def text(line='TPWrite "done";'):
    return MODULE.format(line=line)


def state(services):
    return (
        [module.name for module in services.modules("T_ROB1")],
        services.panel().speed,
        [(task.name, task.active) for task in services.tasks()],
    )


def run(services, source, percent=10):
    said = []
    plan = make_execution_plan(services, source, "part.mod")
    events = execute_module(services, plan, source.encode(), percent=percent, say=said.append)
    return plan, events, said


def test_module_runs_and_everything_is_restored(services):
    services.pp_to_main()
    services.start()
    services.stop()
    before = state(services)
    plan, events, said = run(services, text())
    assert (plan.task, plan.routine, plan.displaced) == ("T_ROB1", "main", ("MainModule",))
    assert services.joint_target().robax[0] == pytest.approx(5.0, abs=1e-3)
    assert any(event.code == 10151 for event in events)  # program started
    assert "started part/main at 10 %" in said
    assert "program pointer of T_ROB1 at the beginning of MainModule/main" in said
    assert state(services) == before
    assert not [f for f in services.list_files(FOLDER) if f.name.endswith(("mod", "modx"))]
    # The displaced program runs again.
    services.start()
    services.stop()
    assert services.pointer("T_ROB1").module == "MainModule"


def test_error_of_the_program_is_reported_and_undone(services):
    services.pp_to_main()
    before = state(services)
    with pytest.raises(DiagnosticError) as error:
        run(services, text("MoveAbsJ [[999,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;"))
    assert {fault.code for fault in error.value.diagnostics} == {"RG758"}
    assert state(services) == before


def test_running_program_is_not_disturbed(services):
    services.start()
    with pytest.raises(DiagnosticError, match="a program runs"):
        make_execution_plan(services, text(), "part.mod")
    assert services.execution().running
    services.stop()


@pytest.mark.parametrize(
    ("source", "options", "report"),
    [
        ("MODULE a\nPROC x()\nENDPROC\nPROC y()\nENDPROC\nENDMODULE\n", {}, "2 procedures"),
        (text(), {"routine": "other"}, "no global procedure 'other'"),
        (text(), {"task": "T_ROB9"}, "no motion task 'T_ROB9'"),
        (text().replace("MODULE part", "MODULE MainModule"), {}, "has a module 'MainModule'"),
        (text().replace("    PROC", "    CONST num c := 5;\n    PROC"), {}, "declares c, too"),
        ("MODULE part\nPROC main(\nENDMODULE\n", {}, "RG2"),
    ],
)
def test_doubtful_module_is_rejected(services, source, options, report):
    before = state(services)
    with pytest.raises(DiagnosticError, match=report):
        make_execution_plan(services, source, "part.mod", **options)
    assert state(services) == before


def test_interruption_stops_the_robot(services):
    services.pp_to_main()
    before = state(services)
    plan = make_execution_plan(services, text("WaitTime 1000;"), "part.mod")

    def interrupt(line):
        if line.startswith("part/main:"):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        execute_module(services, plan, text("WaitTime 1000;").encode(), percent=10, say=interrupt)
    assert not services.execution().running
    assert state(services) == before


class Unstoppable:
    """Web services that do not confirm a stop."""

    def __init__(self, services):
        self._services = services

    def __getattr__(self, name):
        return getattr(self._services, name)

    def stop(self, **_):
        raise NotConfirmed.because("RG655", "the program still runs")


def test_robot_that_cannot_be_stopped_does_not_become_faster(services):
    services.pp_to_main()
    source = text("WaitTime 1000;")
    plan = make_execution_plan(services, source, "part.mod")
    said = []

    def interrupt(line):
        said.append(line)
        if line.startswith("part/main:"):
            raise KeyboardInterrupt

    with pytest.raises(RobotError):
        execute_module(Unstoppable(services), plan, source.encode(), percent=10, say=interrupt)
    assert services.execution().running
    assert services.panel().speed == 10
    assert "the program still runs: the speed stays as it is" in said
    services.stop()

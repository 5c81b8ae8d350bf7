"""`rapidgen execute` against served virtual controllers of each generation of web services."""

import sys
import threading
from contextlib import contextmanager
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "servers" / "rws"))

from served import make_runner

from rapidgen._simulator_registry import Simulator, published
from rapidgen.cli.app import main
from rapidgen.client.errors import RobotError
from rapidgen.client.rws import Controller
from rapidgen.client.rws.errors import NotConfirmed
from rapidgen.deploy.online.module_execution import FOLDER, execute_module, make_execution_plan
from rapidgen.diagnostics import DiagnosticError
from rapidgen.servers.rws.server import serve_rws
from rapidgen.system.model import ModuleFile, TaskSpec
from rapidgen.wire.rws.bodies import Generation

MODULE = """MODULE part
    PROC main()
        MoveAbsJ [[5,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]] \\NoEOffs, v1000, fine, tool0;
        {line}
    ENDPROC
ENDMODULE
"""


@contextmanager
def serving(folder, generation, **options):
    """A controller and its service."""
    with make_runner(folder, generation, clock="real", speed=5, **options) as runner:
        runner.start()
        service = serve_rws(runner, generation)
        yield runner, service
        service.close()


def connected(service, folder):
    return Controller(
        f"rws://{service.host}:{service.port}",
        password=service.password,
        fingerprint=service.host_key,
        pin_file=folder / "known",
    )


@pytest.fixture(params=list(Generation), ids=lambda g: f"rws{g.value}")
def services(request, tmp_path):
    with serving(tmp_path, request.param) as (_, service), connected(service, tmp_path) as client:
        yield client


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


# -- a simulator of this machine -------------------------------------------------------------------


@pytest.mark.parametrize("generation", [Generation.ONE, Generation.TWO], ids=["rws1", "rws2"])
def test_sim_is_the_simulator_with_web_services(generation, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "robotics")
    source = tmp_path / "part.mod"
    source.write_text(text())
    command = ["execute", str(source), "--to", "sim"]
    with published(Simulator("other", 7, {})):
        assert main(command) == 1
        error = capsys.readouterr().err
        assert "error[RG642]" in error
        assert "no simulator of yours serves Robot Web Services" in error
        assert "other (process 7)" in error
        with serving(tmp_path, generation) as (_, service):
            where = f"rws://{service.host}:{service.port}"
            with published(Simulator("cell", 8, {}, where, service.host_key)):
                assert main(command) == 0
    assert "sim: part executed" in capsys.readouterr().out


# -- manual mode -----------------------------------------------------------------------------------


def on_controller(runner, function):
    done = threading.Event()
    assert runner.post(lambda: (function(), done.set()))
    assert done.wait(60)


@pytest.fixture(params=[Generation.ONE, Generation.TWO], ids=["rws1", "rws2"])
def manual(request, tmp_path):
    """A controller in manual mode at reduced speed, whose pendant has granted execution.

    RobotWare 8 has no such grant (tests/client/rws/test_users.py).
    """
    with serving(tmp_path, request.param) as (runner, service):

        def prepare():
            controller = runner.controller
            pendant = controller.operator
            pendant.attach()
            pendant.asked.add(
                lambda: [pendant.answer(q.number, "Grant") for q in pendant.questions]
            )
            controller.set_mode("manual_reduced")

        with connected(service, tmp_path) as client:
            client.pp_to_main()
            on_controller(runner, prepare)
            client.ask_rmmp("exec")
            yield runner, client


def test_manual_mode_waits_for_the_enabling_device(manual):
    runner, services = manual
    before = state(services)
    source = text()
    plan = make_execution_plan(services, source, "part.mod")
    assert (plan.mode, plan.state) == ("MANR", "motoroff")
    said = []

    def press(line):
        said.append(line)
        if line == "press the enabling device":
            on_controller(runner, lambda: runner.controller.set_motors(True))

    execute_module(services, plan, source.encode(), percent=10, say=press)
    assert "press the enabling device" in said
    # The speed ratio of manual mode is the operator's.
    assert f"started part/main at {plan.speed} %" in said
    assert services.joint_target().robax[0] == pytest.approx(5.0, abs=1e-3)
    assert state(services) == before


def test_nothing_moves_without_the_enabling_device(manual, monkeypatch):
    _, services = manual
    before = state(services)
    start = services.joint_target().robax
    monkeypatch.setattr("rapidgen.deploy.online.module_execution._ENABLING", 0.0)
    with pytest.raises(DiagnosticError, match=r"the motors of .* are off"):
        run(services, text())
    assert services.joint_target().robax == start
    assert state(services) == before


def test_released_enabling_device_is_no_success(manual):
    runner, services = manual
    before = state(services)
    source = text("WaitTime 1000;")
    plan = make_execution_plan(services, source, "part.mod")

    def hold(line):
        if line == "press the enabling device":
            on_controller(runner, lambda: runner.controller.set_motors(True))
        elif line == "part/main:4":
            on_controller(runner, lambda: runner.controller.set_motors(False))

    with pytest.raises(DiagnosticError, match="stopped before its end") as error:
        execute_module(services, plan, source.encode(), percent=10, say=hold)
    assert {fault.code for fault in error.value.diagnostics} == {"RG758"}
    assert state(services) == before


# -- a driver that is active -----------------------------------------------------------------------

SERVER = ModuleFile(
    "ROS_server",
    "ROS_server.mod",
    b"MODULE ROS_server\nPROC main()\nWHILE TRUE DO\nWaitTime 0.1;\nENDWHILE\nENDPROC\nENDMODULE\n",
)
DRIVER = TaskSpec("T_ROS_server", "SEMISTATIC", modules=(SERVER,))


@pytest.mark.parametrize("generation", list(Generation), ids=lambda g: f"rws{g.value}")
def test_active_driver_is_replaced_on_request_only(generation, tmp_path):
    def running():
        return [task.name for task in services.tasks() if task.execution == "started"]

    with (
        serving(tmp_path, generation, tasks=[DRIVER], autostart=True) as (_, service),
        connected(service, tmp_path) as services,
    ):
        active = ["T_ROB1", "T_ROS_server"]
        assert sorted(running()) == active
        with pytest.raises(DiagnosticError, match=r"the driver is active at .*T_ROS_server"):
            make_execution_plan(services, text(), "part.mod")
        assert sorted(running()) == active
        modules = services.modules("T_ROB1")
        plan = make_execution_plan(services, text(), "part.mod", replace_driver=True)
        assert sorted(plan.running) == active
        said = []
        execute_module(services, plan, text().encode(), percent=100, say=said.append)
        assert f"stopping {', '.join(plan.running)}" in said
        assert services.joint_target().robax[0] == pytest.approx(5.0, abs=1e-3)
        # The start of the module has started the background task again.
        assert running() == []
        assert services.modules("T_ROB1") == modules

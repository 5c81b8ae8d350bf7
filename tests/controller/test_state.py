"""I/O, faults, files, sockets and control commands of a controller."""

from dataclasses import replace
from typing import get_args, get_type_hints

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.controller.faults import ControllerAction, ControllerRule, FaultPlan, NetworkRule
from rapidgen.controller.operation import ACTIONS
from rapidgen.diagnostics import DiagnosticError
from rapidgen.rapid.switches import Switches
from rapidgen.servers.control_commands import commands, subscribe
from rapidgen.servers.control_socket import CommandError
from rapidgen.system.model import (
    ModuleFile,
    SignalSpec,
    System,
    SystemInput,
    SystemOutput,
    TaskSpec,
)
from rapidgen.viewer.messages import PendantAction

LOOP = """MODULE work
    VAR num passes := 0;
    VAR socketdev server;
    VAR iodev file;
    PERS num speed := 10;
    PERS pos where := [1, 2, 3];
    CONST num fixed := 4;
    PROC main()
        VAR num answer;
        SocketCreate server;
        SocketBind server, "127.0.0.1", 5000;
        SocketListen server;
        Open "HOME:/log", file \\Write;
        WHILE TRUE DO
            WaitTime 0.1;
            Incr passes;
            IF passes = 1000 TPReadNum answer, "go on?";
        ENDWHILE
    ENDPROC
ENDMODULE
"""
SIGNALS = (
    *(SignalSpec(name, "DO") for name in ("doMotors", "doStop", "doRuns", "doError")),
    SignalSpec("diStart", "DI"),
    SignalSpec("diStop", "DI"),
)


def make(text=LOOP, **options):
    modules = (ModuleFile("work", "work.mod", text.encode()),)
    system = System(
        "cell",
        (TaskSpec("T_ROB1", modules=modules),),
        signals=SIGNALS,
        outputs=(
            SystemOutput("MotorOn", "doMotors"),
            SystemOutput("EmStop", "doStop"),
            SystemOutput("TaskExecuting", "doRuns", task="T_ROB1"),
            SystemOutput("ExecError", "doError"),
        ),
        inputs=(SystemInput("Start", "diStart"), SystemInput("Stop", "diStop")),
    )
    return VirtualController(system, **options)


@pytest.fixture
def cell():
    with make() as controller:
        controller.run_for(1)
        yield controller


def outputs(controller):
    return [int(controller.signals[n]) for n in ("doMotors", "doStop", "doRuns", "doError")]


def test_system_outputs_follow_the_controller(cell):
    assert outputs(cell) == [1, 0, 1, 0]
    cell.set_e_stop(True)
    assert outputs(cell) == [0, 1, 0, 0]
    cell.set_e_stop(False)
    cell.set_motors(True)
    cell.start_program()
    assert outputs(cell) == [1, 0, 1, 0]


def test_an_error_is_shown():
    with make("MODULE work\nPROC main()\nVAR num x;\nx := 1 / x;\nENDPROC\nENDMODULE") as c:
        c.run_for(1)
        assert outputs(c)[2:] == [0, 1]


def test_output_shows_error_of_named_task():
    """Backups and ABB's own files give Error a task in -Arg2."""
    fails = b"MODULE ends\nPROC main()\nVAR num x;\nx := 1 / x;\nENDPROC\nENDMODULE"
    names = ("T_ROB1", "T_SIDE")
    system = System(
        "cell",
        (
            TaskSpec("T_ROB1", modules=(ModuleFile("work", "work.mod", LOOP.encode()),)),
            TaskSpec(
                "T_SIDE", "SEMISTATIC", "NoSafety", modules=(ModuleFile("e", "e.mod", fails),)
            ),
        ),
        signals=tuple(SignalSpec(f"do{name}", "DO") for name in (*names, "Any")),
        outputs=(
            *(SystemOutput("Error", f"do{name}", task=name) for name in names),
            SystemOutput("Error", "doAny"),
        ),
    )
    with VirtualController(system) as controller:
        controller.run_for(1)
        assert [int(controller.signals[f"do{n}"]) for n in (*names, "Any")] == [0, 1, 1]


def test_system_inputs_stop_and_start(cell):
    cell.signals["diStop"] = 1
    passes = cell.task("T_ROB1")["work:passes"]
    cell.run_for(1)
    assert cell.task("T_ROB1")["work:passes"] == passes
    cell.signals["diStart"] = 1
    cell.run_for(1)
    assert cell.task("T_ROB1")["work:passes"] > passes


def test_pp_to_main_closes_sockets_and_files(cell):
    """PP to main closes sockets and files, so that main can run again.

    Source: [S4 overview 4-24].
    """
    assert 5000 in cell.network.listeners
    cell.pp_to_main()
    cell.run_for(0.1)
    cell.start_program()
    cell.run_for(1)
    assert cell.task("T_ROB1").state == "running"
    assert 5000 in cell.network.listeners


def test_dynamic_modules_go_at_pp_to_main(cell):
    """[S4 Load]: \\Dynamic modules vanish, static ones stay."""
    text = """MODULE work
        VAR num there := 0;
        PROC main()
            IF ModExist("static") there := there + 1;
            IF ModExist("dynamic") there := there + 10;
            IF there = 0 THEN
                Load "HOME:/static.mod";
                Load \\Dynamic, "HOME:/dynamic.mod";
            ENDIF
            WaitTime 100;
        ENDPROC
    ENDMODULE"""
    with make(text.replace("\\\\", "\\"), autostart=False) as c:
        for name in ("static", "dynamic"):
            (c.files.folder / "HOME" / f"{name}.mod").write_text(f"MODULE {name}\nENDMODULE\n")
        c.start_program()
        c.run_for(1)
        assert c.task("T_ROB1")["work:there"] == 0
        c.pp_to_main()
        c.run_for(0.1)
        c.start_program()
        c.run_for(1)
        assert c.task("T_ROB1")["work:there"] == 1


def test_a_plan_acts_at_its_time_and_at_its_statement():
    plan = FaultPlan(
        controller=(
            ControllerRule("stop", task="T_ROB1", module="work", line=16, pass_=5),
            ControllerRule("e-stop", at=3.0),
        )
    )
    with make(faults=plan) as c:
        c.run_for(2)
        assert c.task("T_ROB1")["work:passes"] == 4
        assert c.task("T_ROB1").state == "stopped"
        assert not c.e_stop
        c.run_for(2)
        assert c.e_stop


def test_every_action_of_the_controller_is_one_of_a_plan_or_of_the_page():
    """The page has buttons for each; a plan starts with motors and mode set."""
    page = set(get_args(get_type_hints(PendantAction)["action"]))
    plan = set(get_args(ControllerAction))
    assert {"release-e-stop", "reset-e-stop", "e-stop"} <= page & plan
    assert page <= set(ACTIONS)
    assert plan <= set(ACTIONS)


def test_a_plan_releases_the_button_before_the_reset():
    plan = FaultPlan(
        controller=(ControllerRule("e-stop", at=1.0), ControllerRule("release-e-stop", at=2.0))
    )
    with make(faults=plan) as c:
        c.run_for(1.5)
        assert (c.e_stop, c.operation.e_stop_pressed) == (True, True)
        c.run_for(1)
        assert (c.e_stop, c.operation.e_stop_pressed) == (True, False)


def test_a_plan_reaches_the_network():
    with make(faults=FaultPlan(network=(NetworkRule("reset", direction="in", after=2),))) as c:
        c.run_for(0.1)
        assert type(c.network).__name__ == "FaultyNetwork"
        assert 5000 in c.network.listeners


def test_power_loss_closes_sockets_and_sets_outputs_back(cell):
    cell.perform("power-loss")
    assert 5000 not in cell.network.listeners
    assert outputs(cell)[0] == 0


SEVERAL = """MODULE several
    VAR socketdev first;
    VAR socketdev second;
    VAR iodev one;
    VAR iodev other;
    PROC main()
        SocketCreate first;
        SocketBind first, "127.0.0.1", 5000;
        SocketListen first;
        SocketCreate second;
        SocketBind second, "127.0.0.1", 5001;
        SocketListen second;
        Open "HOME:/one", one \\Write;
        Open "HOME:/other", other \\Write;
        WaitTime 60;
    ENDPROC
ENDMODULE
"""


def test_a_power_loss_closes_all_sockets_and_files_of_a_task():
    with make(SEVERAL) as controller:
        controller.run_for(1)
        assert set(controller.network.listeners) == {5000, 5001}
        files = [controller.task("T_ROB1")[n] for n in ("one", "other")]
        assert all(device.file is not None for device in files)
        controller.perform("power-loss")
        controller.run_for(0.1)
        assert not controller.network.listeners
        assert not controller.sockets.in_use
        assert all(device.file is None for device in files)


def test_power_loss_ends_states_forbidding_start(cell):
    operation = cell.operation
    for forbid in (
        operation.fail,
        lambda: operation.set_e_stop(True),
        lambda: setattr(operation, "halted", True),
    ):
        forbid()
        if not operation.halted:
            cell.perform("motors-on")  # neither a system failure nor an emergency stop ends so
        assert not cell.perform("start")
        cell.perform("power-loss")
        assert (operation.failed, operation.halted, operation.e_stop) == (False, False, False)
        assert not operation.motors_on
        assert not operation.start_program()
        cell.perform("motors-on")
        assert operation.start_program()


@pytest.mark.parametrize(
    ("before", "action", "numbers"),
    [
        ((), "e-stop", [10012, 10013, 10125]),
        (("e-stop",), "reset-e-stop", [10010]),
        ((), "motors-off", [10010, 10125]),
        (("motors-off",), "motors-on", [10011]),
        ((), "manual", [10125, 10015, 10012]),
        (("manual",), "auto", [10016, 10010, 10017]),
        ((), "stop", [10125]),
        (("stop",), "start", [10052, 10053, 10156]),
        (("stop", "pp-to-main"), "start", [10052, 10053, 10151]),
        (("motors-off",), "start", [20072]),
        (("manual",), "start", [20074]),
        (("e-stop",), "start", [20075]),
        (("e-stop",), "motors-on", [20202]),
        (("stop",), "pp-to-main", [10002]),
        ((), "power-loss", [192140, 10045]),
    ],
)
def test_operator_actions_have_event_numbers(cell, before, action, numbers):
    # Saved event logs of IRB 120 controllers with 5.15 and of a controller with 5.61. Only
    # 192140 is rapidgen's own.
    for earlier in before:
        cell.perform(earlier)
    newest = max(event.sequence for event in cell.log)
    cell.perform(action)
    assert [event.code for event in cell.log.since(newest)] == numbers


# -- control commands -----------------------------------------------------------------------


@pytest.fixture
def do(cell):
    """Carries out one request."""
    known = commands(cell)
    return lambda action, **request: known[action]({"do": action, **request})


def test_status(do, cell):
    status = do("status")
    assert status["tasks"] == {"T_ROB1": "running"}
    assert status["listeners"] == {"5000": 5000}
    assert status["time"] == cell.now
    assert "work.mod:" in do("where")[0]


def test_variables_have_rapid_text(do, cell):
    assert do("get", task="t_rob1", name="work:where") == "[1,2,3]"
    do("set", task="T_ROB1", name="work:where", value="[4, 5, 6]")
    assert do("get", task="T_ROB1", name="where") == "[4,5,6]"
    do("set", task="T_ROB1", name="work:passes", value="500")
    cell.run_for(0.15)
    assert cell.task("T_ROB1")["work:passes"] >= 501


@pytest.mark.parametrize(
    ("request_", "words"),
    [
        ({"do": "get", "task": "T_NONE", "name": "x"}, "no task"),
        ({"do": "get", "task": "T_ROB1", "name": "nothing"}, "no data"),
        ({"do": "get", "task": "T_ROB1"}, "'name' is missing"),
        ({"do": "set", "task": "T_ROB1", "name": "fixed", "value": "1"}, "can be set"),
        ({"do": "set", "task": "T_ROB1", "name": "where", "value": "[1]"}, "no literal"),
        ({"do": "set", "task": "T_ROB1", "name": "server", "value": "1"}, "no value type"),
        ({"do": "set-signal", "name": "none", "value": 1}, "no signal"),
        ({"do": "set-signal", "name": "diStart", "value": 2}, "does not fit"),
        ({"do": "set-signal", "name": "diStart", "value": True}, "no number"),
        ({"do": "override", "value": 101}, "0 to 100"),
        ({"do": "override", "value": -1}, "0 to 100"),
        ({"do": "override", "value": 50, "group": "rob9"}, "no group"),
        ({"do": "mode", "value": "sleepy"}, "one of auto"),
        ({"do": "log", "since": "x"}, "sequence number"),
        ({"do": "answer", "number": 9, "value": "1"}, "no such question"),
    ],
)
def test_impossible_requests_are_rejected(cell, request_, words):
    with pytest.raises(CommandError, match=words):
        commands(cell)[request_["do"]](request_)


def test_signals_and_log(do, cell):
    assert do("signals")["doRuns"] == 1
    do("set-signal", name="diStop", value=1)
    assert do("status")["tasks"]["T_ROB1"] == "stopped"
    last = do("log")[-1]["sequence"]
    do("motors-off")
    assert do("log", since=last)[0]["code"] == 10_010


def test_subscribers_get_events_and_can_answer_dialogs(do, cell):
    seen = []
    end = subscribe(cell, seen.append)
    do("set", task="T_ROB1", name="work:passes", value="998")
    cell.run_for(1)
    (question,) = [e for e in seen if e["event"] == "question"]
    assert (question["dialog"], question["text"]) == ("TPReadNum", "go on?")
    assert do("questions")[0]["number"] == question["number"]
    with pytest.raises(CommandError):
        do("answer", number=question["number"], value="perhaps")
    do("answer", number=question["number"], value="1")
    cell.run_for(1)
    assert cell.task("T_ROB1")["work:passes"] > 1000
    do("motors-off")
    assert any(e["event"] == "log" and e["code"] == 10_010 for e in seen)
    end()
    count = len(seen)
    do("motors-on")
    assert len(seen) == count
    assert "go on?" in do("screen")


# -- bad programs ---------------------------------------------------------------------------


def test_leaked_sockets_are_reported(cell):
    text = """MODULE work
        VAR socketdev s{40};
        VAR num made := 0;
        PROC main()
            FOR i FROM 1 TO 40 DO
                SocketCreate s{i};
                made := i;
            ENDFOR
        ERROR
            IF ERRNO = ERR_SOCK_UNSPEC Stop;
        ENDPROC
    ENDMODULE"""
    with make(text) as c:
        c.run_for(1)
        assert c.task("T_ROB1")["work:made"] == 32


def test_the_same_seed_gives_the_same_run():
    def trace():
        with make() as c:
            seen = []
            c.log.subscribe(lambda event: seen.append(str(event)))
            c.run_for(5)
            c.perform("power-loss")
            return c.scheduler.now, c.scheduler.switches, seen, c.task("T_ROB1")["work:passes"]

    assert trace() == trace()


def test_a_record_without_components_is_a_finding(tmp_path):
    """Found with Modula text in a .mod file: it was an internal fault."""
    path = tmp_path / "modula.mod"
    path.write_text("MODULE m\nRECORD r\nENDRECORD\nPROC main()\nENDPROC\nENDMODULE\n")
    with pytest.raises(DiagnosticError) as raised:
        VirtualController.from_files([path])
    assert raised.value.diagnostics[0].code == "RG201"


@pytest.mark.parametrize(("output", "released"), [("reset", 1), ("button", 0)])
def test_em_stop_is_high_until_the_emergency_stop_is_reset(output, released):
    """No source: switch `e_stop_output`. 20148 is in the log of an IRB 120 with 5.15."""
    system = System(
        "cell",
        (),
        signals=(SignalSpec("doStop", "DO"), SignalSpec("diReset", "DI")),
        outputs=(SystemOutput("EmStop", "doStop"),),
        inputs=(SystemInput("ResetEstop", "diReset"),),
    )
    switches = replace(Switches(), e_stop_output=output)
    with VirtualController(system, (), dialect=switches) as cell:

        def reset():
            cell.signals["diReset"] = 0
            cell.signals["diReset"] = 1

        cell.perform("e-stop")
        reset()
        assert cell.signals["doStop"] == 1
        assert [event.code for event in cell.log][-1] == 20148
        cell.perform("release-e-stop")
        assert cell.signals["doStop"] == released
        assert cell.operation.e_stop
        reset()
        assert cell.signals["doStop"] == 0
        assert not cell.operation.e_stop

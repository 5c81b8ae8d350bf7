"""The controller from outside: stops, modes, faults, values, real time."""

import threading
from dataclasses import replace

import pytest

from rapidgen.controller import Deadlock, VirtualController
from rapidgen.diagnostics import DiagnosticError, Severity
from rapidgen.system.model import (
    ModuleFile,
    SignalSpec,
    System,
    SystemOutput,
    TaskSpec,
)
from tests.runtime.booting import boot, system

COUNT = """
  PERS num n := 0;
  VAR num v := 7;
  CONST num C := 3;
  VAR pos p := [1,2,3];
  PROC main()
    WHILE TRUE DO
      n := n + 1;
      WaitTime 0.1;
    ENDWHILE
  ENDPROC
"""


WAITING = """
  PROC main()
    WaitTime 0.1;
  ENDPROC
"""


def codes(controller: VirtualController) -> list[int]:
    return [event.code for event in controller.log]


def test_values_by_name() -> None:
    controller, _ = boot(COUNT)
    with controller:
        task = controller.task("T1")
        assert (task["m:n"], task["M:V"], task["c"], task["p"].y) == (0, 7, 3, 2)
        task["m:v"] = 0.1
        assert task["v"] == pytest.approx(0.1, abs=1e-8)
        assert task["v"] != 0.1  # stored as IEEE single
        with pytest.raises(KeyError):
            task["c"] = 4
        for name in ("m:nothing", "x:n", "nothing"):
            with pytest.raises(KeyError):
                task[name]


def test_setting_a_pers_from_outside_wakes_the_program() -> None:
    controller, printed = boot(
        """
  PERS bool go := FALSE;
  PROC main()
    WaitTestAndSet go;
    WaitTestAndSet go;
    TPWrite "went";
  ENDPROC
""",
        cycle="once",
    )
    with controller:
        controller.start_program()
        with pytest.raises(Deadlock, match=r"T1\.mod:6"):
            controller.run_until(lambda: bool(printed))
        controller.task("T1")["go"] = False
        assert controller.run_until(lambda: bool(printed), timeout=1)


def test_start_after_stop_continues() -> None:
    controller, _ = boot(COUNT)
    with controller:
        controller.start_program()
        controller.run_for(1.0)
        controller.stop_program()
        controller.run_for(0.01)
        n = controller.task("T1")["n"]
        assert controller.task("T1").state == "stopped"
        controller.run_for(5)
        assert controller.task("T1")["n"] == n
        controller.start_program()
        controller.run_for(1.05)
        assert controller.task("T1")["n"] == n + 10


def test_emergency_stop_needs_reset_and_motors_on() -> None:
    controller, _ = boot(COUNT)
    with controller:
        controller.start_program()
        controller.run_for(1)
        controller.perform("e-stop")
        controller.run_for(1)
        n = controller.task("T1")["n"]
        assert controller.task("T1").state == "stopped"
        assert not controller.start_program()
        controller.perform("reset-e-stop")
        assert not controller.start_program()
        controller.perform("motors-on")
        assert controller.start_program()
        controller.run_for(1)
        assert controller.task("T1")["n"] > n
        assert {10_013, 10_010, 10_011, 20_072, 20_075} <= set(codes(controller))


FAULT = """
  PROC main()
    VAR num z;
    WaitTime 1;
    z := 1 / z;
  ENDPROC
"""


@pytest.mark.parametrize(
    ("trust", "normal", "startable"),
    [
        ("NoSafety", "running", True),
        ("SysStop", "stopped", True),
        ("SysHalt", "stopped", False),
        ("SysFail", "stopped", False),
    ],
)
def test_trust_levels(trust: str, normal: str, startable: bool) -> None:
    """[S4 overview 4-45]"""
    controller, _ = boot(COUNT, FAULT, specs={"T2": {"type": "SEMISTATIC", "trust": trust}})
    with controller:
        controller.start_program()
        controller.run_for(2)
        assert controller.task("T2").state == "error"
        assert controller.task("T1").state == normal
        assert controller.motors_on == startable
        assert controller.start_program() == startable
        controller.set_motors(True)
        assert controller.start_program() == (trust != "SysFail")
        assert 194_199 in codes(controller)


@pytest.mark.parametrize("trust", ["SysHalt", "SysFail"])
def test_system_halt_leaves_motors_off(trust: str) -> None:
    """[S4 overview 4-45]: the outputs report it, and actions are rejected."""
    spec = {"T2": {"type": "STATIC", "trust": trust}}
    signals, outputs = (SignalSpec("doMotors", "DO"),), (SystemOutput("MotorOn", "doMotors"),)
    halting = replace(system({"T1": COUNT, "T2": FAULT}, signals=signals, **spec), outputs=outputs)
    with VirtualController(halting) as controller:
        controller.run_for(0.5)
        assert controller.signals["doMotors"] == 1
        controller.run_for(1)
        assert controller.signals["doMotors"] == 0
        assert controller.execution_error


@pytest.mark.parametrize(
    ("mode", "event"), [("manual_reduced", 10_015), ("manual_full", 10_015), ("auto", 10_017)]
)
def test_mode_change_stops_program_and_motors(mode: str, event: int) -> None:
    controller, _ = boot(COUNT)
    with controller:
        if mode == "auto":
            controller.set_mode("manual_reduced")
            controller.set_motors(True)
        controller.start_program()
        controller.run_for(1)
        controller.set_mode(mode)
        assert (controller.mode, controller.motors_on) == (mode, False)
        assert controller.task("T1").state == "stopped"
        assert event in codes(controller)
        assert not controller.start_program()
        controller.set_motors(True)
        assert controller.start_program()


def test_current_mode_has_no_effect() -> None:
    controller, _ = boot(COUNT)
    with controller:
        controller.start_program()
        controller.set_mode("auto")
        assert controller.motors_on
        assert controller.task("T1").state == "running"
        with pytest.raises(ValueError, match="auto, manual_reduced, manual_full"):
            controller.set_mode("manual")


def test_a_fault_names_event_module_line_and_call_stack() -> None:
    controller, _ = boot(
        """
  PROC main()
    outer;
  ENDPROC
  PROC outer()
    inner 0;
  ENDPROC
  PROC inner(num z)
    z := 1 / z;
  ENDPROC
"""
    )
    with controller:
        controller.start_program()
        controller.run_for(0.1)
        fault = controller.task("T1").fault
        assert fault is not None
        assert [(p.routine, p.span.line) for p in fault.stack] == [
            ("main", 4),
            ("outer", 7),
            ("inner", 10),
        ]
        event = next(e for e in controller.log if e.code == 194_199)
        assert event.task == "T1"
        assert "m/inner/10" in event.texts[0]


def test_a_generated_module_points_to_its_template() -> None:
    text = b"MODULE m\nPROC main()\n VAR num z;\n z := 1 / z;\nENDPROC\nENDMODULE\n"
    file = ModuleFile("m", "m.mod", text, origin=((1, "a.j2", 10), (4, "b.j2", 3)))
    with VirtualController(System("s", (TaskSpec("T1", modules=(file,)),))) as controller:
        controller.run_for(0.1)
        assert controller.task("T1").fault.stack[-1].origin == ("b.j2", 3)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("MODULE m\nPROC main(\nENDMODULE", "RG201"),
        ("MODULE m\nPROC start()\nENDPROC\nENDMODULE", "RG402"),
        ("MODULE m\nVAR num x{2} := [1,2,3];\nPROC main()\nENDPROC\nENDMODULE", "RG401"),
        (
            "MODULE m\nCONST num a := b;\nCONST num b := a;\nPROC main()\nENDPROC\nENDMODULE",
            "RG401",
        ),
    ],
)
def test_faulty_module_is_reported(text: str, code: str) -> None:
    file = ModuleFile("m", "m.mod", text.encode())
    with pytest.raises(DiagnosticError) as caught:
        VirtualController(System("s", (TaskSpec("T1", modules=(file,)),)))
    assert code in {d.code for d in caught.value.diagnostics}


def task(name: str, *bodies: str) -> TaskSpec:
    files = (
        ModuleFile(f"{name}{i}", f"{name}{i}.mod", f"MODULE {name}{i}\n{text}\nENDMODULE".encode())
        for i, text in enumerate(bodies)
    )
    return TaskSpec(name, modules=tuple(files))


def test_two_entry_routines_are_in_the_way_of_their_task_only() -> None:
    """RobotWare 7.21: "Global routine name main ambiguous".

    The error occurs only at the start of that task.
    """
    main = 'PROC main()\nTPWrite "main";\nENDPROC'
    system = System("s", (task("T1", main, main), task("T2", main)))
    with VirtualController(system, autostart=False, cycle="once") as controller:
        assert [(d.code, d.severity) for d in controller.diagnostics] == [
            ("RG402", Severity.WARNING)
        ]
        controller.start_program()
        controller.run(max_time=1)
        assert (controller.task("T1").state, controller.task("T2").state) == ("empty", "finished")
        message = next(e for e in controller.log if e.task == "T1")
        assert message.texts == ("Global routine name main ambiguous",)


def test_a_backup_without_an_entry_routine_boots() -> None:
    """[backup]: controllers save them so, and wait for a program."""
    complete = System("s", (task("T1", "VAR num n;"),), robot_types={"ROB_1": "IRB 120"})
    with VirtualController(complete) as controller:
        assert [d.severity for d in controller.diagnostics] == [Severity.WARNING]
        assert controller.task("T1").state == "empty"


def test_missing_routine_is_reported_and_stops_task() -> None:
    controller, printed = boot('PROC main()\n TPWrite "x";\n FCRefStart;\n missing;\nENDPROC')
    with controller:
        assert {d.code for d in controller.diagnostics} == {"RG403", "RG404"}
        controller.start_program()
        controller.run_for(1)
        assert printed == ["x"]
        assert controller.task("T1").fault.event == 194_001


def test_two_tasks_may_not_share_a_pers_of_two_types() -> None:
    """[S4 overview 4-44]"""
    with pytest.raises(DiagnosticError, match="another type"):
        boot(
            "PERS num n := 0;\nPROC main()\nENDPROC", "PERS bool n := FALSE;\nPROC main()\nENDPROC"
        )


def test_the_first_declaration_with_a_value_counts() -> None:
    """[K §14.4]"""
    body = "\nPROC main()\nENDPROC"
    controller, _ = boot(f"PERS num n;{body}", f"PERS num n := 5;{body}", f"PERS num n := 6;{body}")
    with controller:
        assert [t["n"] for t in controller.tasks.values()] == [5, 5, 5]


def test_real_time_in_a_thread() -> None:
    controller, printed = boot(
        'PROC main()\n TPWrite "tick";\n WaitTime 0.02;\nENDPROC', clock="real"
    )
    seen = threading.Event()
    with controller:
        controller.operator.subscribe(lambda *_: seen.set() if len(printed) > 3 else None)
        controller.start_program()
        controller.start()
        assert seen.wait(60)
        assert controller.call(lambda: controller.task("T1").state) == "running"
        controller.stop()
        count = len(printed)
    assert len(printed) == count

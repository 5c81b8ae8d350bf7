"""Event routines (CAB_EXEC_HOOKS) of a whole system.

The rest: conformance/operation.
"""

from dataclasses import replace

from rapidgen.controller import VirtualController
from rapidgen.system.model import EventRoutine, SignalSpec, SystemInput
from tests.runtime.booting import system

MAIN = 'PROC main()\n TPWrite "main";\n WaitTime 9;\nENDPROC\n'


def test_start_main_by_a_signal() -> None:
    base = system({"T1": MAIN}, signals=(SignalSpec("di", "DI"),))
    printed: list[str] = []
    with VirtualController(replace(base, inputs=(SystemInput("StartMain", "di"),))) as controller:
        controller.operator.subscribe(lambda _, text: printed.append(text))
        controller.run_for(0.5)
        controller.signals["di"] = 1
        controller.run_for(0.5)
        assert printed == ["main", "main"]


def test_routines_of_all_motion_tasks() -> None:
    """-AllMotionTask [code]"""
    routine = 'PROC started()\n TPWrite "START";\nENDPROC\n'
    base = system({"T1": MAIN, "T2": routine + MAIN}, T2={"motion": True})
    hooks = (EventRoutine("started", "Start", "", True), EventRoutine("missing", "START", "T2"))
    printed: list[str] = []
    with VirtualController(replace(base, events=hooks), autostart=False) as controller:
        controller.operator.subscribe(lambda task, text: printed.append(f"{task} {text}"))
        controller.start_program()
        controller.run_for(0.1)
    assert printed == ["T1 main", "T2 START", "T2 main"]

"""A name that nobody declares: the task stops with the name in the event [K §12]."""

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.system.model import ModuleFile, System, TaskSpec


@pytest.mark.parametrize(
    ("body", "error"),
    [
        ("nowhere;", "ERR_REFUNKPRC"),
        ("n := nowhere();", "ERR_REFUNKFUN"),
        ("n := nowhere + 1;", "ERR_REFUNKDAT"),
        ("CONNECT i WITH nowhere;", "ERR_REFUNKTRP"),
    ],
)
def test_the_event_says_which(body, error):
    text = f"MODULE m\nVAR intnum i;\nVAR num n;\nPROC main()\n{body}\nENDPROC\nENDMODULE\n"
    task = TaskSpec("T_ROB1", modules=(ModuleFile("m", "m.mod", text.encode()),))
    with VirtualController(System("unknown", (task,)), cycle="once") as controller:
        controller.run(max_time=1)
        fault = controller.task("T_ROB1").fault
        assert fault is not None
        assert fault.arguments == (error, "nowhere")

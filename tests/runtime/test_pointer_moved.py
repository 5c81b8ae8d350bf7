"""The path after a moved program pointer.

The rest: conformance/operation.
"""

from copy import copy

import pytest

from rapidgen.config import load_config
from rapidgen.motion.modal import ModalSettings
from tests.runtime.booting import boot


@pytest.mark.parametrize("move", ["routine", "statement"])
def test_the_path_is_gone(move: str) -> None:
    targets = "".join(
        f"CONST jointtarget {name} := [[{angle},0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        for name, angle in (("a", 60), ("b", -60))
    )
    text = (
        f"{targets}PROC main()\n VelSet 50, 1000;\n MoveAbsJ a, v200, fine, tool0;\n"
        " there;\nENDPROC\nPROC there()\n MoveAbsJ b, v1000, fine, tool0;\nENDPROC"
    )
    controller, _ = boot(
        text, robots=load_config("irb120").groups, specs={"T1": {"motion": True}}, cycle="once"
    )
    with controller:
        task, group = controller.task("T1"), controller.motion.group("rob1")
        controller.start_program()
        controller.run_for(1)
        controller.stop_program()
        controller.run_for(1)
        settings = copy(group.modal)
        assert settings != ModalSettings()
        assert 0.05 < group.positions()[0] < 1
        assert task.place is not None
        if move == "routine":
            task.pp_to_routine("there")
        else:
            task.pp_to_statement(task.place.span.line + 1)
        controller.start_program()
        highest = group.positions()[0]
        controller.run_for(0.05)
        while task.state == "running":
            controller.run_for(0.05)
            assert group.positions()[0] <= highest + 1e-6
        assert group.positions()[0] == pytest.approx(-1.0472, abs=1e-3)
        assert group.modal == settings

"""Planner faults in scheduler events stop the program by name.

They occur between two statements, where no handler receives them.
"""

import pytest

from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from tests.runtime.booting import boot

PROGRAM = """
PROC main()
 VAR num n;
 WHILE n < 100000 DO
  n := n + 1;
 ENDWHILE
ENDPROC
"""


@pytest.mark.parametrize(
    ("refusal", "title"),
    [
        (FaultReason.OUT_OF_REACH_IN_CORNER, "Position out of reach"),
        (FaultReason.SINGULARITY, "Close to singularity"),
    ],
)
def test_a_refusal_in_an_event(refusal: FaultReason, title: str) -> None:
    controller, _ = boot(PROGRAM, cycle="once")
    with controller:

        def refuse() -> None:
            raise MotionFault(refusal)

        controller.start_program()
        controller.scheduler.after(1_000_000, refuse)
        controller.run(max_time=10)
        task = controller.task("T1")
        assert task.state == "error"
        assert task.fault is not None
        assert task.fault.title == title

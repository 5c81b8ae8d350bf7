"""What a task may do, and what it does to the others."""

from rapidgen.config import load_config
from tests.runtime.booting import boot


def test_a_move_in_a_background_task_stops_it() -> None:
    """Moves are a motion task's [S4 overview 4-48]."""
    target = "[[10,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    controller, _ = boot(
        "PROC main()\n WaitTime 9;\nENDPROC",
        f"PROC main()\n MoveAbsJ {target}, v100, fine, tool0;\nENDPROC",
        robots=load_config("irb120").groups,
        specs={"T1": {"motion": True}, "T2": {"type": "SEMISTATIC", "trust": "NoSafety"}},
    )
    with controller:
        controller.start_program()
        controller.run_for(1)
        assert [t.state for t in controller.tasks.values()] == ["running", "error"]
        assert controller.motion.group("rob1").positions()[0] == 0

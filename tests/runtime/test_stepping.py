"""Statement by statement [K §6, S4 overview 4-39].

The rest: conformance/steps.
"""

import pytest

from rapidgen.config import load_config
from rapidgen.motion import MotionSettings
from tests.runtime.booting import boot

WAY = """
  CONST robtarget a := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ home, v1000, z50, tool0;
    MoveL Offs(a,0,100,0), v500, z20, tool0;
    MoveC Offs(a,50,150,0), Offs(a,0,200,0), v500, z20, tool0;
    MoveJ Offs(a,-50,0,-50), v1000, z50, tool0;
    WaitTime 1;
  ENDPROC
"""


def test_steps_take_the_time_of_the_program() -> None:
    text = "PROC main()\n WaitTime 1;\n WaitTime 0.5;\nENDPROC"
    times = []
    for stepwise in (False, True):
        controller, _ = boot(text, accounting="statement", cycle="once")
        task = controller.task("T1")
        with controller:
            if not stepwise:
                controller.start_program()
            while task.state != "finished":
                if stepwise and task.state != "running":
                    task.step()
                before = controller.now
                controller.run_until(lambda task=task: task.state != "running")
                times.append(controller.now - before)
    assert times[0] == pytest.approx(1.50001, abs=2e-5)
    assert sum(times[1:]) == pytest.approx(times[0], abs=3e-5)


def test_moves_are_driven_back_on_their_way() -> None:
    """[S4 2-SearchL-6] backward, a move executes the movement."""
    robots = load_config("irb120").groups
    controller, _ = boot(WAY, robots=robots, specs={"T1": {"motion": True}}, cycle="once")
    with controller:
        task, group = controller.task("T1"), controller.motion.group("rob1")
        # Smoothing would bring the TCP inside the circle by a millimetre.
        controller.motion.settings = MotionSettings(ramp_time=0.0)

        def step(**how: bool) -> list[tuple[float, ...]]:
            """Places of the TCP on the way, mm."""
            places = []
            task.step(**how)
            while task.state == "running":
                controller.run_for(0.01)
                places.append(
                    tuple(1000 * v for v in group.geometry().forward(group.positions())[0])
                )
            return places

        def line() -> int:
            assert task.place is not None
            return task.place.span.line

        stood = [group.positions()]
        for _ in range(4):
            step()
            stood.append(group.positions())
        assert line() == 10
        ways = []
        for k in (3, 2, 1, 0):
            ways.append(step(back=True))
            assert group.positions() == pytest.approx(stood[k], abs=1e-6)
            assert line() == 6 + k
        assert not any(event.code == 10_128 for event in controller.log)
        # The circle through (50, 150) about (0, 150), and the line with x and z as they were.
        for x, y, _ in ways[1]:
            assert (x - 364.354) ** 2 + (y - 150) ** 2 == pytest.approx(50**2, rel=1e-2)
        for x, _, z in ways[2]:
            assert (x, z) == pytest.approx((364.354, 594), abs=0.05)
        step()
        assert line() == 7
        assert group.positions() == pytest.approx(stood[1], abs=1e-6)

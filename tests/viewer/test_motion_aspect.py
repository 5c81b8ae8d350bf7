"""Robots put elsewhere by hand, without a page."""

import math

import pytest

from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.runner import ControllerRunner
from rapidgen.viewer.messages import Jog, JogBy, JogTo
from rapidgen.viewer.provider import RequestRejected
from rapidgen.viewer.simulator.motion import MotionProvider

AT_THE_LIMIT = """MODULE Far
  PROC main()
    MoveAbsJ [[0,0,0,0,100.3,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
  ENDPROC
ENDMODULE
"""
WITH_A_TOOL = """MODULE Held
  PERS tooldata grip := [TRUE, [[0,0,120],[1,0,0,0]], [1,[0,0,60],[1,0,0,0],0,0,0]];
  CONST robtarget pick := [[10,20,50],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS wobjdata table := [FALSE, TRUE, "", [[300,0,100],[1,0,0,0]], [[0,0,0],[1,0,0,0]]];
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, grip;
    MoveL pick, v500, fine, grip \\WObj:=table;
    WaitTime 1000;
  ENDPROC
ENDMODULE
"""


def test_a_robot_that_is_jogged_keeps_its_tool(tmp_path):
    """It was that of the flange afterwards: the next jog to a TCP went 120 mm too far."""
    module = tmp_path / "held.mod"
    module.write_text(WITH_A_TOOL)
    target = load_target([str(module)], BootOptions(robot="irb120"))
    with ControllerRunner.boot(target, clock="virtual") as controller_runner:
        controller_runner.controller.run_for(20)
        controller_runner.controller.stop_program()
        controller_runner.controller.run_for(1)
        aspect = MotionProvider(controller_runner)
        handlers = aspect.handlers()
        (name,) = controller_runner.controller.motion.groups

        def displayed():
            _, positions = aspect.whole()
            return positions.groups[0]

        axes = list(controller_runner.controller.motion.groups[name].positions())
        axes[0] += 0.1
        handlers[Jog](Jog(group=name, axes=tuple(axes)))
        assert displayed().tool.position == pytest.approx((0, 0, 0.12))
        assert displayed().work_object.position == pytest.approx((0.3, 0, 0.1))
        for place in ((0.31, 0.02, 0.15), (0.3, 0.05, 0.16)):
            tcp = displayed().tcp
            handlers[JogTo](JogTo(group=name, position=place, orientation=tcp.orientation))
            assert displayed().tcp.position == pytest.approx(place)
            assert displayed().tool.position == pytest.approx((0, 0, 0.12))
        # What is not asked for stays.
        here = displayed()
        position = (here.tcp.position[0], 0.06, here.tcp.position[2])
        handlers[JogTo](JogTo(group=name, position=(None, 0.06, None), orientation=None))
        assert displayed().tcp.position == pytest.approx(position)
        assert displayed().tcp.orientation == pytest.approx(here.tcp.orientation)
        here = displayed().axes
        handlers[Jog](Jog(group=name, axes=(None, None, None, None, None, 0.3)))
        assert displayed().axes == pytest.approx((*here[:5], 0.3))


def test_steps_follow_the_axes_of_the_frame(tmp_path):
    """Tool z points down here, and the work object is turned by 90 degrees about z."""
    module = tmp_path / "held.mod"
    turned = "[[300,0,100],[0.70710678,0,0,0.70710678]]"
    module.write_text(
        WITH_A_TOOL.replace("[[300,0,100],[1,0,0,0]]", turned).replace("[10,20,50]", "[20,-10,50]")
    )
    target = load_target([str(module)], BootOptions(robot="irb120"))
    with ControllerRunner.boot(target, clock="virtual") as runner:
        runner.controller.run_for(20)
        aspect = MotionProvider(runner)
        (name,) = runner.controller.motion.groups

        def displayed():
            _, positions = aspect.whole()
            return positions.groups[0]

        assert "stop it first" in displayed().blocked
        runner.controller.stop_program()
        runner.controller.run_for(1)
        assert displayed().blocked == ""
        by, to = aspect.handlers()[JogBy], aspect.handlers()[JogTo]
        x, y, z = displayed().tcp.position
        for frame, axis, moved in (
            ("base", 0, (x + 0.01, y, z)),
            ("work_object", 0, (x + 0.01, y + 0.01, z)),
            ("tool", 2, (x + 0.01, y + 0.01, z - 0.01)),
        ):
            by(JogBy(group=name, frame=frame, axis=axis, distance=0.01))
            assert displayed().tcp.position == pytest.approx(moved, abs=1e-6)
        before = displayed().tcp
        by(JogBy(group=name, frame="base", axis=2, angle=0.1))
        after = displayed().tcp
        assert after.position == pytest.approx(before.position, abs=1e-6)
        cosine = abs(sum(a * b for a, b in zip(before.orientation, after.orientation, strict=True)))
        assert cosine == pytest.approx(math.cos(0.05), abs=1e-6)
        # x of the work object is y of the world.
        to(JogTo(group=name, frame="work_object", position=(0.03, None, None), orientation=None))
        assert displayed().tcp.position[1] == pytest.approx(0.03, abs=1e-6)
        with pytest.raises(RequestRejected, match="does not reach"):
            by(JogBy(group=name, frame="base", axis=0, distance=1.0))


def test_a_robot_that_stands_at_its_limit_is_jogged(tmp_path):
    """The num 100.3 of its program is a little more than the 100.3 of its configuration."""
    cell, module = tmp_path / "cell.yaml", tmp_path / "far.mod"
    cell.write_text("model: irb120\njoints: {joint_5: {upper: 100.3}}\n")
    module.write_text(AT_THE_LIMIT)
    target = load_target([str(module)], BootOptions(robot=str(cell)))
    with ControllerRunner.boot(target, clock="virtual") as controller_runner:
        controller = controller_runner.controller
        controller.run_for(20)
        controller.stop_program()
        controller.run_for(1)
        (group,) = controller.motion.groups.values()
        here = list(group.positions())
        assert here[4] > math.radians(100.3)
        aspect = MotionProvider(controller_runner)
        jog = aspect.handlers()[Jog]
        here[0] = 0.2
        jog(Jog(group=group.name, axes=tuple(here)))
        assert group.positions() == pytest.approx(here)
        here[4] = math.radians(100.4)
        with pytest.raises(RequestRejected, match="joint_5 would leave its range"):
            jog(Jog(group=group.name, axes=tuple(here)))

"""Robots put elsewhere by hand, without a page."""

import math

import pytest

from rapidgen.controller.booting import Wishes, load_target
from rapidgen.controller.cabinet import Cabinet
from rapidgen.view.aspect import Declined
from rapidgen.view.messages import Jog
from rapidgen.view.simulator.motion import MotionAspect

AT_THE_LIMIT = """MODULE Far
  PROC main()
    MoveAbsJ [[0,0,0,0,100.3,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
  ENDPROC
ENDMODULE
"""


def test_a_robot_that_stands_at_its_limit_is_jogged(tmp_path):
    """The num 100.3 of its program is a little more than the 100.3 of its configuration."""
    cell, module = tmp_path / "cell.yaml", tmp_path / "far.mod"
    cell.write_text("model: irb120\njoints: {joint_5: {upper: 100.3}}\n")
    module.write_text(AT_THE_LIMIT)
    target = load_target([str(module)], Wishes(robot=str(cell)))
    with Cabinet.boot(target, clock="virtual") as cabinet:
        controller = cabinet.controller
        controller.run_for(20)
        controller.stop_program()
        controller.run_for(1)
        (group,) = controller.motion.groups.values()
        here = list(group.positions())
        assert here[4] > math.radians(100.3)
        aspect = MotionAspect(cabinet)
        jog = aspect.handlers()[Jog]
        here[0] = 0.2
        jog(Jog(group=group.name, axes=tuple(here)))
        assert group.positions() == pytest.approx(here)
        here[4] = math.radians(100.4)
        with pytest.raises(Declined, match="joint_5 would leave its range"):
            jog(Jog(group=group.name, axes=tuple(here)))

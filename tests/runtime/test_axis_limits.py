"""Axis limits in the configuration: a switch, without a manual."""

import pytest

from rapidgen.config import load_config
from rapidgen.rapid.switches import Switches
from tests.runtime.booting import boot

ASKS = """
    PROC main()
        VAR num bound;

        ReadCfgData "/MOC/ARM/{arm}", "upper_joint_bound", bound;
        TPWrite NumToStr(bound, 3);
        EXIT;
    ERROR
        IF ERRNO = ERR_CFG_NOTFND TPWrite "not found";
        EXIT;
    ENDPROC
"""


@pytest.mark.parametrize(
    ("robot", "arm", "bound"),
    [
        # rob1_1 [backups], rob_R_7 and "MOC/ARM/rob_R_1" [code: a public YuMi server], an axis
        # named as its unit [backups: M7DM1].
        ("irb120", "rob1_1", "2.880"),
        ("irb14000", "rob_R_7", "2.941"),
        ("irb14000", "rob_L_3", "1.396"),
        ("irb120_track", "TRACK_1", "3.000"),
        ("irb910sc", "rob1_3", "0.000"),
    ],
)
def test_the_limits_of_the_axes(robot, arm, bound):
    groups = load_config(robot).groups
    for report in (True, False):
        controller, printed = boot(
            ASKS.replace("{arm}", arm), robots=groups, dialect=Switches(axis_limits_readable=report)
        )
        controller.start_program()
        controller.run_for(1)
        assert printed == [bound if report else "not found"]
        controller.close()

"""ReadCfgData and WriteCfgData on a controller with the cfg of a backup.

Error names: 3HAC16581-1 [manual]. Attributes: backups of RobotWare 6 with a track (EBRUUN).
"""

import pytest

from rapidgen.config import load_config
from rapidgen.system import parse_cfg
from rapidgen.system.controller_cfg import ControllerCfg
from tests.runtime.booting import boot

MOC = """MOC:CFG_1.0:6:0::
#
ROBOT:

      -name "ROB_1" -use_robot_type "ROB1_120_0.58_3" -use_joint_0 "rob1_1"
#
ARM:

      -name "rob1_1" -upper_joint_bound 2.5 -lower_joint_bound -2.5
"""
CFG = ControllerCfg((6, 6), (parse_cfg("SYS:CFG_1.0:6:0::\n"), parse_cfg(MOC)))
READ = """
    PROC main()
        VAR {kind} value;

        {statement}
        TPWrite ValToStr(value);
        EXIT;
    ERROR
        TEST ERRNO
        CASE ERR_CFG_NOTFND:
            TPWrite "not found";
        CASE ERR_CFG_ILLTYPE:
            TPWrite "type";
        CASE ERR_CFG_INTERNAL:
            TPWrite "internal";
        ENDTEST
        EXIT;
    ENDPROC
"""


@pytest.mark.parametrize(
    ("kind", "statement", "answer"),
    [
        ("string", 'ReadCfgData "/MOC/ROBOT/ROB_1", "use_joint_0", value;', '"rob1_1"'),
        ("string", 'ReadCfgData "/MOC/JOINT/rob1_1", "use_arm", value;', '"rob1_1"'),
        ("num", 'ReadCfgData "/MOC/ROBOT/ROB_1", "base_frame_orient_u0", value;', "1"),
        ("num", 'ReadCfgData "/MOC/ROBOT/ROB_1", "gravity_beta", value;', "0"),
        ("num", 'ReadCfgData "/SYS/SYS_MISC/ModalPayLoadMode", "Value", value;', "not found"),
        ("num", 'ReadCfgData "/MOC/ROBOT/ROB_1", "base_mass", value;', "not found"),
        ("num", 'ReadCfgData "/MOC/ROBOT/ROB_1", "use_joint_0", value;', "type"),
        (
            "num",
            'WriteCfgData "/MOC/ARM/rob1_1", "upper_joint_bound", 2; '
            'ReadCfgData "/MOC/ARM/rob1_1", "upper_joint_bound", value;',
            "2",
        ),
        ("num", 'WriteCfgData "/MOC/JOINT/rob1_1", "logical_axis", 2;', "internal"),
        ("bool", 'ReadCfgData "/MOC/ROBOT/ROB_1", "use_old_smb", value;', "FALSE"),
    ],
)
def test_the_cfg_of_a_backup_is_read_and_written(kind, statement, answer):
    text = READ.replace("{kind}", kind).replace("{statement}", statement)
    controller, printed = boot(text, robots=load_config("irb120").groups, cfg=CFG)
    controller.start_program()
    controller.run_for(1)
    assert printed == [answer]
    controller.close()

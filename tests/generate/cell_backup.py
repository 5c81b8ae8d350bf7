"""A backup as controllers write them, of one robot whose motion task has a name of its own.

PAULA's and VInRoS's shape; the file with -AllTask is in every backup up to RobotWare 6.
"""

SYS = """SYS:CFG_1.0:6:0::
CAB_TASKS:
  -Name "T_MOVE" -Type "NORMAL" -MotionTask
  -Name "T_PLC" -TrustLevel "None"
CAB_TASK_MODULES:
  -File "HOME:/user.sys" -ModName "user" -AllTask
CAB_EXEC_HOOKS:
  -Routine "theirs" -Shelf "STOP" -Task "T_MOVE" -SeqNo 50
"""
EIO = """EIO:CFG_1.0:6:1::
EIO_SIGNAL:
  -Name "SIGNALMOTORON" -SignalType "DO" -Category "cell"
SYSSIG_OUT:
  -Status "MotOnState" -Signal "signalMotorOn"
"""
MOC = """MOC:CFG_1.0:6:0::
MOTION_PLANNER:
  -name "motion_planner_1"
ROBOT:
  -name "ROB_1" -use_robot_type "ROB1_120_0.58_3"
SINGLE:
  -name "TRACK_1"
"""
MAIN = "MODULE theirs\n  PROC main()\n    ROS_run;\n  ENDPROC\nENDMODULE\n"
PLC = "MODULE plc\n  PROC main()\n    WaitTime 1;\n  ENDPROC\nENDMODULE\n"
USER = "MODULE user(SYSMODULE)\n  PERS num n_user:=1;\nENDMODULE\n"


def write_backup(folder):
    """The backup, in `folder`."""
    for path, text in {
        "SYSPAR/SYS.cfg": SYS,
        "SYSPAR/EIO.cfg": EIO,
        "SYSPAR/MOC.cfg": MOC,
        "BACKINFO/backinfo.txt": "RobotWare Version: 6.07.00.00\n",
        "RAPID/TASK1/PROGMOD/theirs.mod": MAIN,
        "RAPID/TASK2/PROGMOD/plc.mod": PLC,
        "HOME/user.sys": USER,
    }.items():
        place = folder / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    return folder

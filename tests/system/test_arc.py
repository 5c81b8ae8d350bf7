"""PROC.cfg of a backup: what arc welding equipment has for signals."""

from rapidgen.system.backup import read_backup
from rapidgen.system.cfg import parse_cfg
from rapidgen.system.cfg_reader import arc_signals

PROC = r"""PROC:CFG_1.0:6:0::
#
ARC_SYSTEM_PROP:
      -name "ARC1" -units "WELD_UNITS"
#
ARC_EQUIP_IO_DI:
      -name "stdIO_T_ROB1" -ArcEst "diArcStable"
#
ARC_EQUIP_IO_DO:
      -name "stdIO_T_ROB1" -GasOn "" -WeldOn "doArcOn"\
      -FeedOn "doFeed"
      -name "stdIO_T_ROB2" -WeldOn "doArcOn2"
#
ARC_EQUIP_IO_GO:
      -name "stdIO_T_ROB1" -SchedulePort "goJob"
"""
SYS = """SYS:CFG_1.0:6:0::
#
CAB_TASKS:
      -Name "T_ROB1" -Type "NORMAL" -Entry "main" -MotionTask
"""


def test_signals_by_instance_and_use():
    one, two = arc_signals(parse_cfg(PROC))
    assert (one.instance, two.instance) == ("stdIO_T_ROB1", "stdIO_T_ROB2")
    assert dict(one.names) == {
        "ArcEst": "diArcStable",
        "WeldOn": "doArcOn",
        "FeedOn": "doFeed",
        "SchedulePort": "goJob",
    }


def test_signals_of_a_backup(tmp_path):
    (tmp_path / "SYSPAR").mkdir()
    (tmp_path / "SYSPAR" / "SYS.cfg").write_text(SYS)
    assert read_backup(tmp_path).arc == ()
    (tmp_path / "SYSPAR" / "PROC.cfg").write_text(PROC)
    assert [signals.instance for signals in read_backup(tmp_path).arc] == [
        "stdIO_T_ROB1",
        "stdIO_T_ROB2",
    ]

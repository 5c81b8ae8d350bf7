"""Externally guided motion of a backup: partners and known devices."""

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.motion.egm.law import Profile
from rapidgen.system.backup import read_backup
from rapidgen.system.model import UdpDevice

SYS = """SYS:CFG_1.0:6:1::
#
CAB_TASKS:
      -Name "T_ROB1" -Type "NORMAL" -Entry "main" -MotionTask
"""
# RobotWare 6.03 of a YuMi: the parameter's name has one d.
SIX = r"""SIO:CFG_1.0:6:1::
#
COM_TRP:
      -Name "TCPIP1" -Type "TCP/IP" -PhyChannel ""
      -Name "EGMsensor" -Type "UDPUC" -RemoteAdress "192.168.1.10"\
      -RemotePortNumber 6511
"""
# RobotWare 7.6 of a GoFa.
SEVEN = r"""SIO:CFG_1.0:7:0::
#
UDPUC_HOST:
      -Name "UCdevice" -Type "UDPUC" -RemoteAddress "127.0.0.1"
      -Name "ROB_1" -Type "UDPUC" -RemoteAddress "192.168.125.22"\
      -RemotePortNumber 6511 -LocalPortNumber 0
"""
MODULE = r"""MODULE m
CONST egm_minmax near := [-0.5, 0.5];
VAR egmident id;
PROC main()
EGMGetId id;
EGMSetupUC ROB_1, id, "default", "{device}" \Joint;
EGMActJoint id \J1:=near;
EGMRunJoint id, EGM_STOP_HOLD \J1;
ENDPROC
ENDMODULE
"""


# As the low-latency profile of rpiRobotics/abb_motion_program_exec has them.
MOC = r"""MOC:CFG_1.0:6:1::
#
EXT_MOTION_DATA:
      -name "default" -ext_motion_level 0\
      -do_not_restart_after_motors_off -ramp_time 0.005 -ext_motion_Kp 20\
      -ext_motion_filter_bandwidth 100
"""


@pytest.fixture
def backup(tmp_path):
    def make(sio, device="EGMsensor:", moc=""):
        for folder in ("SYSPAR", "RAPID/TASK1/PROGMOD"):
            (tmp_path / folder).mkdir(parents=True)
        (tmp_path / "SYSPAR/SYS.cfg").write_text(SYS)
        if sio:
            (tmp_path / "SYSPAR/SIO.cfg").write_text(sio)
        if moc:
            (tmp_path / "SYSPAR/MOC.cfg").write_text(moc)
        module = MODULE.replace("{device}", device)
        (tmp_path / "RAPID/TASK1/PROGMOD/m.mod").write_text(module)
        return tmp_path

    return make


@pytest.mark.parametrize(
    ("sio", "devices"),
    [
        (SIX, (UdpDevice("EGMsensor", "192.168.1.10", 6511),)),
        (SEVEN, (UdpDevice("UCdevice", "127.0.0.1"), UdpDevice("ROB_1", "192.168.125.22", 6511))),
        ("", None),
    ],
)
def test_devices_of_a_backup(backup, sio, devices):
    assert read_backup(backup(sio)).udp_devices == devices


def test_the_task_waits_for_the_partner_of_its_configuration(backup):
    with VirtualController.from_folder(backup(SIX)) as controller:
        assert [d.code for d in controller.diagnostics if d.code == "RG408"] == ["RG408"]
        controller.run_for(0.5)
        (where,) = controller.where()
        partner = "EGMsensor at 192.168.1.10:6511"
        assert where.endswith(f"EGMRunJoint waits for datagrams of EGM partner {partner}")


def test_unknown_device_stops_task(backup):
    with VirtualController.from_folder(backup(SIX, "UCdevice")) as controller:
        controller.run_for(1)
        fault = controller.task("T_ROB1").fault
        assert fault.event == 194_911
        assert "UCdevice" in fault.arguments[0]


def test_main_begins_without_identities(backup):
    """PP to main: the variable is new, and what it had is free."""
    with VirtualController.from_folder(backup(SIX)) as controller:
        task = controller.task("T_ROB1")
        for _ in range(6):
            controller.run_for(0.5)
            assert task.state == "running"
            controller.stop_program()
            controller.run_for(0.1)
            task.pp_to_main()
            controller.run_for(0.1)
            controller.start_program()


def test_profile_of_a_backup(backup):
    with VirtualController.from_folder(backup(SIX, moc=MOC)) as controller:
        profile = Profile(0, True, 0.005, 20.0, 100.0)
        assert controller.egm.profile("DEFAULT") == profile
        assert controller.egm.profile("other") is None


def test_unknown_profile_stops_task(backup):
    folder = backup(SIX)
    module = folder / "RAPID/TASK1/PROGMOD/m.mod"
    module.write_text(module.read_text().replace('"default"', '"fast"'))
    with VirtualController.from_folder(folder) as controller:
        controller.run_for(1)
        assert "fast" in controller.task("T_ROB1").fault.arguments[0]

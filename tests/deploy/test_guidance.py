"""A driver with externally guided motion: its cfg instances, and what doctor reports."""

from rapidgen.config import load_config
from rapidgen.deploy.cfg import compare, keyed, merged, name_of, remember
from rapidgen.deploy.doctor import _guidance
from rapidgen.deploy.driver_set import DriverSet
from rapidgen.generate import build
from rapidgen.system import parse_cfg

SIO = r"""SIO:CFG_1.0:6:1::
#
COM_TRP:
      -Name "TCPIP1" -Type "TCP/IP" -PhyChannel ""
      -Name "UCdevice" -Type "UDPUC" -PhyChannel "" -RemoteAdress "127.0.0.1"
"""
MOC = r"""MOC:CFG_1.0:6:0::
#
EXT_MOTION_DATA:
      -name "default" -ramp_time 0.5
"""
OUTPUT = build(load_config("robots/examples/irb120_egm-rw6.yaml"))
DESIRED = [parse_cfg(f.data, path=f.path) for f in OUTPUT.files if f.path in ("SIO.cfg", "MOC.cfg")]


def test_instances_are_added_and_removed_without_touching_others():
    present = [parse_cfg(SIO, path="SIO.cfg"), parse_cfg(MOC, path="MOC.cfg")]
    desired, there = keyed(DESIRED), keyed(present)
    changes = compare(desired, there, frozenset(), {})
    assert [(c.key, c.action) for c in changes] == [
        ("COM_TRP ROS_EGM", "add"),
        ("EXT_MOTION_DATA ROS_EGM", "add"),
    ]
    ours = frozenset(map(name_of, desired))
    before = remember(desired, there, {}, frozenset())
    loaded = [merged(text, desired, frozenset(), {}) for text in present]
    assert len(keyed(loaded)) == len(there) + 2
    left = [merged(text, {}, ours, before) for text in loaded]
    assert keyed(left) == there


def test_doctor_reports_option_and_address():
    for address, verdict in (("127.0.0.1", "ok"), ("192.0.2.1", "warn")):
        egm = {"device": "ROS_EGM", "address": address, "port": 6510}
        manifest = {"configuration": {"groups": [{"name": "rob1", "egm": egm}]}}
        checks = list(_guidance(DriverSet("r", "0" * 12, (6, 15), (), manifest)))
        assert [c.verdict for c in checks] == [verdict, "unknown"]
        assert "689-1" in checks[1].found
    assert not list(_guidance(DriverSet("r", "0" * 12, (6, 15), (), {"configuration": {}})))

"""The cfg database of a controller: instances of files, internal ones, defaults."""

from dataclasses import replace

import pytest

from rapidgen.config import load_config
from rapidgen.system import System, parse_cfg
from rapidgen.system.base.mechanics_cfg import arm_name
from rapidgen.system.cfg_composition import database_of
from rapidgen.system.cfg_database import value_of, with_defaults
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.model import SignalSpec, TaskSpec

IRB120 = load_config("irb120").groups
SYSTEM = System("S", (TaskSpec("T_ROB1", motion=True), TaskSpec("T_OTHER")))
# As in backups: a track that is a product of ABB has no JOINT, its arm type is the joint's name.
MOC = """MOC:CFG_1.0:6:0::
#
MECHANICAL_UNIT:

      -name "TRACK_1" -use_single_0 "TRACK_1" -activate_at_start_up
#
ROBOT:

      -name "ROB_1" -use_robot_type "ROB1_4600_2.55_40" -use_joint_0 "rob1_1" \\
      -use_joint_1 "rob1_2" -use_joint_2 "rob1_3" \\
      -base_frame_coordinated "TRACK_1" -base_frame_orient_u3 0.5
#
SINGLE:

      -name "TRACK_1" -use_single_type "IRBT4004_1" -use_joint "track1"
#
ARM:

      -name "rob1_1" -use_arm_type "ROB1_1" -upper_joint_bound 3.1416 -lower_joint_bound -3.1416

      -name "T4004_3.9_1" -use_arm_type "track1" -upper_joint_bound 3.901
"""
BACKUP = replace(
    SYSTEM, cfg=ControllerCfg((6, 6), (parse_cfg("SYS:CFG_1.0:6:0::\n"), parse_cfg(MOC)))
)


# Sources of the names: `arm_name`.
@pytest.mark.parametrize(
    ("robot", "changes", "external"),
    [
        ("irb120", {}, []),
        ("irb120", {"mechanical_unit": "ROB_2"}, []),
        ("irb14000", {"mechanical_unit": "ROB_R"}, ["rob_R_7"]),
        ("irb120_track", {"external_units": ("TRACK_1", "STN_1")}, ["TRACK_1", "STN_1"]),
        ("irb120_track", {"external_units": ("STN_1",)}, ["STN_1_1", "STN_1_2"]),
        ("irb120_track", {"external_units": ()}, ["rob1_7", "rob1_8"]),
    ],
)
def test_arm_names_match_backups(robot, changes, external):
    group = replace(load_config(robot).groups[0], **changes)
    robots = {"ROB_1": "rob1", "ROB_2": "rob2", "ROB_R": "rob_R"}
    own = [f"{robots[group.mechanical_unit]}_{i}" for i in range(1, 7)]
    assert [arm_name(group, joint) for joint in group.joints] == [*own, *external]


@pytest.mark.parametrize(
    ("path", "count"),
    [
        ("/MOC/ARM/rob1_1", 1),
        ("moc/arm/ROB1_1/", 1),
        ("/MOC/ARM", 6),
        ("/MOC/ARM/rob1_7", 0),
        ("/MOC/ROBOT", 1),
        ("/MOC/JOINT", 6),
        ("/MOC", 0),
        ("/MOC/ARM/rob1_1/upper_joint_bound", 0),
        ("/EIO/EIO_SIGNAL", 0),
        ("/SYS/SYS_MISC/modalpayloadmode", 1),
        ("/NONE/ARM", 0),
    ],
)
def test_instances_are_found_by_their_path(path, count):
    database = database_of(SYSTEM, IRB120)
    domain, section, result = database.find(path)
    assert len(result) == count
    if path.startswith("/MOC/ARM/") and count:
        first = IRB120[0].joints[0]
        assert value_of(domain, section, result[0], "Upper_Joint_Bound") == first.upper
        database.change(domain, section, result[0], {"upper_joint_bound": 1.5})
        changed = database.find(path)[2][0]
        assert value_of(domain, section, changed, "upper_joint_bound") == 1.5
        assert value_of(domain, section, changed, "lower_joint_bound") == first.lower


def test_every_domain_has_cfg_text():
    database = database_of(SYSTEM, IRB120)
    assert database.domains == ("EIO", "MMC", "MOC", "PROC", "SIO", "SYS")
    for domain in database.domains:
        assert database.text(domain).startswith(f"{domain}:CFG_1.0")
    assert database.text("MOC").count('-name "rob1_') == 6


def test_a_flag_is_true_and_a_missing_one_is_not_there():
    first, other = database_of(SYSTEM, IRB120).instances("SYS", "CAB_TASKS")
    assert value_of("SYS", "CAB_TASKS", first, "MotionTask") is True
    assert value_of("SYS", "CAB_TASKS", other, "MotionTask") is None


def test_a_backup_is_read_as_it_is_and_completed_by_what_no_controller_saves():
    database = database_of(BACKUP, IRB120)
    assert [i.text("name") for i in database.instances("MOC", "ARM")] == ["rob1_1", "T4004_3.9_1"]
    joints = database.instances("MOC", "JOINT")
    rows = [(i.text("name"), i.text("logical_axis"), i.text("use_arm")) for i in joints]
    assert rows == [
        ("rob1_1", "1", "rob1_1"),
        ("rob1_2", "2", "rob1_2"),
        ("rob1_3", "3", "rob1_3"),
        ("track1", "7", "T4004_3.9_1"),
    ]
    assert "JOINT" not in database.text("MOC")
    with pytest.raises(ValueError, match="internal"):
        database.change("MOC", "JOINT", joints[0], {"logical_axis": 2})


def test_an_attribute_that_is_left_out_has_its_default():
    database = database_of(BACKUP, IRB120)
    robot = database.instance("MOC", "ROBOT", "rob_1")
    assert value_of("MOC", "ROBOT", robot, "base_frame_orient_u0") == 1.0
    assert value_of("MOC", "ROBOT", robot, "base_frame_orient_u3") == 0.5
    arm = database.instance("MOC", "ARM", "T4004_3.9_1")
    assert value_of("MOC", "ARM", arm, "lower_joint_bound") is None
    names = [a.name for a in with_defaults("MOC", "ROBOT", robot)]
    assert names.count("base_frame_orient_u3") == names.count("base_frame_pos_x") == 1


def test_signals_and_tasks_of_a_cell_are_added():
    system = replace(BACKUP, signals=(SignalSpec("diCell", "DI"),))
    database = database_of(system, IRB120)
    assert database.instance("EIO", "EIO_SIGNAL", "dicell") is not None
    tasks = [i.text("Name") for i in database.instances("SYS", "CAB_TASKS")]
    assert tasks == ["T_ROB1", "T_OTHER"]

"""ReadCfgData on a controller made of a configuration."""

from dataclasses import replace

import pytest

from rapidgen.config import load_config
from rapidgen.machine.system_parameters import SystemParameters, arm_name
from rapidgen.system import System
from rapidgen.system.model import TaskSpec


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
        ("/MOC/ROBOT", 0),
        ("/MOC", 0),
        ("/MOC/ARM/rob1_1/upper_joint_bound", 0),
    ],
)
def test_instances_are_found_by_their_path(path, count):
    parameters = SystemParameters(System("S", ()), load_config("irb120").groups)
    result = parameters.find(path)
    assert len(result) == count
    if count:
        first = load_config("irb120").groups[0].joints[0]
        bounds = result[0]["upper_joint_bound"], result[0]["lower_joint_bound"]
        assert bounds == (first.upper, first.lower)
        result[0]["upper_joint_bound"] = 1.5
        assert parameters.find("/MOC/ARM/rob1_1")[0]["upper_joint_bound"] == 1.5


def test_domains_have_cfg_text():
    parameters = SystemParameters(System("S", ()), load_config("irb120").groups)
    assert parameters.domains == ("SYS", "EIO", "MOC")
    for domain in parameters.domains:
        assert parameters.text(domain).startswith(f"{domain}:CFG_1.0")
    assert parameters.text("MOC").count('-Name "rob1_') == 6
    with pytest.raises(KeyError):
        parameters.text("SIO")


def test_a_flag_is_true():
    tasks = (TaskSpec("T_ROB1", motion=True), TaskSpec("T_OTHER"))
    parameters = SystemParameters(System("S", tasks), load_config("irb120").groups)
    first, other = parameters.find("/SYS/CAB_TASKS")
    assert (first["name"], first["motiontask"]) == ("T_ROB1", True)
    assert "motiontask" not in other

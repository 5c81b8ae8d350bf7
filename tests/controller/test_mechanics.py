"""Robots of tasks: by mechanical unit, name, or type in a backup."""

import pytest

from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config
from rapidgen.config.variant_group import group_of
from rapidgen.config.variant_library import variants
from rapidgen.controller.mechanics import groups_for, mechanics, model_of, robots_named
from rapidgen.diagnostics import DiagnosticError, Severity
from rapidgen.system.model import MechanicalUnitGroup, System, TaskSpec


def yumi(right, left, *, grouped=True):
    """HONG: the right arm's task comes first, tasks and groups differ in case."""
    tasks = (
        TaskSpec(right, motion=True, mechanical_unit_group="rob_R" if grouped else ""),
        TaskSpec(left, motion=True, mechanical_unit_group="rob_L" if grouped else ""),
    )
    groups = (
        MechanicalUnitGroup("rob_r", "ROB_R", ("ROB_R_7",), "motion_planner_1"),
        MechanicalUnitGroup("rob_l", "ROB_L", ("ROB_L_7",), "motion_planner_2"),
    )
    return System("yumi", tasks, groups=groups if grouped else ())


def given(groups):
    return {group.task: group.name for group in groups}


@pytest.mark.parametrize(
    "system",
    [
        yumi("T_ROB_R", "T_ROB_L"),
        yumi("T_ROB_R_MAIN_CTRL", "T_ROB_L_MAIN_CTRL"),
        yumi("T_ROB_R", "T_ROB_L", grouped=False),
    ],
)
def test_the_arms_of_a_yumi_keep_their_tasks(system):
    right, left = (task.name for task in system.tasks)
    groups = groups_for(system, load_config("irb14000").groups)
    assert given(groups) == {right: "rob_r", left: "rob_l"}
    assert [group.mechanical_unit for group in groups] == ["ROB_R", "ROB_L"]


def two_robots(*types):
    """EBRUUN 6.06: the second robot's task comes first."""
    tasks = (
        TaskSpec("T_ROB2", motion=True, mechanical_unit_group="rob2"),
        TaskSpec("T_ROB1", motion=True, mechanical_unit_group="rob1"),
    )
    groups = (MechanicalUnitGroup("rob1", "ROB_1"), MechanicalUnitGroup("rob2", "ROB_2"))
    return System("two", tasks, groups=groups, robot_types=types)


def test_a_copy_has_the_unit_of_its_task():
    groups = groups_for(two_robots(), load_config("irb120").groups)
    assert [(g.task, g.mechanical_unit, g.name) for g in groups] == [
        ("T_ROB2", "ROB_2", "rob2"),
        ("T_ROB1", "ROB_1", "rob1"),
    ]


def test_unnamed_robots_follow_task_order():
    tasks = (TaskSpec("T_A", motion=True), TaskSpec("T_B", motion=True))
    groups = groups_for(System("two", tasks), load_config("irb14000").groups)
    assert given(groups) == {"T_A": "rob_l", "T_B": "rob_r"}


@pytest.mark.parametrize(
    ("robot_type", "model"),
    [
        ("ROB1_120_0.58_3", "irb120"),
        ("ROB1_1200_0.9_5_TypeB", "irb1200"),
        ("ROB_R_14000_05_05_TYPEA", "irb14000"),
        ("ROB1_910SC_0.55_3", "irb910sc"),
        ("ROB1_15000_0_95_5", "crb15000"),
        ("ROB2_4600_2.55_40", "irb4600"),
        ("ROB1_360_1.6_6", ""),
        ("Gantry21_X_Y_Z_NOTCP", ""),
        ("", ""),
    ],
)
def test_types_of_backups(robot_type, model):
    assert model_of(robot_type) == model


def test_backup_moves_robots_of_its_type():
    system = two_robots(("ROB_1", "ROB1_120_0.58_3"), ("ROB_2", "ROB2_4600_2.05_60"))
    groups, notes = mechanics(system)
    assert {group.task: group.model for group in groups} == {
        "T_ROB1": "irb120",
        "T_ROB2": "irb4600",
    }
    assert notes == ()


def test_a_backup_without_a_robot_type_moves_a_replacement():
    """The backups that the virtual controller writes name the unit, not a type of ABB."""
    system = System("one", (TaskSpec("T_ROB1", motion=True),), robot_types=(("ROB_1", ""),))
    (group,), (note,) = mechanics(system)
    assert (group.model, group.mechanical_unit) == ("irb120", "ROB_1")
    assert (note.code, note.severity) == ("RG432", Severity.WARNING)


def test_unshipped_variant_moves_as_in_library():
    system = two_robots(("ROB_1", "ROB1_140_0.81_6"), ("ROB_2", "ROB2_1300_0.9_11"))
    groups, (note,) = mechanics(system)
    assert {g.task: g.model for g in groups} == {
        "T_ROB1": "IRB 140-6/0.81",
        "T_ROB2": "IRB 1300-11/0.9",
    }
    assert "100 deg/s" in note.message
    assert "1300" in note.message


@pytest.mark.parametrize(
    ("robot_type", "model", "reach", "payload", "note"),
    [
        # Public backups name these types; figures: robots/variants.json.
        ("ROB1_4400_1.95_60", "IRB 4400-60/1.95", 1.22, 60, ""),
        ("ROB1_660_250", "irb660", 1.91, 250, ""),
        ("ROB1_660_180", "IRB 660-180/3.15", 1.91, 180, "speeds"),
        ("ROB1_910SC_0.55_3", "IRB 910SC-3/0.55", 0.55, 6, ""),
        ("ROB1_910SC_0.65_3", "IRB 910SC-3/0.65", 0.65, 6, ""),
    ],
)
def test_types_that_public_backups_name(robot_type, model, reach, payload, note):
    tasks = (TaskSpec("T_ROB1", motion=True),)
    (group,), notes = mechanics(System("one", tasks, robot_types=(("ROB_1", robot_type),)))
    assert (group.model, group.max_payload) == (model, payload)
    place, _ = Kinematics.of(group).forward((0.0,) * len(group.joints))
    assert place[0] == pytest.approx(reach)
    assert [d.message.find(note) > 0 for d in notes] == [True] * bool(note)


def test_a_variant_becomes_the_very_arm_of_a_shipped_file():
    """Their chains were written from different sources; the arm is the same."""
    for variant in variants():
        if variant.model in ("irb4600", "irb2400", "irb120", "irb1600"):
            made, shipped = group_of(variant), load_config(variant.model).groups[0]
            assert made is not None
            for axes in ((0,) * 6, (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)):
                pose, known = (
                    Kinematics.of(made).forward(axes),
                    Kinematics.of(shipped).forward(axes),
                )
                for part, own in zip(pose, known, strict=True):
                    assert part == pytest.approx(own, abs=1e-9)


def test_other_variant_is_reported():
    system = two_robots(("ROB_1", "ROB1_120_0.58_3"), ("ROB_2", "ROB2_4600_2.55_99"))
    (note,) = mechanics(system)[1]
    assert note.code == "RG432"
    assert "2.55_99" in note.message
    assert "60/2.05" in note.message


def test_unknown_speeds_suggest_user_file():
    system = two_robots(("ROB_1", "ROB1_1660ID_1.55_4"), ("ROB_2", "ROB1_4600_2.05_60"))
    (note,) = mechanics(system)[1]
    assert (note.code, "new robot.yaml --robot 'IRB 1660ID-4/1.55'" in note.help) == ("RG432", True)


def test_kin_of_an_unknown_variant_can_be_chosen():
    system = two_robots(("ROB_1", "ROB1_6660_1.95_205"), ("ROB_2", "ROB1_6660_1.95_205"))
    with pytest.raises(DiagnosticError) as caught:
        mechanics(system)
    assert "'IRB 6660-205/1.9'" in caught.value.diagnostics[0].help
    groups, notes = mechanics(system, "irb 6660-205/1.9")
    assert [group.coupling for group in groups] == [1, 1]
    assert notes == ()


def test_an_unknown_type_asks_for_a_robot():
    system = two_robots(("ROB_1", "ROB1_360_1.6_6"), ("ROB_2", "ROB2_360_1.6_6"))
    with pytest.raises(DiagnosticError) as caught:
        mechanics(system)
    assert [result.code for result in caught.value.diagnostics] == ["RG432"]
    assert [group.model for group in mechanics(system, "irb1200")[0]] == ["irb1200", "irb1200"]


def test_unknown_mechanics_are_reported():
    system = System("loose", (TaskSpec("T_ROB1", motion=True),))
    groups, (note,) = mechanics(system)
    assert [group.model for group in groups] == ["irb120"]
    assert note.code == "RG432"


@pytest.mark.parametrize("name", ["IRB 1600-999/9.9", "irb 1600-999/9.9", "CRB 1600"])
def test_unknown_variant_is_not_taken_for_a_file(name):
    with pytest.raises(DiagnosticError) as caught:
        robots_named(name)
    (fault,) = caught.value.diagnostics
    assert fault.code == "RG009"
    assert f"'{name}' is an unknown variant" in fault.message
    assert "'IRB 1600-" in fault.help


def test_missing_configuration_is_a_missing_file():
    with pytest.raises(DiagnosticError) as caught:
        robots_named("irb1600.yaml")
    assert [fault.code for fault in caught.value.diagnostics] == ["RG001"]

"""Mechanical units of a backup: tracks, gantries, positioners, base frames.

The files are written for these tests in the form of public backups: a track as a product (EBRUUN),
a track of the owner (KRAKER), a gantry (createchaos/abb_communication, kangoananya/gkr_timber).
"""

import math

import pytest

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.axes.limits import outside
from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.diagnostics import Severity

SYS = """SYS:CFG_1.0:6:0::
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask
"""
ARMS = "".join(
    f'      -name "rob1_{n}" -use_arm_type "ROB1_{n}" -upper_joint_bound 1.5 '
    f"-lower_joint_bound -1.{n}\n"
    for n in range(1, 7)
)
JOINTS = " ".join(f'-use_joint_{n} "rob1_{n + 1}"' for n in range(6))
TRACK = f"""MOC:CFG_1.0:6:0::
#
MECHANICAL_UNIT:

      -name "TRACK_1" -use_single_0 "TRACK_1" -activate_at_start_up -deactivation_forbidden
      -name "STN_1" -use_single_0 "STN_1"
      -name "NO_AXIS" -use_single_0 "NO_AXIS" -activate_at_start_up
#
ROBOT:

      -name "ROB_1" -use_robot_type "ROB1_120_0.58_3" {JOINTS} -base_frame_pos_x 2 \\
      -base_frame_orient_u0 0.70710678 -base_frame_orient_u3 0.70710678 \\
      -base_frame_coordinated "TRACK_1"
#
SINGLE:

      -name "TRACK_1" -use_single_type "IRBT4004_1" -use_joint "track1" -base_frame_pos_x 2 \\
      -base_frame_orient_u0 0 -base_frame_orient_u3 1
      -name "STN_1" -use_single_type "STN" -use_joint "STN" -base_frame_pos_y -1
      -name "NO_AXIS" -use_single_type "IRBP" -use_joint "ROT10"
#
SINGLE_TYPE:

      -name "STN" -mechanics "FREE_ROT"
#
JOINT:

      -name "STN" -logical_axis 8 -use_arm "STN" -use_transmission "STN" -use_drive_system "STN"
#
ARM:

{ARMS}
      -name "T4004_3.9_1" -use_arm_type "track1" -upper_joint_bound 3.9 -lower_joint_bound -0.001
      -name "STN" -use_arm_type "STN" -use_acc_data "STN" -upper_joint_bound 3 -lower_joint_bound -3
#
TRANSMISSION:

      -name "STN" -rotating_move -transm_joint 100
#
DRIVE_SYSTEM:

      -name "STN" -use_stress_duty_cycle "STN"
#
STRESS_DUTY_CYCLE:

      -name "STN" -speed_absolute_max 200
#
ACC_DATA:

      -name "STN" -wc_acc 5
"""
GANTRY_JOINTS = " ".join(
    f'-use_joint_{n} "{"G" if n < 3 else "LOCKED_G"}_{n + 1}"' for n in range(6)
)
LOCKED = "-lock_joint_in_hardware  -lock_joint_in_ipol  -lock_joint_in_servo"
GANTRY = (
    f"""MOC:CFG_1.0:6:0::
#
MECHANICAL_UNIT:

      -name "Gantry" -use_robot "Gantry" -activate_at_start_up
#
ROBOT:

      -name "ROB_1" -use_robot_type "ROB1_120_0.58_3" {JOINTS} -base_frame_coordinated "Gantry"
      -name "Gantry" -use_robot_type "Gantry_X_Y_Z_NOTCP" {GANTRY_JOINTS}
#
ROBOT_TYPE:

      -name "Gantry_X_Y_Z_NOTCP" -type "GEN_KIN" -no_of_joints 6 -base_pose_rot_u0 0.707107 \\
      -base_pose_rot_u2 0.707107
#
JOINT:

"""
    + "".join(
        f'      -name "{name}" -logical_axis {n} -use_arm "{name}" {lock}\\\n'
        f'      -use_transmission "{name}"\n'
        for n, name, lock in (
            (7, "G_1", ""),
            (8, "G_2", '-follower_to_joint "G_1"'),
            (9, "G_3", ""),
            (10, "LOCKED_G_4", LOCKED),
            (11, "LOCKED_G_5", LOCKED),
            (12, "LOCKED_G_6", LOCKED),
        )
    )
    + f"""#
ARM_TYPE:

      -name "G_1"
      -name "G_2" -attitude 1.5708 -theta_home_position 1.5708
      -name "G_3" -attitude 1.5708
#
ARM:

{ARMS}
      -name "G_1" -use_arm_type "G_1" -upper_joint_bound 30 -lower_joint_bound 0
      -name "G_2" -use_arm_type "G_2" -upper_joint_bound 0 -lower_joint_bound -9.65
      -name "G_3" -use_arm_type "G_3" -upper_joint_bound -1 -lower_joint_bound -4.9
      -name "LOCKED_G_4" -upper_joint_bound 3.14 -lower_joint_bound -3.14
      -name "LOCKED_G_5" -upper_joint_bound 3.14 -lower_joint_bound -3.14
      -name "LOCKED_G_6" -upper_joint_bound 3.14 -lower_joint_bound -3.14
#
TRANSMISSION:

      -name "G_1" -transm_joint -376.99
      -name "G_2" -transm_joint -376.99
      -name "G_3" -transm_joint -549.777
"""
)
LIMIT_165 = "-upper_joint_bound 2.87979 -lower_joint_bound -2.87979"
MAIN = """MODULE MainModule
    PERS wobjdata table := [FALSE,FALSE,"STN_1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    PROC main()
{body}
    ERROR
        TPWrite "error";
        TRYNEXT;
    ENDPROC
    PROC show(num value)
        TPWrite "" \\Num:=value;
    ENDPROC
ENDMODULE
"""


@pytest.fixture
def backup(tmp_path):
    """A backup with a MOC.cfg and the body of main."""

    def make(moc, body="        Stop;"):
        folder = tmp_path / "backup"
        (folder / "SYSPAR").mkdir(parents=True)
        (folder / "RAPID/TASK1/PROGMOD").mkdir(parents=True)
        (folder / "SYSPAR/SYS.cfg").write_text(SYS)
        (folder / "SYSPAR/EIO.cfg").write_text("EIO:CFG_1.0:6:1::\n")
        (folder / "SYSPAR/MOC.cfg").write_text(moc)
        text = MAIN.replace("{body}", body)
        (folder / "RAPID/TASK1/PROGMOD/MainModule.mod").write_text(text)
        return folder

    return make


def boot(folder):
    """The controller of a backup."""
    return VirtualController.boot(load_target([folder]), cycle="once")


def printed(folder, seconds=60):
    """What the program of a backup writes, and its controller."""
    with boot(folder) as controller:
        controller.run_for(seconds)
        return list(controller.operator.rows), controller


def test_a_track_and_a_positioner_are_external_axes(backup):
    (group,) = load_target([backup(TRACK)]).groups
    external = [(j.name, j.axis, j.kind) for j in group.joints[6:]]
    assert external == [("track1", "eax_a", "prismatic"), ("STN", "eax_b", "revolute")]
    limits = [limit for j in group.joints[6:] for limit in (j.lower, j.upper)]
    assert limits == pytest.approx([-0.001, 3.9, -3, 3], rel=1e-5)
    assert group.external_units == ("TRACK_1", "STN_1")
    # Motor 200 rad/s over 100; ACC_DATA.
    assert (group.joints[7].speed, group.joints[7].acceleration) == (2.0, 5.0)
    # Limits of the robot are those of ARM, not those of the model.
    limits = [limit for j in group.joints[:2] for limit in (j.lower, j.upper)]
    assert limits == pytest.approx([-1.1, 1.5, -1.2, 1.5], rel=1e-5)


def test_limits_are_not_narrower_than_the_degrees_that_a_controller_rounds(backup):
    """MOC.cfg of all backups of an IRB 120: 2.87979 rad, which is 164.9998 degrees."""
    folder = backup(TRACK.replace("-upper_joint_bound 1.5 -lower_joint_bound -1.1", LIMIT_165))
    first = load_target([folder]).groups[0].joints[0]
    assert outside((first,), (math.radians(165),)) == []
    assert outside((first,), (math.radians(165.01),)) != []


def test_a_driver_on_a_backup_has_the_limits_of_the_backup(backup, tmp_path):
    folder = backup(TRACK)
    assert main(["build", "irb120", "--backup", str(folder), "-o", str(tmp_path / "out")]) == 0
    (group,) = load_target([tmp_path / "out"], BootOptions(backup=folder)).groups
    assert group.joints[0].upper == pytest.approx(1.5, rel=1e-5)


def test_what_is_not_simulated_is_reported(backup):
    notes = [d for d in load_target([backup(TRACK)]).notes if d.code == "RG436"]
    assert {d.severity for d in notes} == {Severity.WARNING}
    assert [d.message for d in notes] == [
        "mechanical unit TRACK_1 (IRBT4004_1): speed, acceleration are not in MOC.cfg",
        "mechanical unit NO_AXIS is not simulated: MOC.cfg has no joint or limits of it",
    ]


def test_a_track_moves_the_robot_from_where_it_stands(backup):
    (group,) = load_target([backup(TRACK)]).groups
    place, turn = Kinematics.of(group).forward((0.0,) * 6 + (0.5, 0.0))
    alone, facing = Kinematics.of(load_config("irb120").groups[0]).forward((0.0,) * 6)
    # At 0 the robot stands 2 m along x and looks along y; the track runs along -x.
    base = ((2.0 - 0.5, 0.0, 0.0), frames.about((0.0, 0.0, 1.0), math.pi / 2))
    expected = frames.compose(base, (alone, facing))
    assert place == pytest.approx(expected[0], abs=1e-7)
    assert frames.angle_between(turn, expected[1]) < 1e-7


def test_a_gantry_carries_the_robot_upside_down(backup):
    result = load_target([backup(GANTRY)])
    (group,) = result.groups
    assert [(j.name, j.axis, j.kind) for j in group.joints[6:]] == [
        ("G_1", "eax_a", "prismatic"),
        ("G_2", "eax_b", "prismatic"),
        ("G_3", "eax_c", "prismatic"),
    ]
    place, turn = Kinematics.of(group).forward((0.0,) * 6 + (10.0, -4.0, -3.0))
    alone = Kinematics.of(load_config("irb120").groups[0]).forward((0.0,) * 6)
    base = ((10.0, 4.0, 3.0), frames.about((1.0, 0.0, 0.0), math.pi))
    expected = frames.compose(base, alone)
    assert place == pytest.approx(expected[0], abs=1e-4)
    assert frames.angle_between(turn, expected[1]) < 1e-4
    assert any("G_2 follows G_1" in d.message for d in result.notes)


def test_targets_move_the_units(backup):
    body = """
        VAR jointtarget at;
        VAR robtarget place;
        MoveAbsJ [[0,0,0,0,30,0],[500,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
        at := CJointT();
        show at.extax.eax_a;
        show at.extax.eax_b;
        ActUnit STN_1;
        MoveAbsJ [[0,0,0,0,30,0],[500,90,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
        place := CRobT(\\Tool:=tool0 \\WObj:=table);
        show place.trans.x;
        place.extax.eax_a := 510;
        place.extax.eax_b := 89;
        MoveL place, v100, fine, tool0 \\WObj:=table;
        place := CRobT(\\Tool:=tool0 \\WObj:=table);
        show place.trans.x;
        DeactUnit STN_1;
        at := CJointT();
        show at.extax.eax_a;
        show at.extax.eax_b;
        Stop;"""
    rows, controller = printed(backup(TRACK, body))
    assert controller.task("T_ROB1").fault is None
    (group,) = controller.motion.groups.values()
    first, off, x, same, last, off_again = map(float, rows)
    assert (first, off, last, off_again) == pytest.approx((500, 0, 510, 89))
    assert same == pytest.approx(x, abs=0.01)
    assert group.positions()[7] == pytest.approx(math.radians(89))


def test_a_unit_that_does_not_start_active_keeps_its_place(backup):
    body = """
        MoveAbsJ [[0,0,0,0,30,0],[0,90,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
        Stop;"""
    _, controller = printed(backup(TRACK, body))
    (group,) = controller.motion.groups.values()
    assert group.positions()[7] == 0.0


def test_a_unit_whose_cfg_forbids_it_cannot_be_deactivated(backup):
    _, controller = printed(backup(TRACK, "        DeactUnit TRACK_1;"))
    assert controller.task("T_ROB1").fault.title == "Not a unit that can be deactivated"


def test_an_axis_beyond_its_limits_in_moc_stops_the_tasks(backup):
    body = "        MoveAbsJ [[0,0,0,0,30,0],[4000,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;"
    rows, controller = printed(backup(TRACK, body))
    assert (rows, controller.task("T_ROB1").fault.event) == ([], 50_050)

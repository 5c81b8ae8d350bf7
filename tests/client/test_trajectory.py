"""Trajectories: shapes, files, checks against a robot (all findings at once), timing."""

import contextlib
import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidgen._data import data_folder
from rapidgen.client import InvalidTrajectory, Trajectory
from rapidgen.client.core.checks import DriverLimits, check_trajectory
from rapidgen.client.core.group import Group
from rapidgen.client.core.state import Feedback
from rapidgen.client.core.state_port import Sample
from rapidgen.client.recording import CsvWriter, JointRecording
from rapidgen.config import load_config

HOME = [0.0] * 6


@pytest.fixture(scope="module")
def irb120():
    config = load_config("irb120")
    return Group.of(config, config.groups[0])


@pytest.fixture(scope="module")
def irb2400():
    config = load_config("irb2400")
    return Group.of(config, config.groups[0])


def codes(error):
    return [d.code for d in error.value.diagnostics]


def test_arrays_are_copied_and_read_only():
    times, positions = np.array([0.0, 1.0]), np.zeros((2, 6))
    trajectory = Trajectory(times, positions)
    positions[0, 0] = 5
    assert trajectory.positions[0, 0] == 0
    with pytest.raises(ValueError, match="read-only"):
        trajectory.positions[0, 0] = 1
    assert trajectory.duration == 1.0


@pytest.mark.parametrize(
    ("times", "positions", "names"),
    [
        ([0, 1], [[0.0]], ()),
        ([0], [0.0], ()),
        ([0], [[0.0, 1.0]], ("a",)),
        (["x"], [[0.0]], ()),
        ([0, 1], [[0.0], [1.0, 2.0]], ()),
    ],
)
def test_shapes_that_do_not_fit(times, positions, names):
    with pytest.raises(InvalidTrajectory) as error:
        Trajectory(times, positions, names)
    assert codes(error) == ["RG611"]


def test_csv_round_trip(tmp_path):
    trajectory = Trajectory([0, 0.1, 1 / 3], [[0.1, -1e-9], [2, 3], [1e9, 4]], ("a", "b c"))
    trajectory.to_csv(tmp_path / "t.csv")
    again = Trajectory.from_csv(tmp_path / "t.csv")
    assert again.names == trajectory.names
    assert np.array_equal(again.times, trajectory.times)
    assert np.array_equal(again.positions, trajectory.positions)
    assert again.lines == (2, 3, 4)


def test_read_csv_reports_all_faults_with_places(tmp_path):
    path = tmp_path / "bad.csv"
    path.write_text("# a comment\ntime,a,b\n0,1\n\n1,x,2\n2,1,2,3\n3,1,y\n4,0_5,1\n")
    with pytest.raises(InvalidTrajectory) as error:
        Trajectory.from_csv(path)
    places = [(d.span.line, d.span.column, d.message) for d in error.value.diagnostics]
    assert places == [
        (3, 1, "2 values, the header has 3"),
        (5, 3, "'x' is not a number"),
        (6, 1, "4 values, the header has 3"),
        (7, 5, "'y' is not a number"),
        (8, 3, "'0_5' is not a number"),  # Python would read 5
    ]
    assert error.value.exit_code == 2


@pytest.mark.parametrize(
    "content",
    [b"", b"a,b\n1,2\n", b"time\n1\n", b"time,a,\n", b"\xff\xfe\x00", b"time,a,a\n0,1,2\n"],
)
def test_csv_that_is_none(tmp_path, content):
    path = tmp_path / "bad.csv"
    path.write_bytes(content)
    with pytest.raises(InvalidTrajectory) as error:
        Trajectory.from_csv(path)
    assert set(codes(error)) == {"RG610"}


def test_read_csv_of_simulator_recording_is_recognised(tmp_path):
    path = tmp_path / "run.mcap"
    path.write_bytes(b"\x89MCAP0\r\n\x01")
    with pytest.raises(InvalidTrajectory) as error:
        Trajectory.from_csv(path)
    (result,) = error.value.diagnostics
    assert result.help == (
        f"it is a recording: `rapidgen view {path} --csv FILE.csv` writes its positions"
    )


CAME = [(5.0, 0.0), (5.0, 0.1), (5.5, 0.2), (6.0, 0.3), (6.0, 0.4), (6.0, 0.5)]
"""When messages came, s, and where the robot was, rad: some were read at once."""
KEPT = [0.1, 0.2, 0.5]


def test_of_messages_that_came_together_a_recording_keeps_the_last(irb120, tmp_path):
    recording = JointRecording(irb120)
    for time, place in CAME:
        recording.add(Sample(time, (place,) * 10))
    recording.to_csv(tmp_path / "r.csv")
    again = Trajectory.from_csv(tmp_path / "r.csv")
    assert again.times.tolist() == pytest.approx([0, 0.5, 1])
    expected = [irb120.from_wire((place,) * 10)[0] for place in KEPT]
    assert again.positions[:, 0].tolist() == pytest.approx(expected)


def test_of_messages_that_came_together_a_file_keeps_the_last(irb120, tmp_path):
    with CsvWriter(tmp_path / "r.csv", irb120) as writer:
        for time, place in [*CAME, (5.9, 0.6)]:  # a clock that goes back tells nothing
            writer.write(Feedback(irb120.names, (place,) * 6, HOME, time, time, 1))
    again = Trajectory.from_csv(tmp_path / "r.csv")
    assert len(again) == writer.count == len(KEPT)
    assert again.times.tolist() == pytest.approx([0, 0.5, 1])
    assert again.positions[:, 0].tolist() == pytest.approx(KEPT)


def test_missing_file(tmp_path):
    with pytest.raises(InvalidTrajectory, match="no such file"):
        Trajectory.from_csv(tmp_path / "none.csv")


@given(st.binary(max_size=200))
def test_random_bytes_as_csv_bring_nothing_but_findings(tmp_path_factory, data):
    path = tmp_path_factory.mktemp("csv") / "t.csv"
    path.write_bytes(b"time,a\n" + data)
    with contextlib.suppress(InvalidTrajectory):
        Trajectory.from_csv(path)


ROS_1 = {
    "joint_names": ["b", "a"],
    "points": [
        {"positions": [1, 2], "time_from_start": {"secs": 0, "nsecs": 500000000}},
        {"positions": [3, 4], "time_from_start": {"secs": 2, "nsecs": 0}},
    ],
}


def test_ros_dicts():
    first = Trajectory.from_ros(ROS_1)
    assert first.names == ("b", "a")
    assert first.times.tolist() == [0.5, 2.0]
    ros_2 = json.loads(json.dumps(ROS_1).replace("nsecs", "nanosec").replace('"secs"', '"sec"'))
    assert Trajectory.from_ros(ros_2).times.tolist() == [0.5, 2.0]
    assert first.reordered(("a", "b")).positions.tolist() == [[2, 1], [4, 3]]


@pytest.mark.parametrize(
    "message",
    [
        {},
        {"points": "x"},
        {"points": [{"positions": [1]}]},
        {"points": [{"positions": ["x"], "time_from_start": 0}]},
        {"points": [{"positions": [1], "time_from_start": {}}]},
        {"points": [{"positions": [1], "time_from_start": None}]},
        {"points": [7]},
        {"points": [], "joint_names": [1]},
    ],
)
def test_ros_dicts_that_are_none(message):
    with pytest.raises(InvalidTrajectory):
        Trajectory.from_ros(message)


def test_json_files(tmp_path):
    path = tmp_path / "t.json"
    trajectory = Trajectory([0, 1], [[0.0, 1.0], [2.0, 3.0]], ("a", "b"))
    path.write_text(json.dumps(trajectory.to_dict()))
    assert Trajectory.from_json(path).positions.tolist() == trajectory.positions.tolist()
    path.write_text(json.dumps(ROS_1))
    assert Trajectory.from_json(path).names == ("b", "a")
    for bad in ("{", "[]", '{"times": []}', '{"times": [0], "positions": "x"}'):
        path.write_text(bad)
        with pytest.raises(InvalidTrajectory):
            Trajectory.from_json(path)


def test_good_trajectory_becomes_axis_values_and_durations(irb120):
    trajectory = Trajectory.from_points([HOME, [0.1] * 6, [0.2] * 6], seconds=[0.5, 0.25])
    made = check_trajectory(trajectory, irb120, start=[0.0] * 10)
    assert made.durations.tolist() == [irb120.policy.min_segment, 0.5, 0.25]
    assert np.allclose(made.wire, trajectory.positions)
    assert made.warnings == ()


def test_columns_go_by_name_not_by_place(irb120):
    names = irb120.names[::-1]
    made = check_trajectory(Trajectory([0, 1], [[0] * 6, [0.1, 0, 0, 0, 0, 0.3]], names), irb120)
    assert np.allclose(made.wire[1], [0.3, 0, 0, 0, 0, 0.1])


def test_all_findings_at_once(irb120):
    positions = np.zeros((5, 6))
    positions[0, 0] = 0.5  # away from the robot
    positions[2, 1] = np.nan
    positions[3, 2] = 9.0  # outside, and too fast
    trajectory = Trajectory([0, 1, 1, 2, 2.01], positions)
    with pytest.raises(InvalidTrajectory) as error:
        check_trajectory(trajectory, irb120, DriverLimits(4), start=[0.0] * 10)
    assert codes(error) == ["RG617"]
    with pytest.raises(InvalidTrajectory) as error:
        check_trajectory(trajectory, irb120, start=[0.0] * 10)
    assert sorted(set(codes(error))) == [
        "RG612",
        "RG613",
        "RG614",
        "RG615",
        "RG616",
        "RG618",
    ]


@pytest.mark.parametrize("seconds", [3601.0, 2e9])
def test_segment_of_more_than_an_hour_is_rejected(irb120, seconds):
    """As the driver would, but with the reason: ROS_MAX_DURATION of ROS_motionServer."""
    with pytest.raises(InvalidTrajectory, match="at most 3600 s") as error:
        check_trajectory(Trajectory([0, seconds], np.zeros((2, 6))), irb120)
    assert codes(error) == ["RG612"]
    check_trajectory(Trajectory([0, 3600.0], np.zeros((2, 6))), irb120)
    template = (data_folder("templates") / "ROS_motionServer.mod.j2").read_text("utf-8")
    assert "CONST num ROS_MAX_DURATION := 3600;" in template


def test_finding_has_the_line_of_its_file(irb120, tmp_path):
    path = tmp_path / "t.csv"
    rows = ["time," + ",".join(irb120.names), "0,0,0,0,0,0,0", "# far out", "9,0,0,4,0,0,0"]
    path.write_text("\n".join(rows))
    with pytest.raises(InvalidTrajectory) as error:
        check_trajectory(Trajectory.from_csv(path), irb120, start=[0.0] * 10)
    (result,) = error.value.diagnostics
    assert (result.code, result.span.line) == ("RG614", 4)
    assert irb120.names[2] in result.message


def test_names_that_do_not_fit(irb120):
    names = ("joint_7", *irb120.names[1:5], "joint_8")
    with pytest.raises(InvalidTrajectory) as error:
        check_trajectory(Trajectory([0], [HOME], names), irb120)
    assert codes(error) == ["RG611"] * 3
    with pytest.raises(InvalidTrajectory, match="twice"):
        Trajectory([0], [HOME], (*irb120.names[:5], irb120.names[1]))
    with pytest.raises(InvalidTrajectory):
        check_trajectory(Trajectory([0], [[0.0] * 5]), irb120)
    with pytest.raises(InvalidTrajectory) as error:
        check_trajectory(Trajectory([], np.zeros((0, 6))), irb120)
    assert codes(error) == ["RG619"]


def test_limits_are_inclusive_up_to_float32(irb120):
    upper = [joint.upper for joint in irb120.joints]
    point = [float(np.float32(value)) for value in upper]
    check_trajectory(Trajectory([30], [point]), irb120)
    with pytest.raises(InvalidTrajectory):
        check_trajectory(Trajectory([30], [[value + 1e-4 for value in upper]]), irb120)


def test_coupled_limits_are_those_of_the_axes(irb2400):
    coupling = irb2400.map.coupling
    assert coupling
    third = irb2400.joints[2]
    # Joint 3 alone is inside; with joint 2 the controller's axis 3 is not.
    urdf = list(irb2400.map.to_urdf([0.0] * 6))
    second = irb2400.joints[1].upper * 0.9
    urdf[1] = second
    urdf[2] = third.upper - coupling * second + 0.05
    with pytest.raises(InvalidTrajectory) as error:
        check_trajectory(Trajectory([60], [urdf]), irb2400)
    assert codes(error) == ["RG614"]
    assert "coupled" in error.value.diagnostics[0].notes[0]


def test_the_map_is_the_one_of_axes(irb2400):
    random = np.random.default_rng(3)
    points = random.uniform(-1, 1, (20, 6))
    expected = [irb2400.map.to_controller(row) for row in points.tolist()]
    assert np.allclose(irb2400.to_wire(points), expected, atol=1e-15)
    back = [irb2400.from_wire((*row, 0, 0, 0, 0)) for row in expected]
    assert np.allclose(back, points, atol=1e-12)


def test_single_point(irb120):
    point = [0.3] * 6
    far = Trajectory([0], [point])
    with pytest.raises(InvalidTrajectory) as error:
        check_trajectory(far, irb120, start=[0.0] * 10)
    assert set(codes(error)) == {"RG616"}
    ours = DriverLimits(100, goes_to_single=True)
    assert len(check_trajectory(far, irb120, ours, start=[0.0] * 10).wire) == 2
    timed = check_trajectory(Trajectory([2.0], [point]), irb120, start=[0.0] * 10)
    assert timed.durations.tolist() == [2.0, irb120.policy.min_segment]
    with pytest.raises(InvalidTrajectory) as error:
        check_trajectory(Trajectory([0.05], [point]), irb120, start=[0.0] * 10)
    assert "RG615" in codes(error)


def test_scaled_resampled_reversed_and_starting_elsewhere():
    trajectory = Trajectory.from_points([[0.0], [1.0], [0.0]], seconds=1.0, names=("a",))
    assert trajectory.scaled(0.5).duration == 4.0
    fine = trajectory.resampled(0.25)
    assert fine.times.tolist() == pytest.approx([0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2])
    assert fine.positions[:, 0].tolist() == pytest.approx(
        [0, 0.25, 0.5, 0.75, 1, 0.75, 0.5, 0.25, 0]
    )
    ramp = Trajectory([0, 1, 3], [[0], [1], [2]], ("a",)).reversed()
    assert ramp.times.tolist() == [0, 2, 3]
    assert ramp.positions[:, 0].tolist() == [2, 1, 0]
    for wrong in (0, -1, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="above 0"):
            trajectory.scaled(wrong)


def test_timed_stays_within_speed_limits(irb120):
    points = np.random.default_rng(1).uniform(-1, 1, (20, 6))
    points[0] = 0
    rough = Trajectory.from_points(points, seconds=0.001)
    with pytest.raises(InvalidTrajectory):
        check_trajectory(rough, irb120, start=[0.0] * 10)
    good = rough.timed(irb120)
    check_trajectory(good, irb120, start=[0.0] * 10)
    assert rough.timed(irb120, 0.5).duration > good.duration


def test_timed_wants_the_joints_of_the_robot(irb120):
    """A missing joint is an error; an unknown one is not dropped."""
    ends = np.zeros((2, 7))
    named = (*irb120.names, "gripper")
    for width, names, message in (
        (5, named[:5], "joints are missing: joint_6"),
        (7, named, "no joint 'gripper'"),
        (5, (), "5 joints, the robot has 6"),
    ):
        path = Trajectory.from_points(ends[:, :width], seconds=1.0, names=names)
        with pytest.raises(InvalidTrajectory, match=message):
            path.timed(irb120)


def test_dataframe_has_times_and_joints():
    path = Trajectory.from_points([[0, 1], [2, 3]], seconds=1, names=["a", "b"])
    frame = path.to_dataframe()
    assert frame.index.name == "time"
    assert list(frame.columns) == ["a", "b"]
    assert frame.loc[1.0, "b"] == 3
    assert list(replace(path, names=()).to_dataframe().columns) == ["joint_1", "joint_2"]


def test_degrees_in_place_of_rad_are_named():
    group = Group.of(config := load_config("irb120"), config.groups[0])
    path = Trajectory([0, 5], [[0.0] * 6, [90.0, 0, 0, 0, 0, 0]], group.names)
    with pytest.raises(InvalidTrajectory) as refused:
        check_trajectory(path, group)
    assert "looks like degrees" in refused.value.diagnostics[0].help

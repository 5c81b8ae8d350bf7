"""An axis without a joint keeps its position, in downloads and streams."""

import math

import pytest

from rapidgen.config import load_config
from rapidgen.config.registry import find_shipped
from rapidgen.generate import build, make_system
from rapidgen.verification.messages import RawReason
from rapidgen.verification.stream import BEGIN, END, Streamer
from rapidgen.verification.testbench import Bench

URDF = find_shipped("irb120").parent / "urdf" / "irb120.urdf"
JOINTS = "\n".join(f"  joint_{n}: {{axis: rax_{n}}}" for n in (1, 2, 3, 4, 6))
THIRTY = math.radians(30)


@pytest.fixture
def robot(tmp_path):
    """A controller of an IRB 120 whose axis 5 stands somewhere, with a driver that keeps it."""
    benches = []

    def boot(keep, axis_value):
        (tmp_path / "cell.yaml").write_text(
            f"urdf: {{file: {URDF}, ignore_joints: [joint_5]}}\nheld_axes: {keep}\n"
            f"joints:\n{JOINTS}\n"
        )
        config = load_config(tmp_path / "cell.yaml")
        bench = Bench(
            config, make_system(config, build(config)), robots=load_config("irb120").groups
        )
        benches.append(bench)
        bench.motion_group.jump((0.0, 0.1, 0.0, 0.0, axis_value, 0.0))
        bench.run(1)
        return bench

    yield boot
    for bench in benches:
        bench.close()


def way(bench):
    """Three points of the driver's five joints."""
    here = tuple(v for n, v in enumerate(bench.position) if n != 4)
    return [
        (here, 1.0),
        ((0.2, *here[1:]), 1.0),
        ((0.2, 0.2, *here[2:]), 1.0),
    ]


def as_moved(bench, before):
    assert bench.position[:2] == pytest.approx((0.2, 0.2))
    assert all(place[4] == pytest.approx(before, abs=1e-6) for _, place in bench.track)


@pytest.mark.parametrize(
    ("keep", "message"),
    [
        ("[rax_5]", "No joint drives axis 5: it is held where it stands when a trajectory begins."),
        (
            "{rax_5: -30}",
            "No joint drives axis 5: a trajectory is refused unless it stands at -30 deg.",
        ),
    ],
)
def test_the_readme_tells(tmp_path, keep, message):
    (tmp_path / "cell.yaml").write_text(
        f"urdf: {{file: {URDF}, ignore_joints: [joint_5]}}\nheld_axes: {keep}\njoints:\n{JOINTS}\n"
    )
    files = build(load_config(tmp_path / "cell.yaml")).files
    assert [f for f in files if f.kind == "readme" and message in f.data.decode()]


@pytest.mark.parametrize("keep", ["[rax_5]", "{rax_5: 30}"])
def test_trajectory_leaves_the_held_axis_in_place(robot, keep):
    bench = robot(keep, THIRTY)
    bench.motion().send(bench.download(way(bench)))
    bench.run(10)
    as_moved(bench, THIRTY)


def test_trajectory_with_held_axis_off_its_place_is_refused(robot):
    bench = robot("{rax_5: 30}", -THIRTY)
    bench.motion().send(bench.download(way(bench)))
    bench.run(10)
    assert bench.position == pytest.approx((0.0, 0.1, 0.0, 0.0, -THIRTY, 0.0))


def test_it_was_jogged_while_the_trajectory_came(robot):
    bench = robot("[rax_5]", THIRTY)
    link, points = bench.motion(), bench.download(way(bench))
    link.send(points[: len(points) // 3])
    bench.run(1)
    bench.motion_group.jump((0.0, 0.1, 0.0, 0.0, 0.4, 0.0))
    link.send(points[len(points) // 3 :])
    bench.run(10)
    assert bench.position == pytest.approx((0.0, 0.1, 0.0, 0.0, 0.4, 0.0))


def test_stream_leaves_the_held_axis_in_place(robot):
    bench = robot("[rax_5]", THIRTY)
    stream = Streamer(bench)
    stream.takes("a way with axis 5 kept", way(bench), BEGIN | END)
    bench.run(10)
    as_moved(bench, THIRTY)


def test_stream_with_held_axis_off_its_place_is_refused(robot):
    bench = robot("{rax_5: -30}", THIRTY)
    Streamer(bench).refuses(
        RawReason.START_TOO_FAR, "axis 5 stands elsewhere", way(bench), BEGIN | END
    )

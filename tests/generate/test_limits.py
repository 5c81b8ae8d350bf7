"""Limits of the axes that the controller tells: the narrower ones count, and what is in doubt is
refused. Instances and attributes of MOC as in backups of controllers; rad and m."""

import math
import struct

import pytest

from rapidgen.generate import layout
from rapidgen.machine.system_parameters import arm_name
from rapidgen.runtime.switches import Switches
from tests.generate.bench import Bench, close_to, trajectory
from tests.generate.driving import LIMIT, move_well, reply_of, send_all

HELLO = 1300


def booted(b: Bench, **bounds):
    """The same controller, restarted with other limits: `rob1_1=(lower, upper)` in rad or m."""
    for arm, (lower, upper) in bounds.items():
        (found,) = b.vc.configuration.find(f"/MOC/ARM/{arm}")
        found["lower_joint_bound"], found["upper_joint_bound"] = lower, upper
    b.vc.log.clear()
    b.vc.perform("power-loss")
    b.vc.run_for(2)
    b.vc.perform("motors-on")
    b.vc.perform("start")
    b.vc.run_for(2)
    return b


def told(b):
    """Titles of what the driver says about limits."""
    return [(int(e.type), e.title, e.texts) for e in b.vc.log if "limits of joint" in e.title]


def hello_limits(b):
    state = b.state_client()
    state.send(struct.pack("<9i", 32, HELLO, 2, 0, 2, 0, 1, 0, 0))
    frame = None
    while frame is None or struct.unpack_from("<i", frame, 4)[0] != HELLO:
        frame = state.wait_frame()
        assert frame is not None
    lower, upper = struct.unpack_from("<10f", frame, 88), struct.unpack_from("<10f", frame, 128)
    return lower, upper


def single(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def try_point(b, joints):
    """The reply to a trajectory from here to there."""
    client = b.client()
    send_all(client, trajectory([list(b.joints()), joints], [10, 8]))
    reply = reply_of(client)
    b.vc.run_for(10 if reply[0] == 1 else 1)
    client.close()
    b.vc.run_for(2)
    return reply


def test_the_same_limits_are_not_worth_a_word(bench):
    b = booted(bench())
    assert told(b) == []
    joints = b.config.groups[0].joints
    lower, upper = hello_limits(b)
    assert lower[:6] == tuple(single(j.lower) for j in joints)
    assert upper[:6] == tuple(single(j.upper) for j in joints)
    assert lower[6:] == upper[6:] == (0.0,) * 4


def test_fewer_digits_are_no_difference(bench):
    """165 degrees in a backup: 2.87979. The limit itself is still a place to go."""
    b = booted(bench(), rob1_1=(-2.87979, 2.87979))
    assert told(b) == []
    limit = b.config.groups[0].joints[0].upper
    assert try_point(b, [limit, 0, 0, 0, 0, 0])[0] == 1
    assert b.joints()[0] == pytest.approx(2.87979, abs=1e-6)


def test_a_narrower_limit_counts(bench):
    b = booted(bench(), rob1_1=(-1.0, 0.5), rob1_3=(-1.0, 1.2217305))
    assert told(b) == [
        (
            2,
            "ROS: limits of joint 1 are narrower",
            (
                "Those of the controller count.",
                "Configuration: -165 to 165 deg",
                "Controller: -57.3 to 28.65 deg",
            ),
        ),
        (
            2,
            "ROS: limits of joint 3 are narrower",
            (
                "Those of the controller count.",
                "Configuration: -110 to 70 deg",
                "Controller: -57.3 to 70 deg",
            ),
        ),
    ]
    lower, upper = hello_limits(b)
    assert (lower[0], upper[0], lower[2]) == (-1.0, 0.5, -1.0)
    assert try_point(b, [0.6, 0, 0, 0, 0, 0]) == (2, (LIMIT, 1, 1))
    assert try_point(b, [0, 0, -1.1, 0, 0, 0]) == (2, (LIMIT, 1, 3))
    assert b.joints() == (0.0,) * 6
    assert try_point(b, [0.49, 0, -0.99, 0, 0, 0])[0] == 1
    assert close_to(b.joints(), (0.49, 0, -0.99, 0, 0, 0))
    assert b.healthy()


def test_a_wider_limit_does_not(bench):
    b = booted(bench(), rob1_4=(-30.0, 30.0))
    assert told(b) == [
        (
            1,
            "ROS: limits of joint 4 are wider",
            (
                "Those of the configuration count.",
                "Configuration: -160 to 160 deg",
                "Controller: -1718.87 to 1718.87 deg",
            ),
        )
    ]
    for joint in (2.9, -2.9):
        assert try_point(b, [0, 0, 0, joint, 0, 0]) == (2, (LIMIT, 1, 4))
    move_well(b)


@pytest.mark.parametrize(
    "bounds",
    [(0.5, -0.5), (0.0, 0.0), (3.0, 4.0), (-4.0, -3.0), (1e30, -1e30)],
    ids=["reversed", "none", "above", "below", "far"],
)
def test_what_makes_no_sense_is_refused(bench, bounds):
    b = booted(bench(), rob1_2=bounds)
    ((kind, title, texts),) = told(b)
    assert (kind, title) == (3, "ROS: limits of joint 2 make no sense")
    assert texts[0] == "No trajectory is taken."
    for joint in (0.0, 0.1, bounds[0], bounds[1]):
        client = b.client()
        send_all(client, trajectory([[0] * 6, [0, joint, 0, 0, 0, 0]], [10, 5]))
        assert reply_of(client) == (2, (LIMIT, 0, 2))
    lower, upper = hello_limits(b)
    assert lower[1] > upper[1]
    b.vc.run_for(1)
    assert b.joints() == (0.0,) * 6
    assert b.healthy()


def test_a_controller_that_does_not_tell(bench):
    b = booted(bench(options={"dialect": Switches(axis_limits_told=False)}))
    assert told(b) == []
    lower, _ = hello_limits(b)
    assert lower[0] == single(b.config.groups[0].joints[0].lower)
    move_well(b)
    limit = b.config.groups[0].joints[0].upper
    assert try_point(b, [limit + 0.001, 0, 0, 0, 0, 0]) == (2, (LIMIT, 1, 1))


def test_a_controller_that_tells_something_else(bench):
    b = bench()
    (first,), (second,) = (b.vc.configuration.find(f"/MOC/ARM/rob1_{n}") for n in (1, 2))
    first["upper_joint_bound"] = "many"
    del second["lower_joint_bound"]
    booted(b)
    assert told(b) == []
    assert b.healthy()
    move_well(b)


def test_a_limit_that_was_widened_again(bench):
    b = booted(bench(), rob1_1=(-0.5, 0.5))
    assert try_point(b, [0.6, 0, 0, 0, 0, 0])[0] == 2
    booted(b, rob1_1=(-2.8797932, 2.8797932))
    assert told(b) == []
    assert try_point(b, [0.6, 0, 0, 0, 0, 0])[0] == 1


def test_linear_axes_and_axes_of_units(bench):
    """A track's limits are in m [backups: M7DM1], a YuMi's seventh axis is rob_L_7 [code]."""
    b = booted(bench("irb120_track"), TRACK_1=(0.0, 2.0), STN_1=(-math.pi / 2, math.pi))
    assert [t[1] for t in told(b)] == [
        "ROS: limits of joint 7 are narrower",
        "ROS: limits of joint 8 are narrower",
    ]
    assert told(b)[0][2][1:] == ("Configuration: 0 to 3000 mm", "Controller: 0 to 2000 mm")
    here = list(b.joints())
    assert try_point(b, [*here[:6], 2.5, 0.0]) == (2, (LIMIT, 1, 7))
    assert try_point(b, [*here[:6], 0.1, -1.6]) == (2, (LIMIT, 1, 8))
    assert try_point(b, [*here[:6], 0.1, -1.5])[0] == 1


def test_each_arm_of_a_yumi_has_its_own(bench):
    b = booted(bench("irb14000"), rob_L_7=(-1.0, 1.0))
    assert [t[1] for t in told(b)] == ["ROS: limits of joint 7 are narrower"]


@pytest.mark.parametrize("name", ["irb120", "irb14000", "irb14050", "irb120_track", "irb460"])
def test_the_driver_asks_for_arms_that_there_are(bench, name):
    for group in bench(name).config.groups:
        for joint in group.joints:
            assert layout.arm(group, joint).lower() == arm_name(group, joint).lower()

"""The watcher of a ROS 1 package, with a stand-in of rospy."""

import sys
from types import ModuleType, SimpleNamespace

import pytest

from rapidgen.config import load_config
from rapidgen.ros.package import ros1_package

PENDING, ACTIVE, SUCCEEDED = 0, 1, 3


class Ros:
    """Subscriptions and publications of the watcher, at a given time."""

    def __init__(self, monkeypatch):
        self.now, self.received, self.cancelled = 0.0, {}, []
        rospy = ModuleType("rospy")
        rospy.init_node = rospy.logerr = lambda *_: None
        rospy.spin = lambda: None
        rospy.get_time = lambda: self.now
        rospy.Publisher = lambda topic, kind, queue_size: SimpleNamespace(
            publish=lambda goal: self.cancelled.append(goal.id)
        )
        rospy.Subscriber = lambda topic, kind, call: self.received.__setitem__(topic, call)
        actions, industrial = ModuleType("actionlib_msgs.msg"), ModuleType("industrial_msgs.msg")
        actions.GoalID = lambda id="": SimpleNamespace(id=id)
        actions.GoalStatus = SimpleNamespace(PENDING=PENDING, ACTIVE=ACTIVE)
        actions.GoalStatusArray = industrial.RobotStatus = object
        for module in (rospy, actions, industrial):
            monkeypatch.setitem(sys.modules, module.__name__, module)

    def goals(self, **states):
        report = [
            SimpleNamespace(goal_id=SimpleNamespace(id=name), status=status)
            for name, status in states.items()
        ]
        if "joint_trajectory_action/status" in self.received:
            self.received["joint_trajectory_action/status"](SimpleNamespace(status_list=report))

    def status(self, in_error, seconds=0.1):
        self.now += seconds
        report = SimpleNamespace(in_error=SimpleNamespace(val=in_error), error_code=104)
        self.received["robot_status"](report)


@pytest.fixture
def ros(monkeypatch):
    made = Ros(monkeypatch)
    script = ros1_package(load_config("irb120"), "irb120", "irb120")["scripts/watcher.py"]
    exec(compile(script, "watcher.py", "exec"), {"__name__": "__main__"})
    return made


def test_a_refused_goal_is_cancelled_at_once(ros):
    ros.goals(a=ACTIVE)
    ros.status(0)
    ros.status(1)
    ros.status(1)
    assert ros.cancelled == ["a"]


def test_a_second_refused_goal_is_cancelled_though_the_error_never_went(ros):
    """Between two refusals the driver takes its error back for less than a state message."""
    ros.goals(a=ACTIVE)
    ros.status(1)
    ros.goals(a=SUCCEEDED, b=PENDING)
    for _ in range(10):
        ros.status(1)
        ros.goals(a=SUCCEEDED, b=ACTIVE)
    assert ros.cancelled == ["a", "b"]


def test_good_goal_after_refused_one_is_not_cancelled(ros):
    ros.goals(a=ACTIVE)
    ros.status(1)
    ros.goals(a=SUCCEEDED, b=ACTIVE)
    ros.status(1, 0.2)
    for _ in range(20):
        ros.status(0)
    assert ros.cancelled == ["a"]


def test_error_before_goal_cancels_after_a_delay(ros):
    ros.status(1)
    ros.goals(a=ACTIVE)
    ros.status(1)
    assert ros.cancelled == []
    ros.status(1, 0.6)
    assert ros.cancelled == ["a"]

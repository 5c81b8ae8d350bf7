"""Trial: the unmodified C++ nodes of ros-industrial/abb_driver against the generated driver.

    python -m tests.foreign.ros_nodes WORKSPACE [CASE...]
    (or: make foreign PROGRAM=ros_nodes FOREIGN=WORKSPACE)

WORKSPACE is a built catkin workspace (ROS 1) with abb_driver, industrial_core and control_msgs;
nothing of it is part of this project. rosmaster, rospy and roslaunch come from the system. Each
case boots `rapidgen sim` on an address of loopback, at the standard ports, starts the nodes, and
drives them with rospy. Where abb_driver's RAPID lies in the workspace, each case runs against
that, too, for comparison: what it does is shown and not judged. Exit code 1: a case of
the generated driver has not come out as it should.
"""

import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from signal import SIGCONT, SIGINT, SIGKILL, SIGSTOP

from rapidgen.protocol import spec
from tests.foreign.abb_driver import read_system
from tests.foreign.ros import HOST, Workspace, until, write_backup
from tests.foreign.ros_cell import FALSE, TRUE, Cell

URDF = Path(__file__).parents[2] / "robots" / "urdf"
FIVE = ([0.0], [0.125], [0.25, 0.125], [0.5, 0.25, 0, 0, 0, 0.125], [0.5, 0.25, -0.5, 0, 0, 0.25])
ACTIVE, PREEMPTED, SUCCEEDED, ABORTED = 1, 2, 3, 4
"""actionlib_msgs/GoalStatus."""


@dataclass(frozen=True)
class Case:
    """What is tried, with which controllers."""

    title: str
    run: Callable[[Cell, "Findings"], None]
    robot: str = "irb120"
    options: tuple[str, ...] = ()
    coupled: bool = False
    upstream: bool = True
    """Whether abb_driver's modules can do it at all."""


CASES: dict[str, Case] = {}


def case(title: str, **what: object):
    """Enter a function into CASES."""

    def enter(function):
        CASES[function.__name__] = Case(title, function, **what)
        return function

    return enter


class Findings:
    """What came out of a case: sentences, each with whether it is as it should be."""

    def __init__(self) -> None:
        self.lines: list[tuple[bool, str]] = []

    def tell(self, text: str) -> None:
        """What is only told."""
        self.lines.append((True, text))

    def must(self, holds: object, text: str) -> None:
        """What should hold."""
        self.lines.append((bool(holds), text))

    def __str__(self) -> str:
        return "; ".join(text if good else f"NOT: {text}" for good, text in self.lines)


def code(reason: spec.Reason, joint: int = 0) -> int:
    """error_code of STATUS."""
    return spec.error_code(reason, joint)


# -- state --------------------------------------------------------------------------------------


def _rate(cell: Cell, found: Findings, hertz: float) -> None:
    cell.command_service(cell.trajectory(FIVE))
    cell.wait_moving(15)
    cell.wait_standing()
    begin = time.monotonic()
    time.sleep(5)
    times = [at for at, _ in cell.joints if at >= begin]
    rate = (len(times) - 1) / (times[-1] - times[0])
    gap = max(b - a for a, b in pairwise(times))
    found.must(abs(rate - hertz) < 0.05 * hertz, f"joint_states at {rate:.1f} Hz of {hertz:g}")
    found.tell(f"longest gap {gap * 1000:.0f} ms")
    said = cell.joints[-1][1]
    off = max(abs(a - b) for a, b in zip(said.position, cell.sim.positions(), strict=True))
    found.must(list(said.name) == cell.names and off < 1e-6, f"positions agree to {off:.0e} rad")
    now = cell.now
    found.must(
        (now.mode.val, now.drives_powered.val, now.e_stopped.val, now.motion_possible.val)
        == (2, TRUE, FALSE, TRUE),
        "robot_status: automatic, drives on, no e-stop, motion possible",
    )


@case("joint_states and robot_status at the default rate")
def states(cell: Cell, found: Findings) -> None:
    _rate(cell, found, 10)


@case("the same at state.rate 50", options=("--set", "state.rate=50"), upstream=False)
def fast_states(cell: Cell, found: Findings) -> None:
    _rate(cell, found, 50)


@case("60 s without a command, then a trajectory")
def idle(cell: Cell, found: Findings) -> None:
    begin = time.monotonic()
    time.sleep(60)
    times = [at for at, _ in cell.joints if at >= begin]
    gap = max(b - a for a, b in pairwise(times))
    found.must(gap < 1, f"states all the time, longest gap {gap * 1000:.0f} ms")
    cell.publish(cell.trajectory(FIVE))
    found.must(cell.arrives(FIVE[-1], 15), "the trajectory is executed")
    lost = sum(len(n.said("ERROR", "WARN")) for n in cell.nodes.values())
    found.must(not lost, "no node warns")


# -- trajectories -------------------------------------------------------------------------------


@case("five points by the topic joint_path_command")
def topic(cell: Cell, found: Findings) -> None:
    with cell.sim.sampled() as samples:
        cell.publish(cell.trajectory(FIVE))
        cell.wait_moving(15)
        first = time.monotonic()
        last = cell.wait_standing()
    found.must(cell.at(FIVE[-1]), "ends at the last point")
    miss = max(
        min(
            max(abs(a - b) for a, b in zip(here, [*point, *[0.0] * 6], strict=False))
            for _, here in samples
        )
        for point in FIVE
    )
    found.must(miss < 0.03, f"passes every point within {miss:.3f} rad")
    found.must(abs(last - first - 2) < 0.4, f"{last - first:.1f} s of motion for 2.0 s")
    moving = {s.in_motion.val for _, s in cell.status}
    found.must(moving == {TRUE, FALSE} and cell.now.in_error.val == FALSE, "in_motion 0, 1, 0")


@case("by the action joint_trajectory_action")
def action(cell: Cell, found: Findings) -> None:
    client = cell.action()
    client.send_goal(cell.goal(cell.trajectory(FIVE)))
    import rospy

    ended = client.wait_for_result(rospy.Duration(25))
    found.must(ended and client.get_state() == SUCCEEDED, "SUCCEEDED")
    found.must(cell.sim.standing() and cell.at(FIVE[-1]), "the robot stands there then")


def _points(cell: Cell, found: Findings, count: int, step: float, patience: float) -> None:
    end = 0.002 * (count - 1)
    cell.publish(cell.trajectory([[0.002 * k] for k in range(count)], step=step))
    cell.wait_moving(15)
    begin = time.monotonic()
    there = cell.arrives([end], patience)
    took = time.monotonic() - begin
    if not there:
        cell.wait_standing(patience)
    last = cell.sim.positions()[0]
    found.must(there, f"ends at {last:.3f} rad of {end:.3f}, after {took:.1f} s")
    found.must(abs(took - step * (count - 1)) < 1 or not there, "in the time asked for")
    now = cell.next_status()
    found.must(now.error_code == 0, f"error_code {now.error_code}")
    points_lost = cell.sim.process.said("50024", "oo many", "xceed")
    if points_lost:
        found.tell(f"{len(points_lost)} lines such as {points_lost[0].strip()!r}")


@case("101 points, 0.1 s each")
def points_101(cell: Cell, found: Findings) -> None:
    _points(cell, found, 101, 0.1, 40)


@case("300 points, 0.1 s each")
def points_300(cell: Cell, found: Findings) -> None:
    _points(cell, found, 300, 0.1, 60)


@case("a single point, from where the robot stands")
def single(cell: Cell, found: Findings) -> None:
    cell.publish(cell.trajectory([[0.3]], start=2.0))
    found.must(cell.arrives([0.3], 15), "goes there")
    found.must(cell.next_status().error_code == 0, "no error")


# -- stops --------------------------------------------------------------------------------------


def _halted(cell: Cell, found: Findings, begin: float) -> None:
    until(cell.sim.standing, 15, "it never stood")
    took = time.monotonic() - begin
    found.must(took < 1, f"the robot stands {took:.2f} s later")
    where = cell.sim.positions()[0]
    found.must(cell.quiet(2), f"and stays (at {where:.2f} rad)")
    now = cell.next_status()
    found.must(
        (now.in_motion.val, now.in_error.val) == (FALSE, FALSE),
        f"in_motion {now.in_motion.val}, in_error {now.in_error.val}",
    )
    cell.publish(cell.ramp(1, to=0.0))
    found.must(cell.arrives([0.0], 25), "a new trajectory from there is executed")


def _moving(cell: Cell, found: Findings) -> None:
    cell.publish(cell.ramp(6, to=1.2))
    cell.wait_moving(15)
    time.sleep(1)


@case("the service stop_motion while the robot moves")
def stop(cell: Cell, found: Findings) -> None:
    _moving(cell, found)
    begin = time.monotonic()
    took = cell.stop()
    found.must(took < 0.5, f"answered after {took * 1000:.0f} ms")
    _halted(cell, found, begin)


@case("stop_motion while the robot stands, twice")
def stop_at_rest(cell: Cell, found: Findings) -> None:
    took = max(cell.stop(), cell.stop())
    found.must(took < 0.5, f"answered within {took * 1000:.0f} ms")
    cell.publish(cell.trajectory(FIVE))
    found.must(cell.arrives(FIVE[-1], 25), "a trajectory right behind is executed")


@case("an empty trajectory while the robot moves")
def empty(cell: Cell, found: Findings) -> None:
    _moving(cell, found)
    _halted(cell, found, cell.publish(cell.trajectory([])))


@case("a goal cancelled while the robot moves")
def cancel(cell: Cell, found: Findings) -> None:
    client = cell.action()
    client.send_goal(cell.goal(cell.ramp(6, to=1.2)))
    cell.wait_moving(15)
    time.sleep(1)
    begin = time.monotonic()
    client.cancel_goal()
    import rospy

    client.wait_for_result(rospy.Duration(5))
    found.must(client.get_state() == PREEMPTED, "PREEMPTED")
    _halted(cell, found, begin)


@case("the motion node ended by Ctrl-C while the robot moves")
def interrupted_node(cell: Cell, found: Findings) -> None:
    _moving(cell, found)
    node = cell.nodes["motion_download_interface"]
    begin = time.monotonic()
    ended = node.end(SIGINT, 5)
    found.must(ended is not None, "the node ends (its STOP is answered)")
    cell.start_node("abb_driver", "motion_download_interface")
    cell.ready()
    _halted(cell, found, begin)


# -- replaced -----------------------------------------------------------------------------------


@case("a new trajectory by topic while the robot moves, from its old start")
def replaced(cell: Cell, found: Findings) -> None:
    _moving(cell, found)
    begin = time.monotonic()
    cell.publish(cell.trajectory(([0.0], [-0.2], [-0.4])))
    time.sleep(1)
    found.must(
        cell.quiet(2) and cell.sim.positions()[0] > 0.1,
        "the old one is stopped, the new one not begun",
    )
    now = cell.next_status()
    found.must(
        now.in_error.val == TRUE and now.error_code == code(spec.Reason.START_TOO_FAR, 1),
        f"in_error {now.in_error.val}, error_code {now.error_code}",
    )
    found.tell(f"at {cell.sim.positions()[0]:.2f} rad; log: {cell.user_sees(begin)!r}")
    if not cell.sim.standing():
        cell.wait_standing(40)
    cell.publish(cell.ramp(1, to=0.0))
    found.must(cell.arrives([0.0], 25), "one from where it stands is executed")
    found.must(cell.next_status().error_code == 0, "error_code is 0 again")


@case("a new goal by action while the robot moves: a single point")
def new_goal(cell: Cell, found: Findings) -> None:
    import rospy

    client = cell.action()
    client.send_goal(cell.goal(cell.ramp(6, to=1.2)))
    cell.wait_moving(15)
    time.sleep(1)
    client.send_goal(cell.goal(cell.trajectory([[-0.1]], start=3)))
    begin = time.monotonic()
    ended = client.wait_for_result(rospy.Duration(25))
    took = time.monotonic() - begin
    found.must(ended and client.get_state() == SUCCEEDED, f"SUCCEEDED after {took:.1f} s")
    found.must(cell.at([-0.1]), "the robot is there")


@case("a new goal by action while the robot moves: from its old start")
def new_goal_far(cell: Cell, found: Findings) -> None:
    import rospy

    client = cell.action()
    client.send_goal(cell.goal(cell.ramp(6, to=1.2)))
    cell.wait_moving(15)
    time.sleep(1)
    client.send_goal(cell.goal(cell.trajectory(([0.0], [-0.2], [-0.4]))))
    time.sleep(1)
    found.must(
        cell.quiet(2) and cell.sim.positions()[0] > 0.1,
        "the old one is stopped, the new one not begun",
    )
    now = cell.next_status()
    found.must(now.error_code == code(spec.Reason.START_TOO_FAR, 1), f"error_code {now.error_code}")
    ended = client.wait_for_result(rospy.Duration(3))
    found.tell(f"the goal {'has ended' if ended else 'stays'}: state {client.get_state()}")


@case("a single point by topic each half second, five times")
def jog(cell: Cell, found: Findings) -> None:
    for k in range(5):
        cell.publish(cell.trajectory([[0.05 * (k + 1)]], start=0.5))
        time.sleep(0.5)
    found.must(cell.arrives([0.25], 40), "the robot gets to the last one")
    found.must(cell.next_status().error_code == 0, "no error")


@case("the same trajectory twice at once")
def twice(cell: Cell, found: Findings) -> None:
    cell.publish(cell.trajectory(FIVE))
    cell.publish(cell.trajectory(FIVE))
    there = cell.arrives(FIVE[-1], 30)
    error = cell.next_status().error_code
    found.must(
        there or (cell.at([0.0], 0.02) and error),
        f"{'executed' if there else 'the first stopped, the second refused'}, error_code {error}",
    )


@case("a second trajectory whose first stamp is behind the last one of the first")
def late_stamps(cell: Cell, found: Findings) -> None:
    cell.publish(cell.trajectory([[0.0], [0.1]], step=0.5))
    found.must(cell.arrives([0.1], 25), "the first is executed")
    cell.publish(cell.trajectory([[0.1], [0.2], [0.3]], step=0.5, start=3.0))
    cell.wait_moving(15)
    begin = time.monotonic()
    found.must(cell.arrives([0.3], 25), "the second, too")
    found.tell(f"in {time.monotonic() - begin:.1f} s for 1.0 s")


# -- refused ------------------------------------------------------------------------------------


def _refused(cell: Cell, found: Findings, points, reason: spec.Reason, joint: int, step=0.5):
    begin = cell.publish(cell.trajectory(points, step=step))
    found.must(cell.quiet(3), "nothing moves")
    now = cell.next_status()
    found.must(
        now.in_error.val == TRUE and now.error_code == code(reason, joint),
        f"in_error {now.in_error.val}, error_code {now.error_code}",
    )
    found.tell(f"log: {cell.user_sees(begin)!r}")
    if not cell.sim.standing():
        cell.wait_standing(40)
    cell.publish(cell.ramp(1, to=0.2))
    found.must(cell.arrives([0.2], 25), "a good one behind it is executed")
    found.must(cell.next_status().in_error.val == FALSE, "in_error is 0 again")


@case("a point outside the limits")
def outside(cell: Cell, found: Findings) -> None:
    points = [[0.0], [1.0], [0.0, 0.0, 1.3]]
    _refused(cell, found, points, spec.Reason.JOINT_LIMIT, 3, step=2)


@case("a start 0.5 rad from the robot")
def far(cell: Cell, found: Findings) -> None:
    _refused(cell, found, [[0.0, 0.5], [0.0, 0.6]], spec.Reason.START_TOO_FAR, 2)


@case("a segment that an axis cannot follow (the URDF is unknown to the node)")
def fast(cell: Cell, found: Findings) -> None:
    _refused(cell, found, [[0.0], [0.1], [1.1]], spec.Reason.TOO_FAST, 1, step=0.15)


@case("points 0.02 s apart")
def dense(cell: Cell, found: Findings) -> None:
    points = [[0.002 * k] for k in range(100)]
    _refused(cell, found, points, spec.Reason.SEGMENT_TOO_SHORT, 0, step=0.02)


@case("a position that is not a number")
def not_a_number(cell: Cell, found: Findings) -> None:
    points = [[0.0], [float("nan")], [0.1]]
    _refused(cell, found, points, spec.Reason.NOT_FINITE, 1)


@case("a goal that the driver refuses")
def refused_goal(cell: Cell, found: Findings) -> None:
    import rospy

    client = cell.action()
    client.send_goal(cell.goal(cell.trajectory(([0.0, 0.5], [0.0, 0.6]))))
    ended = client.wait_for_result(rospy.Duration(5))
    found.tell(f"the goal {'has ended' if ended else 'stays'}: state {client.get_state()}")
    found.must(cell.quiet(1), "nothing moves")
    now = cell.next_status()
    found.must(now.error_code == code(spec.Reason.START_TOO_FAR, 2), f"error_code {now.error_code}")
    client.cancel_goal()
    client.wait_for_result(rospy.Duration(5))
    found.must(client.get_state() == PREEMPTED, "it can be cancelled")
    client.send_goal(cell.goal(cell.ramp(1, to=0.2)))
    ended = client.wait_for_result(rospy.Duration(25))
    found.must(ended and client.get_state() == SUCCEEDED, "the next goal succeeds")


# -- nodes and controllers that come and go -----------------------------------------------------


@case("the motion node killed in a download of 900 points, and started again")
def killed_download(cell: Cell, found: Findings) -> None:
    # Its output is read up to point 100 and no further: it is killed before it gets to the end.
    node = cell.nodes["motion_download_interface"]
    node.end(SIGKILL)
    node = cell.start_node(
        "abb_driver", "motion_download_interface", kill_at="Point[100] sent to controller"
    )
    cell.ready()
    cell.publish(cell.trajectory([[0.001 * k] for k in range(900)], step=0.1))
    node.line_with("Point[100] sent")
    until(lambda: not node.alive, 5, "it lives")
    cell.start_node("abb_driver", "motion_download_interface")
    cell.ready()
    quiet = cell.quiet(3)
    now = cell.next_status()
    found.must(quiet, "nothing moves")
    found.must(
        now.error_code == code(spec.Reason.INCOMPLETE),
        f"in_error {now.in_error.val}, error_code {now.error_code}",
    )
    cell.publish(cell.ramp(1, to=0.2))
    found.must(cell.arrives([0.2], 25), "the new node's trajectory is executed")


@case("the motion node killed while the robot moves, and started again")
def killed_moving(cell: Cell, found: Findings) -> None:
    _moving(cell, found)
    begin = time.monotonic()
    cell.nodes["motion_download_interface"].end(SIGKILL)
    until(cell.sim.standing, 15, "it never stood")
    took = time.monotonic() - begin
    found.must(took < 1, f"the robot stands {took:.2f} s later")
    cell.start_node("abb_driver", "motion_download_interface")
    cell.ready()
    now = cell.next_status()
    found.must(
        now.error_code == code(spec.Reason.CLIENT_LOST),
        f"in_error {now.in_error.val}, error_code {now.error_code}",
    )
    found.tell(f"log: {cell.user_sees(begin)!r}")
    found.must(cell.quiet(2), "nothing resumes")
    cell.publish(cell.ramp(1, to=0.0))
    found.must(cell.arrives([0.0], 25), "the new node's trajectory is executed")


@case("both nodes killed at rest, and started again")
def killed_at_rest(cell: Cell, found: Findings) -> None:
    for name in ("motion_download_interface", "robot_state"):
        cell.nodes[name].end(SIGKILL)
    begin = time.monotonic()
    for name in ("motion_download_interface", "robot_state"):
        cell.start_node("abb_driver", name)
    cell.ready()
    found.must(time.monotonic() - begin < 5, f"states after {time.monotonic() - begin:.1f} s")
    cell.publish(cell.trajectory(FIVE))
    found.must(cell.arrives(FIVE[-1], 25), "a trajectory is executed")


@case("the controller restarted under the nodes")
def restarted(cell: Cell, found: Findings) -> None:
    cell.sim.restart()
    begin = time.monotonic()
    cell.ready()
    found.must(time.monotonic() - begin < 8, f"states after {time.monotonic() - begin:.1f} s")
    cell.publish(cell.trajectory(FIVE))
    first = cell.arrives(FIVE[-1], 12)
    whole = "is executed" if first else "is lost in the node (its socket is dead), nothing moves"
    found.must(first or cell.at([0.0]), f"the first trajectory {whole}")
    if not first:
        cell.publish(cell.trajectory(FIVE))
        found.must(cell.arrives(FIVE[-1], 15), "the second one is executed")


@case("a second motion node while the first one is idle, then the first one again")
def two_nodes(cell: Cell, found: Findings) -> None:
    time.sleep(1.5)
    other = cell.start_node(
        "abb_driver",
        "motion_download_interface",
        "__name:=second",
        "joint_path_command:=second_command",
        "stop_motion:=second_stop",
        name="second",
    )
    other.line_with("Connected to server")
    publisher = _second_publisher()
    publisher.publish(cell.trajectory(FIVE))
    found.must(cell.arrives(FIVE[-1], 25), "the second one's trajectory is executed")
    time.sleep(2)
    cell.publish(cell.ramp(1, to=0.0))
    first = cell.at(FIVE[-1]) and not cell.arrives([0.0, *FIVE[-1][1:]], 14)
    found.must(
        not first or cell.at(FIVE[-1]),
        "the first one's next trajectory "
        + ("is lost in the node, nothing moves" if first else "is executed"),
    )
    if first:
        cell.publish(cell.ramp(1, to=0.0))
        found.must(cell.arrives([0.0, *FIVE[-1][1:]], 25), "the one after that is executed")
    publisher.unregister()


@case("a second motion node while the first one's trajectory is under way")
def two_nodes_moving(cell: Cell, found: Findings) -> None:
    _moving(cell, found)
    begin = time.monotonic()
    other = cell.start_node(
        "abb_driver",
        "motion_download_interface",
        "__name:=second",
        "joint_path_command:=second_command",
        "stop_motion:=second_stop",
        name="second",
    )
    other.line_with("Connected to server")
    time.sleep(2.5)
    moving = not cell.sim.standing()
    where = cell.sim.positions()[0]
    now = cell.next_status()
    found.tell(
        f"the robot {'goes on' if moving else f'was stopped at {where:.2f} rad'}, "
        f"error_code {now.error_code}; log: {cell.user_sees(begin)!r}"
    )
    if moving:
        found.must(cell.arrives([1.2], 25), "to the end")
    else:
        found.must(cell.quiet(2) and now.error_code, "with a reason, and stays")
    publisher = _second_publisher()
    publisher.publish(cell.ramp(1, to=0.0))
    found.must(cell.arrives([0.0], 25), "the second one's trajectory is executed")
    publisher.unregister()


def _second_publisher():
    from rospy import Publisher
    from trajectory_msgs.msg import JointTrajectory

    publisher = Publisher("second_command", JointTrajectory, queue_size=10)
    until(lambda: publisher.get_num_connections() >= 1, 10, "no second node")
    return publisher


@case("a second state node")
def two_states(cell: Cell, found: Findings) -> None:
    import rospy
    from sensor_msgs.msg import JointState

    heard: list[float] = []
    subscriber = rospy.Subscriber(
        "second_states", JointState, lambda _: heard.append(time.monotonic())
    )
    cell.start_node(
        "abb_driver",
        "robot_state",
        "__name:=second_state",
        "joint_states:=second_states",
        "robot_status:=second_status",
        "feedback_states:=second_feedback",
        name="second_state",
    )
    with suppress(AssertionError):
        until(lambda: heard, 8, "nothing")
    begin = time.monotonic()
    time.sleep(4)
    mine = sum(at >= begin for at, _ in cell.joints) / 4
    other = sum(at >= begin for at in heard) / 4
    found.must(mine > 9 and other > 9, f"the first gets {mine:.1f} Hz, the second {other:.1f} Hz")
    subscriber.unregister()


@case("the motion node stopped (SIGSTOP) for 20 s in a trajectory, then a second one started")
def frozen(cell: Cell, found: Findings) -> None:
    _moving(cell, found)
    node = cell.nodes["motion_download_interface"]
    node.send(SIGSTOP)
    found.must(cell.arrives([1.2], 20), "its trajectory is executed to the end")
    node.send(SIGCONT)
    took = cell.stop()
    found.must(took < 0.5, "it is served again")


# -- stops of the controller --------------------------------------------------------------------


def _interrupted(cell: Cell, found: Findings, what: str, reason: spec.Reason, *mend: str) -> None:
    _moving(cell, found)
    begin = time.monotonic()
    cell.sim.ask(what)
    until(cell.sim.standing, 10, "it never stood")
    found.tell(f"stands {time.monotonic() - begin:.2f} s later")
    now = cell.next_status(3)
    found.must(
        now.error_code == code(reason) and now.in_error.val == TRUE,
        f"in_error {now.in_error.val}, error_code {now.error_code}",
    )
    found.must(
        now.motion_possible.val == FALSE and now.in_motion.val == FALSE,
        f"motion_possible {now.motion_possible.val}, in_motion {now.in_motion.val}, "
        f"e_stopped {now.e_stopped.val}, drives_powered {now.drives_powered.val}",
    )
    cell.publish(cell.ramp(1, to=0.0))
    found.must(cell.quiet(1.5), "a trajectory now moves nothing")
    for step in mend:
        cell.sim.ask(step)
    found.must(cell.quiet(4), "nothing moves after Start")
    if not cell.sim.standing():
        cell.wait_standing(40)
    until(lambda: cell.next_status().motion_possible.val == TRUE, 10, "no motion possible")
    cell.publish(cell.ramp(1, to=0.0))
    found.must(cell.arrives([0.0], 25), "a new trajectory is executed")


@case("an emergency stop while the robot moves; reset, motors on, Start")
def emergency(cell: Cell, found: Findings) -> None:
    steps = ("reset-e-stop", "motors-on", "start")
    _interrupted(cell, found, "e-stop", spec.Reason.EMERGENCY_STOP, *steps)


@case("the program stopped while the robot moves; Start")
def program_stop(cell: Cell, found: Findings) -> None:
    _interrupted(cell, found, "stop", spec.Reason.PROGRAM_STOPPED, "start")


# -- other robots -------------------------------------------------------------------------------


@case("eight joints: a track and a positioner", robot="irb120_track", upstream=False)
def external_axes(cell: Cell, found: Findings) -> None:
    end = [0.1, 0.2, -0.1, 0.05, 0.1, 0.3, 0.4, -0.5]
    step = [[v * k / 4 for v in end] for k in range(5)]
    cell.publish(cell.trajectory(step))
    found.must(cell.arrives(end, 25), f"ends at the last point, order {', '.join(cell.names)}")
    cell.next_status()
    said = cell.joints[-1][1]
    off = max(abs(a - b) for a, b in zip(said.position, cell.sim.positions(), strict=True))
    found.must(list(said.name) == cell.names and off < 1e-6, f"joint_states agree to {off:.0e}")


@case("a coupled robot, J23_coupled true", robot="irb2400", coupled=True)
def coupled(cell: Cell, found: Findings) -> None:
    cell.publish(cell.trajectory(([0.0], [0.0, 0.15, 0.1], [0.0, 0.3, 0.2])))
    found.must(cell.arrives([0.0, 0.3, 0.5], 25), "axis 3 of the controller is joint 3 + joint 2")
    cell.next_status()
    said = cell.joints[-1][1].position
    found.must(
        max(abs(said[1] - 0.3), abs(said[2] - 0.2)) < 1e-6, f"joint_states say {said[2]:.3f}"
    )


@case("abb_driver's own launch file")
def launched(cell: Cell, found: Findings) -> None:
    import rospy

    for name in list(cell.nodes):
        cell.nodes.pop(name).end(SIGKILL)
    time.sleep(1)
    launch = cell.workspace.launch("abb_driver", "robot_interface.launch", f"robot_ip:={HOST}")
    cell.nodes["launch"] = launch
    cell.ready()
    cell.nodes["joint_trajectory_action"] = launch
    client = cell.action()
    client.send_goal(cell.goal(cell.trajectory(FIVE)))
    ended = client.wait_for_result(rospy.Duration(25))
    found.must(ended and client.get_state() == SUCCEEDED, "a goal succeeds")
    found.must(launch.end(SIGINT, 20) is not None, "it ends on Ctrl-C")


# -- the run ------------------------------------------------------------------------------------


def _try(workspace: Workspace, one: Case, target: str, options: tuple[str, ...]) -> Findings:
    found = Findings()
    urdf = URDF / f"{one.robot}.urdf"
    known = urdf if one.run is not fast else None
    try:
        cell = Cell(workspace, target, *options, robot=one.robot, urdf=known, coupled=one.coupled)
    except AssertionError as error:
        found.must(False, str(error))
        return found
    try:
        one.run(cell, found)
    except AssertionError as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        found.must(False, f"{error} ({place.name})")
        for name, node in cell.nodes.items():
            print(name, *[line for _, line in node.lines[-6:]], sep="\n    ", file=sys.stderr)
    finally:
        cell.close()
    return found


def main(folder: Path, wanted: list[str]) -> int:
    """Run the cases; 1 if one of the generated driver has failed."""
    rapid = next(folder.glob("src/**/ROS_motionServer.mod"), None)
    workspace = Workspace(folder)
    failed = []
    try:
        for name, one in CASES.items():
            if wanted and name not in wanted:
                continue
            print(f"## {name}: {one.title}", flush=True)
            ours = _try(workspace, one, one.robot, one.options)
            print(f"rapidgen: {ours}", flush=True)
            if not all(good for good, _ in ours.lines):
                failed.append(name)
            if rapid is not None and one.upstream:
                with tempfile.TemporaryDirectory() as scratch:
                    backup = write_backup(read_system(rapid.parent), Path(scratch) / "abb_driver")
                    theirs = _try(workspace, one, str(backup), ("--robot", one.robot))
                print(f"abb_driver: {theirs}", flush=True)
    finally:
        workspace.close()
    print(f"failed: {', '.join(failed) or 'none'}")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2:]))

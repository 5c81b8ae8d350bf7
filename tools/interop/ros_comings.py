"""Cases with ROS nodes: node restarts, controller stops, other robots."""

import time
from contextlib import suppress
from signal import SIGCONT, SIGINT, SIGKILL, SIGSTOP

from rapidgen.wire.simple_message import spec
from tools.interop.ros import HOST, until
from tools.interop.ros_case import FIVE, SUCCEEDED, Findings, begin_moving, case, code
from tools.interop.ros_cell import FALSE, TRUE, Cell

SILENT = "network: [{do: silent, port: 11000, direction: in, connection: 1, after: 340}]"
"""Five points pass, then no data, not even the end of the connection."""

# -- nodes and controllers that start and end ---------------------------------------------------


@case("the motion node killed in a download of 900 points, and started again")
def killed_download(cell: Cell, findings: Findings) -> None:
    # Its output is read up to point 100 and no further: it is killed before it gets to the end.
    node = cell.nodes["motion_download_interface"]
    node.end(SIGKILL)
    node = cell.start_motion_node(kill_at="Point[100] sent to controller")
    cell.publish(cell.trajectory([[0.001 * k] for k in range(900)], step=0.1))
    node.line_with("Point[100] sent")
    until(lambda: not node.alive, 5, "it lives")
    cell.start_motion_node()
    findings.must(cell.quiet(3), "nothing moves")
    findings.reports(cell, spec.Reason.INCOMPLETE, error=False)
    findings.ramped(cell, "the new node's trajectory is executed", to=0.2)


@case("the motion node killed while the robot moves, and started again")
def killed_moving(cell: Cell, findings: Findings) -> None:
    begin_moving(cell)
    begin = time.monotonic()
    cell.nodes["motion_download_interface"].end(SIGKILL)
    findings.stands(cell, begin)
    cell.start_motion_node()
    findings.reports(cell, spec.Reason.CLIENT_LOST, error=False)
    findings.tell(f"log: {cell.user_sees(begin)!r}")
    findings.must(cell.quiet(2), "nothing resumes")
    findings.ramped(cell, "the new node's trajectory is executed")


@case("both nodes killed at rest, and started again")
def killed_at_rest(cell: Cell, findings: Findings) -> None:
    for name in ("motion_download_interface", "robot_state"):
        cell.nodes[name].end(SIGKILL)
    begin = time.monotonic()
    for name in ("motion_download_interface", "robot_state"):
        cell.start_node("abb_driver", name)
    cell.ready()
    findings.must(time.monotonic() - begin < 5, f"states after {time.monotonic() - begin:.1f} s")
    findings.five(cell, "a trajectory is executed")


@case("the controller restarted under the nodes")
def restarted(cell: Cell, findings: Findings) -> None:
    cell.sim.restart()
    begin = time.monotonic()
    cell.ready()
    findings.must(time.monotonic() - begin < 8, f"states after {time.monotonic() - begin:.1f} s")
    cell.publish(cell.trajectory(FIVE))
    first = cell.arrives(FIVE[-1], 12)
    complete = "is executed" if first else "is lost in the node (its socket is dead), nothing moves"
    findings.must(first or cell.at([0.0]), f"the first trajectory {complete}")
    if not first:
        findings.five(cell, "the second one is executed", 15)


@case("a second motion node while the first one is idle, then the first one again")
def two_nodes(cell: Cell, findings: Findings) -> None:
    time.sleep(1.5)
    _start_second_node(cell)
    publisher = _second_publisher()
    publisher.publish(cell.trajectory(FIVE))
    findings.must(cell.arrives(FIVE[-1], 25), "the second one's trajectory is executed")
    time.sleep(2)
    cell.publish(cell.ramp(1, to=0.0))
    executed = cell.arrives([0.0, *FIVE[-1][1:]], 14)
    what = "is executed" if executed else "is lost in the node, nothing moves"
    findings.must(executed or cell.at(FIVE[-1]), f"the first one's next trajectory {what}")
    if not executed:
        cell.publish(cell.ramp(1, to=0.0))
        findings.must(cell.arrives([0.0, *FIVE[-1][1:]], 25), "the one after that is executed")
    publisher.unregister()


@case("a second motion node while the first one's trajectory is under way")
def two_nodes_moving(cell: Cell, findings: Findings) -> None:
    begin_moving(cell)
    _start_second_node(cell)
    time.sleep(2.5)
    moving, text = not cell.sim.standing(), cell.next_status().error_code
    what = "goes on" if moving else f"was stopped at {cell.sim.positions()[0]:.2f} rad"
    findings.must(moving and not text, f"the robot {what}, error_code {text}")
    findings.must(cell.arrives([1.2], 25), "to the end")
    publisher = _second_publisher()
    publisher.publish(cell.ramp(1, to=0.0))
    findings.must(cell.arrives([0.0], 25), "the second one's trajectory is executed")
    publisher.unregister()


@case(
    "a second motion node's stop_motion while the first one's trajectory is under way",
    upstream=False,
)
def second_stops(cell: Cell, findings: Findings) -> None:
    begin_moving(cell)
    _start_second_node(cell)
    time.sleep(1.5)
    findings.must(not cell.sim.standing(), "the robot goes on")
    begin = time.monotonic()
    took = cell.stop("second_stop")
    findings.must(took < 0.5, f"answered after {took * 1000:.0f} ms")
    findings.stands(cell, begin)
    findings.must(cell.quiet(2) and not cell.at([1.2]), "and stays")
    publisher = _second_publisher()
    publisher.publish(cell.ramp(1, to=0.0))
    findings.must(cell.arrives([0.0], 25), "the second one's trajectory is executed")
    publisher.unregister()


def _start_second_node(cell: Cell) -> None:
    """Start another connected motion node, with its own topics."""
    other = cell.start_node(
        "abb_driver",
        "motion_download_interface",
        "__name:=second",
        "joint_path_command:=second_command",
        "stop_motion:=second_stop",
        name="second",
    )
    other.line_with("Connected to server")


def _second_publisher():
    from rospy import Publisher
    from trajectory_msgs.msg import JointTrajectory

    publisher = Publisher("second_command", JointTrajectory, queue_size=10)
    until(lambda: publisher.get_num_connections() >= 1, 10, "no second node")
    return publisher


@case("a second state node")
def two_states(cell: Cell, findings: Findings) -> None:
    import rospy
    from sensor_msgs.msg import JointState

    received: list[float] = []
    subscriber = rospy.Subscriber(
        "second_states", JointState, lambda _: received.append(time.monotonic())
    )
    _observe(cell, "second")
    with suppress(AssertionError):
        until(lambda: received, 8, "nothing")
    begin = time.monotonic()
    time.sleep(4)
    mine = sum(at >= begin for at, _ in cell.joints) / 4
    other = sum(at >= begin for at in received) / 4
    findings.must(
        mine > 9 and other > 9, f"the first gets {mine:.1f} Hz, the second {other:.1f} Hz"
    )
    subscriber.unregister()


def _observe(cell: Cell, name: str) -> None:
    """Start another state node with its own topics."""
    cell.start_node(
        "abb_driver",
        "robot_state",
        f"__name:={name}",
        f"joint_states:={name}_states",
        f"robot_status:={name}_status",
        f"feedback_states:={name}_feedback",
        name=name,
    )


@case("three more state nodes while a goal is under way")
def four_states(cell: Cell, findings: Findings) -> None:
    client = cell.action()
    client.send_goal(cell.goal(cell.ramp(8, to=0.8)))
    cell.wait_moving(15)
    for name in ("second", "third", "fourth"):
        _observe(cell, name)
        time.sleep(0.5)
    target = cell.ended(client, 20)
    state = client.get_state()
    findings.must(target and state == SUCCEEDED, f"the goal ends with state {state}")


@case("the link of the motion node dies without a word; the node is started again", faults=SILENT)
def silent(cell: Cell, findings: Findings) -> None:
    findings.five(cell, "the last trajectory before is executed")
    cell.nodes["motion_download_interface"].end(SIGKILL)
    cell.start_motion_node()
    time.sleep(2)
    cell.publish(cell.ramp(1, to=0.0))
    findings.must(cell.arrives([0.0, *FIVE[-1][1:]], 25), "the new node's trajectory is executed")


@case("the motion node stopped (SIGSTOP) in a trajectory until after its end")
def frozen(cell: Cell, findings: Findings) -> None:
    begin_moving(cell)
    node = cell.nodes["motion_download_interface"]
    node.send(SIGSTOP)
    findings.must(cell.arrives([1.2], 20), "its trajectory is executed to the end")
    node.send(SIGCONT)
    took = cell.stop()
    findings.must(took < 0.5, "it is served again")


# -- stops of the controller --------------------------------------------------------------------


def _interrupted(
    cell: Cell, findings: Findings, what: str, reason: spec.Reason, *help: str
) -> None:
    begin_moving(cell)
    begin = time.monotonic()
    cell.sim.ask(what)
    until(cell.sim.standing, 10, "it never stood")
    findings.tell(f"stands {time.monotonic() - begin:.2f} s later")
    now = cell.next_status(3)
    findings.must(
        now.error_code == code(reason) and now.in_error.val == TRUE,
        f"in_error {now.in_error.val}, error_code {now.error_code}",
    )
    findings.must(
        now.motion_possible.val == FALSE and now.in_motion.val == FALSE,
        f"motion_possible {now.motion_possible.val}, in_motion {now.in_motion.val}, "
        f"e_stopped {now.e_stopped.val}, drives_powered {now.drives_powered.val}",
    )
    cell.publish(cell.ramp(1, to=0.0))
    findings.must(cell.quiet(1.5), "a trajectory now moves nothing")
    for step in help:
        cell.sim.ask(step)
    findings.must(cell.quiet(4), "nothing moves after Start")
    if not cell.sim.standing():
        cell.wait_standing(40)
    until(lambda: cell.next_status().motion_possible.val == TRUE, 10, "no motion possible")
    findings.ramped(cell, "a new trajectory is executed")


@case("an emergency stop while the robot moves; reset, motors on, Start")
def emergency(cell: Cell, findings: Findings) -> None:
    steps = ("reset-e-stop", "motors-on", "start")
    _interrupted(cell, findings, "e-stop", spec.Reason.EMERGENCY_STOP, *steps)


@case("the program stopped while the robot moves; Start")
def program_stop(cell: Cell, findings: Findings) -> None:
    _interrupted(cell, findings, "stop", spec.Reason.PROGRAM_STOPPED, "start")


# -- other robots -------------------------------------------------------------------------------


@case("eight joints: a track and a positioner", robot="irb120_track", upstream=False)
def external_axes(cell: Cell, findings: Findings) -> None:
    end = [0.1, 0.2, -0.1, 0.05, 0.1, 0.3, 0.4, -0.5]
    step = [[v * k / 4 for v in end] for k in range(5)]
    cell.publish(cell.trajectory(step))
    findings.must(cell.arrives(end, 25), f"ends at the last point, order {', '.join(cell.names)}")
    cell.next_status()
    message = cell.joints[-1][1]
    off = max(abs(a - b) for a, b in zip(message.position, cell.sim.positions(), strict=True))
    findings.must(
        list(message.name) == cell.names and off < 1e-6, f"joint_states agree to {off:.0e}"
    )


@case("a coupled robot, J23_coupled true", robot="irb2400", coupled=True)
def coupled(cell: Cell, findings: Findings) -> None:
    cell.publish(cell.trajectory(([0.0], [0.0, 0.15, 0.1], [0.0, 0.3, 0.2])))
    findings.must(
        cell.arrives([0.0, 0.3, 0.5], 25), "axis 3 of the controller is joint 3 + joint 2"
    )
    cell.next_status()
    message = cell.joints[-1][1].position
    findings.must(
        max(abs(message[1] - 0.3), abs(message[2] - 0.2)) < 1e-6,
        f"joint_states say {message[2]:.3f}",
    )


@case("abb_driver's own launch file")
def launched(cell: Cell, findings: Findings) -> None:
    for name in list(cell.nodes):
        cell.nodes.pop(name).end(SIGKILL)
    time.sleep(1)
    launch = cell.workspace.launch("abb_driver", "robot_interface.launch", f"robot_ip:={HOST}")
    cell.nodes["launch"] = launch
    cell.ready()
    cell.nodes["joint_trajectory_action"] = launch
    client = cell.action()
    client.send_goal(cell.goal(cell.trajectory(FIVE)))
    findings.succeeds(client, "a goal succeeds")
    findings.must(launch.end(SIGINT, 20) is not None, "it ends on Ctrl-C")

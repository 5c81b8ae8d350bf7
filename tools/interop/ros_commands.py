"""Cases of the trial with ROS nodes: states, trajectories, stops, replacements."""

import time
from itertools import pairwise
from signal import SIGINT

from rapidgen.wire.simple_message import spec
from tools.interop.ros import until
from tools.interop.ros_case import FIVE, PREEMPTED, Findings, begin_moving, case
from tools.interop.ros_cell import FALSE, TRUE, Cell

# -- state --------------------------------------------------------------------------------------


def _rate(cell: Cell, findings: Findings, hertz: float) -> None:
    cell.command_service(cell.trajectory(FIVE))
    cell.wait_moving(15)
    cell.wait_standing()
    begin = time.monotonic()
    time.sleep(5)
    times = [at for at, _ in cell.joints if at >= begin]
    rate = (len(times) - 1) / (times[-1] - times[0])
    gap = max(b - a for a, b in pairwise(times))
    findings.must(abs(rate - hertz) < 0.05 * hertz, f"joint_states at {rate:.1f} Hz of {hertz:g}")
    findings.tell(f"longest gap {gap * 1000:.0f} ms")
    message = cell.joints[-1][1]
    off = max(abs(a - b) for a, b in zip(message.position, cell.sim.positions(), strict=True))
    findings.must(
        list(message.name) == cell.names and off < 1e-6, f"positions agree to {off:.0e} rad"
    )
    now = cell.now
    findings.must(
        (now.mode.val, now.drives_powered.val, now.e_stopped.val, now.motion_possible.val)
        == (2, TRUE, FALSE, TRUE),
        "robot_status: automatic, drives on, no e-stop, motion possible",
    )


@case("joint_states and robot_status at the default rate")
def states(cell: Cell, findings: Findings) -> None:
    _rate(cell, findings, 10)


@case("the same at state.rate 50", options=("--set", "state.rate=50"), upstream=False)
def fast_states(cell: Cell, findings: Findings) -> None:
    _rate(cell, findings, 50)


@case("60 s without a command, then a trajectory")
def idle(cell: Cell, findings: Findings) -> None:
    begin = time.monotonic()
    time.sleep(60)
    times = [at for at, _ in cell.joints if at >= begin]
    gap = max(b - a for a, b in pairwise(times))
    findings.must(gap < 1, f"states all the time, longest gap {gap * 1000:.0f} ms")
    findings.five(cell, "the trajectory is executed", 15)
    lost = sum(len(n.lines_containing("ERROR", "WARN")) for n in cell.nodes.values())
    findings.must(not lost, "no node warns")


# -- trajectories -------------------------------------------------------------------------------


@case("five points by the topic joint_path_command")
def topic(cell: Cell, findings: Findings) -> None:
    with cell.sim.sampled() as samples:
        cell.publish(cell.trajectory(FIVE))
        cell.wait_moving(15)
        first = time.monotonic()
        last = cell.wait_standing()
    findings.must(cell.at(FIVE[-1]), "ends at the last point")
    miss = max(
        min(
            max(abs(a - b) for a, b in zip(current, [*point, *[0.0] * 6], strict=False))
            for _, current in samples
        )
        for point in FIVE
    )
    findings.must(miss < 0.03, f"passes every point within {miss:.3f} rad")
    findings.must(abs(last - first - 2) < 0.4, f"{last - first:.1f} s of motion for 2.0 s")
    moving = {s.in_motion.val for _, s in cell.status}
    findings.must(moving == {TRUE, FALSE} and cell.now.in_error.val == FALSE, "in_motion 0, 1, 0")


@case("by the action joint_trajectory_action")
def action(cell: Cell, findings: Findings) -> None:
    client = cell.action()
    client.send_goal(cell.goal(cell.trajectory(FIVE)))
    findings.succeeds(client, "SUCCEEDED")
    findings.must(cell.sim.standing() and cell.at(FIVE[-1]), "the robot stands there then")


def _points(cell: Cell, findings: Findings, count: int, step: float, timeout: float) -> None:
    end = 0.002 * (count - 1)
    cell.publish(cell.trajectory([[0.002 * k] for k in range(count)], step=step))
    cell.wait_moving(15)
    begin = time.monotonic()
    target = cell.arrives([end], timeout)
    took = time.monotonic() - begin
    if not target:
        cell.wait_standing(timeout)
    last = cell.sim.positions()[0]
    findings.must(target, f"ends at {last:.3f} rad of {end:.3f}, after {took:.1f} s")
    findings.must(abs(took - step * (count - 1)) < 1 or not target, "in the time asked for")
    now = cell.next_status()
    findings.must(now.error_code == 0, f"error_code {now.error_code}")
    points_lost = cell.sim.process.lines_containing("50024", "oo many", "xceed")
    if points_lost:
        findings.tell(f"{len(points_lost)} lines such as {points_lost[0].strip()!r}")


@case("101 points, 0.1 s each")
def points_101(cell: Cell, findings: Findings) -> None:
    _points(cell, findings, 101, 0.1, 40)


@case("300 points, 0.1 s each")
def points_300(cell: Cell, findings: Findings) -> None:
    _points(cell, findings, 300, 0.1, 60)


@case("a single point, away from where the robot stands")
def single(cell: Cell, findings: Findings) -> None:
    where = cell.sim.positions()[0]
    cell.publish(cell.trajectory([[0.3]], start=2.0))
    time.sleep(1)
    findings.must(cell.quiet(2) and cell.at([where]), "nothing moves")
    findings.reports(cell, spec.Reason.START_TOO_FAR, 1)


# -- stops --------------------------------------------------------------------------------------


def _halted(cell: Cell, findings: Findings) -> None:
    where = cell.sim.positions()[0]
    findings.must(cell.quiet(2), f"and stays (at {where:.2f} rad)")
    now = cell.next_status()
    findings.must(
        (now.in_motion.val, now.in_error.val) == (FALSE, FALSE),
        f"in_motion {now.in_motion.val}, in_error {now.in_error.val}",
    )
    findings.ramped(cell, "a new trajectory from there is executed")


@case("the service stop_motion while the robot moves")
def stop(cell: Cell, findings: Findings) -> None:
    begin_moving(cell)
    begin = time.monotonic()
    took = cell.stop()
    findings.must(took < 0.5, f"answered after {took * 1000:.0f} ms")
    findings.stands(cell, begin)
    _halted(cell, findings)


@case("stop_motion while the robot stands, twice")
def stop_at_rest(cell: Cell, findings: Findings) -> None:
    took = max(cell.stop(), cell.stop())
    findings.must(took < 0.5, f"answered within {took * 1000:.0f} ms")
    findings.five(cell, "a trajectory right after it is executed")


@case("an empty trajectory while the robot moves")
def empty(cell: Cell, findings: Findings) -> None:
    begin_moving(cell)
    findings.stands(cell, cell.publish(cell.trajectory([])))
    _halted(cell, findings)


@case("a goal cancelled while the robot moves")
def cancel(cell: Cell, findings: Findings) -> None:
    client = cell.moving_by_action()
    begin = time.monotonic()
    client.cancel_goal()
    cell.ended(client, 5)
    findings.must(client.get_state() == PREEMPTED, "PREEMPTED")
    findings.stands(cell, begin)
    _halted(cell, findings)


@case("the motion node ended by Ctrl-C while the robot moves")
def interrupted_node(cell: Cell, findings: Findings) -> None:
    begin_moving(cell)
    node = cell.nodes["motion_download_interface"]
    finished = node.end(SIGINT, 5)
    # From the STOP on: the node sends it some time after the signal.
    findings.stands(cell, time.monotonic())
    findings.must(finished is not None, "the node ends (its STOP is answered)")
    cell.start_motion_node()
    _halted(cell, findings)


# -- replacements -------------------------------------------------------------------------------


def _not_begun(cell: Cell, findings: Findings, *, error: bool = True) -> None:
    """Check a trajectory from an old start that arrives during a motion."""
    findings.must(
        cell.quiet(2) and cell.sim.positions()[0] > 0.1,
        "the old one is stopped, the new one not started",
    )
    findings.reports(cell, spec.Reason.START_TOO_FAR, 1, error=error)


@case("a new trajectory by topic while the robot moves, from its old start")
def replaced(cell: Cell, findings: Findings) -> None:
    begin_moving(cell)
    begin = time.monotonic()
    cell.publish(cell.trajectory(([0.0], [-0.2], [-0.4])))
    time.sleep(1)
    _not_begun(cell, findings)
    findings.tell(f"at {cell.sim.positions()[0]:.2f} rad; log: {cell.user_sees(begin)!r}")
    if not cell.sim.standing():
        cell.wait_standing(40)
    findings.ramped(cell, "one from where it stands is executed")
    findings.must(cell.next_status().error_code == 0, "error_code is 0 again")


@case("a new goal by action while the robot moves: from its old start")
def new_goal_far(cell: Cell, findings: Findings) -> None:
    client = cell.moving_by_action()
    client.send_goal(cell.goal(cell.trajectory(([0.0], [-0.2], [-0.4]))))
    time.sleep(1)
    _not_begun(cell, findings, error=False)
    target = cell.ended(client, 3)
    findings.tell(f"the goal {'has ended' if target else 'stays'}: state {client.get_state()}")


@case("the same trajectory twice at once")
def twice(cell: Cell, findings: Findings) -> None:
    cell.publish(cell.trajectory(FIVE))
    cell.publish(cell.trajectory(FIVE))
    target = cell.arrives(FIVE[-1], 30)
    error = cell.next_status().error_code
    findings.must(
        target or (cell.at([0.0], 0.02) and error),
        f"{'executed' if target else 'the first stopped, the second refused'}, error_code {error}",
    )


@case("a second trajectory whose first stamp is after the last one of the first")
def late_stamps(cell: Cell, findings: Findings) -> None:
    cell.publish(cell.trajectory([[0.0], [0.1]], step=0.5))
    findings.must(cell.arrives([0.1], 25), "the first is executed")
    cell.publish(cell.trajectory([[0.1], [0.2], [0.3]], step=0.5, start=3.0))
    cell.wait_moving(15)
    begin = time.monotonic()
    findings.must(cell.arrives([0.3], 25), "the second, too")
    findings.tell(f"in {time.monotonic() - begin:.1f} s for 1.0 s")


@case("stop_motion while the program is stopped, and in an emergency stop")
def stop_when_stopped(cell: Cell, findings: Findings) -> None:
    for what in ("stop", "e-stop"):
        cell.sim.ask(what)
        time.sleep(0.5)
        took = cell.stop()
        findings.must(took < 2, f"{what}: answered after {took * 1000:.0f} ms")
    for step in ("reset-e-stop", "motors-on", "start"):
        cell.sim.ask(step)
    until(lambda: cell.next_status().motion_possible.val == TRUE, 10, "no motion possible")
    findings.five(cell, "then a trajectory is executed")

"""Cases of the trial with ROS nodes: states, trajectories, stops, replacements."""

import time
from itertools import pairwise
from signal import SIGINT

from rapidgen.wire.simple_message import spec
from tools.foreign.ros import until
from tools.foreign.ros_case import FIVE, PREEMPTED, Findings, begin_moving, case
from tools.foreign.ros_cell import FALSE, TRUE, Cell

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
    found.five(cell, "the trajectory is executed", 15)
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
    found.succeeds(client, "SUCCEEDED")
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


@case("a single point, away from where the robot stands")
def single(cell: Cell, found: Findings) -> None:
    where = cell.sim.positions()[0]
    cell.publish(cell.trajectory([[0.3]], start=2.0))
    time.sleep(1)
    found.must(cell.quiet(2) and cell.at([where]), "nothing moves")
    found.reports(cell, spec.Reason.START_TOO_FAR, 1)


# -- stops --------------------------------------------------------------------------------------


def _halted(cell: Cell, found: Findings) -> None:
    where = cell.sim.positions()[0]
    found.must(cell.quiet(2), f"and stays (at {where:.2f} rad)")
    now = cell.next_status()
    found.must(
        (now.in_motion.val, now.in_error.val) == (FALSE, FALSE),
        f"in_motion {now.in_motion.val}, in_error {now.in_error.val}",
    )
    found.ramped(cell, "a new trajectory from there is executed")


@case("the service stop_motion while the robot moves")
def stop(cell: Cell, found: Findings) -> None:
    begin_moving(cell)
    begin = time.monotonic()
    took = cell.stop()
    found.must(took < 0.5, f"answered after {took * 1000:.0f} ms")
    found.stands(cell, begin)
    _halted(cell, found)


@case("stop_motion while the robot stands, twice")
def stop_at_rest(cell: Cell, found: Findings) -> None:
    took = max(cell.stop(), cell.stop())
    found.must(took < 0.5, f"answered within {took * 1000:.0f} ms")
    found.five(cell, "a trajectory right behind is executed")


@case("an empty trajectory while the robot moves")
def empty(cell: Cell, found: Findings) -> None:
    begin_moving(cell)
    found.stands(cell, cell.publish(cell.trajectory([])))
    _halted(cell, found)


@case("a goal cancelled while the robot moves")
def cancel(cell: Cell, found: Findings) -> None:
    client = cell.moving_by_action()
    begin = time.monotonic()
    client.cancel_goal()
    cell.ended(client, 5)
    found.must(client.get_state() == PREEMPTED, "PREEMPTED")
    found.stands(cell, begin)
    _halted(cell, found)


@case("the motion node ended by Ctrl-C while the robot moves")
def interrupted_node(cell: Cell, found: Findings) -> None:
    begin_moving(cell)
    node = cell.nodes["motion_download_interface"]
    ended = node.end(SIGINT, 5)
    # From its end: the node sends its STOP some time after the signal.
    found.stands(cell, time.monotonic())
    found.must(ended is not None, "the node ends (its STOP is answered)")
    cell.start_motion_node()
    _halted(cell, found)


# -- replaced -----------------------------------------------------------------------------------


def _not_begun(cell: Cell, found: Findings, *, error: bool = True) -> None:
    """A trajectory from an old start came while the robot moved."""
    found.must(
        cell.quiet(2) and cell.sim.positions()[0] > 0.1,
        "the old one is stopped, the new one not begun",
    )
    found.reports(cell, spec.Reason.START_TOO_FAR, 1, error=error)


@case("a new trajectory by topic while the robot moves, from its old start")
def replaced(cell: Cell, found: Findings) -> None:
    begin_moving(cell)
    begin = time.monotonic()
    cell.publish(cell.trajectory(([0.0], [-0.2], [-0.4])))
    time.sleep(1)
    _not_begun(cell, found)
    found.tell(f"at {cell.sim.positions()[0]:.2f} rad; log: {cell.user_sees(begin)!r}")
    if not cell.sim.standing():
        cell.wait_standing(40)
    found.ramped(cell, "one from where it stands is executed")
    found.must(cell.next_status().error_code == 0, "error_code is 0 again")


@case("a new goal by action while the robot moves: from its old start")
def new_goal_far(cell: Cell, found: Findings) -> None:
    client = cell.moving_by_action()
    client.send_goal(cell.goal(cell.trajectory(([0.0], [-0.2], [-0.4]))))
    time.sleep(1)
    _not_begun(cell, found, error=False)
    there = cell.ended(client, 3)
    found.tell(f"the goal {'has ended' if there else 'stays'}: state {client.get_state()}")


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


@case("stop_motion while the program is stopped, and in an emergency stop")
def stop_when_stopped(cell: Cell, found: Findings) -> None:
    for what in ("stop", "e-stop"):
        cell.sim.ask(what)
        time.sleep(0.5)
        took = cell.stop()
        found.must(took < 2, f"{what}: answered after {took * 1000:.0f} ms")
    for step in ("reset-e-stop", "motors-on", "start"):
        cell.sim.ask(step)
    until(lambda: cell.next_status().motion_possible.val == TRUE, 10, "no motion possible")
    found.five(cell, "then a trajectory is executed")

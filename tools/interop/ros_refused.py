"""Cases of the trial with ROS nodes: trajectories that the driver rejects."""

from rapidgen.wire.simple_message import spec
from tools.interop.ros_case import PREEMPTED, Findings, case
from tools.interop.ros_cell import FALSE, Cell


def _refused(cell: Cell, findings: Findings, points, reason: spec.Reason, joint: int, step=0.5):
    begin = cell.publish(cell.trajectory(points, step=step))
    findings.must(cell.quiet(3), "nothing moves")
    findings.reports(cell, reason, joint)
    findings.tell(f"log: {cell.user_sees(begin)!r}")
    if not cell.sim.standing():
        cell.wait_standing(40)
    findings.ramped(cell, "a good one after it is executed", to=0.2)
    findings.must(cell.next_status().in_error.val == FALSE, "in_error is 0 again")


@case("a point outside the limits")
def outside(cell: Cell, findings: Findings) -> None:
    points = [[0.0], [1.0], [0.0, 0.0, 1.3]]
    _refused(cell, findings, points, spec.Reason.JOINT_LIMIT, 3, step=2)


@case("a start 0.5 rad from the robot")
def far(cell: Cell, findings: Findings) -> None:
    _refused(cell, findings, [[0.0, 0.5], [0.0, 0.6]], spec.Reason.START_TOO_FAR, 2)


@case("a segment that an axis cannot follow")
def fast(cell: Cell, findings: Findings) -> None:
    _refused(cell, findings, [[0.0], [0.1], [1.1]], spec.Reason.TOO_FAST, 1, step=0.15)


@case("points 0.02 s apart")
def dense(cell: Cell, findings: Findings) -> None:
    points = [[0.002 * k] for k in range(100)]
    _refused(cell, findings, points, spec.Reason.SEGMENT_TOO_SHORT, 0, step=0.02)


@case("a position that is not a number")
def not_a_number(cell: Cell, findings: Findings) -> None:
    points = [[0.0], [float("nan")], [0.1]]
    _refused(cell, findings, points, spec.Reason.NOT_FINITE, 1)


@case("a goal that the driver refuses")
def refused_goal(cell: Cell, findings: Findings) -> None:
    client = cell.action()
    client.send_goal(cell.goal(cell.trajectory(([0.0, 0.5], [0.0, 0.6]))))
    target = cell.ended(client, 5)
    findings.tell(f"the goal {'has ended' if target else 'stays'}: state {client.get_state()}")
    findings.must(cell.quiet(1), "nothing moves")
    findings.reports(cell, spec.Reason.START_TOO_FAR, 2, error=False)
    client.cancel_goal()
    cell.ended(client, 5)
    findings.must(client.get_state() == PREEMPTED, "it can be cancelled")
    client.send_goal(cell.goal(cell.ramp(1, to=0.2)))
    findings.succeeds(client, "the next goal succeeds")

"""STOP, and trajectories that replace each other."""

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import JOINT_POSITION, decode
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import distance
from rapidgen.verification.raw_connection import STOP
from rapidgen.verification.testbench import Bench

case = SuiteGroup("stopping")


@case("stop-on-path", "STOP ends the motion on the path and nothing follows")
def _stops_on_the_path(bench: Bench) -> None:
    link = bench.motion()
    for delay in (0.02, 0.3, 0.55, 1.1):
        points = bench.wave(10)
        since = bench.now
        bench.start_motion(link, points, delay)
        link.send(STOP)
        requested = bench.now
        link.expect_reply(1, "STOP is answered while the robot moves")
        bench.wait_until_standing(5)
        if bench.now - requested > 1.5:
            raise CheckFailed(f"the robot stood {bench.now - requested:.2f} s after STOP")
        bench.followed([p for p, _ in points], since=since)
        bench.assert_at_rest(3, "it was stopped")


@case("again-after-stop", "a new trajectory moves after a STOP, again and again", "R5, R6")
def _moves_again_after_stop(bench: Bench) -> None:
    link = bench.motion()
    for _ in range(4):
        bench.start_motion(link, bench.wave(10), 0.4)
        link.stop(1)
        if bench.setting.motion.servo_lag:
            # The current position is too far from the rest position to be a start.
            bench.wait_until_standing(2)
        bench.assert_moves_through(link, bench.wave(3))


@case("stop-any-moment", "STOP at every moment of the hand-over", "R7b")
def _stop_at_every_moment(bench: Bench) -> None:
    link = bench.motion()
    # From before the end frame is processed until well into the motion.
    for step in range(0, 40):
        points = bench.wave(5, duration=0.3)
        link.send(bench.download(points))
        bench.run(step * 0.005)
        link.stop(2, f"STOP {step * 5} ms after a trajectory is answered")
        bench.wait_until_at_rest(5, 0.5, "it was stopped")
    bench.assert_moves_through(link, bench.wave(4))


@case("stop-in-download", "STOP in a download: what follows belongs to nothing")
def _stop_in_a_download(bench: Bench) -> None:
    link = bench.motion()
    frames = bench.download(bench.wave(8))
    link.send(frames[: 68 * 4] + STOP)
    link.expect_reply(1, "STOP in a download is answered")
    bench.assert_at_rest(2, "the download was stopped")
    link.send(frames[68 * 4 :])
    bench.assert_at_rest(2, "points after a STOP belong to no trajectory")
    bench.assert_moves_through(link, bench.wave(3))


@case("stop-thrice", "several STOPs at once are all answered")
def _twice_stopped(bench: Bench) -> None:
    link = bench.motion()
    bench.start_motion(link, bench.wave(10))
    link.send(STOP + STOP + STOP)
    for _ in range(3):
        link.expect_reply(2, "each of three STOPs is answered")
    bench.wait_until_standing(5)
    bench.assert_moves_through(link, bench.wave(3))


@case("superseded", "a new trajectory ends the one under way", "R5")
def _new_trajectory_while_moving(bench: Bench) -> None:
    link = bench.motion()
    first = bench.wave(10)
    bench.start_motion(link, first, 0.6)
    # The new one starts where the old one started: too far away by now, or just in reach. In both
    # cases the old one is over and is not executed any more.
    second = bench.wave(4)
    since = bench.now
    link.send(bench.download(second))
    # The new one may start only after the old path is cleared.
    bench.run(5)
    bench.wait_until_standing(20)
    reached = distance(bench.position, second[-1][0]) < 1e-4
    old = distance(bench.position, first[-1][0]) < 1e-4
    if old and not reached:
        raise CheckFailed("the old trajectory went on after a new one was sent")
    if reached:
        bench.followed([bench.track_at(since), *(p for p, _ in second)], since=since, corner=0.1)
    bench.assert_at_rest(2, "nothing is left to execute")
    bench.assert_moves_through(link, bench.wave(3))


@case("ends-once", "a finished trajectory is not executed again")
def _ends_once(bench: Bench) -> None:
    link = bench.motion()
    points = bench.wave(5)
    bench.assert_moves_through(link, points)
    bench.assert_at_rest(30, "the trajectory is done")


@case("ring-is-empty", "a stopped long trajectory leaves no points")
def _short_way_to_stop(bench: Bench) -> None:
    """Stop a long trajectory early: its ring is not executed later."""
    link = bench.motion()
    count = min(bench.config.trajectory.capacity, 400)
    bench.start_motion(link, bench.wave(count, duration=0.2, size=0.01), 0.2)
    link.stop(3, "STOP after a long trajectory is answered")
    bench.wait_until_standing(5)
    points = bench.wave(4)
    bench.assert_moves_through(link, points)
    bench.assert_at_rest(2, "the old points are gone")


@case("stop-in-status", "STATUS after a STOP")
def _state_tells_of_the_stop(bench: Bench) -> None:
    state, link = bench.state(), bench.motion()
    bench.start_motion(link, bench.wave(10))
    link.stop(1)
    bench.wait_until_standing(5)
    bench.run(1)
    status = bench.status(state)
    if (status.in_error, status.in_motion, status.motion_possible) != (0, 0, 1):
        raise CheckFailed(f"after a STOP STATUS says {status}")
    joints = [decode(f) for f in state.read() if f.number == JOINT_POSITION]
    if any(not isinstance(j, messages.RawJointPosition) for j in joints):
        raise CheckFailed("JOINT cannot be read")

"""Control connection: STOP, PAUSE, SPEED, HEARTBEAT, without delay by points."""

import math
from collections.abc import Callable
from dataclasses import replace

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import Instruction, fails, watched_orders, wrapped
from rapidgen.verification.messages import RawComm, RawReason, RawStreamFlag, RawTrajectoryState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import distance
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.stream import BEGIN, END, Streamer, way
from rapidgen.verification.suite.motion_task import halt_timeout
from rapidgen.verification.testbench import HELLO, Bench

case = SuiteGroup("controlling", needs="control")

_TRAJ = messages.JOINT_TRAJ_PT


def stop(link: RawLink, seconds: float = 1) -> None:
    """Send STOP over this connection; check that it is confirmed in time."""
    if not isinstance(link.stop(seconds), messages.RawAcknowledged):
        raise CheckFailed("STOP on the control port is not confirmed")


def stopped(link: RawLink, trajectory: int) -> None:
    """Wait for STOPPED of this trajectory; skip one of an earlier one."""
    while link.expect(messages.RawStopped, 3, "STOPPED arrives").trajectory != trajectory:
        pass


def not_done(reply: object, reason: RawReason, what: str) -> None:
    """Check that a reply is a failure for that reason."""
    if reply != messages.RawNotDone(reason):
        raise CheckFailed(f"{what}: wanted {reason.name}, the reply is {reply}")


def done(reply: object, what: str) -> None:
    """Check that a reply is a plain success."""
    if not isinstance(reply, messages.RawAcknowledged):
        raise CheckFailed(f"{what}: the reply is {reply}")


@case("control-stop", "STOP over the control port, and the robot's position", "R5")
def _stops(bench: Bench) -> None:
    """Send STOP during a download; STOPPED gives the robot's position."""
    control, watcher = bench.control(), bench.watcher()
    stop(control)
    for delay in (0.0, 0.02, 0.7):
        link, since, points = bench.motion(), bench.now, bench.wave(12)
        bench.start_motion(link, points, delay)
        requested = bench.now
        control.read()
        stop(control)
        bench.wait_until_standing(3)
        if bench.now - requested > 1.5:
            raise CheckFailed(f"the robot stood {bench.now - requested:.2f} s after STOP")
        bench.followed([p for p, _ in points], since=since)
        reply = control.expect(messages.RawStopped, 2, "STOPPED arrives")
        progress = bench.progress(watcher)
        current = (*bench.position, *[0.0] * (messages.MAX_JOINTS - len(bench.position)))
        # If axes follow late, their last millimetres still change.
        near = 5e-3 if bench.setting.motion.servo_lag else 1e-4
        if max(abs(a - b) for a, b in zip(reply.joints, current, strict=True)) > near:
            raise CheckFailed(f"the robot is at {current}, STOPPED says {reply.joints}")
        if (reply.trajectory, reply.reached, reply.reason) != (
            progress.trajectory,
            progress.reached,
            RawReason.STOPPED,
        ):
            raise CheckFailed(f"STOPPED says {reply}, PROGRESS {progress}")
        bench.assert_at_rest(2, "it was stopped over the control port")
        bench.assert_moves_through(link, bench.wave(3))
        link.close(then=1.5)


@case("stop-under-load", "STOP is answered whatever lies before the motion server", "R5")
def _stop_under_load(bench: Bench) -> None:
    """Send STOP while the motion server is busy: the reply is immediate."""
    control = bench.control()
    # Other clients that receive all messages, and one with heartbeats.
    for _ in range(3):
        bench.state().send(messages.encode(HELLO._replace(subscribe=49), RawComm.REQUEST))
    control.ask(messages.RawHeartbeat(5))
    orders = watched_orders(bench)
    costs = bench.controller.costs
    # The delay from request to trap is the controller's; the remainder is the driver's.
    for delay in (0.002, 0.01, 0.02, 0.03):
        trap = round(delay * 10**9)
        bench.controller.costs = replace(costs, interrupt_delay=(trap, trap))
        stream = Streamer(bench)
        points = way(bench, 200)
        stream.put(points[:20], BEGIN)
        bench.wait_until_moving()
        # Requests without points: the driver reads, checks and answers each.
        question = stream.frame((), RawStreamFlag(0))
        stream.link.send(question * 400)
        requested = bench.now
        stop(control)
        # Some controllers continue a program after StopMove only when the robot has settled.
        settled = bench.setting.motion.settle if bench.setting.motion.stop_waits else 0
        if bench.now - requested > 0.3 + settled:
            raise CheckFailed(f"under load STOP is answered after {bench.now - requested:.2f} s")
        late = next(o.time for o in orders if o.time >= requested and o.instruction == "StopMove")
        most = delay + 0.01 * bench.setting.slowness
        if late - requested > most and not bench.setting.random_schedule:
            raise CheckFailed(
                f"under load the stop is ordered after {late - requested:.3f} s, not {most:.3f} s"
            )
        bench.wait_until_at_rest(3, 1, "it was stopped under load")
        stream.link.close(then=2)
    bench.assert_moves_through(bench.motion(), bench.wave(3))


@case("control-any-moment", "STOP over the control port at every moment", "R7b")
def _stop_at_any_moment(bench: Bench) -> None:
    """Send STOP at times from the hand-over into the motion, over both ports."""
    control, link = bench.control(), bench.motion()
    for step in range(30):
        points = bench.wave(6, duration=0.2)
        link.send(bench.download(points))
        bench.run(step * 0.004)
        stop(control)
        if step % 3 == 0:
            link.stop()
        bench.wait_until_standing(5)
        bench.run(0.3)
        link.stop()
        bench.assert_at_rest(0.4, f"STOP came {step * 4} ms after a trajectory")
    bench.assert_moves_through(link, bench.wave(4))


@case("pause", "a pause on the path")
def _pauses(bench: Bench) -> None:
    """Pause on the path, and resume to the end, in order."""
    control, watcher = bench.control(), bench.watcher()
    not_done(control.ask(messages.RawPause(1)), RawReason.IDLE, "a pause of nothing")
    not_done(control.ask(messages.RawPause(0)), RawReason.IDLE, "an end of no pause")
    link, since, points = bench.motion(), bench.now, bench.wave(14)
    bench.start_motion(link, points)
    for _ in range(3):
        bench.run(0.8)
        done(control.ask(messages.RawPause(1)), "PAUSE")
        bench.wait_until_at_rest(3, 4, "it is paused")
        reply, status = bench.progress(watcher), bench.status(watcher)
        if reply.state != RawTrajectoryState.PAUSED or reply.reason:
            raise CheckFailed(f"a trajectory is paused, PROGRESS says {reply}")
        if (status.in_motion, status.in_error) != (0, 0):
            raise CheckFailed(f"a trajectory is paused, STATUS says {status}")
        done(control.ask(messages.RawPause(1)), "PAUSE again")
        done(control.ask(messages.RawPause(0)), "the end of PAUSE")
        bench.wait_until_moving(2)
        done(control.ask(messages.RawPause(0)), "the end of no pause, on the way")
    bench.wait_until_at(points[-1][0], 30)
    bench.followed([p for p, _ in points], since=since)
    for wrong in (2, -1, 7):
        not_done(control.ask(messages.RawPause(wrong)), RawReason.BAD_VALUE, f"PAUSE {wrong}")


@case("pause-ends", "what halts a motion halts a paused one", "R6", background=True)
def _pause_ends(bench: Bench) -> None:
    """End a paused motion: every event that halts a motion halts it too."""
    for action in ("STOP", "control STOP", "e-stop", "motors-off", "stop", "leaves", "another"):
        control, link = bench.control(), bench.motion()
        bench.start_motion(link, bench.wave(14), 0.5)
        done(control.ask(messages.RawPause(1)), "PAUSE")
        bench.wait_until_standing(3)
        if action == "STOP":
            link.stop()
        elif action == "control STOP":
            stop(control)
        elif action == "leaves":
            link.close()
        elif action == "another":
            link.send(bench.download(bench.wave(4)))
            bench.run(6)
        else:
            bench.controller.perform(action)
        bench.run(0.5)
        reply = control.ask(messages.RawPause(0))
        if isinstance(reply, messages.RawAcknowledged) and action != "another":
            raise CheckFailed(f"after {action} an end of the pause is taken: {reply}")
        bench.wait_until_at_rest(5, 3, f"it was paused, then came {action}")
        bench.start_again()
        bench.assert_at_rest(3, f"it was paused, then came {action} and a start of the program")
        control.close()
        link.close(then=2)
        bench.assert_moves_through(bench.motion(), bench.wave(3))
        bench.run(1.5)


@case("nobody-answers", "a motion task that does not answer", background=True)
def _stopped_motion_task(bench: Bench) -> None:
    """Send requests while the motion task is stopped: failure replies, soon."""
    control, link = bench.control(), bench.motion()
    bench.start_motion(link, bench.wave(12))
    bench.controller.perform("stop")
    bench.run(0.5)
    requested = bench.now
    reply = control.ask(messages.RawSpeed(50))
    if not isinstance(reply, messages.RawNotDone) or bench.now - requested > 1.5:
        raise CheckFailed(f"SPEED is answered by {reply} after {bench.now - requested:.2f} s")
    bench.controller.perform("start")
    bench.assert_at_rest(3, "the program was stopped and started")
    bench.assert_moves_through(link, bench.wave(3))
    # In a long move; short moves get their time for the speed, without SpeedRefresh.
    bench.start_motion(link, bench.wave(12, duration=1.0), 0.3)
    ends = fails(bench, "ROS_motion", "SpeedRefresh", "ERR_SPEED_REFRESH_LIM", 1000)
    not_done(control.ask(messages.RawSpeed(50)), RawReason.INTERNAL, "SPEED that is not set")
    ends()
    done(control.ask(messages.RawSpeed(50)), "SPEED")


@case("one-stops", "one background task alone stops and starts the robot", "R7b")
def _one_stops(bench: Bench) -> None:
    """Let only one background task stop and start the robot.

    ABB's manual is remembered to allow StopMove and StartMove from one background task only.
    """
    control, link = bench.control(), bench.motion()
    used: set[str] = set()

    def watched(name: str) -> Callable[[Instruction], Instruction]:
        def wrap(as_before: Instruction) -> Instruction:
            def call(*arguments: object) -> object:
                used.add(name)
                return as_before(*arguments)

            return call

        return wrap

    tasks = bench.controller.rapid_tasks
    for name, task in tasks.items():
        for instruction in ("StopMove", "StartMove", "StopMoveReset"):
            wrapped(task, instruction, watched(name))
    for port in (control, link):
        bench.start_motion(link, bench.wave(12), 0.3)
        stop(port)
        bench.wait_until_at_rest(3, 1, "it was stopped")
    bench.start_motion(link, bench.wave(12), 0.3)
    done(control.ask(messages.RawPause(1)), "PAUSE")
    done(control.ask(messages.RawPause(0)), "the end of a pause")
    control.ask(messages.RawHeartbeat(0.25))
    bench.wait_until_standing(3)
    bench.assert_moves_through(link, bench.wave(3))
    adjacent = [name for name in used if not tasks[name].spec.motion]
    if adjacent != [bench.task("ROS_supervisor")]:
        raise CheckFailed(f"the robot is stopped and started by {adjacent}")


@case("heartbeats", "a missing heartbeat stops the robot", "R12")
def _heartbeats(bench: Bench) -> None:
    """Send heartbeats, then omit one: the robot stops."""
    watcher = bench.watcher()
    for before in (False, True):
        control, link = bench.control(), bench.motion()
        beat = messages.RawHeartbeat(0.5)
        if before:
            control.ask(beat)
        points = bench.wave(30)
        bench.start_motion(link, points)
        reply = control.ask(beat)
        for _ in range(12):
            bench.run(0.3)
            reply = control.ask(beat)
            if not isinstance(reply, messages.RawHeartbeatReply):
                raise CheckFailed(f"HEARTBEAT is answered by {reply}")
            if reply.trajectory != bench.progress(watcher).trajectory:
                raise CheckFailed(f"HEARTBEAT is answered for another trajectory: {reply}")
            if bench.standing or reply.state != RawTrajectoryState.MOVING:
                raise CheckFailed(f"the robot does not move although heartbeats come: {reply}")
        last = bench.now
        stop_ordered = control.expect(messages.RawStopped, 3, "without a heartbeat the robot stops")
        bench.wait_until_standing(3)
        if not 0.45 < bench.now - last < 2.5 or stop_ordered.reason != RawReason.CLIENT_LOST:
            raise CheckFailed(f"{bench.now - last:.2f} s after the last heartbeat: {stop_ordered}")
        bench.assert_at_rest(3, "a heartbeat is missing")
        # The first missing heartbeat.
        bench.assert_moves_through(link, bench.wave(6))
        bench.start_motion(link, bench.wave(30))
        control.ask(beat)
        # Some controllers continue the supervisor only when the robot has settled.
        stopped(control, bench.progress(watcher).trajectory)
        reply = control.ask(messages.RawHeartbeat(0))
        if (
            not isinstance(reply, messages.RawHeartbeatReply)
            or reply.state != RawTrajectoryState.FAILED
        ):
            raise CheckFailed(f"a heartbeat after one was missing is answered by {reply}")
        bench.assert_moves_through(link, bench.wave(10))
        if not isinstance(control.ask(messages.RawHeartbeat(3600)), messages.RawHeartbeatReply):
            raise CheckFailed("an hour between heartbeats is refused")
        for wrong in (-1.0, 3601.0, 1e5, math.nan, math.inf):
            not_done(control.ask(messages.RawHeartbeat(wrong)), RawReason.BAD_VALUE, f"{wrong:g} s")
        link.close()
        control.close(then=2)


@case("heartbeat-in-time", "the stop for a missing heartbeat comes in time", "R12")
def _heartbeat_in_time(bench: Bench) -> None:
    """Stop for a missing heartbeat when it is due, not at the next look."""
    control, link = bench.control(), bench.motion()
    orders = watched_orders(bench)
    for seconds in (0.25, 0.53):
        bench.start_motion(link, bench.wave(20))
        control.ask(messages.RawHeartbeat(seconds))
        last = bench.now
        bench.wait_until_standing(3)
        stops = [o.time for o in orders if o.instruction == "StopMove" and o.time > last]
        if not stops or not seconds - 0.02 <= stops[0] - last <= seconds + 0.06:
            raise CheckFailed(f"heartbeats of {seconds} s: the last at {last:.3f} s, stops {stops}")
        control.ask(messages.RawHeartbeat(0))
        bench.assert_moves_through(link, bench.wave(4))
        # Axes may follow late.
        bench.wait_until_standing()


@case("awaits-heartbeat", "a server that awaits a heartbeat leaves the other tasks their time")
def _awaits(bench: Bench) -> None:
    """Look for bytes ten times a second, and when the heartbeat is due."""
    control, looks = bench.control(), []

    def counted(as_before: Instruction) -> Instruction:
        def counting(*arguments: object) -> object:
            looks.append(bench.now)
            return as_before(*arguments)

        return counting

    wrapped(bench.rapid_task("ROS_control"), "SocketReceive", counted)
    for seconds in (5, 0.7):
        control.ask(messages.RawHeartbeat(seconds))
        looks.clear()
        bench.run(0.65)
        if not 5 <= len(looks) <= 9:
            raise CheckFailed(
                f"in 0.65 s it looked {len(looks)} times for a heartbeat of {seconds} s"
            )
    control.ask(messages.RawHeartbeat(0))


@case("control-fails", "instructions of the control server that report errors", "R3")
def _instructions_fail(bench: Bench) -> None:
    """Make the control server's instructions fail.

    The next client can stop the robot each time.
    """
    for instruction, error in (
        ("SocketReceive", "ERR_SOCK_CLOSED"),
        ("SocketSend", "ERR_SOCK_CLOSED"),
        ("SocketAccept", "ERR_SOCK_CLOSED"),
        ("UnpackRawBytes", "ERR_OUTOFBND"),
        ("CopyRawBytes", "ERR_OUTOFBND"),
    ):
        control, link = bench.control(), bench.motion()
        points = bench.wave(30)
        bench.start_motion(link, points)
        recovers = fails(bench, "ROS_control", instruction, error)
        control.send(messages.encode(HELLO, RawComm.REQUEST))
        bench.run(0.3)
        control.send(STOP)
        bench.run(1)
        recovers()
        bench.assert_healthy()
        control = bench.control()
        bench.run(0.3)
        stop(control, 2)
        bench.wait_until_at_rest(
            3, 1, f"it was stopped; {instruction} of the control server has failed"
        )
        bench.assert_moves_through(link, bench.wave(3))
        control.close()
        link.close(then=1.3)
    for content in _REQUESTS:
        control = bench.control()
        # The data read after length, type and kind belongs to the request.
        recovers = fails(bench, "ROS_control", "UnpackRawBytes", "ERR_OUTOFBND", after=3)
        control.send(content)
        control.wait_disconnected(2, "a request that cannot be read drops its client")
        recovers()
        bench.assert_healthy()
        stop(bench.control(), 2)


_REQUESTS = (
    STOP,
    *(
        messages.encode(content, RawComm.REQUEST)
        for content in (messages.RawPause(1), messages.RawSpeed(50), messages.RawHeartbeat(1.0))
    ),
)


@case("first-start", "a driver that starts for the first time orders nothing", background=True)
def _first_start(bench: Bench) -> None:
    """Start for the first time: persistents are 0, even as codes of commands."""
    received = watched_orders(bench)
    bench.run(2)
    if received:
        raise CheckFailed(f"no client has asked for anything, the driver orders {received[0]}")


@case("supervisor-gone", "a supervisor that does not answer", "R7b", background=True)
def _supervisor_is_gone(bench: Bench) -> None:
    """End the supervisor: nothing moves, and no reply claims success."""
    with bench.second_controller(bench.system) as other:
        control, link, state = other.control(), other.motion(), other.state()
        other.run(1)
        if not other.status(state).motion_possible:
            raise CheckFailed("no motion is possible, before anything has happened")
        fails(other, "ROS_supervisor", "OpMode", "ERR_OUTOFBND")
        other.run(1.5 + 2 * other.config.state_period)
        if other.status(state).motion_possible:
            raise CheckFailed("the supervisor has ended, STATUS says that motion is possible")
        link.send(other.download(other.wave(8)))
        other.assert_at_rest(3, "the supervisor does not answer")
        for requested in (control, link):
            requested.send(STOP)
            answer = requested.reply(_TRAJ, 3)
            if not isinstance(answer, messages.RawFailure):
                raise CheckFailed(f"the supervisor does not answer, STOP is answered by {answer}")
        not_done(control.ask(messages.RawPause(1), 3), RawReason.INTERNAL, "PAUSE")
        other.assert_at_rest(1, "the supervisor does not answer")
    with bench.second_controller(bench.system) as other:
        control, link = other.control(), other.motion()
        other.start_motion(link, other.wave(30))
        fails(other, "ROS_supervisor", "OpMode", "ERR_OUTOFBND")
        other.run(0.5)
        control.stop(3)
        other.wait_until_at_rest(1, 3, "it was stopped, the supervisor does not answer")


@case("old-end", "STOPPED tells what ends, not what has ended")
def _old_end(bench: Bench) -> None:
    """Do not report earlier trajectories to a later client.

    A cut stream gives joint and position.
    """
    link = bench.motion()
    bench.start_motion(link, bench.wave(12))
    link.stop()
    bench.wait_until_standing(3)
    bench.run(halt_timeout(bench))
    control = bench.control()
    bench.run(1)
    if any(f.number == messages.STOPPED for f in control.read()):
        raise CheckFailed(
            "a client gets STOPPED of a trajectory that had ended before it connected"
        )
    link.close(then=1.2)
    stream = Streamer(bench)
    points = way(bench, 20)
    stream.put(points, BEGIN)
    bench.wait_until_moving()
    joint = bench.group.joints[1]
    current = points[-1][0]
    stream.put([((current[0], joint.upper + 0.1, *current[2:]), 30.0)])
    stream.refused(RawReason.JOINT_LIMIT, "joint 2 is outside its limits")
    reply = control.expect(messages.RawStopped, 10, "STOPPED arrives")
    if (reply.reached, reply.reason) != (20, RawReason.JOINT_LIMIT):
        raise CheckFailed(f"a stream was cut after 20 points, STOPPED says {reply}")
    # Axes that follow late are not at their target yet.
    near = 1e-3 + 0.2 * bench.setting.motion.servo_lag
    if distance(reply.joints[: len(current)], current) > near or any(reply.joints[len(current) :]):
        raise CheckFailed(f"the stream ended at {current}, STOPPED says {reply.joints}")


@case("stream-control", "pause, speed and STOP of a stream")
def _stream_over_control(bench: Bench) -> None:
    """Send PAUSE, SPEED and STOP for a stream."""
    control = bench.control()
    stream, since = Streamer(bench), bench.now
    points = way(bench, 90)
    stream.put(points[:25], BEGIN)
    bench.wait_until_moving()
    done(control.ask(messages.RawSpeed(60)), "SPEED of a stream")
    bench.run(0.7)
    done(control.ask(messages.RawPause(1)), "PAUSE of a stream")
    bench.wait_until_standing(3)
    stream.takes("points while the stream is paused", points[25:50])
    bench.assert_at_rest(3, "the stream is paused")
    done(control.ask(messages.RawPause(0)), "the end of a pause")
    stream.takes("points after a pause", points[50:70])
    stream.takes("the end of a stream after a pause", points[70:], END)
    bench.arrives(points, since, 60)
    stream = Streamer(bench, stream.link, number=2)
    stream.put(way(bench, 25), BEGIN)
    bench.wait_until_moving()
    bench.run(0.5)
    control.read()
    stop(control)
    reply = control.expect(messages.RawStopped, 2, "STOPPED arrives")
    refusal = stream.refuses(RawReason.STOPPED, "points after a STOP", way(bench, 3))
    if refusal.trajectory != reply.trajectory or refusal.point != reply.reached:
        raise CheckFailed(f"STOPPED says {reply}, a batch after it is answered by {refusal}")
    bench.wait_until_at_rest(1, 2, "the stream was stopped")

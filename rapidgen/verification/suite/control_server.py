"""Control server: its own stop, heartbeat deadlines, lost clients."""

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails, watched_orders
from rapidgen.verification.messages import RawComm, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.stream import BEGIN, Streamer, way
from rapidgen.verification.suite.control import not_done, stop, stopped
from rapidgen.verification.testbench import Bench

case = SuiteGroup("controlling", needs="control")

_TRAJ = messages.JOINT_TRAJ_PT
_FAILED = RawTrajectoryState.FAILED
_PING = messages.encode(messages.RawPing(), RawComm.REQUEST)


@case("stops-alone", "STOP while the supervisor hangs", "R7b")
def _alone(bench: Bench) -> None:
    """Stop without the supervisor: the control server stops the robot itself.

    No reply claims success.
    """
    for port in ("control", "motion", "heartbeat", "leaves"):
        with bench.second_controller(bench.system) as other:
            _stops_alone(other, port)


def _stops_alone(bench: Bench, port: str) -> None:
    control, link = bench.control(), bench.motion()
    supervisor = bench.controller.task(bench.task("ROS_supervisor"))
    bench.start_motion(link, bench.wave(12), 0.5)
    if port == "heartbeat":
        control.ask(messages.RawHeartbeat(0.2))
    orders, last = watched_orders(bench), bench.last_event
    supervisor.stop()
    requested = bench.now
    chosen = control if port == "control" else link
    if port == "leaves":
        link.close()
    elif port != "heartbeat":
        chosen.send(STOP)
    motion = bench.setting.motion
    bench.wait_until_standing(1.3 + motion.settle + motion.servo_lag)
    if port in ("control", "motion"):
        answer = chosen.reply(_TRAJ, 2)
        if not isinstance(answer, messages.RawFailure) or not 0.9 < bench.now - requested < 1.8:
            raise CheckFailed(f"STOP is answered by {answer} after {bench.now - requested:.2f} s")
    if not any(o.instruction == "StopMove" and o.free for o in orders):
        raise CheckFailed(f"the supervisor hangs, a stop was asked for ({port}), then {orders}")
    # Some controllers continue a program after StopMove, and report it, only then.
    bench.run(2 * motion.settle if motion.stop_waits else 0)
    log_entries = [e.title for e in bench.controller.log.since(last) if e.title.startswith("ROS")]
    if "ROS: the supervisor does not answer" not in log_entries:
        raise CheckFailed(
            f"the supervisor hangs, the robot was stopped, the event log says {log_entries}"
        )
    for paused in (0, 1):
        refused = control.ask(messages.RawPause(paused))
        not_done(refused, RawReason.INTERNAL, f"the supervisor hangs, PAUSE {paused}")
    bench.assert_at_rest(1, "the robot was stopped, the supervisor hangs")
    link = link if port != "leaves" else bench.motion()
    supervisor.start()
    bench.assert_at_rest(3, "the supervisor goes on")
    if bench.setting.motion.stop_owner == "kind":
        bench.assert_moves_through(link, bench.wave(3))
        return
    # Here the supervisor cannot reset the stop of a server.
    log_entries = [e.title for e in bench.controller.log.since(last)]
    if "ROS: the robot stays stopped" not in log_entries:
        raise CheckFailed(f"a server's stop cannot be taken back, the event log says {log_entries}")
    link.send(bench.download(bench.wave(3)))
    bench.assert_at_rest(4, "a server's stop cannot be taken back")


@case("cannot-stop-alone", "a server that cannot stop the robot, either")
def _cannot(bench: Bench) -> None:
    """Reject the server's StopMove.

    The event log reports it, and another task stops the robot.
    """
    control, link = bench.control(), bench.motion()
    supervisor = bench.controller.task(bench.task("ROS_supervisor"))
    bench.start_motion(link, bench.wave(12), 0.5)
    last = bench.last_event
    fails(bench, "ROS_control", "StopMove", "ERR_PATH_STOP")
    supervisor.stop()
    control.send(STOP)
    answer = control.reply(_TRAJ, 2)
    # If the motion server was first, this one has not tried.
    texts = " ".join(str(event) for event in bench.controller.log.since(last))
    known = "could not stop the robot" in texts or "The robot was stopped by" in texts
    if not isinstance(answer, messages.RawFailure) or not known:
        raise CheckFailed(f"a server cannot stop the robot, {answer}, the event log says {texts}")
    bench.wait_until_standing(1 + bench.setting.motion.settle + bench.setting.motion.servo_lag)
    supervisor.start()
    bench.wait_until_at_rest(3, 1, "the supervisor goes on, and was asked to stop")
    if bench.setting.motion.stop_owner != "kind":
        # Here the supervisor cannot reset the stop of a server.
        return
    bench.assert_moves_through(link, bench.wave(3))


@case("beats", "heartbeats to the moment", "R12")
def _beats(bench: Bench) -> None:
    """Check heartbeat deadlines exactly; HEARTBEAT of 0 ends them."""
    control, link = bench.control(), bench.motion()
    reply = control.ask(messages.RawHeartbeat(0))
    if not isinstance(reply, messages.RawHeartbeatReply) or reply.state != RawTrajectoryState.NONE:
        raise CheckFailed(f"a heartbeat at rest is answered by {reply}")
    points = bench.wave(12)
    bench.start_motion(link, points)
    for seconds in (0.3, 0.0):
        control.ask(messages.RawHeartbeat(seconds))
    bench.wait_until_at(points[-1][0], 10)
    orders = watched_orders(bench)
    for seconds in (0.25, 1.03):
        bench.start_motion(link, bench.wave(12))
        orders.clear()
        control.ask(messages.RawHeartbeat(0.1))
        beating = control.ask(messages.RawHeartbeat(seconds))
        last = bench.now
        bench.run(seconds - 0.01)
        for _ in range(8):
            control.send(_PING)
            bench.run(0.001)
        bench.wait_until_standing(3)
        stops = [o.time for o in orders if o.instruction == "StopMove"]
        late = bench.setting.latest_interrupt + 0.01 * bench.setting.slowness
        if not stops or not seconds - 0.02 <= stops[0] - last <= seconds + late:
            raise CheckFailed(f"heartbeats of {seconds} s: the last at {last:.3f} s, stops {stops}")
        if seconds > 1:
            if not isinstance(beating, messages.RawHeartbeatReply):
                raise CheckFailed(f"HEARTBEAT is answered by {beating}")
            # Some controllers continue the supervisor only when the robot has settled.
            stopped(control, beating.trajectory)
            reply = control.ask(messages.RawHeartbeat(0.2))
            if not isinstance(reply, messages.RawHeartbeatReply) or reply.state != _FAILED:
                raise CheckFailed(f"a heartbeat after one was missing is answered by {reply}")
            control.ask(messages.RawHeartbeat(0))
        bench.assert_moves_through(link, bench.wave(5))


@case("beating-clients", "clients that beat, and are lost in each way", "R12")
def _leave(bench: Bench) -> None:
    """Lose each of several clients with heartbeats: the robot stops."""
    link, control = bench.motion(), bench.control()
    for how in ("leaves", "is replaced", "is reset", "has not beaten", "is dropped", "leaves"):
        points = bench.wave(6, duration=0.25)
        bench.start_motion(link, points)
        if how != "has not beaten":
            control.ask(messages.RawHeartbeat(0.6))
        bench.run(0.2)
        next_one: RawLink | None = None
        if how == "is replaced":
            next_one = bench.control()
        elif how == "is dropped":
            # By an error while the server serves it.
            fails(bench, "ROS_control", "CopyRawBytes", "ERR_OUTOFBND")
            control.send(_PING)
        else:
            control.close(abort=how == "is reset")
        if how == "has not beaten":
            bench.wait_until_at(points[-1][0], 5)
        else:
            bench.wait_until_at_rest(
                0.3 + 0.05 * bench.setting.slowness, 0.3, f"a client that beats {how}"
            )
        if not control.lost:
            raise CheckFailed(f"a control client that {how} keeps its connection")
        control = next_one if next_one is not None else bench.control()
        # The next client has requested no heartbeats.
        bench.assert_moves_through(link, bench.wave(6, duration=0.25))


@case("stops-before", "STOP before a stream moves")
def _not_started(bench: Bench) -> None:
    """Stop a stream before its motion: no point was reached."""
    if bench.config.trajectory.preload <= 0:
        raise NotApplicable("streams begin at once, `preload` is 0")
    control, watcher = bench.control(), bench.watcher()
    stream = Streamer(bench)
    stream.put(way(bench, 1), BEGIN)
    number = stream.accepted("the first points").trajectory
    stop(control)
    reply = control.expect(messages.RawStopped, 2, "STOPPED arrives")
    current = (*bench.position, *[0.0] * (messages.MAX_JOINTS - len(bench.position)))
    if (
        reply[:3] != (number, 0, RawReason.STOPPED)
        or max(abs(a - b) for a, b in zip(reply.joints, current, strict=True)) > 1e-5
    ):
        raise CheckFailed(f"a stream was stopped before it moved, STOPPED says {reply}")
    stream.refuses(RawReason.STOPPED, "points after STOP", way(bench, 2))
    bench.run(0.3)
    progress = bench.progress(watcher)
    if (progress.trajectory, progress.state, progress.reason) != (
        number,
        RawTrajectoryState.STOPPED,
        RawReason.STOPPED,
    ):
        raise CheckFailed(f"a stream was stopped before it moved, PROGRESS says {progress}")
    bench.assert_at_rest(0.5, "the stream was stopped before it moved")

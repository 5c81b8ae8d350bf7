"""Failing instructions, ports in use, and wrap of counters and clocks."""

import re
from dataclasses import replace

from rapidgen.generate.context import WRAP
from rapidgen.machine.event_log import EventType
from rapidgen.runtime.builtins.system import StopWatch
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.messages import (
    STATUS,
    RawReason,
    RawTrajectoryState,
    RawTriState,
    text_of,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import STOP
from rapidgen.verification.suite.motion_task import CpuMeter, datum
from rapidgen.verification.suite.off_path import STAYS_STOPPED
from rapidgen.verification.testbench import Bench

case = SuiteGroup("failing")

_COUNTERS = (
    ("head", "tail"),
    (
        "trajectory",
        "phase_trajectory",
        "active_trajectory",
        "done_trajectory",
        "started_trajectory",
    ),
    ("stop_asked", "stop_done"),
    ("check_asked", "check_done"),
    ("control_asked", "control_done"),
    ("pause_asked", "pause_done"),
    ("speed_asked", "speed_done"),
    ("abort", "abort_done"),
    ("wakeup",),
    ("interruptions", "interruptions_seen"),
    ("ended_early", "halted_trajectory"),
)
"""Counters in ROS_common.

Those of one row have the same value in an idle driver, the last row that of an old trajectory.
"""


def _serves(bench: Bench) -> None:
    """Check a trajectory, STOP in the next one, and another trajectory."""
    link = bench.motion()
    bench.assert_moves_through(link, bench.wave(3, duration=0.2))
    bench.start_motion(link, bench.wave(8), 0.3)
    link.stop()
    bench.wait_until_standing(5)
    bench.assert_moves_through(link, bench.wave(3, duration=0.2))
    bench.status(bench.state(), 5)
    link.close(then=0.3)


@case("instructions-fail", "an instruction that reports an error ends no task", "R3")
def _instructions_fail(bench: Bench) -> None:
    """Make each instruction that may fail do so twice, at rest and moving."""
    for module, instruction, error in (
        ("ROS_motionServer", "SocketReceive", "ERR_SOCK_CLOSED"),
        ("ROS_motionServer", "SocketPeek", "ERR_SOCK_CLOSED"),
        ("ROS_motionServer", "SocketSend", "ERR_SOCK_CLOSED"),
        ("ROS_motionServer", "SocketAccept", "ERR_SOCK_CLOSED"),
        ("ROS_motionServer", "UnpackRawBytes", "ERR_OUTOFBND"),
        ("ROS_stateServer", "SocketSend", "ERR_SOCK_CLOSED"),
        ("ROS_stateServer", "SocketPeek", "ERR_SOCK_CLOSED"),
        ("ROS_stateServer", "SocketAccept", "ERR_SOCK_CLOSED"),
        ("ROS_supervisor", "StopMove", "ERR_PATH_STOP"),
        ("ROS_supervisor", "StartMove", "ERR_PATHDIST"),
        ("ROS_supervisor", "DOutput", "ERR_NORUNUNIT"),
        ("ROS_stateServer", "DOutput", "ERR_NORUNUNIT"),
        ("ROS_motion", "ClearPath", "ERR_PATH_STOP"),
        ("ROS_motion", "WaitRob", "ERR_PATH_STOP"),
        ("ROS_motion", "StopMove", "ERR_PATH_STOP"),
        ("ROS_motion", "StartMove", "ERR_PATHDIST"),
    ):
        for moving in (False, True):
            link = bench.motion()
            state = bench.state()
            if moving:
                bench.start_motion(link, bench.wave(6))
            recovers = fails(bench, module, instruction, error, 2)
            bench.run(0.3)
            link.send(STOP)
            bench.run(2)
            recovers()
            bench.assert_healthy()
            bench.assert_at_rest(1, f"it was stopped; {instruction} of {module} has failed")
            link.close()
            state.close(then=2.5)
            try:
                _serves(bench)
            except CheckFailed as error:
                how = "while moving" if moving else "at a standstill"
                raise CheckFailed(f"{instruction} of {module} has failed {how}: {error}") from error


@case("move-fails", "a move that fails ends its trajectory with its own reason", "R11, R14")
def _move_fails(bench: Bench) -> None:
    for error, reason in (
        ("ERR_COLL_STOP", RawReason.COLLISION),
        ("ERR_PATH_STOP", RawReason.MOTION_ERROR),
    ):
        watcher, link = bench.watcher(), bench.motion()
        errors = _errors(bench)
        points = bench.wave(10)
        bench.start_motion(link, points, 0.9)
        fails(bench, "ROS_motion", "MoveAbsJ", error)
        bench.wait_until_at_rest(5, 3, f"a move ended with {error}")
        bench.run(0.3)
        reply, status = bench.progress(watcher), bench.status(watcher)
        if (reply.state, reply.reason) != (RawTrajectoryState.FAILED, reason):
            raise CheckFailed(f"a move ended with {error}, PROGRESS says {reply}")
        if (status.in_error, status.error_code, status.in_motion) != (1, reason, 0):
            raise CheckFailed(f"a move ended with {error}, STATUS says {status}")
        log_entries = [text for text in _errors(bench)[len(errors) :] if text_of(reason) in text]
        if len(log_entries) != 1 or f"point {reply.planned - 1}" not in log_entries[0]:
            raise CheckFailed(
                f"a move to point {reply.planned - 1} failed, the event log says {log_entries}"
            )
        bench.assert_moves_through(link, bench.wave(3))
        bench.run(0.3)
        if bench.status(watcher).in_error:
            raise CheckFailed("in_error stays after a good trajectory")
        watcher.close()
        link.close(then=1.5)


def _errors(bench: Bench) -> list[str]:
    return [str(e) for e in bench.controller.log if e.type is EventType.ERROR]


@case("path-stays", "a path that cannot be cleared is not executed")
def _path_stays(bench: Bench) -> None:
    """Fail to clear a path, or to read the standstill: the robot stays at rest."""
    for instruction, times in (
        ("ClearPath", 1),
        ("ClearPath", 3),
        ("ClearPath", 5),
        ("WaitRob", 3),
    ):
        link = bench.motion()
        # A move that is already ordered would take longer than a stop.
        bench.start_motion(link, bench.wave(6, duration=2.0), 0.5)
        fails(bench, "ROS_motion", instruction, "ERR_PATH_STOP", times)
        link.stop(2, "STOP is answered, whatever becomes of the path")
        bench.wait_until_at_rest(1, 6, f"it was stopped; {instruction} has failed {times} times")
        bench.assert_moves_through(link, bench.wave(4))
        link.close(then=1.5)


@case("far-off-once", "a stop far off the path makes no later one so", "R7b")
def _far_off_once(bench: Bench) -> None:
    """Use StopMoveReset only if the robot is too far from its path."""
    link = bench.motion()
    for error, why in (
        ("ERR_PATHDIST", "It stands too far from the path that it left."),
        ("ERR_PATH_STOP", "Its stop cannot be reset."),
    ):
        last, keeps = bench.last_event, bench.setting.motion.stop_move_reset == "keeps"
        bench.start_motion(link, bench.wave(12), 0.3)
        recovers = fails(bench, "ROS_supervisor", "StartMove", error, 1000)
        link.stop()
        bench.wait_until_at_rest(3, 3, f"it was stopped, StartMove says {error}")
        log_entries = [
            e.texts[0] for e in bench.controller.log.since(last) if e.title == STAYS_STOPPED
        ]
        held = keeps or error != "ERR_PATHDIST"
        if bool(bench.motion_group.stop_reasons) != held or log_entries != [why] * held:
            raise CheckFailed(
                f"StartMove says {error}: held by {bench.motion_group.stop_reasons}, the event "
                f"log says {log_entries}"
            )
        recovers()
        bench.run(0.5)
        bench.assert_moves_through(link, bench.wave(3))


@case("port-taken", "a port that is taken is waited for", "R18")
def _port_taken(bench: Bench) -> None:
    with bench.second_controller(bench.system, setting=bench.setting.early()) as other:
        network = other.controller.network
        accepted = [
            network.bind("127.0.0.1", port)
            for port in (other.group.ports.motion, other.group.ports.state)
        ]
        other.run(4.5)
        warned = [e for e in other.controller.log if "cannot be opened" in str(e)]
        if len(warned) != 2:
            raise CheckFailed(
                f"two ports were taken for 4 s, the event log has {len(warned)} warnings"
            )
        for endpoint in accepted:
            network.close(endpoint)
        other.run(1.1)
        _serves(other)


@case("counters-wrap", "counters begin anew after their last value", once=True)
def _counters_wrap(bench: Bench) -> None:
    """Set counters to their last values, which take years to reach."""
    for before in (1, 3, 5):
        with bench.second_controller(bench.system) as other:
            set_counters(other, WRAP - before)
            watcher, link = other.watcher(), other.motion()
            first = other.progress(watcher).trajectory
            for _ in range(4):
                other.assert_moves_through(link, other.wave(6, duration=0.2))
                _serves_stop(other)
                link = other.motion()
            other.run(0.3)
            number = other.progress(watcher).trajectory
            if number >= WRAP or (number - first) % WRAP != 8:
                raise CheckFailed(
                    f"after trajectory {first} come eight others, the last is {number}"
                )
            other.assert_healthy()


@case("number-again", "a trajectory with the number of a program of years ago", needs="stream")
def _number_again(bench: Bench) -> None:
    """Restart the numbers after a program: the points are no instructions."""
    watcher, link = bench.watcher(), bench.motion()
    task = bench.controller.task(bench.task("ROS_motion"))
    task[datum(bench, "ros_program_number")] = bench.progress(watcher).trajectory + 1
    bench.assert_moves_through(link, bench.wave(4))


def set_counters(bench: Bench, value: int) -> None:
    """Set all counters, before the first request."""
    task = bench.controller.task(bench.task("ROS_motion"))
    declared = task.rapid.program.modules["ros_common"].declarations
    for name in [name for row in _COUNTERS for name in row]:
        # With several groups, the names end in the group's number.
        full = [key for key in declared if re.fullmatch(rf"ros_{name}(_\d+)?", key)]
        for one in full:
            task[f"ROS_common:{one}"] = value


def _serves_stop(bench: Bench) -> None:
    link = bench.motion()
    bench.run(1.2)
    bench.start_motion(link, bench.wave(6))
    link.stop()
    bench.wait_until_standing(5)
    link.close(then=0.2)


@case("clocks-end", "a clock at the end of its 49 days")
def _clocks_at_their_end(bench: Bench) -> None:
    """Wait 49 days without a rejection: the warning clock has overflowed."""
    link = bench.motion()
    link.send(bench.download(bench.wave(4))[68:])
    bench.run(2)
    program = bench.rapid_task("ROS_motionServer").program
    for value in program.space.values():
        if isinstance(value, StopWatch) and value.started is not None:
            value.started -= 50 * 86_400 * 10**9
    link.send(bench.download(bench.wave(4))[68:])
    bench.run(2)
    bench.assert_healthy()
    bench.assert_moves_through(link, bench.wave(3))


@case("state-for-hours", "the state schedule over the ends of its clock", once=True)
def _state_for_hours(bench: Bench) -> None:
    """Send state for hours: messages keep their schedule.

    Clocks and counters of the server restart meanwhile.
    """
    link = bench.state()
    bench.run(1050)
    stamps = [when for when, f in link.frames if f.number == STATUS]
    period = bench.config.state_period
    for i, when in enumerate(stamps):
        if abs(when - (stamps[0] + i * period)) > period:
            raise CheckFailed(f"STATUS {i} came at {when:.3f} s, more than a period off")
    if abs(len(stamps) - 1050 / period) > 3:
        raise CheckFailed(f"{len(stamps)} STATUS in 1050 s, wanted {1050 / period:.0f}")


@case("nobody-costs", "a driver without clients takes little processor time", "R19")
def _unused_driver_costs(bench: Bench) -> None:
    """Measure processor time without clients: each task waits."""
    bench.run(0.1)
    meter = CpuMeter(bench)
    bench.run(0.5)
    meter.end("without clients")


@case("idle-costs", "a driver that waits takes little of the processor", "R19")
def _idle_costs_nothing(bench: Bench) -> None:
    """Measure processor time of an idle driver: other tasks get it."""
    link, state = bench.motion(), bench.state()
    if bench.group.ports.control:
        bench.control()
    bench.run(2)
    meter = CpuMeter(bench)
    bench.run(20)
    meter.end("while no client asks for anything")
    bench.status(state)
    link.close()


@case("signals-fail", "signals that cannot be read are unknown", "R15")
def _signal_units_fail(bench: Bench) -> None:
    """Lose a signal's I/O unit: the signal is unknown, not off."""
    state = bench.state()
    fails(bench, "ROS_stateServer", "DOutput", "ERR_NORUNUNIT", 10**6)
    bench.run(1)
    status = bench.status(state)
    unknown = RawTriState.UNKNOWN
    if (status.drives_powered, status.e_stopped, status.in_motion) != (unknown, unknown, 0):
        raise CheckFailed(f"no signal can be read, STATUS says {status}")
    if status.in_error:
        raise CheckFailed(f"no signal can be read, STATUS calls it an error: {status}")


@case("stopped-unseen", "a program stop that no signal shows", "R15", background=True)
def _stopped_without_signals(bench: Bench) -> None:
    """Stop the program without signals: the robot stays stopped."""
    with bench.second_controller(
        replace(bench.system, signals=(), outputs=(), cross=(), events=())
    ) as other:
        link = other.motion()
        other.start_motion(link, other.wave(10))
        other.controller.perform("stop")
        other.wait_until_standing(5)
        watcher = other.watcher()
        link.send(STOP)
        other.run(3)
        reply = other.progress(watcher)
        if (reply.state, reply.reason) != (RawTrajectoryState.STOPPED, RawReason.STOPPED):
            raise CheckFailed(
                f"STOP came while the motion task does not answer, PROGRESS says {reply}"
            )
        if reply.point != reply.reached or not 0 < reply.planned <= reply.received:
            raise CheckFailed(
                f"STOP came while the motion task does not answer, PROGRESS says {reply}"
            )
        log_entries = [e for e in other.controller.log if "does not answer" in str(e)]
        if len(log_entries) != 1:
            raise CheckFailed(
                f"the motion task does not answer, the event log says so {len(log_entries)} times"
            )
        link.send(other.download(other.wave(4)))
        other.assert_at_rest(5, "the program is stopped")
        other.controller.perform("start")
        other.assert_at_rest(3, "the program was started again, no client asked for motion")
        other.assert_moves_through(link, other.wave(4))

"""Order of program instructions: late, missing and delayed ones."""

import random
import re
from dataclasses import replace

from rapidgen.machine.event_log import EventType
from rapidgen.runtime.values import Value
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import at_call
from rapidgen.verification.messages import (
    JOINT_TRAJ_PT,
    RawInstruction,
    RawReason,
    RawStreamFlag,
    RawTrajectoryState,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.raw_programs import BEGIN, Programmer, orders
from rapidgen.verification.stream import FLUSH, Streamer, way
from rapidgen.verification.suite.motion_task import datum, halt_timeout
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")


def _ring(bench: Bench) -> list[Value]:
    """Return the instructions in the motion task's ring, by index."""
    task = bench.rapid_task("ROS_motion")
    declared = task.program.modules["ros_common"].declarations
    name = next(key for key in declared if re.fullmatch(r"ros_instr_ring(_\d+)?", key))
    view = bench.controller.task(bench.group.task)
    return list(view[f"ROS_common:{name}"].values())


def _expect_progress(
    bench: Bench, watcher: RawLink, trajectory: int, state: RawTrajectoryState, reason: RawReason
) -> messages.RawProgress:
    """Return PROGRESS; check state and reason of the trajectory."""
    reply = bench.progress(watcher)
    if (reply.trajectory, reply.state, reply.reason) != (trajectory, state, reason):
        raise CheckFailed(
            f"{trajectory} {state.name} for {reason.name} is wanted, PROGRESS: {reply}"
        )
    return reply


@case("program-late", "an instruction that comes late is dropped, a hole ends the program", "R5")
def _late(bench: Bench) -> None:
    """Announce an instruction after STOP; then one with a wrong number."""
    watcher, client = bench.watcher(), Programmer(bench)
    task, head = bench.controller.task(bench.group.task), datum(bench, "ros_head")
    program = [replace(order, zone=None) for order in orders(bench, 6, random.Random(51))]
    last = bench.last_event
    number = client.takes("a program", program)
    bench.wait_until_moving()
    bench.run(0.3)
    client.link.stop()
    bench.run(halt_timeout(bench))
    reply = _expect_progress(bench, watcher, number, RawTrajectoryState.STOPPED, RawReason.STOPPED)
    ring = _ring(bench)
    late, like = ring[int(task[head]) % len(ring)], ring[0]
    late.trajectory, late.index = number, reply.planned + 1
    late.kind, late.joints, late.speed, late.zone = like.kind, like.joints, like.speed, like.zone
    task[head] = task[head] + 1
    bench.assert_at_rest(1, "an instruction of a stopped program came late")
    number = client.takes("a program after it", program)
    next(o for o in ring if (o.trajectory, o.index) == (number, 4)).index = 5.0
    bench.wait_until_at(program[2].joints, 60)
    bench.assert_at_rest(1, "an instruction is missing")
    reply = _expect_progress(bench, watcher, number, RawTrajectoryState.FAILED, RawReason.INTERNAL)
    if (reply.planned, reply.reached) != (3, 3):
        raise CheckFailed(f"the fourth instruction is missing, PROGRESS says {reply}")
    log_entries = [e for e in bench.controller.log.since(last) if e.type is EventType.ERROR]
    if len(log_entries) != 1:
        raise CheckFailed(
            f"an instruction is missing, the event log says {[str(e) for e in log_entries]}"
        )
    client.takes("a program after that", program)
    bench.wait_until_at(program[-1].joints, 60)


@case("stop-starved", "STOP while a stream or a program waits for more", "R9")
def _stop_starved(bench: Bench) -> None:
    """Send STOP to a program that waits for instructions.

    The robot stops where it is, and no task ends.
    """
    watcher, client = bench.watcher(), Programmer(bench)
    starved, moving = RawTrajectoryState.STARVED, RawTrajectoryState.MOVING
    stream, task = Streamer(bench, client.link), bench.rapid_task("ROS_motion")

    def ask() -> None:
        client.link.at_once(STOP)
        task.sleep(0.08)

    for program in (False, True):
        if program:
            first, *_, last = orders(bench, 4, random.Random(52))
            goals = [first, replace(last, kind=RawInstruction.MOVE_ABSJ, pose=None)]
            number = client.takes("the beginning of a program", goals[:1], BEGIN)
            ends = [goal.joints for goal in goals]
        else:
            points = way(bench, 20)
            number = stream.takes("the beginning", points[:8], BEGIN | FLUSH).trajectory
            ends = [points[7][0], points[-1][0]]
        bench.wait_until_at(ends[0], 60)
        bench.run(halt_timeout(bench))
        _expect_progress(bench, watcher, number, starved, RawReason.NONE)
        if program:
            client.say(goals[1].words, 1, RawStreamFlag(0), first=1)
        else:
            stream.takes("the rest", points[8:], FLUSH)
        bench.wait_until_moving()
        bench.run(2 * bench.config.state_period)
        _expect_progress(bench, watcher, number, moving, RawReason.NONE)
        bench.wait_until_at(ends[1], 60)
        bench.run(halt_timeout(bench))
        # The motion task waits for more here; this takes longer than a server and two interrupts.
        at_call(bench, "ROS_motion", "WaitTime", 1, ask)
        if client.link.reply(JOINT_TRAJ_PT) != messages.RawAcknowledged():
            raise CheckFailed("STOP is not confirmed while more is waited for")
        bench.assert_at_rest(halt_timeout(bench), "it was stopped while it waited for more")
        _expect_progress(bench, watcher, number, RawTrajectoryState.STOPPED, RawReason.STOPPED)
        bench.assert_healthy()
        bench.assert_moves_through(client.link, bench.wave(3))

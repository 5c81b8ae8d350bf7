"""Programs: right and wrong instructions, batches, waits, and what supersedes them."""

import random
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from rapidgen.machine.event_log import EventType
from rapidgen.runtime.values import Value
from rapidgen.verification import messages
from rapidgen.verification.batches import millionths, words_frame
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import at_call
from rapidgen.verification.messages import (
    JOINT_TRAJ_PT,
    PROGRAM,
    RawInstruction,
    RawModal,
    RawReason,
    RawStreamFlag,
    RawTrajectoryState,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import SETTLED, changed, distance, inward, small_unit
from rapidgen.verification.program_steps import (
    ANY_INDEX,
    ANY_JOINT,
    CornersMade,
    Ended,
    Go,
    More,
    No,
    Program,
    Reached,
    Reasons,
    Taken,
    instruction,
    right,
)
from rapidgen.verification.raw_connection import STOP
from rapidgen.verification.raw_programs import ALL, BEGIN, Item, RawMove, computes, orders, reached
from rapidgen.verification.steps import (
    WAY,
    At,
    Healthy,
    MovesOn,
    Moving,
    Pass,
    Rest,
    Run,
    Send,
    Step,
    Stop,
    Way,
    generated,
)
from rapidgen.verification.stream_steps import Batch, Begin
from rapidgen.verification.suite.motion_task import datum, halt_timeout
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")

ABSJ, MOVE_L, MOVE_C = RawInstruction.MOVE_ABSJ, RawInstruction.MOVE_L, RawInstruction.MOVE_C
WAIT, SET = RawInstruction.WAIT, RawInstruction.SET
BAD_SPEED, BAD_ZONE, BAD_VALUE = RawReason.BAD_SPEED, RawReason.BAD_ZONE, RawReason.BAD_VALUE
FRAMING, NO_FRAME = RawReason.FRAMING, RawReason.NO_FRAME
NO_INSTRUCTION, POSE_MISMATCH = RawReason.NO_INSTRUCTION, RawReason.POSE_MISMATCH
DONE, FAILED, MOVING = (
    RawTrajectoryState.DONE,
    RawTrajectoryState.FAILED,
    RawTrajectoryState.MOVING,
)
REFUSED, STARVED, STOPPED = (
    RawTrajectoryState.REFUSED,
    RawTrajectoryState.STARVED,
    RawTrajectoryState.STOPPED,
)
END, FLUSH = RawStreamFlag.END, RawStreamFlag.FLUSH


# -- instructions ------------------------------------------------------------------------------


@case("program-refused", "one wrong instruction refuses a program whole, with its index")
@generated
def _refused(bench: Bench) -> Iterator[Step]:
    program = orders(bench, 6, random.Random(3))
    head, one, tail = program[:3], program[3], program[3:]
    for n, own in enumerate(bench.group.joints):
        unit = small_unit(own)
        for value in (own.lower - 2 * unit, own.upper + 2 * unit):
            wrong = replace(one, kind=ABSJ, joints=changed(one.joints, n, value), pose=None)
            yield Program([*head, wrong, *tail], No(RawReason.JOINT_LIMIT, 3, n + 1))
        for value in (own.lower + unit, own.upper - unit):
            inside = replace(one, kind=ABSJ, joints=changed(one.joints, n, value), pose=None)
            yield right([*head, inside])
        start = changed(bench.position, n, inward(own, bench.position[n], 0.1))
        yield Program(program, No(RawReason.START_TOO_FAR, 0, n + 1), start=start)
    # The smallest and the widest zone: 1.5 times its size is the widest radius.
    for zone in (0.0, 2 / 3):
        yield right([*head, replace(one, zone=zone, speed=_fastest(bench))])
    for bad, move in _wrong_moves(bench, program):
        yield Program([*head, move, *tail], No(bad, 3), str(move))
    for reason, index, item in _wrong_words(bench, program[0]):
        yield Program([item], No(reason, index), str(item))
    if bench.motion_group.kinematics is not None and not computes(bench):
        line = replace(one, kind=MOVE_L, pose=reached(bench, one.joints))
        yield Program([*head, line], No(RawReason.NO_GEOMETRY, 3))
    many = [program[0]] * (bench.config.trajectory.ring + 3)
    yield from (Program(many, No(RawReason.OVERRUN, ANY_INDEX)), Rest(1))
    yield from (Ended(RawReason.OVERRUN, 0, REFUSED), Go(program))


def _fastest(bench: Bench) -> float:
    """Return the fastest TCP speed of a program, m/s, as on the wire."""
    return 1e-6 * round(1e6 * bench.group.tcp_speed_limit)


def _wrong_moves(bench: Bench, program: Sequence[RawMove]) -> Iterator[tuple[RawReason, RawMove]]:
    """Yield moves that are rejected."""
    one = program[3]
    for speed in (0.0, -1.0, 2000.0, _fastest(bench) + 1e-3):
        yield BAD_SPEED, replace(one, speed=speed)
    for zone in (-0.001, 0.67, 1.1):
        yield BAD_ZONE, replace(one, zone=zone)
    for move in program:
        if move.pose is None:
            continue
        (x, y, z), q = move.pose
        far = replace(move, pose=((x, y, z + 1.1 * bench.config.trajectory.pose_tolerance), q))
        yield POSE_MISMATCH, far
        yield POSE_MISMATCH, replace(move, pose=((x, y, z), (q[1], q[0], q[3], q[2])))
        yield POSE_MISMATCH, replace(far, kind=MOVE_C, via=move.pose)
        for size in (0.0, 0.98, 1.02):
            a, b, c, d = (size * part for part in q)
            yield BAD_VALUE, replace(move, pose=((x, y, z), (a, b, c, d)))
        return


def _wrong_words(bench: Bench, move: RawMove) -> Iterator[tuple[Reasons, int, Item]]:
    """Yield the words of an instruction that is rejected, and the rejected index."""
    place, speeds = millionths(bench.position), millionths(move.speeds)
    for words in ([99, 0], [0], [-1], [4096 + ABSJ, 0], [4096], [12, 0, *place]):
        yield NO_INSTRUCTION, 0, words
    yield FRAMING, 0, [ABSJ, 0]
    yield FRAMING, 1, [*move.words, 0]
    # Speed and zone of the program before are not used.
    yield BAD_SPEED, 0, [ABSJ, *place]
    yield BAD_ZONE, 0, [ABSJ | RawModal.SPEED, *speeds, *place]
    for frames in ((99.0, 0.0), (0.0, 0.5)):
        yield NO_FRAME, 0, [ABSJ | RawModal.FRAMES, *millionths(frames), *place]
    yield (RawReason.NO_SIGNAL, NO_INSTRUCTION), 0, instruction(SET, 99.0, 0.0)


@case("program-operands", "each speed and each radius of a zone is looked at by itself")
@generated
def _operands(bench: Bench) -> Iterator[Step]:
    move = RawMove(ABSJ, bench.position, None)
    speeds, zones, most = range(1, 5), range(6, 12), 2**31 - 1

    def with_word(place: int, value: int) -> list[int]:
        return [*move.words[:place], value, *move.words[place + 1 :]]

    for reason, places, values in (
        (BAD_SPEED, speeds, (0, -1, most)),
        (BAD_ZONE, zones, (-1, most)),
        (BAD_ZONE, (5,), (-1, 1, 2_000_000)),
    ):
        for place, value in ((place, value) for place in places for value in values):
            items: list[Item] = [move, with_word(place, value)]
            yield Program(items, No(reason, 1), f"word {place} of a move is {value}")
    for places, value in ((speeds, 1), (zones, 0), (zones[:3], 1_000_000)):
        for place in places:
            yield right([with_word(place, value)], f"word {place} of a move is {value}")
    yield Rest(0.5)


@case("program-waits", "a wait between moves, which STOP ends")
@generated
def _waits(bench: Bench) -> Iterator[Step]:
    """Wait after a stop point, whatever the zone; reject invalid waits."""
    first, *_, last = orders(bench, 6, random.Random(4))
    target = replace(last, kind=ABSJ, pose=None, zone=0.01)
    for seconds in (1.5, 0.5, 0.0):
        yield Program([target, instruction(WAIT, seconds), first])
        # Axes that lag move on before they rest.
        yield Reached(target.joints) if seconds else _ComesBy(target)
        yield from (Rest(0.8 * seconds), Reached(first.joints))
    yield CornersMade()
    for seconds in (-1.0, 2001.0):
        yield Program([target, instruction(WAIT, seconds), first], No(BAD_VALUE, 1))
    # The longest wait.
    yield Program([target, instruction(WAIT, 2000.0), first])
    yield from (Reached(target.joints), Pass(0.5), Stop(), Rest(2))


class _ComesBy:
    """The robot comes to the end of a move, and may move on."""

    def __init__(self, move: RawMove) -> None:
        self._place = move.joints

    def play(self, run: Run) -> None:
        """Wait for it."""
        bench = run.bench
        bench.until(lambda: distance(bench.position, self._place) < SETTLED, 60, "it comes by")


# -- batches of a program ----------------------------------------------------------------------


@case("program-stream", "a program that comes while the robot moves is executed up to a fault")
@generated
def _stream(bench: Bench) -> Iterator[Step]:
    program = orders(bench, 16, random.Random(11))
    wrong = replace(program[12], speed=0.0)
    yield from (Program(program[:8], flags=BEGIN), Moving())
    yield More([*program[8:12], wrong, *program[13:]], 8, No(BAD_SPEED, 12), END)
    yield from (Reached(program[11].joints, 90), Pass(0.5), Ended(BAD_SPEED, 12, FAILED), Rest(1))


@case("program-index-wraps", "more instructions than numbers", once=True)
@generated
def _index_wraps(bench: Bench) -> Iterator[Step]:
    """Let instruction numbers wrap after the last exact integer."""
    last = messages.INDEX_WRAP
    program = [replace(move, zone=None) for move in orders(bench, 10, random.Random(12))]
    yield Program(program[:3], flags=BEGIN)
    yield from (Reached(program[2].joints), Pass(0.5))
    server = bench.controller.task(bench.task("ROS_motionServer"))
    motion = bench.controller.task(bench.task("ROS_motion"))
    server["ROS_motionServer:ROS_point_count"] = server["ROS_stream:accepted"] = last - 3
    motion["ROS_motion:expected_index"] = last - 2
    yield More(program[3:9], last - 3, Taken(3), END)
    yield from (Reached(program[8].joints), Pass(0.5), Healthy())


@case("program-halves", "a trajectory ends a program, and a program a trajectory")
@generated
def _superseded(bench: Bench) -> Iterator[Step]:
    """Replace a program by something newer: none of it executes later."""
    program = orders(bench, 5, random.Random(2))
    yield from (Program(program), Moving(), Pass(0.3))
    yield Send(bench.wave(4))
    yield from (Ended(None, state=(DONE, REFUSED), within=40), Rest(1))
    yield Send(bench.wave(20))
    yield from (Moving(), Pass(0.5), _IntoTrajectory(program), Reached(program[-1].joints))


class _IntoTrajectory:
    """Send a program into a trajectory.

    It began at the robot's position when it was sent: if the robot is too far from there now, the
    program is rejected, and taken when the robot stands.
    """

    def __init__(self, program: Sequence[RawMove]) -> None:
        self._program = program

    def play(self, run: Run) -> None:
        """Send it once or twice."""
        reply = run.client.send(self._program)
        if isinstance(reply, messages.RawPointsRefused):
            No(RawReason.START_TOO_FAR, 0, ANY_JOINT).check(reply, run, 0)
            run.bench.wait_until_at_rest(5, 1, "neither is under way")
            Program(self._program).play(run)


@case("program-late", "an instruction that comes late is dropped, a hole ends the program", "R5")
@generated
def _late(bench: Bench) -> Iterator[Step]:
    """Announce an instruction after STOP; then one with a wrong number."""
    program = [replace(move, zone=None) for move in orders(bench, 6, random.Random(51))]
    last = bench.last_event
    yield from (Program(program), Moving(), Pass(0.3), Stop(), Pass(halt_timeout(bench)))
    yield from (Ended(RawReason.STOPPED, state=STOPPED), _Announce(), Rest(1))
    yield from (Program(program), _Renumber(4), Reached(program[2].joints), Rest(1))
    yield Ended(RawReason.INTERNAL, 3, FAILED)
    log_entries = [e for e in bench.controller.log.since(last) if e.type is EventType.ERROR]
    if len(log_entries) != 1:
        raise CheckFailed(f"an instruction is missing, the event log says {log_entries}")
    yield Go(program)


def _ring(bench: Bench) -> list[Value]:
    """Return the instructions in the motion task's ring, by index."""
    task = bench.rapid_task("ROS_motion")
    declared = task.program.modules["ros_common"].declarations
    name = next(key for key in declared if re.fullmatch(r"ros_instr_ring(_\d+)?", key))
    view = bench.controller.task(bench.group.task)
    return list(view[f"ROS_common:{name}"].values())


class _Announce:
    """Announce the next instruction of the newest program, as the motion server does."""

    def play(self, run: Run) -> None:
        """Write it to the ring."""
        bench = run.bench
        task, head = bench.controller.task(bench.group.task), datum(bench, "ros_head")
        planned = bench.progress(run.watcher).planned
        ring = _ring(bench)
        late, like = ring[int(task[head]) % len(ring)], ring[0]
        late.trajectory, late.index = run.trajectory, planned + 1
        late.kind, late.joints = like.kind, like.joints
        late.speed, late.zone = like.speed, like.zone
        task[head] = task[head] + 1


class _Renumber:
    """Give an instruction of the newest program in the ring the number of the next one."""

    def __init__(self, index: int) -> None:
        self._index = index

    def play(self, run: Run) -> None:
        """Change the number."""
        wanted = (run.trajectory, self._index)
        found = next(i for i in _ring(run.bench) if (i.trajectory, i.index) == wanted)
        found.index = self._index + 1.0


@case("stop-starved", "STOP while a stream or a program waits for more", "R9")
@generated
def _stop_starved(bench: Bench) -> Iterator[Step]:
    """The robot stops where it is, and no task ends."""
    over = Pass(halt_timeout(bench))
    stopped = (
        *(over, _StopWhileWaiting(), Rest(halt_timeout(bench))),
        *(Ended(RawReason.STOPPED, state=STOPPED), Healthy(), MovesOn(3)),
    )
    starved, reports = Ended(RawReason.NONE, state=STARVED), Pass(2 * bench.config.state_period)
    moving = (Moving(), reports, Ended(RawReason.NONE, state=MOVING))
    yield from (Way(20), Begin(WAY[:8], FLUSH), At(7, 60), over, starved)
    yield from (Batch(WAY[8:], FLUSH), *moving, At(-1, 60), *stopped)
    first, *_, last = orders(bench, 4, random.Random(52))
    last = replace(last, kind=ABSJ, pose=None)
    yield from (Program([first], flags=BEGIN), Reached(first.joints), over, starved)
    yield from (More([last], 1), *moving, Reached(last.joints), *stopped)


class _StopWhileWaiting:
    """Send STOP while the motion task waits for more: it is confirmed."""

    def play(self, run: Run) -> None:
        """Let the wait take longer than a server and two interrupts."""
        task = run.bench.rapid_task("ROS_motion")

        def ask() -> None:
            run.link.at_once(STOP)
            task.sleep(0.08)

        at_call(run.bench, "ROS_motion", "WaitTime", 1, ask)
        if run.link.reply(JOINT_TRAJ_PT) != messages.RawAcknowledged():
            raise CheckFailed("STOP is not confirmed while more is waited for")


plain = SuiteGroup("programs")


@plain("program-basic", "a driver of the basic profile says that it takes no programs")
def _basic(bench: Bench) -> None:
    """Omit PROGRAMS from HELLO, and answer PROGRAM with a failure."""
    link = bench.motion()
    answer = bench.send_hello(bench.state())
    if bool(answer.features & messages.RawFeature.PROGRAMS) is not bench.streams:
        raise CheckFailed(f"HELLO reports the features {answer.features}")
    if bench.streams:
        return
    place = millionths(bench.position)
    link.send(words_frame(1, 0, 1, [*place, ABSJ, *place], ALL, number=PROGRAM))
    if not isinstance(link.reply(PROGRAM), messages.RawFailure):
        raise CheckFailed("a driver of the basic profile takes a program")
    bench.assert_at_rest(1, "nothing was taken")

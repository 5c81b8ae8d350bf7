"""Motion programs: moves to joints and poses, executed as in RAPID."""

import random
from dataclasses import replace

from rapidgen.motion.settings import MotionSettings
from rapidgen.verification import messages
from rapidgen.verification.batches import millionths, words_frame
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import (
    PROGRAM,
    RawInstruction,
    RawReason,
    RawStreamFlag,
    RawTrajectoryState,
)
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.path_deviation import farthest, movement, points
from rapidgen.verification.position_checks import (
    SETTLED,
    Position,
    changed,
    distance,
    inward,
    small_unit,
)
from rapidgen.verification.raw_programs import (
    ALL,
    BEGIN,
    Programmer,
    RawMove,
    bent,
    by_hand,
    called,
    computes,
    orders,
    reached,
)
from rapidgen.verification.testbench import CORNER_FAILURE, Bench

case = SuiteGroup("programs", needs="stream")

MOVE_ABSJ = RawInstruction.MOVE_ABSJ
_LATER = 0.005
"""Share of its time by which a program may differ from RAPID."""
_SAME = 1e-5
"""m by which the TCP may leave the path of the same program in RAPID."""


@case("program-like-rapid", "a program moves as the same one written in RAPID", once=True)
def _like_rapid(bench: Bench) -> None:
    """Execute on the same path and in the same time, without more stop points."""
    matches_rapid(bench, 6, random.Random(7))
    program_matches_rapid(Programmer(bench), bench, _turning(bench))


def _turning(bench: Bench) -> list[RawMove]:
    """Return moves whose duration depends on rotation or external axes."""
    first = orders(bench, 1, random.Random(8))[0]
    speed = min(0.5, bench.group.tcp_speed_limit)
    slow = RawMove(
        MOVE_ABSJ, turned_by(bench, first.joints, 0.4), None, speed=speed, turn=0.2, linear=0.03
    )
    if not computes(bench):
        return [first, slow]
    back = turned_by(bench, first.joints, 0.1)
    back_slow = replace(slow, kind=RawInstruction.MOVE_L, joints=back, pose=reached(bench, back))
    return [first, slow, back_slow]


def turned_by(bench: Bench, place: Position, angle: float) -> Position:
    """Return a position with the last and external axes moved by so much."""
    last = max(joint.axis for joint in bench.group.joints if joint.axis.startswith("rax"))
    return tuple(
        inward(joint, value, angle if joint.kind == "revolute" else 0.1)
        if joint.axis == last or joint.axis.startswith("eax")
        else value
        for joint, value in zip(bench.group.joints, place, strict=True)
    )


def matches_rapid(bench: Bench, count: int, chance: random.Random) -> None:
    """Compare random programs with RAPID (more: `rapidgen test --programs`)."""
    client = Programmer(bench)
    for _ in range(count):
        program_matches_rapid(client, bench, orders(bench, 8, chance))


class MotionDiffers(CheckFailed):
    """A program moved differently than the same one in RAPID."""


def program_matches_rapid(
    client: Programmer,
    bench: Bench,
    program: list[RawMove],
    other: Bench | None = None,
    hand: list[RawMove] | None = None,
) -> None:
    """Compare a program with the same one in RAPID.

    Raises MotionDiffers, and CheckFailed as a check does.

    `other`: a new controller from `called`. `hand`: the RAPID program, if it differs.
    """
    home, since = bench.position, bench.now
    client.takes("a program", program)
    mine = _moved(bench, program, since)
    with other or bench.second_controller(called(bench.config, bench.group.task)) as other:
        by_hand(other, hand or program)
        other.motion_group.jump(home)
        theirs = _moved(other, program, 0.5)
    later, same = _LATER, _SAME
    if bench.setting.motion != MotionSettings():
        # If a robot settles, or its moves are planned just before the corner, the millisecond of
        # the next order decides how it is made; a stop there would take longer.
        later, same = 4 * later, 200 * same
    if abs(mine[0] - theirs[0]) > later * theirs[0]:
        raise MotionDiffers(
            f"a program took {mine[0]:.3f} s, {theirs[0]:.3f} s when written in RAPID"
        )
    paths = points(bench, mine[1]), points(bench, theirs[1])
    for one, path in (paths, paths[::-1]):
        far = farthest(one, path)
        if far > same:
            raise MotionDiffers(
                f"a program is {far * 1000:.3f} mm off the way of the same in RAPID"
            )


def _moved(bench: Bench, program: list[RawMove], since: float) -> tuple[float, list[Position]]:
    """Return s of movement and the positions until the robot stands."""
    bench.wait_until_at(program[-1].joints, 60)
    bench.run(0.3)
    return movement([sample for sample in bench.track if sample[0] >= since])


@case("program-configurations", "a program reaches its poses in the postures that it says")
def _configurations(bench: Bench) -> None:
    """Move between configurations; earlier instructions have no influence."""
    if not computes(bench):
        raise NotApplicable("the driver computes no poses")
    client, middle = Programmer(bench), bent(bench)
    target = RawMove(MOVE_ABSJ, middle, None, zone=None)
    client.takes("a program", [target])
    bench.wait_until_at(middle, 60)
    for n, joint in enumerate(bench.group.joints):
        if joint.kind != "revolute" or not joint.lower < -middle[n] < joint.upper:
            continue
        turned = changed(middle, n, -middle[n])
        away = replace(
            target, kind=RawInstruction.MOVE_J, joints=turned, pose=reached(bench, turned)
        )
        back = replace(away, joints=middle, pose=reached(bench, middle))
        for order in (away, back):
            client.takes(f"axis {n + 1} on its other side", [order])
            bench.wait_until_at(order.joints, 90)
            bench.run(0.5)


@case("program-arm-side", "a pose is reached on the side of the arm that is asked for", once=True)
def _arm_side(bench: Bench) -> None:
    """Use poses with two postures of one configuration, the other one nearer."""
    geometry = bench.motion_group.kinematics
    if geometry is None or not computes(bench):
        raise NotApplicable("the driver computes no poses")
    middle = bent(bench)
    client, requested = Programmer(bench), (0.9, -middle[1], *middle[2:])
    alike = geometry.configuration(requested)
    to_pose = RawMove(RawInstruction.MOVE_J, requested, reached(bench, requested), zone=None)
    for other in geometry.solutions(geometry.forward(requested), requested):
        if distance(other, requested) < 0.1 or geometry.configuration(other) != alike:
            continue
        target = tuple(round(value, 6) for value in other)
        for path in ([RawMove(MOVE_ABSJ, target, None, zone=None)], [to_pose]):
            client.takes("another posture of the pose", path)
            bench.wait_until_at(path[0].joints, 60)
            bench.run(0.5)


@case("program-index-wraps", "more instructions than numbers", once=True)
def _index_wraps(bench: Bench) -> None:
    """Let instruction numbers wrap after the last exact integer."""
    last, client = messages.INDEX_WRAP, Programmer(bench)
    program = orders(bench, 10, random.Random(12))
    some = [replace(o, zone=None) for o in program]
    client.number += 1
    values = [*millionths(bench.position), *(w for o in some[:3] for w in o.words)]
    client.say(values, 3, BEGIN)
    bench.wait_until_at(some[2].joints, 60)
    bench.run(0.5)
    server = bench.controller.task(bench.task("ROS_motionServer"))
    motion = bench.controller.task(bench.task("ROS_motion"))
    server["ROS_motionServer:ROS_point_count"] = server["ROS_stream:accepted"] = last - 3
    motion["ROS_motion:expected_index"] = last - 2
    reply = client.say(
        [w for o in some[3:9] for w in o.words], 6, RawStreamFlag.END, first=last - 3
    )
    if not isinstance(reply, messages.RawPointsAccepted) or reply.accepted != 3:
        raise CheckFailed(f"six instructions from {last - 3} on, the reply is {reply}")
    bench.wait_until_at(some[8].joints, 60)
    bench.run(0.5)
    bench.assert_healthy()


@case("program-refused", "one wrong instruction refuses a program whole, with its index")
def _refused(bench: Bench) -> None:
    """Reject a program with one invalid instruction or start: no motion."""
    right = orders(bench, 6, random.Random(3))
    client, watcher = Programmer(bench), bench.watcher()
    for n, own in enumerate(bench.group.joints):
        for value in (own.lower - 2 * small_unit(own), own.upper + 2 * small_unit(own)):
            outside = replace(right[3], joints=changed(right[3].joints, n, value), pose=None)
            reply = client.send([*right[:3], replace(outside, kind=MOVE_ABSJ), *right[3:]])
            expected = (RawReason.JOINT_LIMIT, 3, n + 1)
            if reply[-3:] != expected:
                raise CheckFailed(f"joint {n + 1} at {value}: the reply is {reply}")
        for value in (own.lower + small_unit(own), own.upper - small_unit(own)):
            inside = replace(right[3], joints=changed(right[3].joints, n, value), pose=None)
            # The next instruction is invalid.
            after = replace(right[3], speed=0.0)
            reply = client.send([*right[:3], replace(inside, kind=MOVE_ABSJ), after])
            client.refused(reply, RawReason.BAD_SPEED, 4, f"joint {n + 1} at {value}")
    # The smallest and the widest zone; the next instruction is invalid.
    for zone in (0.0, 2 / 3):
        reply = client.send(
            [*right[:3], replace(right[3], zone=zone), replace(right[3], speed=0.0)]
        )
        client.refused(reply, RawReason.BAD_SPEED, 4, f"a zone of {zone:g} m")
    wrong: list[tuple[RawMove, RawReason]] = [
        (replace(right[3], speed=0.0), RawReason.BAD_SPEED),
        (replace(right[3], speed=-1.0), RawReason.BAD_SPEED),
        (replace(right[3], speed=2000.0), RawReason.BAD_SPEED),
        (replace(right[3], zone=-0.001), RawReason.BAD_ZONE),
        (replace(right[3], zone=1.1), RawReason.BAD_ZONE),
    ]
    for order in right:
        if order.pose is not None:
            (x, y, z), q = order.pose
            far = 1.1 * bench.config.trajectory.pose_tolerance
            away = replace(order, pose=((x, y, z + far), q))
            turned = replace(order, pose=((x, y, z), (q[1], q[0], q[3], q[2])))
            wrong += [(away, RawReason.POSE_MISMATCH), (turned, RawReason.POSE_MISMATCH)]
            for size in (0.0, 0.98, 1.02):
                a, b, c, d = (size * part for part in q)
                unlike = replace(order, pose=((x, y, z), (a, b, c, d)))
                wrong.append((unlike, RawReason.BAD_VALUE))
            circle = replace(away, kind=RawInstruction.MOVE_C, via=order.pose)
            wrong.append((circle, RawReason.POSE_MISMATCH))
            break
    for order, reason in wrong:
        reply = client.send([*right[:3], order, *right[3:]])
        client.refused(reply, reason, 3, f"a program with {order}")
    fastest = 1e-6 * round(1e6 * bench.group.tcp_speed_limit)
    wrong_too = [replace(right[3], speed=fastest + 1e-3), replace(right[3], zone=0.67)]
    for order, reason in zip(wrong_too, (RawReason.BAD_SPEED, RawReason.BAD_ZONE), strict=True):
        client.refused(client.send([*right[:3], order]), reason, 3, f"a program with {order}")
    # The maximum speed and zone: 1.5 times that is the widest radius.
    most = replace(right[3], speed=fastest, zone=2 / 3)
    reply = client.send([*right[:3], most, replace(most, speed=0.0)])
    client.refused(reply, RawReason.BAD_SPEED, 4, f"{most} is right")
    for values in ([99, 0], [0], [-1], [4096 + MOVE_ABSJ, 0], [4096]):
        client.number += 1
        start = millionths(bench.position)
        reply = client.say([*start, *values], 1, ALL)
        client.refused(reply, RawReason.NO_INSTRUCTION, 0, f"the instruction {values}")
    client.number += 1
    reply = client.say([*millionths(bench.position), MOVE_ABSJ, 0], 1, ALL)
    client.refused(reply, RawReason.FRAMING, 0, "half an instruction")
    client.number += 1
    place = millionths(bench.position)
    reply = client.say([*place, MOVE_ABSJ, *place], 1, ALL)
    client.refused(reply, RawReason.BAD_SPEED, 0, "a speed is that of a program before")
    client.number += 1
    with_speed = [MOVE_ABSJ | messages.RawModal.SPEED, *millionths(right[0].speeds)]
    reply = client.say([*place, *with_speed, *place], 1, ALL)
    client.refused(reply, RawReason.BAD_ZONE, 0, "a zone is that of a program before")
    client.number += 1
    reply = client.say([*millionths(bench.position), *right[0].words, 0], 1, ALL)
    client.refused(reply, RawReason.FRAMING, 1, "a word too many")
    for n, own in enumerate(bench.group.joints):
        target = changed(bench.position, n, inward(own, bench.position[n], 0.1))
        reply = client.send(right, start=target)
        if reply[-3:] != (RawReason.START_TOO_FAR, 0, n + 1):
            raise CheckFailed(f"another beginning for joint {n + 1}, the reply is {reply}")
    many = [right[0]] * (bench.config.trajectory.ring + 3)
    reply = client.send(many)
    if not isinstance(reply, messages.RawPointsRefused) or reply.reason != RawReason.OVERRUN:
        raise CheckFailed(f"more instructions than the ring holds: the reply is {reply}")
    if bench.motion_group.kinematics is not None and not computes(bench):
        pose = reached(bench, right[3].joints)
        unknown_pose = replace(right[3], kind=RawInstruction.MOVE_L, pose=pose)
        reply = client.send([*right[:3], unknown_pose])
        client.refused(reply, RawReason.NO_GEOMETRY, 3, "a pose with unknown joints")
    bench.assert_at_rest(1, "no program was right")
    reply = bench.progress(watcher)
    if (reply.state, reply.planned) != (RawTrajectoryState.REFUSED, 0):
        raise CheckFailed(f"a program was refused, PROGRESS says {reply}")
    client.takes("a right program", right)
    bench.wait_until_at(right[-1].joints, 60)


@case("program-stream", "a program that comes while the robot moves is executed up to a fault")
def _stream(bench: Bench) -> None:
    """Cut a stream at an invalid instruction.

    Earlier ones are executed, the last as a stop point.
    """
    watcher, client = bench.watcher(), Programmer(bench)
    program = orders(bench, 16, random.Random(11))
    client.number += 1
    some = [*millionths(bench.position), *(word for o in program[:8] for word in o.words)]
    reply = client.say(some, 8, BEGIN)
    if not isinstance(reply, messages.RawPointsAccepted):
        raise CheckFailed(f"the first instructions are right, the reply is {reply}")
    bench.wait_until_moving()
    wrong = replace(program[12], speed=0.0)
    remaining = [word for o in (*program[8:12], wrong, *program[13:]) for word in o.words]
    reply = client.say(remaining, 8, messages.RawStreamFlag.END, first=8)
    client.refused(reply, RawReason.BAD_SPEED, 12, "a wrong speed in the middle")
    bench.wait_until_at(program[11].joints, 90)
    bench.run(0.5)
    seen = bench.progress(watcher)
    expected = (RawTrajectoryState.FAILED, 12, RawReason.BAD_SPEED)
    if (seen.state, seen.reached, seen.reason) != expected:
        raise CheckFailed(f"a program was cut after 12 instructions, PROGRESS says {seen}")
    bench.assert_at_rest(1, "a program was cut")


@case("program-halves", "a trajectory ends a program, and a program a trajectory")
def _superseded(bench: Bench) -> None:
    """Replace a program by something newer: none of it executes later."""
    client, watcher = Programmer(bench), bench.watcher()
    program = orders(bench, 5, random.Random(2))
    client.takes("a program", program)
    bench.wait_until_moving()
    bench.run(0.3)
    client.link.send(bench.download(bench.wave(4)))
    over = (RawTrajectoryState.DONE, RawTrajectoryState.REFUSED)
    for _ in range(200):
        answer = bench.progress(watcher)
        if answer.trajectory == 2 and answer.state in over:
            break
    else:
        raise CheckFailed(f"a trajectory has come into a program, PROGRESS says {answer}")
    bench.assert_at_rest(1, "the program has ended")
    points = bench.wave(20)
    bench.start_motion(client.link, points, 0.5)
    reply = client.send(program)
    if isinstance(reply, messages.RawPointsRefused):
        # It started at the robot's position when it was sent.
        client.refused(reply, RawReason.START_TOO_FAR, 0, "a program into a trajectory")
        bench.wait_until_at_rest(5, 1, "neither is under way")
        client.takes("a program", program)
    bench.wait_until_at(program[-1].joints, 60)


@case("program-waits", "a wait between moves, which STOP ends")
def _waits(bench: Bench) -> None:
    """Wait after a stop point, whatever the zone; reject invalid waits."""
    client = Programmer(bench)
    first, *_, last = orders(bench, 6, random.Random(4))
    target = replace(last, kind=MOVE_ABSJ, pose=None, zone=0.01)

    def sends(seconds: float) -> messages.RawContent:
        client.number += 1
        wait = [int(RawInstruction.WAIT), *millionths([seconds])]
        values = [*millionths(bench.position), *target.words, *wait, *first.words]
        return client.say(values, 3, ALL)

    def comes_by() -> bool:
        return distance(bench.position, target.joints) < SETTLED

    for seconds in (1.5, 0.5, 0.0):
        if not isinstance(sends(seconds), messages.RawPointsAccepted):
            raise CheckFailed(f"a program with a wait of {seconds} s is refused")
        if seconds:
            bench.wait_until_at(target.joints, 60)
        else:  # Axes that lag move on before they rest.
            bench.until(comes_by, 60, "the robot comes by the point before the wait")
        bench.assert_at_rest(0.8 * seconds, "the program waits")
        bench.wait_until_at(first.joints, 60)
    corners_made(bench)
    for seconds in (-1.0, 2001.0):
        client.refused(sends(seconds), RawReason.BAD_VALUE, 1, f"a wait of {seconds} s")
    # The longest wait.
    sends(2000.0)
    bench.wait_until_at(target.joints, 60)
    bench.run(0.5)
    client.link.stop()
    bench.assert_at_rest(2, "STOP has ended a wait")
    for values, reason in (
        ([1024 + MOVE_ABSJ, *millionths([99.0, 0.0])], RawReason.NO_FRAME),
        ([1024 + MOVE_ABSJ, *millionths([0.0, 0.5])], RawReason.NO_FRAME),
        ([int(RawInstruction.SET), *millionths([99.0, 0.0])], None),
        ([12, 0], RawReason.NO_INSTRUCTION),
    ):
        client.number += 1
        start = millionths(bench.position)
        reply = client.say([*start, *values, *start], 1, ALL)
        if not isinstance(reply, messages.RawPointsRefused) or reply.point != 0:
            raise CheckFailed(f"the instruction {values} is answered by {reply}")
        if reason is not None:
            client.refused(reply, reason, 0, f"the instruction {values}")
    bench.assert_at_rest(1, "no instruction was right")


def corners_made(bench: Bench) -> None:
    """Check that no corner lacked its next move: a stop point was due."""
    failed = [event for event in bench.controller.log if event.code == CORNER_FAILURE]
    if failed:
        raise CheckFailed(f"the robot was to stop where it passes: {failed[0]}")


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
    link.send(words_frame(1, 0, 1, [*place, MOVE_ABSJ, *place], ALL, number=PROGRAM))
    if not isinstance(link.reply(PROGRAM), messages.RawFailure):
        raise CheckFailed("a driver of the basic profile takes a program")
    bench.assert_at_rest(1, "nothing was taken")

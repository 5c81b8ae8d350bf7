"""Messages to a paired client on the state port: HELLO and PROGRESS."""

import struct
from itertools import pairwise

from rapidgen import __version__
from rapidgen.client.core.group import Group
from rapidgen.generate.hello_reply import features
from rapidgen.verification import batches, messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.messages import RawComm, RawFeature, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.testbench import HELLO, Bench

case = SuiteGroup("paired")


def _float32(value: float) -> float:
    return float(struct.unpack("<f", struct.pack("<f", value))[0])


def _padded(values: list[float]) -> tuple[float, ...]:
    return tuple(_float32(v) for v in (*values, *[0.0] * (messages.MAX_JOINTS - len(values))))


@case("hello", "HELLO tells limits and capacities as they were configured")
def _hello_tells_all(bench: Bench) -> None:
    link = bench.state()
    reply = bench.send_hello(link)
    joints, policy = bench.group.joints, bench.config.trajectory
    expected: dict[str, object] = {
        "protocol": messages.PROTOCOL_VERSION,
        "driver": tuple(int(part) for part in __version__.split(".")[:3]),
        "build_id": bench.system.build_id,
        "mapping": Group.of(bench.config, bench.group).mapping,
        "capacity": policy.capacity,
        "joint_count": len(joints),
        "prismatic": sum(1 << i for i, j in enumerate(joints) if j.kind == "prismatic"),
        "state_period": _float32(bench.config.state_period),
        "min_segment": _float32(policy.min_segment),
        "start_tolerance": _float32(policy.start_tolerance),
        "start_tolerance_linear": _float32(policy.start_tolerance_linear),
        "lower": _padded([j.lower for j in joints]),
        "upper": _padded([j.upper for j in joints]),
        "speed": _padded([j.speed for j in joints]),
        "features": int(features(bench.config, bench.group)),
        "control_port": bench.group.ports.control,
        "ring": policy.ring - 1 if bench.streams else 0,
        "preload": _float32(policy.preload if bench.streams else 0.0),
        "batch": batches.batch_points(len(joints)) if bench.streams else 0,
        "signals": len(bench.config.signals) if bench.group.ports.control else 0,
    }
    for name, value in expected.items():
        if not _same(getattr(reply, name), value):
            raise CheckFailed(
                f"HELLO tells {name} {getattr(reply, name)}, the configuration {value}"
            )
    if RawFeature.PROGRESS not in RawFeature(reply.features):
        raise CheckFailed("HELLO does not promise PROGRESS")
    progress = bench.progress(link)
    if progress.state not in (RawTrajectoryState.NONE, RawTrajectoryState.DONE):
        raise CheckFailed(f"a driver that was never asked for anything tells {progress}")


def _same(reply: object, expected: object) -> bool:
    """True if equal within the last digits of RAPID's number texts."""
    if isinstance(reply, tuple) and isinstance(expected, tuple):
        return len(reply) == len(expected) and all(map(_same, reply, expected))
    if isinstance(reply, float) and isinstance(expected, float):
        return abs(reply - expected) <= 1e-6 * max(1.0, abs(expected))
    return reply == expected


@case("hello-versions", "a HELLO of another version is refused, PROGRESS only where asked for")
def _other_versions(bench: Bench) -> None:
    link = bench.state()
    older = HELLO._replace(protocol=messages.PROTOCOL_VERSION - 1)
    for _ in range(3):
        link.send(messages.encode(older, RawComm.REQUEST))
        reply = link.expect(messages.RawHelloRefusal, 2, "an older HELLO is answered")
        if reply.protocol != messages.PROTOCOL_VERSION:
            raise CheckFailed(f"an older HELLO is answered by version {reply.protocol}")
    bench.run(1)
    log_entries = [e for e in bench.controller.log if "another version was refused" in str(e)]
    if len(log_entries) != 1 or f"has version {older.protocol}," not in " ".join(
        log_entries[0].texts
    ):
        raise CheckFailed(
            f"a client of version {older.protocol} was refused, the event log says {log_entries}"
        )
    if any(f.number == messages.PROGRESS for f in link.read()):
        raise CheckFailed("PROGRESS comes although HELLO was refused")
    link.send(messages.encode(HELLO._replace(subscribe=2), RawComm.REQUEST))
    link.expect(messages.RawHelloReply, 2, "the next HELLO on the same link is answered")
    bench.run(1)
    if any(f.number == messages.PROGRESS for f in link.read()):
        raise CheckFailed("PROGRESS comes although it was not asked for")


@case("hello-in-pieces", "a HELLO in pieces is answered", "R2")
def _hello_in_pieces(bench: Bench) -> None:
    link = bench.state()
    data = messages.encode(HELLO, RawComm.REQUEST)
    for size in (1, 3, len(data) - 5):
        link.send(data[:size])
        data = data[size:]
        bench.run(0.4)
    link.send(data)
    link.expect(messages.RawHelloReply, 2, "a HELLO in pieces is answered")


@case("state-port-junk", "what is no HELLO breaks that link and no other")
def _state_port_takes_nothing_else(bench: Bench) -> None:
    good = messages.encode(HELLO, RawComm.REQUEST)
    values = struct.unpack(f"<{len(good) // 4}i", good)
    wrong = {
        "another length": (values[0] - 1, *values[1:]),
        "another type": (values[0], messages.PING, *values[2:]),
        "a topic": (*values[:2], 1, *values[3:]),
        "a reply": (*values[:2], 3, *values[3:]),
    }
    messages_of = {name: struct.pack(f"<{len(w)}i", *w) for name, w in wrong.items()}
    messages_of["a byte too many"] = good + b"\0"
    messages_of["two at once"] = good + good
    messages_of["garbage"] = b"\xff" * len(good)
    for name, data in messages_of.items():
        link = bench.state()
        bench.status(link)
        link.send(data)
        link.wait_disconnected(3, f"HELLO as {name} breaks the link")
        bench.status(bench.state(), 5)
        bench.run(0.5)


def _straight(bench: Bench, count: int, duration: float = 0.3) -> list[Point]:
    """Return points at equal distances on a straight line from here."""
    points = bench.wave(2, duration=0.3)
    start, end = points[0][0], points[1][0]
    return [
        (
            tuple(a + (b - a) * n / (count - 1) for a, b in zip(start, end, strict=True)),
            duration if n else 10.0,
        )
        for n in range(count)
    ]


def _passed(bench: Bench, points: list[Point]) -> float:
    """Return how many points on a straight line the robot has passed."""
    start, end = points[0][0], points[-1][0]
    axis = max(range(len(start)), key=lambda i: abs(end[i] - start[i]))
    share = (bench.position[axis] - start[axis]) / (end[axis] - start[axis])
    return 1 + share * (len(points) - 1)


def _newest(bench: Bench, link: RawLink) -> messages.RawProgress:
    bench.run(2 * bench.config.state_period)
    return bench.progress(link)


@case("progress", "PROGRESS counts points received, planned and reached")
def _progress_tells_the_way(bench: Bench) -> None:
    link, motion = bench.watcher(), bench.motion()
    before = bench.progress(link).trajectory
    for number in range(1, 3):
        points = _straight(bench, 12)
        bench.start_motion(motion, points, bench.config.state_period)
        reply: list[messages.RawProgress] = []
        while not reply or reply[-1].state != RawTrajectoryState.DONE:
            reply.append(bench.progress(link))
            _is_consistent(reply[-1], before + number, len(points))
            passed = _passed(bench, points)
            # A point counts when its successor is planned: late, never early.
            if reply[-1].state == RawTrajectoryState.MOVING and not (
                passed - 4 <= reply[-1].reached <= passed + 0.5
            ):
                raise CheckFailed(f"the robot has passed {passed:.1f} points, {reply[-1]}")
            if len(reply) > 100:
                raise CheckFailed(f"the trajectory does not end: {reply[-1]}")
        counts = [(t.received, t.planned, t.reached) for t in reply]
        if any(a > b for one, two in pairwise(counts) for a, b in zip(one, two, strict=True)):
            raise CheckFailed(f"counts of PROGRESS go back: {counts}")
        if reply[-1] != (before + number, RawTrajectoryState.DONE, 12, 12, 12, 0, -1, 0):
            raise CheckFailed(f"a trajectory of 12 points is done, PROGRESS says {reply[-1]}")
        seen = {t.state for t in reply}
        if RawTrajectoryState.MOVING not in seen:
            raise CheckFailed("no PROGRESS says that the robot is moving")
        bench.run(0.5)


def _is_consistent(reply: messages.RawProgress, number: int, count: int) -> None:
    fine = (
        reply.trajectory == number
        and reply.state
        in (RawTrajectoryState.RECEIVING, RawTrajectoryState.MOVING, RawTrajectoryState.DONE)
        and 0 <= reply.reached <= reply.planned <= reply.received <= count
        and (reply.reason, reply.point, reply.joint) == (0, -1, 0)
    )
    if not fine:
        raise CheckFailed(
            f"trajectory {number} of {count} points is under way, PROGRESS says {reply}"
        )


@case("progress-download", "PROGRESS of a download and its STOP")
def _progress_of_a_download(bench: Bench) -> None:
    link, motion = bench.watcher(), bench.motion()
    frames = bench.download(bench.wave(6))
    size = messages.POINT_BYTES
    for sent in range(1, 5):
        motion.send(frames[(sent - 1) * size : sent * size])
        reply = _newest(bench, link)
        if reply[1:] != (RawTrajectoryState.RECEIVING, sent, 0, 0, 0, -1, 0):
            raise CheckFailed(f"{sent} points were sent, PROGRESS says {reply}")
    motion.stop(1)
    reply = _newest(bench, link)
    if (reply.state, reply.reason) != (RawTrajectoryState.STOPPED, RawReason.STOPPED):
        raise CheckFailed(f"a download was stopped, PROGRESS says {reply}")
    if bench.status(link).in_error:
        raise CheckFailed("a download that was stopped is an error in STATUS")


@case("progress-refused", "PROGRESS of a refusal: reason, point, joint", "R1, R10")
def _progress_of_a_refusal(bench: Bench) -> None:
    link, motion = bench.watcher(), bench.motion()
    points = [(p, 30.0) for p, _ in bench.wave(6)]
    high = bench.group.joints[1].upper + 0.5
    points[3] = ((points[3][0][0], high, *points[3][0][2:]), 30.0)
    motion.send(bench.download(points))
    reply = _newest(bench, link)
    if reply[1:] != (RawTrajectoryState.REFUSED, 3, 0, 0, RawReason.JOINT_LIMIT, 3, 2):
        raise CheckFailed(f"point 3 was refused for joint 2, PROGRESS says {reply}")
    status = bench.status(link)
    if (status.in_error, status.error_code) != (1, 204):
        raise CheckFailed(f"point 3 was refused for joint 2, STATUS says {status}")
    motion.stop(1)
    reply, status = _newest(bench, link), bench.status(link)
    if (reply.state, status.in_error, status.error_code) != (RawTrajectoryState.STOPPED, 0, 0):
        raise CheckFailed(f"STOP ends the report of a refusal, but {reply}, {status}")


@case(
    "progress-ended",
    "PROGRESS of a trajectory that ended early: why and where",
    "R11, R14",
    background=True,
)
def _progress_of_an_early_end(bench: Bench) -> None:
    """Report each early end by its own reason and position."""
    stopped = (RawReason.MOTORS_OFF, RawReason.PROGRAM_STOPPED)
    for action, state, reasons in (
        ("STOP", RawTrajectoryState.STOPPED, (RawReason.STOPPED,)),
        # One stop comes with the next: the first one seen counts.
        ("e-stop", RawTrajectoryState.FAILED, (RawReason.EMERGENCY_STOP, *stopped)),
        ("motors-off", RawTrajectoryState.FAILED, stopped),
        ("stop", RawTrajectoryState.FAILED, (RawReason.PROGRAM_STOPPED,)),
        ("leaves", RawTrajectoryState.FAILED, (RawReason.CLIENT_LOST,)),
    ):
        link, motion = bench.watcher(), bench.motion()
        points = _straight(bench, 16)
        bench.start_motion(motion, points, 1.5)
        if action == "STOP":
            motion.send(STOP)
        elif action == "leaves":
            motion.close()
        else:
            bench.controller.perform(action)
        bench.wait_until_standing(5)
        reply, passed = _newest(bench, link), _passed(bench, points)
        if reply.state != state or reply.reason not in reasons or reply.joint:
            raise CheckFailed(f"a trajectory was ended by {action}, PROGRESS says {reply}")
        if reply.point != reply.reached or not passed - 4 <= reply.reached <= passed + 0.5:
            raise CheckFailed(f"{action} after {passed:.1f} points, PROGRESS says {reply}")
        status = bench.status(link)
        failed = state is RawTrajectoryState.FAILED
        if (status.in_error, status.error_code) != ((1, reply.reason) if failed else (0, 0)):
            raise CheckFailed(f"a trajectory was ended by {action}, STATUS says {status}")
        if status.in_motion:
            raise CheckFailed(f"the robot is at rest after {action}, STATUS says {status}")
        bench.start_again()
        bench.run(1)
        link.close()
        motion.close(then=1.5)


@case("progress-superseded", "PROGRESS is of the newest trajectory")
def _progress_of_a_successor(bench: Bench) -> None:
    link, motion = bench.watcher(), bench.motion()
    bench.start_motion(motion, bench.wave(30), 0.5)
    number = bench.progress(link).trajectory
    motion.send(bench.download(bench.wave(4))[:68])
    reply = _newest(bench, link)
    if reply[:3] != (number + 1, RawTrajectoryState.RECEIVING, 1):
        raise CheckFailed(f"a new trajectory has started, PROGRESS says {reply}")
    bench.wait_until_standing(2)
    link.read()
    bench.run(1)
    states = {
        content.state
        for frame in link.read()
        if isinstance(content := messages.decode(frame), messages.RawProgress)
    }
    if states != {RawTrajectoryState.RECEIVING}:
        raise CheckFailed(f"half a trajectory was received, PROGRESS says {states}")


@case("progress-in-between", "PROGRESS while another task writes what it tells")
def _progress_in_between(bench: Bench) -> None:
    """Report two numbers of another task together.

    PROGRESS reports the newer trajectory or none.
    """
    link, motion = bench.watcher(), bench.motion()
    points = [(p, 30.0) for p, _ in bench.wave(4)]
    far = (bench.group.joints[0].upper + 0.5, *points[2][0][1:])
    points[2] = (far, 30.0)
    motion.send(bench.download(points))
    reply = _newest(bench, link)
    refusal = (RawTrajectoryState.REFUSED, 2, 0, 0, RawReason.JOINT_LIMIT, 2, 1)
    if reply[1:] != refusal:
        raise CheckFailed(f"point 2 was refused for joint 1, PROGRESS says {reply}")
    # A trajectory starts: only its number is known.
    task = bench.controller.task(bench.task("ROS_motionServer"))
    declared = task.rapid.program.modules["ros_common"].declarations
    names = {key.rstrip("_0123456789"): f"ROS_common:{key}" for key in declared}
    task[names["ros_trajectory"]] = reply.trajectory + 1
    between = _newest(bench, link)
    if between != (reply.trajectory + 1, RawTrajectoryState.RECEIVING, 0, 0, 0, 0, -1, 0):
        raise CheckFailed(f"a trajectory begins after {reply}, PROGRESS says {between}")
    task[names["ros_trajectory"]] = reply.trajectory
    # STOP resets the rejection: its code is written before its state.
    task[names["ros_refusal_code"]] = RawReason.STOPPED
    between = _newest(bench, link)
    if between[1:] != (RawTrajectoryState.STOPPED, 2, 0, 0, RawReason.STOPPED, -1, 0):
        raise CheckFailed(f"a STOP takes back a refusal, PROGRESS says {between}")
    status = bench.status(link)
    if (status.in_error, status.error_code) != (0, 0):
        raise CheckFailed(f"a STOP takes back a refusal, STATUS says {status}")
    bench.assert_moves_through(motion, bench.wave(3))


@case("other-hellos", "a HELLO of later versions, and one that cannot be read")
def _other_hellos(bench: Bench) -> None:
    """Send HELLO of a newer client, with unknown features, and a bad one."""
    link, later = bench.state(), 1 << 20
    newer = HELLO._replace(protocol=messages.PROTOCOL_VERSION + 1, subscribe=later | 1)
    link.send(messages.encode(newer, RawComm.REQUEST))
    link.expect(messages.RawHelloReply, 2, "a newer HELLO is answered")
    bench.progress(link)
    fails(bench, "ROS_stateServer", "UnpackRawBytes", "ERR_OUTOFBND")
    link.send(messages.encode(HELLO, RawComm.REQUEST))
    link.wait_disconnected(1, "a HELLO that cannot be read breaks the link")
    good = messages.encode(HELLO, RawComm.REQUEST)
    for data in (good + b"\0", good[:8] + b"\3" + good[9:], b"\x21" + good[1:]):
        link = bench.watcher()
        link.send(data)
        link.wait_disconnected(1, "what is no HELLO breaks the link")
    bench.progress(bench.watcher())

"""Events that end or pause a program: a prefix is executed and reported."""

import random
from dataclasses import replace

from rapidgen.verification import messages
from rapidgen.verification.batches import millionths
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawInstruction, RawReason
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.raw_programs import ALL, Programmer, computes, orders, reached
from rapidgen.verification.suite.control import done, stop
from rapidgen.verification.suite.speed import aside
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")

SET = RawInstruction.SET


_ASIDE = 0.12
"""rad and m by which a zone cuts a corner, and a line bends between the joints at its ends."""


@case(
    "program-prefix",
    "what ends a program leaves a prefix of it, with index and reason",
    once=True,
    needs="control",
)
def _prefix(bench: Bench) -> None:
    """End a program by STOP, disconnection, emergency stop and program stop."""
    control, watcher = bench.control(), bench.watcher()
    chance = random.Random(5)
    for ending in _endings(bench):
        for at in range(6):
            program = orders(bench, 7, chance)
            client = Programmer(bench)
            start, since = bench.position, bench.now
            client.takes("a program", program)
            _ended(client, control, watcher, ending, at, len(program))
            bench.assert_at_rest(1, f"{ending} has ended a program")
            bench.start_again()
            bench.assert_at_rest(2, f"{ending} has ended a program")
            if ending != "e-stop":
                bench.followed([start, *(o.joints for o in program)], since=since, corner=_ASIDE)
            client.link.close(then=1.5)


@case(
    "program-prefix-kinds",
    "what ends a program leaves a prefix of it, at whatever instruction",
    once=True,
    needs="control",
)
def _kinds(bench: Bench) -> None:
    """End programs with all instruction kinds."""
    control, watcher, chance = bench.control(), bench.watcher(), random.Random(6)
    outputs = [s.name for s in bench.config.signals if (s.kind, s.access) == ("DO", "write")]
    for ending in _endings(bench):
        for at in range(1, 30):
            program, sets = _all_kinds(bench, chance)
            if at > len(program) - 2:
                break  # The last one is reached when all are.
            for name in outputs[:1]:
                bench.controller.signals[name] = 0
            client = Programmer(bench)
            client.number += 1
            values = [*millionths(bench.position), *(w for part in program for w in part)]
            reply = client.say(values, len(program), ALL)
            if not isinstance(reply, messages.RawPointsAccepted):
                raise CheckFailed(f"a program of all kinds is right, the reply is {reply}")
            seen = _ended(client, control, watcher, ending, at, len(program))
            bench.start_again()
            bench.assert_at_rest(1, f"{ending} has ended a program")
            for name in outputs[:1]:
                value = bench.controller.signals[name]
                if value != (seen.reached > sets) and not seen.reached <= sets < seen.planned:
                    raise CheckFailed(
                        f"{ending} after {seen.reached}: {name}, set by {sets}, is {value}"
                    )
            client.link.close(then=1.5)


def _all_kinds(bench: Bench, chance: random.Random) -> tuple[list[list[int]], int]:
    """Return words of one instruction each, and the one that sets a signal.

    A move comes first and last.
    """
    first, *some, last = orders(bench, 6, chance)
    exposed = bench.config.signals
    parts = [first.words, [RawInstruction.WAIT, *millionths([0.1])]]
    sets = next((n for n, s in enumerate(exposed) if (s.kind, s.access) == ("DO", "write")), -1)
    if computes(bench):
        frame = [0.0, 0.0, 0.1, 1.0, 0.0, 0.0, 0.0]
        parts += [
            [RawInstruction.SETTINGS, *millionths([3.0])],
            [RawInstruction.TOOL, *millionths([*frame, *frame, 1.0, 0.0, 0.0, 0.0])],
            [RawInstruction.WORK_OBJECT, *millionths([*frame, *frame])],
        ]
        before, pose = (reached(bench, order.joints) for order in some[:2])
        # So flat that it does not tilt the tool out of a SCARA's reach.
        via = aside(before, pose, 0.05)
        circle = replace(some[1], kind=RawInstruction.MOVE_C, pose=pose, via=via)
        parts += [replace(some[0], zone=None).words, circle.words]
    if sets >= 0:
        parts += [[SET, *millionths([float(sets), 1.0])]]
        parts += [[RawInstruction.WAIT_SIGNAL, *millionths([float(sets), 1.0, 5.0])]]
    parts += [some[2].words, some[3].words, last.words]
    return parts, len(parts) - 5 if sets >= 0 else len(parts)


def _reaches(bench: Bench, watcher: RawLink, at: int) -> None:
    """Let time pass until the robot is past so many instructions."""
    bench.wait_until_moving()
    for _ in range(600):
        if bench.progress(watcher).reached >= at:
            return
    raise CheckFailed(f"{at} instructions are not reached")


_ENDINGS = {
    "STOP": RawReason.STOPPED,
    "STOP on the control port": RawReason.STOPPED,
    "a cut connection": RawReason.CLIENT_LOST,
    "e-stop": RawReason.EMERGENCY_STOP,
    "stop": RawReason.PROGRAM_STOPPED,
    "a pause and STOP": RawReason.STOPPED,
}


def _endings(bench: Bench) -> list[str]:
    """Return the reported endings.

    Servers of a driver in commissioning stop with the program.
    """
    unreported = ("e-stop", "stop") if bench.config.commissioning else ()
    return [ending for ending in _ENDINGS if ending not in unreported]


def _ended(
    client: Programmer, control: RawLink, watcher: RawLink, ending: str, at: int, length: int
) -> messages.RawProgress:
    """End a program after an instruction; return the following PROGRESS."""
    bench = client.bench
    _reaches(bench, watcher, at)
    _end(bench, client, control, ending)
    bench.wait_until_standing(10)
    bench.run(0.5)
    reply = bench.progress(watcher)
    if reply.reason != _ENDINGS[ending] or not at <= reply.reached < length:
        raise CheckFailed(f"{ending} after instruction {at}: PROGRESS says {reply}")
    return reply


def _end(bench: Bench, client: Programmer, control: RawLink, ending: str) -> None:
    if ending == "STOP":
        client.link.stop()
    elif ending == "STOP on the control port":
        stop(control)
    elif ending == "a cut connection":
        client.link.close(abort=True)
    elif ending == "a pause and STOP":
        done(control.ask(messages.RawPause(1)), "PAUSE")
        bench.wait_until_standing(3)
        client.link.stop()
    else:
        bench.controller.perform(ending)


@case("program-paused", "a paused program goes on where it was", needs="control")
def _paused(bench: Bench) -> None:
    """Pause a program and resume it to its end, on its path."""
    control, watcher, client = bench.control(), bench.watcher(), Programmer(bench)
    program, start, since = orders(bench, 4, random.Random(9)), bench.position, bench.now
    client.takes("a program", program)
    for at in (0, 1):
        _reaches(bench, watcher, at)
        done(control.ask(messages.RawPause(1)), "PAUSE")
        bench.wait_until_at_rest(3, 1, "a program is paused")
        done(control.ask(messages.RawPause(0)), "the end of PAUSE")
    bench.wait_until_at(program[-1].joints, 60)
    bench.followed([start, *(o.joints for o in program)], since=since, corner=_ASIDE)

"""Circles of programs: degenerate points or too large angles are rejected."""

import math
import random
from collections.abc import Iterator
from dataclasses import replace

from rapidgen.axes import frames
from rapidgen.axes.frames import Vector
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawInstruction, RawReason
from rapidgen.verification.model import NotApplicable
from rapidgen.verification.raw_programs import (
    BEGIN,
    END,
    Programmer,
    RawMove,
    computes,
    orders,
    reached,
)
from rapidgen.verification.suite.program_frames import object_of, placement_of, says
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")

_CHORD_BY_HEIGHT = {
    degrees: 2 * math.tan(math.radians((360 - degrees) / 4)) for degrees in (239, 241)
}
"""Values for a circle that turns too far: its ends and midpoint are closer than allowed."""


@case("program-circles", "three points that make no circle, or too much of one, are refused")
def _circles(bench: Bench) -> None:
    """Check circles from the start, after a move, and across batches.

    Source: [REF MoveC, Limitations].
    """
    if not computes(bench):
        raise NotApplicable("the driver computes no poses")
    client = Programmer(bench)
    result = orders(bench, 3, random.Random(71))
    one, two, three = (replace(o, kind=RawInstruction.MOVE_ABSJ, pose=None) for o in result)
    client.takes("a program", [replace(one, zone=None)])
    bench.wait_until_at(one.joints, 60)
    bench.run(0.5)
    # If the circle is valid nothing moves, because the next instruction is invalid.
    wrong = replace(two, speed=0.0)
    line = replace(one, kind=RawInstruction.MOVE_L, pose=reached(bench, one.joints))
    for before, start in (((), one), ((two, three), three), ((three, line), line)):
        for right, why, circle in _with_end(bench, start, two):
            reply = client.send([*before, circle, wrong])
            reason = RawReason.BAD_SPEED if right else RawReason.NO_CIRCLE
            client.refused(reply, reason, len(before) + right, why)
    _in_other_frames(bench, client, two, three)
    bench.assert_at_rest(0.5, "no program was right")
    client.takes("a move, something follows", [replace(two, zone=None)], BEGIN)
    bench.wait_until_at(two.joints, 60)
    *_, (_, why, circle) = _with_end(bench, two, three)
    reply = client.say(circle.words, 1, END, first=1)
    client.refused(reply, RawReason.NO_CIRCLE, 1, f"in the next batch {why}")
    bench.assert_at_rest(0.5, "no circle was right")


def _in_other_frames(bench: Bench, client: Programmer, start: RawMove, end: RawMove) -> None:
    """Change the work object: the pose before a circle changes with it."""
    given = object_of(0.1)
    frame, first = placement_of(given[1]), bench.group.work_object.user_frame
    origin = frames.compose(
        frames.invert((frame.position, frame.orientation)), (first.position, first.orientation)
    )
    before = replace(start, kind=RawInstruction.MOVE_L, pose=reached(bench, start.joints))
    own = 0, 1 + len(bench.group.work_objects)
    *_, (_, _, short), (_, _, long) = _with_end(bench, start, end)
    for circle, reason in ((short, RawReason.BAD_SPEED), (long, RawReason.NO_CIRCLE)):
        assert circle.pose is not None
        assert circle.via is not None
        pose, via = (frames.compose(origin, place) for place in (circle.pose, circle.via))
        seen = replace(circle, pose=pose, via=via, frames=own)
        reply = says(client, replace(before, frames=(0, 0)), given, seen, replace(end, speed=0.0))
        index = 3 if reason is RawReason.BAD_SPEED else 2
        client.refused(reply, reason, index, "a circle in another work object")


def _with_end(bench: Bench, start: RawMove, end: RawMove) -> Iterator[tuple[bool, str, RawMove]]:
    """Yield circles between two moves: valid or not, label, circle."""
    first, last = reached(bench, start.joints)[0], reached(bench, end.joints)[0]
    path = frames.subtract(last, first)
    chord = frames.norm(path)
    along = frames.unit(path)
    # Any direction across it.
    across = frames.unit(
        frames.cross(along, (0.0, 0.0, 1.0) if abs(along[2]) < 0.9 else (1.0, 0.0, 0.0))
    )

    def at(share: float, height: float) -> RawMove:
        via = frames.add(frames.scale(path, share), frames.scale(across, height))
        return _circle(bench, start, end, via)

    yield True, "half a circle", at(0.5, chord / 2)
    for far in (0.09e-3, 0.11e-3):
        yield far > 1e-4, f"a point {far} m from the beginning", at(0.0, far)
    # A point so close to the end is nearly on a line, too.
    for far in (0.09e-3, 0.018 * chord):
        yield far > 1e-4, f"a point {far} m from the end", at(1.0, far)
    for angle in (0.98, 1.02):
        height = chord / 2 * math.tan(math.radians(angle))
        yield angle > 1, f"two points seen {angle} degrees apart", at(0.5, height)
    yield False, "a point of the line, beyond its end", at(1.5, 0.0)
    yield (
        False,
        "a circle that ends where it begins",
        _circle(bench, start, start, (0.0, 0.0, 0.05)),
    )
    for degrees, ratio in _CHORD_BY_HEIGHT.items():
        yield degrees <= 240, f"{degrees} degrees", at(0.5, chord / ratio)


def _circle(bench: Bench, start: RawMove, end: RawMove, via: Vector) -> RawMove:
    """Return a circle to the end of `end`.

    `via` is relative to the end of `start`.
    """
    place, turned = reached(bench, start.joints)
    return replace(
        end,
        kind=RawInstruction.MOVE_C,
        pose=reached(bench, end.joints),
        via=(frames.add(place, via), turned),
    )

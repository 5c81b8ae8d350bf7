"""Brake stops at full speed: the robot rests off its path, and recovers."""

from dataclasses import replace
from functools import partial

from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point, Position
from rapidgen.verification.testbench import CEILING, Bench

case = SuiteGroup("off the path")

_FAST = 0.8
"""Share of an axis' speed at which the stop occurs."""
STAYS_STOPPED = "ROS: the robot stays stopped"
"""Title of the event with the reason."""


def _zigzag(bench: Bench, count: int, seconds: float) -> list[Point]:
    """Return points with axes near full speed, every other one reversed.

    In `seconds`, or in less if no axis has such a long way.
    """
    ranges = [(joint.upper - joint.lower, joint.speed) for joint in bench.group.joints]
    seconds = min(seconds, max(0.7 * wide / (0.95 * speed) for wide, speed in ranges))

    def corner(odd: int) -> Position:
        failures = []
        for number, joint in enumerate(bench.group.joints):
            wide = min(0.7 * (joint.upper - joint.lower), 0.95 * joint.speed * seconds)
            away = wide / 2 if (odd + number) % 2 else -wide / 2
            failures.append((joint.upper + joint.lower) / 2 + away)
        return tuple(failures)

    # Both before `seconds` changes: with a TCP speed limit the motion takes longer, and goes no
    # further.
    ends = corner(0), corner(1)
    seconds = max(seconds, 1.1 * bench.tcp_seconds(*ends))
    return [(ends[number % 2], seconds) for number in range(count)]


def _speed(bench: Bench) -> float:
    """Return the largest current axis speed as a share of its limit."""
    (since, before), (now, current) = bench.track[-2:]
    if now == since or bench.now - now > 0.01:
        return 0.0
    joints = zip(bench.group.joints, before, current, strict=True)
    return max(abs(b - a) / (now - since) / joint.speed for joint, a, b in joints)


def _stopped_at_speed(bench: Bench, action: str, quick: float, seconds: float) -> float:
    """Stop while an axis is fast; return the distance (m) from the path."""
    motion = replace(bench.setting.motion, quick_factor=quick)
    with bench.second_controller(
        bench.system, setting=replace(bench.setting, motion=motion)
    ) as other:
        link = other.motion()
        path = _zigzag(other, 6, seconds)
        to_it = 2 * other.seconds_to(path[0][0])
        link.send(other.download([(other.position, 10.0), (path[0][0], to_it)]))
        other.wait_until_at(path[0][0], 2 * to_it + 5)
        other.run(0.3 + 2 * motion.settle)
        other.start_motion(link, [(other.position, 10.0), *path[1:]])
        if path[0][1] > seconds:
            # A TCP speed limit slows down the axes; in the middle they are fastest.
            other.run(0.5 * path[0][1])
        else:
            other.until(lambda: _speed(other) >= _FAST, 5, f"an axis runs at {_FAST:.0%}")
        last = other.last_event
        other.controller.perform(action)
        other.wait_until_standing(20)
        other.run(1)
        off, _ = other.motion_group.off_path
        other.start_again()
        if other.controller.task(other.group.task).state != "running":
            # Too far off to start from the previous position of the program.
            if off <= motion.regain_distance:
                raise CheckFailed(
                    f"{1000 * off:.0f} mm off its path after {action} no program starts"
                )
            other.controller.perform("pp-to-main")
            other.start_again()
        reply = f"after {action} at speed, {1000 * off:.0f} mm off the path"
        other.assert_at_rest(4, f"{reply}, no client asked for motion")
        log_entries = [e for e in other.controller.log.since(last) if e.title == STAYS_STOPPED]
        held = off > motion.path_distance and motion.stop_move_reset == "keeps"
        if log_entries and not held:
            raise CheckFailed(f"{reply}, the event log says {log_entries[0]}")
        if other.motion_group.stop_reasons:
            if not (held and log_entries):
                raise CheckFailed(f"{reply}, the robot is held, and the event log does not say why")
            # The action that the event asks for.
            for step in ("stop", "pp-to-main", "start"):
                other.controller.perform(step)
        other.assert_at_rest(1, f"{reply}, no client asked for motion")
        link.close()
        other.run(1.5)
        other.assert_moves_through(other.motion(), other.wave(3))
        other.assert_healthy()
    return off


def _at_speed(bench: Bench, action: str) -> None:
    """Check that the old path is gone, and a new trajectory works."""
    result = [
        _stopped_at_speed(bench, action, quick, seconds)
        for quick, seconds in ((2.0, 0.5), (0.2, 0.5), (0.04, 0.7))
    ]
    motion = bench.setting.motion
    by_brakes = action == "power-loss" or motion.emergency_stop == "brakes"
    # If the controller forgets a cleared path, the distance is unknown. With a TCP speed limit, a
    # robot may be too slow to leave its path.
    fast = bench.group.tcp_speed_limit >= CEILING
    reply = by_brakes and fast and motion.cleared_distance == "counts"
    if reply and bench.motion_group.kinematics is not None and max(result) < 0.05:
        raise CheckFailed(
            f"the robot never was far from its path: {[f'{d:.3f} m' for d in result]}"
        )


case("e-stop-at-speed", "an emergency stop at full speed")(partial(_at_speed, action="e-stop"))
case("power-loss-at-speed", "a power failure at full speed")(
    partial(_at_speed, action="power-loss")
)

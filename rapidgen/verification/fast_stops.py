"""Emergency stops and power failures at 80 % of an axis' speed or more.

The brakes stop each axis independently, so that the robot comes to rest off its path. A controller
may refuse to continue then (ERR_PATHDIST). One seed decides where the robot starts, which way it
moves, when it is stopped, and which task runs when. Invariants:

- a robot at rest stays at rest, also when the program is started again;
- then the driver accepts a new trajectory from the current position and executes it to the last
  point.
"""

import random
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point, Position
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.testbench import FAILURES, Bench

FAST = 0.8
"""Share of an axis' speed limit."""
STEP = 0.004
"""s between two samples of the axes' speeds."""
BRAKES = (0.5, 1.0, 2.0)
"""Braking decelerations, in units of the axes' acceleration: no figure is public."""
ATTEMPTS = 20
"""Trajectories until one runs as fast as that."""


@dataclass(frozen=True, slots=True)
class FastStop:
    """The result of one stop at speed."""

    seed: int
    action: str
    share: float
    """Share of the fastest axis' speed limit at the moment of the stop."""
    off_path: float
    """m from the rest position to the point where the path continues, as the controller sees it."""
    from_main: bool
    """The operator had to start from main, as the robot was too far off or the driver asked."""
    finding: str
    log: tuple[str, ...] = ()


def fast_stop(bench: Bench, seed: int) -> FastStop:
    """Run one stop at speed on a new bench, with random choices from `seed`."""
    bench.controller.scheduler.draw_from(seed)
    chance = random.Random(f"{seed} fast stop")
    action = chance.choice(("e-stop", "power-loss"))
    motion = bench.controller.motion
    motion.settings = replace(motion.settings, quick_factor=chance.choice(BRAKES))
    share, off_path, from_main, finding = 0.0, 0.0, False, ""
    try:
        link, share = _at_speed(bench, chance)
        bench.controller.perform(action)
        bench.wait_until_standing(10)
        off_path, _ = bench.motion_group.off_path
        from_main = _start_again(bench, chance)
        _goes_on(bench, chance, link if action == "e-stop" else None)
        bench.assert_healthy()
    except FAILURES as error:
        finding = f"{action} at {share:.0%}, {off_path * 1000:.1f} mm off the path: {error}"
    return FastStop(
        seed, action, share, off_path, from_main, finding, bench.log() if finding else ()
    )


def _at_speed(bench: Bench, chance: random.Random) -> tuple[RawLink, float]:
    """Return the client of a fast motion, and the share of its axis' speed."""
    link = bench.motion()
    for _ in range(ATTEMPTS):
        bench.motion_group.jump(_anywhere(bench, chance))
        bench.run(0.1)
        points = _way(bench, chance)
        bench.start_motion(link, points)
        bench.run(chance.uniform(0, sum(seconds for _, seconds in points[1:])))
        while not bench.standing:
            before = bench.position
            bench.run(STEP)
            share = _share(bench, before, bench.position)
            if share >= FAST:
                return link, share
        bench.run(1)
    raise CheckFailed(f"no axis ran at {FAST:.0%} of its speed in {ATTEMPTS} trajectories")


def _anywhere(bench: Bench, chance: random.Random) -> Position:
    return tuple(
        joint.lower + chance.uniform(0.05, 0.95) * (joint.upper - joint.lower)
        for joint in bench.group.joints
    )


def _way(bench: Bench, chance: random.Random) -> list[Point]:
    """Return points from here, each as far as its fastest axis allows.

    The axis runs at nearly full speed.
    """
    points = [(bench.position, 10.0)]
    for _ in range(chance.randrange(1, 4)):
        current, target = points[-1][0], _anywhere(bench, chance)
        seconds = max(
            abs(b - a) / (0.97 * joint.speed) + joint.speed / joint.acceleration
            for a, b, joint in zip(current, target, bench.group.joints, strict=True)
        )
        points.append((target, max(seconds, 1.1 * bench.tcp_seconds(current, target))))
    return points


def _share(bench: Bench, before: Sequence[float], after: Sequence[float]) -> float:
    """Return the speed of the fastest axis as a share of its limit."""
    joints = zip(bench.group.joints, before, after, strict=True)
    return max(abs(b - a) / STEP / joint.speed for joint, a, b in joints)


def _start_again(bench: Bench, chance: random.Random) -> bool:
    """Restart as an operator does; True if that needed PP to main."""
    last = bench.last_event
    bench.run(chance.uniform(0.2, 4))
    bench.start_again()
    refused = bench.controller.task(bench.group.task).state != "running"
    why = "the program was started, and no client has asked for motion"
    if not refused:
        # The supervisor reports it 2 s after the start.
        bench.assert_at_rest(chance.uniform(2.2, 4), why)
        refused = any("from main" in str(event) for event in bench.controller.log.since(last))
    if refused:
        for action in ("stop", "pp-to-main"):
            bench.controller.perform(action)
        bench.start_again()
        bench.assert_at_rest(chance.uniform(2, 4), why)
    return refused


def _goes_on(bench: Bench, chance: random.Random, link: RawLink | None) -> None:
    """Check that a new trajectory from here is executed.

    It uses the old connection or a new one.
    """
    if link is not None and (link.lost or chance.random() < 0.5):
        link.close(then=1.5)
        link = None
    points = bench.wave(4)
    since = bench.now
    (link or bench.motion()).send(bench.download(points))
    bench.arrives(points, since, 15)

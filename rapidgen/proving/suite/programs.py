"""Motion programs: moves to joints and poses, checked whole, executed as RAPID would."""

import random

from rapidgen.proving.behaviour import Theme
from rapidgen.proving.bench import Bench
from rapidgen.proving.model import Broken
from rapidgen.proving.programs import (
    Order,
    Programmer,
    by_hand,
    farthest,
    movement,
    orders,
)
from rapidgen.proving.track import Position

case = Theme("programs", needs="stream")

_SAME = 1e-5
"""m that the TCP may be away from the path of the same program in RAPID."""


@case("program-like-rapid", "a program moves as the same one written in RAPID", once=True)
def _like_rapid(bench: Bench) -> None:
    """On the same path, in the same time, with no stop point more."""
    chance = random.Random(7)
    client = Programmer(bench)
    for _ in range(6):
        program = orders(bench, 8, chance)
        home, since = bench.position, bench.now
        client.takes("a program", program)
        mine = _moved(bench, program, since)
        with bench.beside(by_hand(bench, program)) as other:
            other.motion_group.jump(home)
            theirs = _moved(other, program, 0.5)
        if abs(mine[0] - theirs[0]) > 0.02 * theirs[0]:
            raise Broken(f"a program took {mine[0]:.3f} s, {theirs[0]:.3f} s when written in RAPID")
        for one, way in ((mine[1], theirs[1]), (theirs[1], mine[1])):
            far = farthest(bench, one, way)
            if far > _SAME:
                raise Broken(f"a program is {far * 1000:.3f} mm off the way of the same in RAPID")


def _moved(bench: Bench, program: list[Order], since: float) -> tuple[float, list[Position]]:
    """s of movement and where the robot was, until it stands at the end."""
    bench.wait_until_at(program[-1].joints, 60)
    bench.run(0.3)
    return movement([sample for sample in bench.track if sample[0] >= since])

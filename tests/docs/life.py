"""The picture of a trajectory's life in docs/develop/architecture.md, drawn from one that lives.

`python -m tests.docs.life` draws it again: a client and the driver of an IRB 120 on the virtual
clock; what passes between them, and the routines of the driver that work for the first time then.
"""

from collections import Counter

from rapidgen.client import AsyncRobot, Trajectory
from rapidgen.client.address import Address
from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.generate import build, make_system
from rapidgen.testing.asyncio_clock import VirtualLoop
from rapidgen.wire.simple_message.codec import decode
from rapidgen.wire.simple_message.frames import FrameSplitter
from tests.docs.drawn import Picture

PICTURE = Picture(
    "<!-- drawn by tests/docs/life.py -->\n```text\n", "```\n<!-- the life is drawn -->\n"
)
IDLE = 1.0
"""s in which everything that goes on all the time is seen."""
WIDTH = 100


class Seen:
    """What happens, in order, but for what happens all the time."""

    def __init__(self) -> None:
        self.events: list[tuple[str, str]] = []
        self.known: set[tuple[str, str]] = set()
        self.listens = False

    def statement(self, task, routine, _) -> None:
        """A routine of a task, the first time."""
        self._once(task, f"{routine.module.name}: {routine.name}")

    def news(self, events) -> None:
        """Bytes between the client and a task, as messages; each kind in turn once."""
        splitter = FrameSplitter()
        splitter.feed(events.data)
        kinds = []
        while (frame := splitter.next()) is not None:
            kinds.append(type(decode(frame)).__name__)
        arrow = {"in": "──▶", "out": "◀──"}.get(events.change)
        if arrow and kinds:
            counts = Counter(kinds)
            text = ", ".join(k if n == 1 else f"{k} × {n}" for k, n in counts.items())
            self._once(events.task, f"client {arrow} {text}")

    def _once(self, task: str, text: str) -> None:
        if (task, text) not in self.known:
            self.known.add((task, text))
            if self.listens:
                self.events.append((task, text))


def watched() -> list[tuple[str, str]]:
    """(task, what) of a trajectory of four points, from the call to its result."""
    config, seen = load_config("irb120"), Seen()
    group = config.groups[0]
    system = make_system(config, build(config))
    with VirtualController(system, config.groups, autostart=False, tracing=True) as controller:
        controller.statements.listen(seen.statement)
        controller.sockets.listeners.append(seen.news)
        controller.start_program()
        controller.run_for(IDLE)
        loop = VirtualLoop(controller)
        address = Address("controller", group.ports.motion, group.ports.state)
        loop.run_until_complete(_live(AsyncRobot(config, address=address), controller, seen))
        loop.run_until_complete(loop.shutdown_asyncgens())
        loop.close()
    return seen.events


async def _live(robot, controller, seen) -> None:
    async with robot:
        await robot.wait_until(lambda _: controller.now > 2 * IDLE, timeout=3 * IDLE)
        here = list(robot.state.joints)
        target = [here[0] + 0.2, *here[1:]]
        points = [here, target, here, target]
        seen.listens = True
        seen.events.append(("client", "core/checks.py: every point within limits and speeds"))
        execution = await robot.execute(
            Trajectory.from_points(points, seconds=1, names=robot.group.names)
        )
        seen.events.append(("client", "execute() returns"))
        await execution.result()
        seen.events.append(("client", "result() returns: the robot stands"))
        seen.listens = False


def draw() -> str:
    """The picture."""
    lines, last = [], ""
    for task, text in watched():
        if task != last:
            lines.append("─" * WIDTH)
        lines.append(f"{task if task != last else '':<16}{text}")
        last = task
    return "\n".join([*lines, "─" * WIDTH, ""])


if __name__ == "__main__":
    PICTURE.put(draw())

"""A case of the trial with ROS nodes, and its results."""

import time
from collections.abc import Callable
from dataclasses import dataclass

from rapidgen.wire.simple_message import spec
from tools.interop.ros import until
from tools.interop.ros_cell import TRUE, Cell

FIVE = ([0.0], [0.125], [0.25, 0.125], [0.5, 0.25, 0, 0, 0, 0.125], [0.5, 0.25, -0.5, 0, 0, 0.25])
ACTIVE, PREEMPTED, SUCCEEDED, ABORTED = 1, 2, 3, 4
"""actionlib_msgs/GoalStatus."""


@dataclass(frozen=True)
class Case:
    """A case and its controllers."""

    title: str
    run: Callable[[Cell, "Findings"], None]
    robot: str = "irb120"
    options: tuple[str, ...] = ()
    coupled: bool = False
    faults: str = ""
    """A plan of faults, as `rapidgen sim --faults` reads it."""
    upstream: bool = True
    """True if abb_driver's modules support it."""


CASES: dict[str, Case] = {}


def case(title: str, **what: object):
    """Add a function to CASES."""

    def enter(function):
        CASES[function.__name__] = Case(title, function, **what)
        return function

    return enter


class Findings:
    """Results of a case: sentences, each with its check result."""

    def __init__(self) -> None:
        self.lines: list[tuple[bool, str]] = []

    def tell(self, text: str) -> None:
        """Record a sentence without a check."""
        self.lines.append((True, text))

    def must(self, holds: object, text: str) -> None:
        """Record a check."""
        self.lines.append((bool(holds), text))

    def succeeds(self, client, text: str) -> None:
        """Check that the goal of an action succeeds."""
        self.must(Cell.ended(client, 25) and client.get_state() == SUCCEEDED, text)

    def stands(self, cell: Cell, begin: float) -> None:
        """Check that the robot stands within 1 s from `begin`."""
        until(cell.sim.standing, 15, "it never stood")
        took = time.monotonic() - begin
        self.must(took < 1, f"the robot stands {took:.2f} s later")

    def five(self, cell: Cell, text: str, seconds: float = 25) -> None:
        """Check that FIVE by topic is executed."""
        cell.publish(cell.trajectory(FIVE))
        self.must(cell.arrives(FIVE[-1], seconds), text)

    def ramped(self, cell: Cell, text: str, *, to: float = 0.0) -> None:
        """Check that joint 1 gets to a position from the current one."""
        cell.publish(cell.ramp(1, to=to))
        self.must(cell.arrives([to], 25), text)

    def reports(self, cell: Cell, reason: spec.Reason, joint: int = 0, *, error=True) -> None:
        """Check that error_code reports the reason.

        With `error` in_error must be set, too.
        """
        now = cell.next_status()
        self.must(
            now.error_code == code(reason, joint) and (now.in_error.val == TRUE or not error),
            f"in_error {now.in_error.val}, error_code {now.error_code}",
        )

    def __str__(self) -> str:
        return "; ".join(text if good else f"NOT: {text}" for good, text in self.lines)


def code(reason: spec.Reason, joint: int = 0) -> int:
    """Return error_code of STATUS."""
    return spec.error_code(reason, joint)


def begin_moving(cell: Cell) -> None:
    """Start joint 1 to 1.2 rad in 6 s, and wait one second."""
    cell.publish(cell.ramp(6, to=1.2))
    cell.wait_moving(15)
    time.sleep(1)

"""Long runs: clocks that overflow, and interrupts that are lost."""

from rapidgen.runtime.builtins.system import StopWatch
from rapidgen.runtime.errors import RapidError
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import Instruction, wrapped
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.testbench import Bench

case = SuiteGroup("lasting")

_DAYS = 10.0
"""s that replace the 49 days of a clock."""


def _short_clocks(bench: Bench) -> None:
    """Make every clock of the driver overflow after `_DAYS`."""

    def wrap(as_before: Instruction) -> Instruction:
        def read(*arguments: object) -> object:
            watch = next(each for each in arguments if isinstance(each, StopWatch))
            if watch.read(bench.controller.scheduler.now) > _DAYS * 1e9:
                raise RapidError("ERR_OVERFLOW")
            return as_before(*arguments)

        return read

    for task in bench.controller.rapid_tasks.values():
        wrapped(task, "ClkRead", wrap)


@case("days", "what has not happened for longer than a clock counts", "R3", background=True)
def _days(bench: Bench) -> None:
    """Wait 50 days without client, heartbeat, rejection and halt; then check."""
    _short_clocks(bench)
    link = bench.motion()
    bench.run(_DAYS + 2)
    for _ in range(2):
        if bench.group.ports.control:
            control = bench.control()
            for _ in range(2):
                bench.run(0.3)
                reply = control.ask(messages.RawHeartbeat(1.0))
                if not isinstance(reply, messages.RawHeartbeatReply):
                    raise CheckFailed(
                        f"after days without a client HEARTBEAT is answered by {reply}"
                    )
            control.ask(messages.RawHeartbeat(0))
            bench.run(_DAYS + 2)
            control.stop()
            control.close()
        bench.start_motion(link, bench.wave(8), 0.3)
        link.stop()
        bench.wait_until_standing(3)
        bench.assert_moves_through(link, bench.wave(3))
        bench.start_motion(link, bench.wave(8), 0.3)
        bench.controller.perform("stop")
        bench.run(_DAYS + 2)
        bench.controller.perform("start")
        bench.assert_at_rest(2, "it was stopped for days")
        bench.assert_moves_through(link, bench.wave(3))
        bench.assert_healthy()


@case("unheard", "interrupts that a stopped program misses", "R7a", background=True)
def _lost_interrupts(bench: Bench) -> None:
    """Stop and PP to main in a motion, Start much later: motion works."""
    link = bench.motion()
    for steps in (("stop", "pp-to-main"), ("stop",), ("e-stop", "pp-to-main")):
        bench.start_motion(link, bench.wave(8), 0.4)
        for step in steps:
            bench.controller.perform(step)
            bench.run(0.01)
        bench.run(11)
        bench.start_again()
        bench.assert_at_rest(2, f"{', '.join(steps)}, and Start")
        bench.assert_healthy()
        bench.assert_moves_through(link, bench.wave(3))
